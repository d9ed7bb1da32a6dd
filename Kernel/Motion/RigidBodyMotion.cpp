#include "Kernel/Motion/RigidBodyMotion.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "Kernel/Contacts/ParticleSum.h"
#include "Kernel/Parallel.h"
#include "Kernel/Species/Field.h"

namespace pendular {

namespace {

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
        alignas(64) double lanes[3][64];
        storeRecords(lanes[0], std::array{mass, inertia.x, inertia.y, inertia.z, position.x, position.y,
                                          position.z, velocity.x});
        storeRecords(lanes[1], std::array{velocity.y, velocity.z, acceleration.x, acceleration.y,
                                          acceleration.z, momentum.x, momentum.y, momentum.z});
        storeRecords(lanes[2],
                     std::array{torque.x, torque.y, torque.z, orientation.real, orientation.imaginary.x,
                                orientation.imaginary.y, orientation.imaginary.z, largestFreeMass});
        for (int lane = 0; lane < count; ++lane)
            for (int part = 0; part < 3; ++part)
                std::memcpy(&bodies[index[lane]].mass + 8 * part, lanes[part] + 8 * lane, 64);
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

/// What the grains of a body need to know of it.
struct alignas(64) BodyInSpace {
    Four position, velocity, spin, x, y, z, acceleration, unused;
};
using EightInSpace = std::array<BodyInSpace, Pack::lanes>;

/// @param withAxes also where its axes are
void toSpace(const EightBodies& b, bool withAxes, EightInSpace& to) {
    const Axes<Pack> axes(b.orientation);
    const Vector<Pack> spin = RigidBody::spinOf(axes, b.inertia, b.momentum);
    const Pack none = 0;
    alignas(64) double lanes[64];
    const auto put = [&](std::size_t part, const Vector<Pack>& first, const Vector<Pack>& second) {
        storeRecords(lanes, std::array{first.x, first.y, first.z, none, second.x, second.y, second.z, none});
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane)
            std::memcpy(reinterpret_cast<double*>(&to[lane]) + 8 * part, lanes + 8 * lane, 64);
    };
    put(0, b.position, b.velocity);
    put(1, spin, axes.x);
    if (withAxes) put(2, axes.y, axes.z);
    else put(3, b.acceleration, b.acceleration);
}

template <bool hasSpin, bool hasContactTorque>
class BodyLoops {
public:
    static constexpr std::size_t lanes = Pack::lanes;
    static constexpr std::size_t groupsWorthAThread = 32;

    BodyLoops(ParticleStore& store, const Integrator& integrator, const PeriodicBox& periodic)
        : grains(store), bodies(store.bodies), scheme(integrator), box(periodic) {}

    /// What is not wanted is null.
    struct Finish {
        const ContactStore& contacts;
        Vector<double> gravity;
        double step;
    };
    double step(int threads, const Finish* finish, const double* beginStep) {
        const std::vector<std::uint32_t>& order = bodies.inSpace();
        std::vector<double> farthest(static_cast<std::size_t>(threads), 0);
        inParts((order.size() + lanes - 1) / lanes, threads,
                [&](int part, std::size_t first, std::size_t end) {
                    double most = 0;
                    for (std::size_t group = first; group < end; ++group)
                        most = std::max(most, stepGroup(order, group * lanes, finish, beginStep));
                    farthest[static_cast<std::size_t>(part)] = most;
                },
                groupsWorthAThread);
        for (const std::uint32_t k : bodies.spheres()) follow(k, beginStep);
        return *std::ranges::max_element(farthest);
    }

private:
    double stepGroup(const std::vector<std::uint32_t>& order, std::size_t first, const Finish* finish,
                     const double* beginStep) {
        const auto count = static_cast<int>(std::min(lanes, order.size() - first));
        std::array<std::uint32_t, lanes> index;
        for (std::size_t lane = 0; lane < lanes; ++lane)
            index[lane] = order[std::min(first + lane, order.size() - 1)];
        EightBodies eight = EightBodies::load(bodies, index.data());
        if (finish != nullptr) {
            alignas(64) std::array<std::array<double, 8>, lanes> sums{};
            for (int lane = 0; lane < count; ++lane)
                sumForces(index[lane], finish->contacts, sums[lane].data());
            static constexpr std::array<std::uint32_t, lanes> inOrder{0, 1, 2, 3, 4, 5, 6, 7};
            const auto c = loadRecords<8>(sums[0].data(), 8, inOrder.data());
            eight.finish({c[0], c[1], c[2]}, {c[4], c[5], c[6]}, finish->gravity, finish->step, scheme);
        }
        if (beginStep != nullptr) eight.begin(*beginStep, scheme);
        eight.store(bodies, index.data(), count);
        EightInSpace inSpace;
        toSpace(eight, beginStep != nullptr, inSpace);
        double farthest = 0;
        for (int lane = 0; lane < count; ++lane)
            if (beginStep != nullptr)
                farthest = std::max(farthest, moveGrains(index[lane], inSpace[lane], *beginStep));
            else placeGrains(index[lane], inSpace[lane]);
        return farthest;
    }

    /// Of all contacts of all grains of a body: force, and torque about its centre of mass.
    void sumForces(std::uint32_t body, const ContactStore& contacts, double* to) const {
        Four force{}, torque{};
        for (std::uint32_t m = bodies.begin(body); m < bodies.end(body); ++m) {
            const std::uint32_t place = bodies.placeOf(m);
            const auto sum =
                sumContacts<hasSpin, hasContactTorque>(contacts, place, grains.translation[place].radius);
            force += sum.force;
            torque += crossFour(loadFour(bodies.turnedArm(m).arm), sum.force);
            if constexpr (hasSpin) torque += sum.torque;
        }
        *reinterpret_cast<Four*>(to) = force;
        *reinterpret_cast<Four*>(to + 4) = torque;
    }

    double moveGrains(std::uint32_t body, const BodyInSpace& now, double length) {
        double farthest = 0;
        for (std::uint32_t m = bodies.begin(body); m < bodies.end(body); ++m) {
            const Vector<double>& own = bodies.member(m).arm;
            const Four arm = own.x * now.x + own.y * now.y + own.z * now.z;
            storeVector(bodies.turnedArm(m).arm, arm, Four{});
            TranslationRecord& grain = grains.translation[bodies.placeOf(m)];
            const Four before = loadFour(grain.position), after = now.position + arm;
            storeVector(grain.position, after, before);
            setVelocity(bodies.placeOf(m), now, arm);
            Vector<double> shift = vectorOf(after - before);
            if (box.imagesMove) shift -= length * box.flowAt(vectorOf(before));
            const double squared = squaredNorm(shift);
            farthest = std::max(farthest, std::isnan(squared) ? infinity : squared);
        }
        return farthest;
    }
    void placeGrains(std::uint32_t body, const BodyInSpace& now) {
        for (std::uint32_t m = bodies.begin(body); m < bodies.end(body); ++m) {
            setVelocity(bodies.placeOf(m), now, loadFour(bodies.turnedArm(m).arm));
            grains.acceleration[bodies.placeOf(m)] = vectorOf(now.acceleration);
        }
    }
    [[gnu::always_inline]] void setVelocity(std::uint32_t place, const BodyInSpace& now, Four arm) {
        TranslationRecord& grain = grains.translation[place];
        storeVector(grain.velocity, now.velocity + crossFour(now.spin, arm), loadFour(grain.velocity));
        if constexpr (hasSpin)
            storeVector(grains.rotation[place].spin, now.spin, loadFour(grains.rotation[place].spin));
    }

    /// A sphere is where its grain is, and turns as that does: by the spin in the middle of the step.
    void follow(std::uint32_t k, const double* beginStep) {
        bodies.follow(grains, k);
        RigidBody& body = bodies[k];
        if (beginStep == nullptr) return;
        const Vector<double> middle =
            body.angularMomentum + ((scheme.position0 - scheme.velocity0) * *beginStep) * body.torque;
        body.orientation = turnedFreely(body.orientation, body.inertia, middle, *beginStep);
    }

    ParticleStore& grains;
    RigidBodies& bodies;
    const Integrator& scheme;
    const PeriodicBox& box;
};

double stepAll(ParticleStore& grains, bool hasContactTorque, int threads, const Integrator& scheme,
               const PeriodicBox& box, const ContactStore* contacts, const Vector<double>& gravity,
               double step, const double* beginStep) {
    grains.bodies.refresh(grains);
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
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        RigidBody& body = bodies[k];
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
