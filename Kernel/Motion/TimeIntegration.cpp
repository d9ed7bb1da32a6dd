#include "Kernel/Motion/TimeIntegration.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Contacts/ParticleSum.h"
#include "Kernel/Parallel.h"
#include "Kernel/Species/Field.h"

namespace pendular {
namespace {

template <bool hasSpin, bool hasContactTorque>
class Loops {
public:
    using Grains = ParticleStore;
    static constexpr std::size_t grainsWorthAThread = 512;

    /// Moves all grains by a step; returns the largest squared displacement (m^2), infinite
    /// if one is not a number.
    static double begin(Grains& grains, double step, int threads, const Integrator& scheme) {
        if (scheme.remembersEarlier()) grains.earlier.resize(grains.size());  // of the first grains in a run
        return largestOfAll(grains, threads, scheme, [&]<bool remembers>(std::size_t k) {
            return move<remembers>(grains, step, scheme, k);
        });
    }
    /// The new accelerations, and with them the velocities at the end of the step.
    static void finish(Grains& grains, const ContactStore& store, const Vector<double>& gravity, double step,
                       int threads, const Integrator& scheme) {
        largestOfAll(grains, threads, scheme, [&, weight = fourOf(gravity)]<bool remembers>(std::size_t k) {
            accelerate<remembers>(grains, store, weight, step, scheme, k);
            return 0.0;
        });
    }
    static double finishAndBegin(Grains& grains, const ContactStore& store, const Vector<double>& gravity,
                                 double step, double nextStep, int threads, const Integrator& scheme) {
        return largestOfAll(grains, threads, scheme,
                            [&, weight = fourOf(gravity)]<bool remembers>(std::size_t k) {
                                accelerate<remembers>(grains, store, weight, step, scheme, k);
                                return move<remembers>(grains, nextStep, scheme, k);
                            });
    }

    /// Undoes begin, up to round-off.
    static void takeBack(Grains& grains, double step, const Integrator& scheme) {
        for (std::size_t k = 0; k < grains.size(); ++k) {
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
        for (std::size_t k = 0; k < grains.size(); ++k) grains.earlier.push_back(lastOf(grains, k));
    }

private:
    using Earlier = EarlierAcceleration;

    static Earlier lastOf(const Grains& grains, std::size_t k) {
        Earlier last{.acceleration = grains.acceleration[k]};
        if constexpr (hasSpin) last.angularAcceleration = grains.rotation[k].angularAcceleration;
        return last;
    }

    /// The largest of function.operator()<remembers>(k) over all grains k.
    template <class Function>
    static double largestOfAll(const Grains& grains, int threads, const Integrator& scheme,
                               const Function& function) {
        std::vector<double> largest(static_cast<std::size_t>(threads), 0);
        const auto ofAll = [&]<bool remembers>() {
            inParts(
                grains.size(), threads,
                [&](int part, std::size_t first, std::size_t end) {
                    const Function own = function;
                    double most = 0;
                    for (std::size_t k = first; k < end; ++k)
                        most = std::max(most, own.template operator()<remembers>(k));
                    largest[static_cast<std::size_t>(part)] = most;
                },
                grainsWorthAThread);
        };
        scheme.remembersEarlier() ? ofAll.template operator()<true>() : ofAll.template operator()<false>();
        return *std::max_element(largest.begin(), largest.end());
    }

    /// Returns the squared displacement (m^2).
    template <bool remembers>
    [[gnu::always_inline]] static double move(Grains& grains, double step, const Integrator& scheme,
                                              std::size_t k) {
        const double position = scheme.position0 * step, velocity = scheme.velocity0 * step;
        TranslationRecord& grain = grains.translation[k];
        const Four before = loadFour(grain.velocity), place = loadFour(grain.position);
        const Four acceleration = fourOf(grains.acceleration[k]);
        Four mean = before + position * acceleration;
        if constexpr (remembers) mean += (scheme.position1 * step) * fourOf(grains.earlier[k].acceleration);
        const Four shift = step * mean;
        storeVector(grain.position, place + shift, place);
        Four after = before + velocity * acceleration;
        if constexpr (remembers) after += (scheme.velocity1 * step) * fourOf(grains.earlier[k].acceleration);
        storeVector(grain.velocity, after, before);
        if constexpr (hasSpin) {
            RotationRecord& turning = grains.rotation[k];
            const Four spin = loadFour(turning.spin);
            Four next = spin + velocity * loadFour(turning.angularAcceleration);
            if constexpr (remembers)
                next += (scheme.velocity1 * step) * fourOf(grains.earlier[k].angularAcceleration);
            storeVector(turning.spin, next, spin);
        }
        const double shift2 = squaredNorm(vectorOf(shift));
        return std::isnan(shift2) ? infinity : shift2;
    }

    template <bool remembers>
    [[gnu::always_inline]] static void accelerate(Grains& grains, const ContactStore& store, Four gravity,
                                                  double step, const Integrator& scheme, std::size_t k) {
        TranslationRecord& grain = grains.translation[k];
        const auto sum = sumContacts<hasSpin, hasContactTorque>(store, k, grain.radius);
        const Four weight = grain.inverseMass == 0 ? Four{} : gravity;
        const Four acceleration = grain.inverseMass * sum.force + weight;
        const Earlier last = remembers ? lastOf(grains, k) : Earlier{};
        const double corrector = scheme.corrector * step;
        const Four velocity = loadFour(grain.velocity);
        Four after = velocity + corrector * (acceleration - scheme.now * fourOf(grains.acceleration[k]));
        if constexpr (remembers)
            after += (corrector * scheme.earlier) * fourOf(grains.earlier[k].acceleration);
        storeVector(grain.velocity, after, velocity);
        grains.acceleration[k] = vectorOf(acceleration);
        if constexpr (hasSpin) {
            RotationRecord& turning = grains.rotation[k];
            const Four spin = loadFour(turning.spin), before = loadFour(turning.angularAcceleration);
            const Four angular = turning.inverseInertia * sum.torque;
            Four next = spin + corrector * (angular - scheme.now * before);
            if constexpr (remembers)
                next += (corrector * scheme.earlier) * fourOf(grains.earlier[k].angularAcceleration);
            storeVector(turning.spin, next, spin);
            storeVector(turning.angularAcceleration, angular, before);
        }
        if constexpr (remembers) grains.earlier[k] = last;
    }
};

/// Calls function.template operator()<Loops<...>>().
template <class Function>
auto withLoops(bool hasSpin, bool hasContactTorque, Function&& function) {
    if (!hasSpin) return function.template operator()<Loops<false, false>>();
    if (!hasContactTorque) return function.template operator()<Loops<true, false>>();
    return function.template operator()<Loops<true, true>>();
}

}  // namespace

double TimeIntegration::begin(ParticleStore& grains, double step, int threads, const Integrator& scheme) {
    return withLoops(grains.hasSpin, false,
                     [&]<class L>() { return L::begin(grains, step, threads, scheme); });
}
void TimeIntegration::finish(ParticleStore& grains, const ContactStore& store, const Vector<double>& gravity,
                             double step, int threads, const Integrator& scheme) {
    withLoops(grains.hasSpin, store.memory.getLayout().hasContactTorque,
              [&]<class L>() { L::finish(grains, store, gravity, step, threads, scheme); });
}
double TimeIntegration::finishAndBegin(ParticleStore& grains, const ContactStore& store,
                                       const Vector<double>& gravity, double step, double nextStep,
                                       int threads, const Integrator& scheme) {
    return withLoops(grains.hasSpin, store.memory.getLayout().hasContactTorque, [&]<class L>() {
        return L::finishAndBegin(grains, store, gravity, step, nextStep, threads, scheme);
    });
}
void TimeIntegration::takeBack(ParticleStore& grains, double step, const Integrator& scheme) {
    withLoops(grains.hasSpin, false, [&]<class L>() { L::takeBack(grains, step, scheme); });
}
void TimeIntegration::start(ParticleStore& grains, const Integrator& scheme) {
    withLoops(grains.hasSpin, false, [&]<class L>() { L::start(grains, scheme); });
}

}  // namespace pendular
