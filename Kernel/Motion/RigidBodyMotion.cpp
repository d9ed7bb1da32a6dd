#include "Kernel/Motion/RigidBodyMotion.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Contacts/ParticleSum.h"
#include "Kernel/Species/Field.h"

namespace pendular {

namespace {

struct ContactSum {
    Vector<double> force, torque;  // N, N m
};

/// Of the contacts of the grain at a place.
ContactSum contactSum(const ContactStore& store, const ParticleStore& grains, std::uint32_t place) {
    const double radius = grains.translation[place].radius;
    const auto vectors = [](const ForceAndTorque<true>& sum) {
        return ContactSum{vectorOf(sum.force), vectorOf(sum.torque)};
    };
    const ContactLayout& layout = store.memory.getLayout();
    if (!layout.hasTorque)
        return {vectorOf(sumContacts<false, false>(store, place, radius).force), {0, 0, 0}};
    return vectors(layout.hasContactTorque ? sumContacts<true, true>(store, place, radius)
                                           : sumContacts<true, false>(store, place, radius));
}

}  // namespace

void turnFreely(RigidBody& body, double time) {
    Vector<double> l = body.orientation.turnBack(body.angularMomentum);
    const auto turnAbout = [&](double Vector<double>::*along, double part) {
        Vector<double> axis{0, 0, 0};
        axis.*along = 1;
        const Quaternion turn = rationalTurn(axis, part * time * (l.*along) / (body.inertia.*along));
        body.orientation = body.orientation * turn;
        l = turn.turnBack(l);
    };
    turnAbout(&Vector<double>::x, 0.5);
    turnAbout(&Vector<double>::y, 0.5);
    turnAbout(&Vector<double>::z, 1);
    turnAbout(&Vector<double>::y, 0.5);
    turnAbout(&Vector<double>::x, 0.5);
    body.orientation = body.orientation.normalised();
}

double RigidBodyMotion::begin(ParticleStore& grains, double step, const Integrator& scheme) {
    before.clear();
    double farthest = 0;
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        RigidBody& body = grains.bodies[k];
        before.push_back(body);
        body.position += step * (body.velocity + (scheme.position0 * step) * body.acceleration);
        body.velocity += (scheme.velocity0 * step) * body.acceleration;
        const Vector<double> momentum = body.angularMomentum;
        body.angularMomentum = momentum + (scheme.position0 * step) * body.torque;
        turnFreely(body, step);
        body.angularMomentum = momentum + (scheme.velocity0 * step) * body.torque;
        for (const BodyMember& member : grains.bodies.membersOf(k)) {
            const Vector<double> shift = body.position + body.orientation.turn(member.arm) -
                                         before[k].position - before[k].orientation.turn(member.arm);
            const double shift2 = squaredNorm(shift);
            farthest = std::max(farthest, std::isnan(shift2) ? infinity : shift2);
        }
        grains.bodies.place(grains, k);
    }
    return farthest;
}

void RigidBodyMotion::finish(ParticleStore& grains, const ContactStore& store, const Vector<double>& gravity,
                             double step, const Integrator& scheme) {
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        RigidBody& body = grains.bodies[k];
        Vector<double> force{0, 0, 0}, torque{0, 0, 0};
        for (const BodyMember& member : grains.bodies.membersOf(k)) {
            const auto sum = contactSum(store, grains, grains.place[member.grain]);
            force += sum.force;
            torque += cross(body.orientation.turn(member.arm), sum.force) + sum.torque;
        }
        const Vector<double> acceleration = (1 / body.mass) * force + gravity;
        const double corrector = scheme.corrector * step;
        body.velocity += corrector * (acceleration - scheme.now * body.acceleration);
        body.angularMomentum += corrector * (torque - scheme.now * body.torque);
        body.acceleration = acceleration;
        body.torque = torque;
        grains.bodies.place(grains, k);
    }
}

void RigidBodyMotion::takeBack(ParticleStore& grains) const {
    for (std::size_t k = 0; k < before.size(); ++k) grains.bodies[k] = before[k];
    grains.bodies.place(grains);
}

}  // namespace pendular
