#include "Kernel/Core/Motion/TimeIntegration.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "Kernel/Core/Contacts/ParticleSum.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {
namespace {

/// The columns of the grains that move, as places in memory: a loop keeps these in registers, where it would
/// ask a ParticleStore for them again at each grain.
struct Columns {
    TranslationRecord* translation;
    RotationRecord* rotation;
    Vector<double>* acceleration;
    EarlierAcceleration* earlier;
    const HeldBits* held;

    explicit Columns(ParticleStore& grains)
        : translation(grains.translation.data()),
          rotation(grains.rotation.data()),
          acceleration(grains.acceleration.data()),
          earlier(grains.earlier.data()),
          held(grains.held.data()) {}
};

template <bool hasSpin, bool hasContactTorque, bool imagesMove>
class Loops {
public:
    using Grains = ParticleStore;
    static constexpr std::size_t grainsWorthAThread = 512, grainsOfAShare = 512;

    /// Moves all grains by a step; returns the largest squared displacement (m^2), infinite
    /// if one is not a number.
    static double begin(Grains& grains, double step, int threads, const Integrator& scheme,
                        const PeriodicBox& box) {
        if (scheme.remembersEarlier()) grains.earlier.resize(grains.size());  // of the first grains in a run
        return largestOfAll(grains, threads, scheme,
                            [&, columns = Columns(grains)]<bool remembers, bool isHeld>(std::size_t k) {
                                Motion motion = load(columns, k);
                                const double shift2 = move<remembers>(columns, step, scheme, k, box, motion);
                                storeVelocity(columns, k, motion);
                                return shift2;
                            });
    }
    /// The new accelerations, and with them the velocities at the end of the step.
    static void finish(Grains& grains, const ContactStore& store, const Vector<double>& gravity, double step,
                       int threads, const Integrator& scheme) {
        largestOfAll(grains, threads, scheme,
                     [&, columns = Columns(grains), sums = Sums(store),
                      weight = fourOf(gravity)]<bool remembers, bool isHeld>(std::size_t k) {
                         Motion motion = load(columns, k);
                         accelerate<remembers, isHeld>(columns, sums, weight, step, scheme, k, motion);
                         storeVelocity(columns, k, motion);
                         storeAcceleration(columns, k, motion);
                         return 0.0;
                     });
    }
    static double finishAndBegin(Grains& grains, const ContactStore& store, const Vector<double>& gravity,
                                 double step, double nextStep, int threads, const Integrator& scheme,
                                 const PeriodicBox& box) {
        return largestOfAll(grains, threads, scheme,
                            [&, columns = Columns(grains), sums = Sums(store),
                             weight = fourOf(gravity)]<bool remembers, bool isHeld>(std::size_t k) {
                                Motion motion = load(columns, k);
                                accelerate<remembers, isHeld>(columns, sums, weight, step, scheme, k, motion);
                                storeAcceleration(columns, k, motion);
                                const double shift2 =
                                    move<remembers>(columns, nextStep, scheme, k, box, motion);
                                storeVelocity(columns, k, motion);
                                return shift2;
                            });
    }

    /// Undoes begin, up to round-off.
    static void takeBack(Grains& grains, double step, const Integrator& scheme) {
        for (std::size_t k = 0; k < grains.ownSize(); ++k) {
            TranslationRecord& grain = grains.translation[k];
            const Vector<double>& now = grains.acceleration[k];
            const Earlier before = scheme.remembersEarlier() ? grains.earlier[k] : Earlier{};
            grain.velocity -= step * (scheme.velocity0 * now + scheme.velocity1 * before.acceleration);
            grain.position -=
                step *
                (grain.velocity + step * (scheme.position0 * now + scheme.position1 * before.acceleration));
            if constexpr (hasSpin)
                grains.rotation[k].spin -= step * (scheme.velocity0 * grains.rotation[k].angularAcceleration +
                                                   scheme.velocity1 * before.angularAcceleration);
        }
    }

    /// At the start of a run there is no step before the first.
    static void start(Grains& grains, const Integrator& scheme) {
        grains.earlier.clear();
        if (!scheme.remembersEarlier()) return;
        for (std::size_t k = 0; k < grains.size(); ++k) grains.earlier.push_back(lastOf(Columns(grains), k));
    }

private:
    using Earlier = EarlierAcceleration;
    using Sums = SumTaker<hasSpin, hasContactTorque>;

    static Earlier lastOf(const Columns& grains, std::size_t k) {
        Earlier last{.acceleration = grains.acceleration[k]};
        if constexpr (hasSpin) last.angularAcceleration = grains.rotation[k].angularAcceleration;
        return last;
    }

    /// The largest of function.operator()<remembers, isHeld>(k) over some grains, with the function inlined:
    /// by itself g++ inlines none of this size that is called from two places. Within the loop over shares it
    /// would keep ten of its vectors in memory.
    template <bool remembers, bool isHeld, class Function, class PlaceOf>
    [[gnu::flatten, gnu::noinline]] static double largestOf(const Function& function, std::size_t first,
                                                            std::size_t end, const PlaceOf& placeOf) {
        const Function own = function;
        double most = 0;
        for (std::size_t k = first; k < end; ++k)
            most = std::max(most, own.template operator()<remembers, isHeld>(placeOf(k)));
        return most;
    }

    /// The largest value of the function over all grains.
    template <class Function>
    static double largestOfAll(const Grains& grains, int threads, const Integrator& scheme,
                               const Function& function) {
        // Of each thread; of one alone without memory that each step would ask the system for.
        double alone = 0;
        std::vector<double> ofThreads(threads > 1 ? static_cast<std::size_t>(threads) : 0);
        const std::span<double> largest = threads > 1 ? std::span(ofThreads) : std::span(&alone, 1);
        // Grains of rigid bodies are moved with these.
        const bool hasBodies = !grains.bodies.empty();
        const std::vector<std::uint32_t>& own = grains.bodies.ownPlaces();
        const auto ofAll = [&]<bool remembers, bool isHeld>() {
            inShares(
                hasBodies ? own.size() : grains.ownSize(), threads,
                [&](int part, std::size_t first, std::size_t end) {
                    const double most =
                        hasBodies
                            ? largestOf<remembers, isHeld>(
                                  function, first, end, [&](std::size_t k) -> std::size_t { return own[k]; })
                            : largestOf<remembers, isHeld>(function, first, end,
                                                           [](std::size_t k) { return k; });
                    double& ofPart = largest[static_cast<std::size_t>(part)];
                    ofPart = std::max(ofPart, most);
                },
                grainsWorthAThread, shareOf(grainsOfAShare));
        };
        const auto ofKind = [&]<bool isHeld>() {
            scheme.remembersEarlier() ? ofAll.template operator()<true, isHeld>()
                                      : ofAll.template operator()<false, isHeld>();
        };
        grains.held.empty() ? ofKind.template operator()<false>() : ofKind.template operator()<true>();
        return *std::ranges::max_element(largest);
    }

    /// How a grain moves, in registers; lane 3 is the number behind the vector in its record.
    struct Motion {
        Four velocity, acceleration;         // m/s, m/s^2
        Four spin{}, angularAcceleration{};  // rad/s, rad/s^2
    };
    [[gnu::always_inline]] static Motion load(const Columns& grains, std::size_t k) {
        Motion motion{loadFour(grains.translation[k].velocity), fourOf(grains.acceleration[k])};
        if constexpr (hasSpin) {
            motion.spin = loadFour(grains.rotation[k].spin);
            motion.angularAcceleration = loadFour(grains.rotation[k].angularAcceleration);
        }
        return motion;
    }
    /// Only what a part of a step changes: not the numbers behind the vectors.
    [[gnu::always_inline]] static void storeVelocity(const Columns& grains, std::size_t k,
                                                     const Motion& now) {
        storeVector(grains.translation[k].velocity, now.velocity, loadFour(grains.translation[k].velocity));
        if constexpr (hasSpin)
            storeVector(grains.rotation[k].spin, now.spin, loadFour(grains.rotation[k].spin));
    }
    [[gnu::always_inline]] static void storeAcceleration(const Columns& grains, std::size_t k,
                                                         const Motion& now) {
        grains.acceleration[k] = vectorOf(now.acceleration);
        if constexpr (hasSpin) {
            Vector<double>& angular = grains.rotation[k].angularAcceleration;
            storeVector(angular, now.angularAcceleration, Four{});
        }
    }

    /// @param free 1 along an axis that is free, else 0
    static Four freePart(Four v, const Vector<double>& free) { return v * fourOf(free); }

    /// Moves a grain, and its motion to the start of the forces; returns the squared displacement (m^2).
    template <bool remembers>
    [[gnu::always_inline]] static double move(const Columns& grains, double step, const Integrator& scheme,
                                              std::size_t k, const PeriodicBox& box, Motion& motion) {
        const double position = scheme.position0 * step, velocity = scheme.velocity0 * step;
        TranslationRecord& grain = grains.translation[k];
        const Four place = loadFour(grain.position);
        Four mean = motion.velocity + position * motion.acceleration;
        if constexpr (remembers) mean += (scheme.position1 * step) * fourOf(grains.earlier[k].acceleration);
        const Four shift = step * mean;
        storeVector(grain.position, place + shift, place);
        motion.velocity += velocity * motion.acceleration;
        if constexpr (remembers)
            motion.velocity += (scheme.velocity1 * step) * fourOf(grains.earlier[k].acceleration);
        if constexpr (hasSpin) {
            motion.spin += velocity * motion.angularAcceleration;
            if constexpr (remembers)
                motion.spin += (scheme.velocity1 * step) * fourOf(grains.earlier[k].angularAcceleration);
        }
        Vector<double> seen = vectorOf(shift);
        if constexpr (imagesMove)
            if (grain.radius > 0) seen -= step * box.flowAt(vectorOf(place));  // else a gap, at rest
        const double shift2 = squaredNorm(seen);
        return std::isnan(shift2) ? infinity : shift2;
    }

    /// @tparam isHeld some grains are held along some axes
    template <bool remembers, bool isHeld>
    [[gnu::always_inline]] static void accelerate(const Columns& grains, const Sums& sums, Four gravity,
                                                  double step, const Integrator& scheme, std::size_t k,
                                                  Motion& motion) {
        const TranslationRecord& grain = grains.translation[k];
        const auto sum = sums.take(k, grain.radius);
        const Four weight = grain.inverseMass == 0 ? Four{} : gravity;
        Four acceleration = grain.inverseMass * sum.force + weight;
        if constexpr (isHeld) acceleration = freePart(acceleration, grains.held[k].freeAlong());
        const Earlier last = remembers ? lastOf(grains, k) : Earlier{};
        const double corrector = scheme.corrector * step;
        motion.velocity += corrector * (acceleration - scheme.now * motion.acceleration);
        if constexpr (remembers)
            motion.velocity += (corrector * scheme.earlier) * fourOf(grains.earlier[k].acceleration);
        motion.acceleration = acceleration;
        if constexpr (hasSpin) {
            Four angular = grains.rotation[k].inverseInertia * sum.torque;
            if constexpr (isHeld) angular = freePart(angular, grains.held[k].freeAbout());
            motion.spin += corrector * (angular - scheme.now * motion.angularAcceleration);
            if constexpr (remembers)
                motion.spin += (corrector * scheme.earlier) * fourOf(grains.earlier[k].angularAcceleration);
            motion.angularAcceleration = angular;
        }
        if constexpr (remembers) grains.earlier[k] = last;
    }
};

/// Calls function.template operator()<Loops<...>>().
template <class Function>
auto withLoops(bool hasSpin, bool hasContactTorque, bool imagesMove, Function&& function) {
    const auto with = [&]<bool moving>() {
        if (!hasSpin) return function.template operator()<Loops<false, false, moving>>();
        if (!hasContactTorque) return function.template operator()<Loops<true, false, moving>>();
        return function.template operator()<Loops<true, true, moving>>();
    };
    return imagesMove ? with.template operator()<true>() : with.template operator()<false>();
}

}  // namespace

double TimeIntegration::begin(ParticleStore& grains, double step, int threads, const Integrator& scheme,
                              const PeriodicBox& box) {
    grains.bodies.refresh(grains);
    return withLoops(grains.hasSpin, false, box.imagesMove,
                     [&]<class L>() { return L::begin(grains, step, threads, scheme, box); });
}
/// Grains of rigid bodies are not moved here. Those of other ranks are not, either: nobody needs their
/// totals.
static void noteTaken(const ParticleStore& grains, const ContactStore& store) {
    if (!grains.bodies.empty() || !store.keepsTotals) return;
    for (std::size_t ghost = grains.ownSize(); ghost < grains.size(); ++ghost)
        static_cast<void>(store.totals.taker().take(ghost));
    store.totals.allAreTaken();
}
void TimeIntegration::finish(ParticleStore& grains, const ContactStore& store, const Vector<double>& gravity,
                             double step, int threads, const Integrator& scheme) {
    grains.bodies.refresh(grains);
    withLoops(grains.hasSpin, store.memory.getLayout().hasContactTorque, false,
              [&]<class L>() { L::finish(grains, store, gravity, step, threads, scheme); });
    noteTaken(grains, store);
}
double TimeIntegration::finishAndBegin(ParticleStore& grains, const ContactStore& store,
                                       const Vector<double>& gravity, double step, double nextStep,
                                       int threads, const Integrator& scheme, const PeriodicBox& box) {
    grains.bodies.refresh(grains);
    const double shift2 =
        withLoops(grains.hasSpin, store.memory.getLayout().hasContactTorque, box.imagesMove, [&]<class L>() {
            return L::finishAndBegin(grains, store, gravity, step, nextStep, threads, scheme, box);
        });
    noteTaken(grains, store);
    return shift2;
}
void TimeIntegration::takeBack(ParticleStore& grains, double step, const Integrator& scheme) {
    withLoops(grains.hasSpin, false, false, [&]<class L>() { L::takeBack(grains, step, scheme); });
}
void TimeIntegration::renewAccelerations(ParticleStore& grains, const ContactStore& store,
                                         const Vector<double>& gravity,
                                         std::span<const std::uint32_t> places) {
    for (const std::uint32_t at : places) {
        if (!grains.isFree(at)) continue;
        const TranslationRecord& grain = grains.translation[at];
        const ContactSum sum = contactSum(store, at, grain.radius);
        const HeldBits held = grains.heldAt(at);
        grains.acceleration[at] = held.partAlong(grain.inverseMass * sum.force + gravity);
        if (grains.hasSpin)
            grains.rotation[at].angularAcceleration =
                held.partAbout(grains.rotation[at].inverseInertia * sum.torque);
    }
}
void TimeIntegration::start(ParticleStore& grains, const Integrator& scheme) {
    grains.remembersEarlier = scheme.remembersEarlier();
    grains.bodies.startEarlier(scheme.remembersEarlier());
    withLoops(grains.hasSpin, false, false, [&]<class L>() { L::start(grains, scheme); });
}

}  // namespace pendular
