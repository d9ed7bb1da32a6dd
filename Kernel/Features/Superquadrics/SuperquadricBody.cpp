#include "Kernel/Features/Superquadrics/SuperquadricBody.h"

#include <algorithm>

namespace pendular {

namespace {

/// kg, of the largest free sphere of a body, as the stability limit takes it (RigidBodies::response): it
/// compares the mass with which the body's contacts move, 1 / max(1/m, R^2 / (5/2 I)) with the smallest
/// moment I, with that of this sphere. A normal force at an arm turns a superquadric as well.
double freeMass(const RigidBody& body, const Superquadric& shape, double turning, double massOfSphere) {
    const double radius = shape.boundingRadius();
    const double moment = std::min({body.inertia.x, body.inertia.y, body.inertia.z});
    const double ofSpheres = std::max(1 / body.mass, radius * radius / (2.5 * moment));
    return massOfSphere * std::max((1 + turning) / body.mass, ofSpheres) / ofSpheres;
}

}  // namespace

RigidBody bodyOf(const ShapedGrain& grain, const MassProperties& solid, double density) {
    const Eigen::Quaterniond& q = grain.getOrientation();
    const SphericalParticle& around = grain.around();
    RigidBody body{.mass = density * solid.volume,
                   .inertia = toVector(Vec3D(density * solid.inertia.diagonal())),
                   .position = toVector(around.getPosition()),
                   .velocity = toVector(around.getVelocity()),
                   .orientation = {q.w(), toVector(Vec3D(q.vec()))}};
    body.setSpin(toVector(around.getAngularVelocity()));
    return body;
}

RigidBody bodyOf(const SuperquadricGrain& grain, double density, double turning) {
    RigidBody body = bodyOf(grain, grain.getShape().mass(), density);
    body.largestFreeMass =
        freeMass(body, grain.getShape(), turning, sphereMass(grain.around().getRadius(), density));
    return body;
}

}  // namespace pendular
