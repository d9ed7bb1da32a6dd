#include <algorithm>
#include <array>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Features/RigidBodies/RigidBodies.h"

// Rigid bodies that are held along or about axes of space.

namespace pendular {

Vector<double> spinOfHeld(const Vector<double>& inertia, const Quaternion& orientation, HeldBits axes,
                          const Vector<double>& momentum, const Vector<double>& heldSpin) {
    // The rows of the inertia in space; those of held axes are replaced by those of 1.
    const Axes<double> principal(orientation);
    const auto row = [&](const Vector<double>& unit) {
        const Vector<double> u = principal.turnBack(unit);
        return principal.turn({inertia.x * u.x, inertia.y * u.y, inertia.z * u.z});
    };
    std::array<Vector<double>, 3> rows{row({1, 0, 0}), row({0, 1, 0}), row({0, 0, 1})};
    const Vector<double> free = axes.freeAbout();
    const Vector<double> known{dot(rows[0], heldSpin), dot(rows[1], heldSpin), dot(rows[2], heldSpin)};
    const Vector<double> right = axes.partAbout(momentum - known) + heldSpin;
    const double scale = std::max({inertia.x, inertia.y, inertia.z});
    constexpr std::array units{Vector<double>{1, 0, 0}, Vector<double>{0, 1, 0}, Vector<double>{0, 0, 1}};
    const std::array frees{free.x, free.y, free.z}, rights{right.x, right.y, right.z};
    std::array<double, 3> sides{};
    for (std::size_t k = 0; k < 3; ++k) {
        rows[k] = frees[k] > 0 ? axes.partAbout(rows[k]) : scale * units[k];
        sides[k] = frees[k] > 0 ? rights[k] : scale * rights[k];
    }
    // Cramer's rule, of a symmetric matrix.
    const Vector<double> minor = cross(rows[1], rows[2]);
    const Vector<double> side =
        sides[0] * minor + sides[1] * cross(rows[2], rows[0]) + sides[2] * cross(rows[0], rows[1]);
    return axes.partAbout((1 / dot(rows[0], minor)) * side) + heldSpin;
}

Vector<double> RigidBodies::spinIn(std::size_t at, const Quaternion& orientation,
                                   const Vector<double>& momentum) const {
    const RigidBody& body = bodies[at];
    if (held.empty()) return RigidBody::spinOf(Axes<double>(orientation), body.inertia, momentum);
    return spinOfHeld(body.inertia, orientation, held[at].axes, momentum, held[at].spin);
}

Vector<double> RigidBodies::spinOf(std::size_t at) const {
    const RigidBody& body = bodies[at];
    if (!heldAxesOf(at).areAbout()) return body.spin();
    return spinIn(at, body.orientation, body.angularMomentum);
}

void RigidBodies::setSpin(std::size_t at, const Vector<double>& spin) {
    bodies[at].setSpin(spin);
    if (!held.empty()) held[at].spin = spin - held[at].axes.partAbout(spin);
}

Vector<double> RigidBodies::constrain(std::size_t at) {
    RigidBody& body = bodies[at];
    if (!heldAxesOf(at).areAbout()) return body.spin();
    const Vector<double> spin = spinOf(at), before = body.angularMomentum;
    body.setSpin(spin);
    const Vector<double>& all = body.angularMomentum;
    body.angularMomentum = held[at].axes.partAbout(before) + (all - held[at].axes.partAbout(all));
    return spin;
}

void RigidBodies::hold(ParticleStore& grains, std::size_t at, HeldBits axes) {
    if (held.empty()) held.resize(size());
    const Vector<double> spin = spinOf(at);
    held[at] = {axes, {0, 0, 0}};
    bodies[at].velocity = axes.partAlong(bodies[at].velocity);
    setSpin(at, axes.partAbout(spin));
    for (const BodyMember& member : membersOf(at))
        grains.setHeldAt(grains.place[member.grain], axes.areAll() ? HeldBits() : axes);
    place(grains, at);
    forgetPlaces();
}

void RigidBodies::startEarlier(bool remembers) {
    earlier.clear();
    if (!remembers) return;
    for (const RigidBody& body : bodies) earlier.push_back({body.acceleration, body.torque});
}

void RigidBodies::visitHeld(StateArchive& archive) {
    if (archive.isReading()) held.clear();
    if (archive.isWriting() ? held.empty() : !archive.holds("heldAxes")) return;
    std::vector<std::uint8_t> axes;
    std::vector<Vector<double>> spins;
    for (const HeldBody& own : held) axes.push_back(own.axes.byte()), spins.push_back(own.spin);
    archive.column<std::uint8_t>("heldAxes", axes);
    archive.column<double>("heldSpins", spins);
    archive.require(axes.size() == size() && spins.size() == size(), "heldAxes",
                    "does not have one row for each body");
    archive.requireFinite("heldSpins", spins);
    held.clear();
    for (std::size_t k = 0; k < size(); ++k) {
        archive.require(axes[k] <= HeldBits::all, "heldAxes", "has axes that there are not");
        held.push_back({HeldBits(axes[k]), spins[k]});
    }
}

}  // namespace pendular
