#include "Kernel/Features/RigidBodies/SingleBodyMotion.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Core/Contacts/ParticleSum.h"
#include "Kernel/Features/RigidBodies/FreeTurn.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

/// Turned about an axis in space by a spin (rad/s) for a time (s), right to fourth order: the tangent of half
/// the angle is taken with its third power.
Quaternion turnedBy(const Quaternion& orientation, const Vector<double>& spin, double time) {
    const double angle2 = squaredNorm(spin) * time * time;
    const Quaternion turn{1, (0.5 * time * (1 + angle2 / 12)) * spin};
    return (turn * orientation).normalised();
}

}  // namespace

Quaternion SingleBodyMotion::turnedHeld(std::size_t k, const Vector<double>& momentum, double time) const {
    constexpr int most = 8;  // each is right to two more orders
    const Quaternion& start = bodies[k].orientation;
    Vector<double> spin = bodies.spinIn(k, start, momentum);
    for (int round = 0; round < most; ++round) {
        const Vector<double> next = bodies.spinIn(k, turnedBy(start, spin, 0.5 * time), momentum);
        if (next == spin) break;
        spin = next;
    }
    return turnedBy(start, spin, time);
}

Quaternion SingleBodyMotion::turned(std::size_t k, const Vector<double>& momentum, double time) const {
    if (bodies.heldAxesOf(k).areAbout()) return turnedHeld(k, momentum, time);
    const RigidBody& body = bodies[k];
    if (!scheme.remembersEarlier()) return turnedFreely(body.orientation, body.inertia, momentum, time);
    constexpr double outer = 1.3512071919596578, inner = 1 - 2 * outer;  // 1 / (2 - 2^(1/3))
    Quaternion orientation = body.orientation;
    for (const double part : {outer, inner, outer})
        orientation = turnedFreely(orientation, body.inertia, momentum, part * time);
    return orientation;
}

void SingleBodyMotion::finish(std::size_t k, const ContactStore& contacts, const Vector<double>& gravity,
                              double step) {
    RigidBody& body = bodies[k];
    const HeldBits held = bodies.heldAxesOf(k);
    const Axes axes(body.orientation);
    Vector<double> force{0, 0, 0}, torque{0, 0, 0};
    for (const BodyMember& member : bodies.membersOf(k)) {
        const std::uint32_t place = grains.place[member.grain];
        const ContactSum sum = contactSum(contacts, place, grains.translation[place].radius);
        force += sum.force;
        torque += cross(axes.turn(member.arm), sum.force) + sum.torque;
    }
    const Vector<double> acceleration = (1 / body.mass) * force + gravity;
    const EarlierBodyMotion earlier = earlierOf(k);
    const double corrector = scheme.corrector * step;
    body.velocity += corrector * held.partAlong(acceleration - scheme.now * body.acceleration +
                                                scheme.earlier * earlier.acceleration);
    body.angularMomentum +=
        corrector * held.partAbout(torque - scheme.now * body.torque + scheme.earlier * earlier.torque);
    if (scheme.remembersEarlier()) bodies.earlier[k] = {body.acceleration, body.torque};
    body.acceleration = acceleration;
    body.torque = torque;
    bodies.constrain(k);
    bodies.place(grains, k);
}

double SingleBodyMotion::begin(std::size_t k, double step) {
    RigidBody& body = bodies[k];
    const HeldBits held = bodies.heldAxesOf(k);
    const std::span<const BodyMember> members = bodies.membersOf(k);
    std::vector<TranslationRecord> before;
    for (const BodyMember& member : members) before.push_back(grains.translation[grains.place[member.grain]]);
    const Vector<double> spinBefore = bodies.spinOf(k);

    const EarlierBodyMotion earlier = earlierOf(k);
    const auto both = [](double a, const Vector<double>& now, double b, const Vector<double>& then) {
        return a * now + b * then;
    };
    body.position +=
        step * (body.velocity + step * held.partAlong(both(scheme.position0, body.acceleration,
                                                           scheme.position1, earlier.acceleration)));
    const Vector<double> middle =
        body.angularMomentum +
        step * held.partAbout(both(scheme.position0, body.torque, scheme.position1, earlier.torque));
    body.orientation = turned(k, middle, step);
    body.velocity += step * held.partAlong(both(scheme.velocity0, body.acceleration, scheme.velocity1,
                                                earlier.acceleration));
    body.angularMomentum +=
        step * held.partAbout(both(scheme.velocity0, body.torque, scheme.velocity1, earlier.torque));
    const Vector<double> spin = bodies.constrain(k);
    bodies.place(grains, k);

    double farthest = 0;
    for (std::size_t m = 0; m < members.size(); ++m) {
        const std::uint32_t place = grains.place[members[m].grain];
        Vector<double> shift = grains.translation[place].position - before[m].position;
        if (box.imagesMove) shift -= step * box.flowAt(before[m].position);
        const double squared = squaredNorm(shift);
        farthest = std::max(farthest, std::isnan(squared) ? infinity : squared);
        if (!scheme.contacts.springsInStep || !(step > 0)) continue;
        // Contacts take the velocity in the middle of the step from what their grains carry and half of this.
        grains.acceleration[place] = (1 / step) * (grains.translation[place].velocity - before[m].velocity);
        if (grains.hasSpin) grains.rotation[place].angularAcceleration = (1 / step) * (spin - spinBefore);
    }
    return farthest;
}

void SingleBodyMotion::takeBack(std::size_t k, double step) {
    RigidBody& body = bodies[k];
    const HeldBits held = bodies.heldAxesOf(k);
    const EarlierBodyMotion earlier = earlierOf(k);
    body.velocity -=
        step * held.partAlong(scheme.velocity0 * body.acceleration + scheme.velocity1 * earlier.acceleration);
    body.position -= step * (body.velocity + step * held.partAlong(scheme.position0 * body.acceleration +
                                                                   scheme.position1 * earlier.acceleration));
    body.angularMomentum -=
        step * held.partAbout(scheme.velocity0 * body.torque + scheme.velocity1 * earlier.torque);
    // The turn is symmetric in time.
    const Vector<double> middle =
        body.angularMomentum +
        step * held.partAbout(scheme.position0 * body.torque + scheme.position1 * earlier.torque);
    body.orientation = turned(k, middle, -step);
    bodies.constrain(k);
    bodies.place(grains, k);
}

}  // namespace pendular
