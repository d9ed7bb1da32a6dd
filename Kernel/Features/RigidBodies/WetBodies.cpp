#include <Eigen/Core>
#include <cmath>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Features/RigidBodies/ClumpTemplate.h"
#include "Kernel/Features/RigidBodies/RigidBodies.h"
#include "Kernel/Foundation/Math/EigenConversion.h"

// The mass that the films of its grains give a rigid body.

namespace pendular {

namespace {

/// kg m^2, of a mass (kg) at a place (m), about the origin.
Eigen::Matrix3d inertiaOfPoint(double mass, const Vector<double>& place) {
    const Eigen::Vector3d at = toEigen(place);
    return mass * (at.squaredNorm() * Eigen::Matrix3d::Identity() - at * at.transpose());
}

}  // namespace

void RigidBodies::weigh(ParticleStore& grains, std::size_t at, std::span<const double> filmMasses,
                        const Vector<double>& gravity) {
    if (dry.empty()) {
        for (const RigidBody& body : bodies) dry.push_back({body.mass, body.inertia, {0, 0, 0}, {}});
        for (const BodyMember& member : members) dryArms.push_back(member.arm);
        films.assign(members.size(), 0);
    }
    const std::size_t first = begins[at], count = begins[at + 1] - first;
    double* const own = films.data() + first;
    if (std::equal(filmMasses.begin(), filmMasses.end(), own)) return;
    std::copy(filmMasses.begin(), filmMasses.end(), own);

    DryBody& base = dry[at];
    RigidBody& body = bodies[at];
    double mass = base.mass;
    Vector<double> moment{0, 0, 0};  // kg m, in the dry axes
    for (std::size_t m = 0; m < count; ++m) mass += own[m], moment += own[m] * dryArms[first + m];
    const Vector<double> centre = (1 / mass) * moment;
    Eigen::Matrix3d inertia = toEigen(base.inertia).asDiagonal();
    inertia += inertiaOfPoint(base.mass, centre);
    bool isUneven = false;  // so that other axes are the principal ones
    for (std::size_t m = 0; m < count; ++m) {
        const double radius = grains.translation[grains.place[members[first + m].grain]].radius;
        isUneven = isUneven || (own[m] > 0 && (count > 1 || squaredNorm(dryArms[first + m]) > 0));
        inertia += 2.0 / 3 * own[m] * radius * radius * Eigen::Matrix3d::Identity() +
                   inertiaOfPoint(own[m], dryArms[first + m] - centre);
    }
    const Quaternion turned = body.orientation * Quaternion{base.axes.real, -base.axes.imaginary};
    const Vector<double> shift = turned.turn(centre - base.centre), spin = spinOf(at);
    base.centre = centre;
    body.velocity += cross(spin, shift);
    body.position += shift;
    // Forces and torques stay: F = M (a - g).
    const auto renew = [&](Vector<double>& acceleration, Vector<double>& torque) {
        const Vector<double> force = body.mass * (acceleration - gravity);
        acceleration = gravity + (1 / mass) * force;
        torque -= cross(shift, force);
    };
    if (!earlier.empty()) renew(earlier[at].acceleration, earlier[at].torque);
    renew(body.acceleration, body.torque);
    body.mass = mass;
    body.inertia = {inertia(0, 0), inertia(1, 1), inertia(2, 2)};
    base.axes = {};
    if (isUneven) {
        const PrincipalAxes principal = principalAxes(inertia);
        body.inertia = toVector(principal.moments);
        base.axes = {principal.axes.w(), toVector(principal.axes.vec())};
    }
    body.orientation = (turned * base.axes).normalised();
    for (std::size_t m = 0; m < count; ++m)
        members[first + m].arm = base.axes.turnBack(dryArms[first + m] - centre);
    setSpin(at, spin);
    place(grains, at);
    forgetPlaces();
}

void RigidBodies::visitDry(StateArchive& archive) {
    if (archive.isReading()) dry.clear(), dryArms.clear(), films.clear();
    if (archive.isWriting() ? dry.empty() : !archive.holds("dry")) return;
    archive.column<double>("dry", dry);
    archive.column<double>("dryArms", dryArms);
    archive.column<double>("films", films);
    archive.requireFinite("dry", dry);
    archive.requireFinite("dryArms", dryArms);
    archive.require(dry.size() == size(), "dry", "does not have one row for each body");
    for (const DryBody& own : dry)
        archive.require(own.mass > 0 && own.inertia.x > 0 && own.inertia.y > 0 && own.inertia.z > 0, "dry",
                        "has a mass or a moment of inertia that is not positive");
    archive.require(!begins.empty() && dryArms.size() == begins.back() && films.size() == begins.back(),
                    "films", "or dryArms have another number of rows than bodies/grains");
    for (const double film : films) archive.require(film >= 0, "films", "has a negative mass");
}

}  // namespace pendular
