#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Features/RigidBodies/ClumpTemplate.h"

namespace pendular {

/// A rigid body of a scene, found by its number: valid until it is removed; then every call throws
/// InputError.
class BodyReference {
public:
    BodyReference(ParticleHandler& particles, std::uint32_t body) : handler(&particles), number(body) {}

    [[nodiscard]] std::uint32_t getId() const { return number; }
    [[nodiscard]] double getMass() const { return body().mass; }  // kg; with films that have a mass
    /// m^3; overlaps of its grains are counted once
    [[nodiscard]] double getVolume() const { return handler->store().bodies.volumeOf(at()); }
    [[nodiscard]] Vec3D getInertia() const { return toEigen(body().inertia); }    // kg m^2, principal
    [[nodiscard]] Vec3D getPosition() const { return toEigen(body().position); }  // m, centre of mass
    [[nodiscard]] Vec3D getVelocity() const { return toEigen(body().velocity); }  // m/s
    [[nodiscard]] Vec3D getAngularVelocity() const {                              // rad/s
        return toEigen(handler->store().bodies.spinOf(at()));
    }
    [[nodiscard]] Vec3D getAngularMomentum() const {  // kg m^2/s
        return toEigen(body().angularMomentum);
    }
    /// The force (N) of all contacts and of its weight, in the last step; also along axes along which it is
    /// held (but not for a body of one sphere). A body that is held altogether does not touch walls.
    [[nodiscard]] Vec3D getForce() const { return body().mass * toEigen(body().acceleration); }
    /// N m, of all contacts about the centre of mass, in the last step.
    [[nodiscard]] Vec3D getTorque() const { return toEigen(body().torque); }
    /// Turns the shape into space, as setOrientation() of Clump and of shaped grains does: of a clump the
    /// frame of its template, of a superquadric or a block its axes; of grains that were joined, from how
    /// they were then.
    [[nodiscard]] Eigen::Quaterniond getOrientation() const;
    /// Turns the principal axes, about which getInertia() is, into space.
    [[nodiscard]] Eigen::Quaterniond getPrincipalAxes() const;
    /// The identities of its grains.
    [[nodiscard]] std::vector<std::uint32_t> getGrains() const;

    void setVelocity(const Vec3D& velocity);
    void setAngularVelocity(const Vec3D& spin);
    /// Holds the body, or lets it go. A body that is held feels no force, and moves with the velocity and the
    /// angular velocity that are set from then on; at first it has none.
    void fixBody(bool fix = true) { setHeldAxes(fix ? HeldAxes::all() : HeldAxes{}); }
    [[nodiscard]] bool isFixed() const { return handler->store().bodies.isHeld(at()); }
    /// Holds the body along and about these axes of space (rotations are about its centre of mass), and lets
    /// it go along and about all others: as GrainReference::setHeldAxes().
    void setHeldAxes(const HeldAxes& axes);
    [[nodiscard]] HeldAxes getHeldAxes() const { return handler->store().bodies.heldAxesOf(at()).axes(); }

private:
    [[nodiscard]] std::size_t at() const;
    [[nodiscard]] RigidBody& body() const { return handler->store().bodies[at()]; }
    void requireFinite(std::string_view what, const Vec3D& value, std::string_view unit) const;

    ParticleHandler* handler;  // its store() finishes a step that was left unfinished
    std::uint32_t number;
};

/// Joins grains of a scene to rigid bodies. From then on these move together; contacts between them are not
/// looked for. Everything else about them is as before: laws, walls, outputs.
class BodyHandler {
public:
    BodyHandler(ParticleHandler& particleHandler, const PeriodicBox& periodicBox)
        : particles(particleHandler), periodic(periodicBox) {}

    /// Joins grains to a body, which takes over the motion of their spheres: momentum and angular momentum,
    /// if it has their mass. That is so if none is given. In a periodic scene the nearest images are joined.
    /// Grains that are all held alike make a body that is held so. Throws InputError for grains that are held
    /// otherwise than the others, or in a body already; that overlap without a given mass; or for a mass or
    /// an inertia that no body can have.
    /// @param mass its centre is in space, as the grains are now
    BodyReference join(std::span<const std::uint32_t> identities, const std::optional<BodyMass>& mass = {}) {
        return join(identities, mass, nullptr, Eigen::Quaterniond::Identity());
    }
    BodyReference join(std::initializer_list<std::uint32_t> identities,
                       const std::optional<BodyMass>& mass = {}) {
        return join(std::span(identities.begin(), identities.size()), mass);
    }
    /// Adds the spheres of a clump and joins them: a body with the mass of its template. Its spheres follow
    /// each other in the order of the template; they take no notice of other grains (insert() does). Throws
    /// InputError as copyAndAddObject() of grains does; then nothing was added.
    BodyReference copyAndAddObject(const Clump& clump);
    /// Throws InputError if a body is wider than half the shortest period of a scene, so that it could meet
    /// itself, or another one twice. Returns the width of the widest (m, as it turns).
    double refuseTooWide() const;
    /// Removes a body and all its grains.
    void removeObject(std::size_t number);

    /// Throws InputError where each rank of a scene has its own bodies only, until gather().
    [[nodiscard]] std::size_t getSize() const;
    [[nodiscard]] bool isEmpty() const { return getSize() == 0; }
    /// The body with this number, of those that were added and are not removed. Throws InputError if there is
    /// none.
    [[nodiscard]] BodyReference getObject(std::size_t number);
    /// Over all bodies that there are at its begin, in the order of their numbers, also where others were
    /// removed: for (BodyReference body : bodyHandler). What is added on the way is not visited; the body
    /// itself may be removed. Throws InputError as getSize() does.
    class Iterator {
    public:
        BodyReference operator*() const { return {handler->particles, number}; }
        Iterator& operator++() {
            number = handler->firstFrom(std::size_t{number} + 1, bound);
            return *this;
        }
        friend bool operator==(const Iterator& a, const Iterator& b) { return a.number == b.number; }

    private:
        friend class BodyHandler;
        Iterator(BodyHandler& bodies, std::uint32_t first, std::size_t end)
            : handler(&bodies), number(first), bound(end) {}

        BodyHandler* handler;
        std::uint32_t number;  // RigidBodies::none at the end
        std::size_t bound;     // the number of the first that is not visited
    };
    [[nodiscard]] Iterator begin();
    [[nodiscard]] Iterator end() { return {*this, RigidBodies::none, 0}; }
    /// The number of the body that a grain is part of, if any.
    [[nodiscard]] std::optional<std::uint32_t> bodyOf(std::uint32_t grain) const;

private:
    /// The solid that spheres which overlap make together.
    struct Solid {
        double volume;                // m^3, each point counted once
        std::vector<double> exposed;  // of each sphere, as BodyMember has it
    };
    static Solid solidOf(const std::vector<Ball>& spheres);
    /// @param turn turns the shape, as it was given, to where the grains are
    BodyReference join(std::span<const std::uint32_t> identities, const std::optional<BodyMass>& mass,
                       const Solid* known, const Eigen::Quaterniond& turn);
    BodyReference joinWithMotion(std::span<const std::uint32_t> identities, const Clump& clump,
                                 const BodyMass& mass);
    BodyReference add(RigidBody body, std::span<const std::uint32_t> identities,
                      const std::vector<Ball>& spheres, const Solid* known, bool isSphere,
                      const Quaternion& frame);

    void holdAsJoined(HeldBits held);
    /// The smallest number of a body from the first on and below the bound, or RigidBodies::none.
    [[nodiscard]] std::uint32_t firstFrom(std::size_t first, std::size_t bound) const;

    ParticleHandler& particles;
    const PeriodicBox& periodic;
};

}  // namespace pendular
