#include "Kernel/Features/RigidBodies/MovingBodies.h"

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/Math/SymmetricMatrix.h"

namespace pendular {

namespace {

/// N s, that makes the velocities of a free mass (kg) and of a point of a body, at an arm (m) from its
/// centre, the same: J = (1/m + K)^-1 (v_m - v_p), with K = 1/M - [a] I^-1 [a], the body's response at the
/// point.
Vector<double> plasticImpulse(const RigidBody& body, HeldBits held, const Vector<double>& arm, double mass,
                              const Vector<double>& approach) {
    if (held.any()) {
        Eigen::Matrix3d response = 1 / mass * Eigen::Matrix3d::Identity();
        for (int axis = 0; axis < 3; ++axis) {
            const Vector<double> unit = toVector(Eigen::Vector3d::Unit(axis));
            const Vector<double> spin =
                spinOfHeld(body.inertia, body.orientation, held, cross(arm, unit), {0, 0, 0});
            response.col(axis) += toEigen((1 / body.mass) * held.partAlong(unit) + cross(spin, arm));
        }
        return toVector(solveSymmetric(response, toEigen(approach)));
    }
    const Axes axes(body.orientation);
    Eigen::Matrix3d turn;
    turn << toEigen(axes.x), toEigen(axes.y), toEigen(axes.z);
    const Eigen::Matrix3d inverseInertia =
        turn * toEigen(body.inertia).cwiseInverse().asDiagonal() * turn.transpose();
    Eigen::Matrix3d cross;
    cross << 0, -arm.z, arm.y, arm.z, 0, -arm.x, -arm.y, arm.x, 0;
    const Eigen::Matrix3d response =
        (1 / mass + 1 / body.mass) * Eigen::Matrix3d::Identity() - cross * inverseInertia * cross;
    return toVector(solveSymmetric(response, toEigen(approach)));
}

}  // namespace

std::size_t countBodies(const ParticleStore& grains) {
    std::size_t members = 0;
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) members += grains.bodies.membersOf(k).size();
    return grains.count() - members + grains.bodies.size();
}

double volumeOfBodies(const ParticleStore& grains) {
    double volume = 0;
    for (const std::uint32_t place : grains.place)
        if (!grains.bodies.contains(grains.identity[place]))
            volume += sphereMass(grains.translation[place].radius, 1);
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) volume += grains.bodies.volumeOf(k);
    return volume;
}

double mobilityOf(const RigidBody& body, const Vector<double>& arm, const Vector<double>& direction,
                  HeldBits held) {
    if (held.any()) {
        const Vector<double> lever = cross(arm, direction);
        return squaredNorm(held.partAlong(direction)) / body.mass +
               dot(lever, spinOfHeld(body.inertia, body.orientation, held, lever, {0, 0, 0}));
    }
    const Vector<double> lever = body.orientation.turnBack(cross(arm, direction));
    return 1 / body.mass + lever.x * lever.x / body.inertia.x + lever.y * lever.y / body.inertia.y +
           lever.z * lever.z / body.inertia.z;
}

void catchMomentum(ParticleStore& grains, std::uint32_t place, const PeriodicBox& periodic, double mass,
                   const Vector<double>& point, const Vector<double>& velocity) {
    TranslationRecord& grain = grains.translation[place];
    if (grain.inverseMass == 0) return;
    const std::uint32_t number = grains.bodies.bodyOf(grains.identity[place]);
    const std::uint32_t k = number == RigidBodies::none ? number : grains.bodies.find(number);
    if (number == RigidBodies::none || grains.bodies.isSphere(grains, k)) {
        const double share = mass * grain.inverseMass / (1 + mass * grain.inverseMass);
        grain.velocity += grains.heldAt(place).partAlong(share * (velocity - grain.velocity));
        if (number != RigidBodies::none) grains.bodies.follow(grains, k);
        return;
    }
    RigidBody& body = grains.bodies[k];
    const Vector<double> arm = periodic.nearest(point - body.position);
    const Vector<double> impulse =
        plasticImpulse(body, grains.bodies.heldAxesOf(k), arm, mass,
                       velocity - (body.velocity + cross(grains.bodies.spinOf(k), arm)));
    body.velocity += grains.bodies.heldAxesOf(k).partAlong((1 / body.mass) * impulse);
    body.angularMomentum += cross(arm, impulse);
    grains.bodies.constrain(k);
    grains.bodies.place(grains, k);
}

}  // namespace pendular
