#include "Kernel/Features/RigidBodies/RigidBodyMotion.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "Kernel/Core/Contacts/ParticleSum.h"
#include "Kernel/Features/RigidBodies/SingleBodyMotion.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

/// A Four of each of eight bodies.
struct EightFours {
    Four of[Pack::lanes];
    Four operator[](std::size_t lane) const { return of[lane]; }
};
[[gnu::always_inline]] inline EightFours foursOf(const Pack& a, const Pack& b, const Pack& c, const Pack& d) {
    alignas(64) EightFours fours;
    storeRecords(reinterpret_cast<double*>(fours.of), std::array{a, b, c, d});
    return fours;
}
[[gnu::always_inline]] inline EightFours foursOf(const Vector<Pack>& v, const Pack& behind) {
    return foursOf(v.x, v.y, v.z, behind);
}

/// Eight bodies, one in each lane.
struct EightBodies {
    Pack mass;
    Vector<Pack> inertia, position, velocity, acceleration, momentum, torque;
    QuaternionOf<Pack> orientation;
    Pack largestFreeMass;

    static constexpr std::size_t record = sizeof(RigidBody) / sizeof(double);

    static EightBodies load(const RigidBodies& bodies, const std::uint32_t* index) {
        const double* base = &bodies[0].mass;
        const auto a = loadRecords<8>(base, record, index), b = loadRecords<8>(base + 8, record, index),
                   c = loadRecords<8>(base + 16, record, index);
        return {a[0],
                {a[1], a[2], a[3]},
                {a[4], a[5], a[6]},
                {a[7], b[0], b[1]},
                {b[2], b[3], b[4]},
                {b[5], b[6], b[7]},
                {c[0], c[1], c[2]},
                {c[3], {c[4], c[5], c[6]}},
                c[7]};
    }
    void store(RigidBodies& bodies, const std::uint32_t* index, int count) const {
        // Only what a step changes is stored: all but the mass and the moments, which are the first four
        // numbers. It goes in pieces as they come from registers: a longer load would wait for both of its
        // halves.
        constexpr std::size_t firstPart = 1;
        const std::array<EightFours, record / 4 - firstPart> parts{
            foursOf(position, velocity.x), foursOf({velocity.y, velocity.z, acceleration.x}, acceleration.y),
            foursOf({acceleration.z, momentum.x, momentum.y}, momentum.z), foursOf(torque, orientation.real),
            foursOf(orientation.imaginary, largestFreeMass)};
        for (int lane = 0; lane < count; ++lane) {
            Four* const to = reinterpret_cast<Four*>(&bodies[index[lane]].mass);
            for (std::size_t part = 0; part < parts.size(); ++part)
                to[firstPart + part] = parts[part][static_cast<std::size_t>(lane)];
        }
    }

    void begin(double step, const Integrator& scheme) {
        const Pack h = step, position0 = scheme.position0 * step, velocity0 = scheme.velocity0 * step;
        position += h * (velocity + position0 * acceleration);
        velocity += velocity0 * acceleration;
        orientation = turnedFreely(orientation, inertia, momentum + position0 * torque, h);
        momentum += velocity0 * torque;
    }
    void finish(const Vector<Pack>& force, const Vector<Pack>& newTorque, const Vector<double>& gravity,
                double step, const Integrator& scheme) {
        const Pack corrector = scheme.corrector * step, now = scheme.now;
        const Vector<Pack> newAcceleration =
            (1.0 / mass) * force + Vector<Pack>{gravity.x, gravity.y, gravity.z};
        velocity += corrector * (newAcceleration - now * acceleration);
        momentum += corrector * (newTorque - now * torque);
        acceleration = newAcceleration;
        torque = newTorque;
    }
};

/// The axes of eight bodies, which turn the arms of their grains.
struct EightAxes {
    EightFours x, y, z;

    explicit EightAxes(const Axes<Pack>& axes)
        : x(foursOf(axes.x, 0)), y(foursOf(axes.y, 0)), z(foursOf(axes.z, 0)) {}
    [[gnu::always_inline]] Four turn(std::size_t lane, const Vector<double>& v) const {
        return v.x * x[lane] + v.y * y[lane] + v.z * z[lane];
    }
};

/// What the grains of eight bodies need to know of them.
struct EightInSpace {
    EightAxes axes;
    EightFours position, velocity, spin;

    explicit EightInSpace(const EightBodies& b) : EightInSpace(b, Axes<Pack>(b.orientation)) {}
    EightInSpace(const EightBodies& b, const Axes<Pack>& of)
        : axes(of),
          position(foursOf(b.position, 0)),
          velocity(foursOf(b.velocity, 0)),
          spin(foursOf(RigidBody::spinOf(of, b.inertia, b.momentum), 0)) {}
};

template <bool hasSpin, bool hasContactTorque>
class BodyLoops {
public:
    static constexpr std::size_t lanes = Pack::lanes;
    static constexpr std::size_t groupsWorthAThread = 32, groupsOfAShare = 32;
    static constexpr std::size_t grainsAhead = 8;  // whose contacts are asked for before

    BodyLoops(ParticleStore& store, const Integrator& integrator, const PeriodicBox& periodic)
        : grains(store),
          bodies(store.bodies),
          members(store.bodies.membersInSpace()),
          scheme(integrator),
          box(periodic) {}

    /// The end of a step; step() takes null for an end, or a beginning, that is not wanted.
    struct Finish {
        const ContactStore& contacts;
        Vector<double> gravity;
        double step;
    };
    double step(int threads, const Finish* finish, const double* beginStep) {
        const std::vector<std::uint32_t>& order = bodies.inSpace();
        std::vector<double> farthest(static_cast<std::size_t>(threads), 0);
        if (scheme.remembersEarlier() || scheme.contacts.springsInStep)
            stepSingly(order, threads, finish, beginStep, farthest);
        else
            inShares((order.size() + lanes - 1) / lanes, threads,
                     [&](int part, std::size_t first, std::size_t end) {
                         double most = 0;
                         for (std::size_t group = first; group < end; ++group)
                             most = std::max(most, stepGroup(order, group * lanes, finish, beginStep));
                         double& ofPart = farthest[static_cast<std::size_t>(part)];
                         ofPart = std::max(ofPart, most);
                     },
                     groupsWorthAThread, shareOf(groupsOfAShare));
        for (const std::uint32_t k : bodies.spheres()) follow(k, beginStep);
        stepSingly(bodies.heldOnes(), threads, finish, beginStep, farthest);
        return *std::ranges::max_element(farthest);
    }

private:
    /// @param farthest squared (m^2), of each thread
    void stepSingly(const std::vector<std::uint32_t>& those, int threads, const Finish* finish,
                    const double* beginStep, std::vector<double>& farthest) {
        inParts(
            those.size(), threads,
            [&](int part, std::size_t first, std::size_t end) {
                SingleBodyMotion one(grains, scheme, box);
                double& most = farthest[static_cast<std::size_t>(part)];
                for (std::size_t k = first; k < end; ++k) {
                    if (finish != nullptr)
                        one.finish(those[k], finish->contacts, finish->gravity, finish->step);
                    if (beginStep != nullptr) most = std::max(most, one.begin(those[k], *beginStep));
                }
            },
            lanes * groupsWorthAThread);
    }

    double stepGroup(const std::vector<std::uint32_t>& order, std::size_t first, const Finish* finish,
                     const double* beginStep) {
        const std::size_t count = std::min(lanes, order.size() - first);
        std::array<std::uint32_t, lanes> index;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            index[lane] = order[std::min(first + lane, order.size() - 1)];
            prefetch<true>(&bodies[order[std::min(first + 2 * lanes + lane, order.size() - 1)]],
                           sizeof(RigidBody));
        }
        EightBodies eight = EightBodies::load(bodies, index.data());
        if (finish != nullptr) {
            alignas(64) std::array<ForceAndTorque<true>, lanes> sums{};
            const EightAxes axes(Axes<Pack>(eight.orientation));
            for (std::size_t lane = 0; lane < count; ++lane)
                sums[lane] = sumForces(first + lane, axes, lane, finish->contacts);
            static constexpr std::array<std::uint32_t, lanes> inOrder{0, 1, 2, 3, 4, 5, 6, 7};
            const auto c = loadRecords<8>(reinterpret_cast<const double*>(sums.data()), 8, inOrder.data());
            eight.finish({c[0], c[1], c[2]}, {c[4], c[5], c[6]}, finish->gravity, finish->step, scheme);
        }
        if (beginStep != nullptr) eight.begin(*beginStep, scheme);
        eight.store(bodies, index.data(), static_cast<int>(count));
        const EightInSpace inSpace(eight);
        double farthest = 0;
        for (std::size_t lane = 0; lane < count; ++lane)
            if (beginStep != nullptr)
                farthest = std::max(farthest, moveGrains(first + lane, inSpace, lane, *beginStep));
            else placeGrains(first + lane, inSpace, lane);
        return farthest;
    }

    /// The grains of the body at a place of inSpace().
    [[nodiscard]] std::span<const MemberInSpace> membersOf(std::size_t at) const {
        return {members.data() + bodies.firstInSpace(at), members.data() + bodies.firstInSpace(at + 1)};
    }

    /// The force of all contacts of all grains of a body, and their torque about its centre of mass.
    [[nodiscard]] ForceAndTorque<true> sumForces(std::size_t body, const EightAxes& axes, std::size_t lane,
                                                 const ContactStore& contacts) const {
        const SumTaker<hasSpin, hasContactTorque> sums(contacts);
        Four force{}, torque{};
        for (std::size_t m = bodies.firstInSpace(body); m < bodies.firstInSpace(body + 1); ++m) {
            if (m + grainsAhead < members.size()) prefetchGrain(members[m + grainsAhead].place);
            const MemberInSpace& member = members[m];
            const auto sum = sums.take(member.place, grains.translation[member.place].radius);
            force += sum.force;
            torque += crossFour(axes.turn(lane, member.arm), sum.force);
            if constexpr (hasSpin) torque += sum.torque;
        }
        return {force, torque};
    }

    [[gnu::always_inline]] void prefetchGrain(std::uint32_t place) const {
        prefetch<true>(&grains.translation[place], sizeof(TranslationRecord));
        if constexpr (hasSpin) prefetch<true>(&grains.rotation[place], sizeof(RotationRecord));
    }

    double moveGrains(std::size_t body, const EightInSpace& now, std::size_t lane, double length) {
        double farthest = 0;
        for (const MemberInSpace& member : membersOf(body)) {
            const Four arm = now.axes.turn(lane, member.arm);
            TranslationRecord& grain = grains.translation[member.place];
            const Four before = loadFour(grain.position), after = now.position[lane] + arm;
            storeVector(grain.position, after, before);
            setVelocity(member.place, now, lane, arm);
            Vector<double> shift = vectorOf(after - before);
            if (box.imagesMove) shift -= length * box.flowAt(vectorOf(before));
            const double squared = squaredNorm(shift);
            farthest = std::max(farthest, std::isnan(squared) ? infinity : squared);
        }
        return farthest;
    }
    void placeGrains(std::size_t body, const EightInSpace& now, std::size_t lane) {
        const Vector<double>& acceleration = bodies[bodies.inSpace()[body]].acceleration;
        for (const MemberInSpace& member : membersOf(body)) {
            setVelocity(member.place, now, lane, now.axes.turn(lane, member.arm));
            grains.acceleration[member.place] = acceleration;
        }
    }
    [[gnu::always_inline]] void setVelocity(std::uint32_t place, const EightInSpace& now, std::size_t lane,
                                            Four arm) {
        TranslationRecord& grain = grains.translation[place];
        storeVector(grain.velocity, now.velocity[lane] + crossFour(now.spin[lane], arm),
                    loadFour(grain.velocity));
        if constexpr (hasSpin)
            storeVector(grains.rotation[place].spin, now.spin[lane], loadFour(grains.rotation[place].spin));
    }

    /// A sphere is where its grain is, and turns as that does: by the spin in the middle of the step.
    void follow(std::uint32_t k, const double* beginStep) {
        bodies.follow(grains, k);
        RigidBody& body = bodies[k];
        if (beginStep == nullptr) return;
        Vector<double> middle =
            body.angularMomentum + ((scheme.position0 - scheme.velocity0) * *beginStep) * body.torque;
        if (scheme.remembersEarlier())
            middle += ((scheme.position1 - scheme.velocity1) * *beginStep) * bodies.earlier[k].torque;
        body.orientation = turnedFreely(body.orientation, body.inertia, middle, *beginStep);
    }

    ParticleStore& grains;
    RigidBodies& bodies;
    const std::vector<MemberInSpace>& members;  // of all
    const Integrator& scheme;
    const PeriodicBox& box;
};

double stepAll(ParticleStore& grains, bool hasContactTorque, int threads, const Integrator& scheme,
               const PeriodicBox& box, const ContactStore* contacts, const Vector<double>& gravity,
               double step, const double* beginStep) {
    grains.bodies.refresh(grains);
    if (scheme.remembersEarlier() && grains.bodies.earlier.size() != grains.bodies.sizeWithGhosts())
        grains.bodies.startEarlier(true);  // of the first bodies in a run
    const auto with = [&]<class L>() {
        if (contacts == nullptr) return L(grains, scheme, box).step(threads, nullptr, beginStep);
        const typename L::Finish finish{*contacts, gravity, step};
        return L(grains, scheme, box).step(threads, &finish, beginStep);
    };
    if (!grains.hasSpin) return with.template operator()<BodyLoops<false, false>>();
    if (!hasContactTorque) return with.template operator()<BodyLoops<true, false>>();
    return with.template operator()<BodyLoops<true, true>>();
}

bool hasContactTorque(const ContactStore& store) { return store.memory.getLayout().hasContactTorque; }

}  // namespace

double RigidBodyMotion::begin(ParticleStore& grains, double step, int threads, const Integrator& scheme,
                              const PeriodicBox& box) {
    return stepAll(grains, false, threads, scheme, box, nullptr, {0, 0, 0}, 0, &step);
}
void RigidBodyMotion::finish(ParticleStore& grains, const ContactStore& store, const Vector<double>& gravity,
                             double step, int threads, const Integrator& scheme) {
    stepAll(grains, hasContactTorque(store), threads, scheme, {}, &store, gravity, step, nullptr);
}
double RigidBodyMotion::finishAndBegin(ParticleStore& grains, const ContactStore& store,
                                       const Vector<double>& gravity, double step, double nextStep,
                                       int threads, const Integrator& scheme, const PeriodicBox& box) {
    return stepAll(grains, hasContactTorque(store), threads, scheme, box, &store, gravity, step, &nextStep);
}

void RigidBodyMotion::takeBack(ParticleStore& grains, double step, const Integrator& scheme) {
    RigidBodies& bodies = grains.bodies;
    const bool isSingle = scheme.remembersEarlier() || scheme.contacts.springsInStep;
    const PeriodicBox unused;
    SingleBodyMotion one(grains, scheme, unused);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        RigidBody& body = bodies[k];
        if ((isSingle || bodies.heldAxesOf(k).any()) && !bodies.isSphere(grains, k)) {
            one.takeBack(k, step);
            continue;
        }
        const double position0 = scheme.position0 * step, velocity0 = scheme.velocity0 * step;
        body.velocity -= velocity0 * body.acceleration;
        body.position -= step * (body.velocity + position0 * body.acceleration);
        body.angularMomentum -= velocity0 * body.torque;
        // The turn is symmetric in time.
        const Vector<double> middle = body.angularMomentum + position0 * body.torque;
        body.orientation = turnedFreely(body.orientation, body.inertia, middle, -step);
        if (bodies.isSphere(grains, k)) bodies.follow(grains, k);  // TimeIntegration took the grain back
    }
    bodies.placeAll(grains);
}

}  // namespace pendular
