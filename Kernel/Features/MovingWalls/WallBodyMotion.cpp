#include "Kernel/Features/MovingWalls/WallBodyMotion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Features/RigidBodies/FreeTurn.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {
namespace {

using WallBodyStep = WallBodyMotion::Step;

/// Calls function(number, wall, body) for each wall that is a body.
template <class Function>
void forEachBody(const WallHandler& walls, Function&& function) {
    for (const auto& [number, wall] : walls.present())
        if (WallBody* const body = wall->body())
            if (auto* const rigid = dynamic_cast<RigidWall*>(wall.get())) function(number, *rigid, *body);
}

/// N m, of the grains on a wall, about its centre.
Vector<double> torqueOn(const Wall& wall, const WallBody& body) {
    const Vector<double> about = toVector(wall.getTorquePoint());
    return toVector(wall.getTorque()) + cross(about - body.centre(), toVector(wall.getForce()));
}

/// N or N m, of the load and the weight of a slider or a rotor.
double loadOf(const WallBody& body, const Vector<double>& gravity) {
    const WallBodySettings& asked = body.asked;
    return asked.load + (body.turns() ? 0 : asked.inertia * dot(gravity, asked.axis));
}

/// m/s^2 or rad/s^2, without the friction.
double accelerationOf(const Wall& wall, const WallBody& body, const Vector<double>& gravity) {
    const Vector<double> byGrains = body.turns() ? torqueOn(wall, body) : toVector(wall.getForce());
    return (dot(byGrains, body.asked.axis) + loadOf(body, gravity)) / body.asked.inertia;
}

/// The change of a speed by dry friction in a time (s): against it, and at most the speed itself.
double frictionOf(const WallBody& body, double speed, double time) {
    const double most = time * body.asked.friction / body.asked.inertia;
    return -std::clamp(speed, -most, most);
}

double limited(const WallBody& body, double speed) {
    return std::clamp(speed, -body.asked.largestSpeed, body.asked.largestSpeed);
}

void beginAlongWay(const RigidWall& wall, WallBody& body, const WallBodyStep& step) {
    const Integrator& s = step.scheme;
    const double h = step.length, v = body.speed, a = accelerationOf(wall, body, step.gravity);
    if (body.steps == 0) body.earlier = a;  // as of grains: no step before the first
    const double e = body.earlier, held = frictionOf(body, v + h * a, h);
    body.acceleration = a;
    body.startSpeed = v;
    body.speed = v + h * (s.velocity0 * a + s.velocity1 * e);
    body.way += h * limited(body, v + h * (s.position0 * a + s.position1 * e) + 0.5 * held);
    body.carried += h * body.across;
    body.seen = body.velocityAt(limited(body, body.speed + (s.velocity0 + s.velocity1) * held));
}

void finishAlongWay(const RigidWall& wall, WallBody& body, const WallBodyStep& step) {
    const Integrator& s = step.scheme;
    const double h = step.length, now = accelerationOf(wall, body, step.gravity);
    const double free =
        body.speed + s.corrector * h * (now - s.now * body.acceleration + s.earlier * body.earlier);
    body.speed = limited(body, free + frictionOf(body, free, h));
    const double mean = 0.5 * (body.startSpeed + body.speed), momentum = body.asked.inertia * mean;
    body.mean = body.velocityAt(mean);
    body.work = {.byLoads = h * mean * loadOf(body, step.gravity),
                 .inFriction = momentum * (free - body.speed),
                 .missing = s.takesMeanAcceleration()
                                ? 0
                                : momentum * (free - body.startSpeed - 0.5 * h * (body.acceleration + now))};
    body.earlier = body.acceleration;
}

/// The acceleration and the torque of a free body now.
void takeForces(const RigidWall& wall, WallBody& body, const WallBodyStep& step) {
    body.free.acceleration =
        (1 / body.free.mass) * (toVector(wall.getForce()) + body.asked.force) + step.gravity;
    body.free.torque = torqueOn(wall, body) + body.asked.torque;
}

void beginFreely(const RigidWall& wall, WallBody& body, const WallBodyStep& step) {
    const Integrator& s = step.scheme;
    const double h = step.length;
    RigidBody& free = body.free;
    body.startVelocity = free.velocity;
    body.startSpin = free.spin();
    body.startEnergy = body.kineticEnergy();
    body.mean.point = free.position;
    body.startForce = toVector(wall.getForce());
    body.startTorque = torqueOn(wall, body);
    takeForces(wall, body, step);
    if (body.steps == 0) body.earlierAcceleration = free.acceleration, body.earlierTorque = free.torque;
    const auto sum = [&](double ofNow, const Vector<double>& now, double ofEarlier,
                         const Vector<double>& earlier) { return h * (ofNow * now + ofEarlier * earlier); };
    const Vector<double>&a = free.acceleration, &t = free.torque;
    free.position += h * (free.velocity + sum(s.position0, a, s.position1, body.earlierAcceleration));
    free.velocity += sum(s.velocity0, a, s.velocity1, body.earlierAcceleration);
    free.orientation =
        turnedFreely(free.orientation, free.inertia,
                     free.angularMomentum + sum(s.position0, t, s.position1, body.earlierTorque), h);
    free.angularMomentum += sum(s.velocity0, t, s.velocity1, body.earlierTorque);
    body.seen = body.velocity();
}

void finishFreely(const RigidWall& wall, WallBody& body, const WallBodyStep& step) {
    const Integrator& s = step.scheme;
    const double h = step.length;
    RigidBody& free = body.free;
    const Vector<double> acceleration = free.acceleration, torque = free.torque;
    takeForces(wall, body, step);
    const auto corrected = [&](const Vector<double>& now, const Vector<double>& before,
                               const Vector<double>& earlier) {
        return s.corrector * h * (now - s.now * before + s.earlier * earlier);
    };
    free.velocity += corrected(free.acceleration, acceleration, body.earlierAcceleration);
    free.angularMomentum += corrected(free.torque, torque, body.earlierTorque);
    body.earlierAcceleration = acceleration;
    body.earlierTorque = torque;
    body.mean = {0.5 * (body.startVelocity + free.velocity), 0.5 * (body.startSpin + free.spin()),
                 body.mean.point};
    const RigidVelocity& mean = body.mean;
    const double byLoads = h * (dot(mean.linear, body.asked.force + free.mass * step.gravity) +
                                dot(mean.spin, body.asked.torque));
    const double byGrains = 0.5 * h *
                            (dot(mean.linear, body.startForce + toVector(wall.getForce())) +
                             dot(mean.spin, body.startTorque + torqueOn(wall, body)));
    body.work = {.byLoads = byLoads, .missing = body.kineticEnergy() - body.startEnergy - byLoads - byGrains};
}

}  // namespace

void WallBodyMotion::begin(const WallHandler& walls, const WallBodyStep& step) {
    before.clear();
    forEachBody(walls, [&](std::size_t number, const RigidWall& wall, const WallBody& body) {
        before.push_back({number, body, wall.getPose(), wall.shownVelocity()});
    });
    forEachBody(walls, [&](std::size_t number, RigidWall& wall, WallBody& body) {
        if (body.isFree()) beginFreely(wall, body, step);
        else beginAlongWay(wall, body, step);
        wall.followBody();
        wall.showVelocity(body.seen);
        if (!(wall.lastShift() <= step.smallestRadius))
            throw RunError(fmt::format(
                "At time {:.6g} s wall {}, which forces move, goes {:.4g} m in a step of {:.4g} s, farther "
                "than the smallest radius, {:.4g} m: take a smaller time step, a heavier wall, or a smaller "
                "force, torque or speed.",
                step.time, number, wall.lastShift(), step.length, step.smallestRadius));
    });
}

void WallBodyMotion::finish(const WallHandler& walls, const WallBodyStep& step) {
    forEachBody(walls, [&](std::size_t, RigidWall& wall, WallBody& body) {
        ++body.steps;
        if (body.isFree()) finishFreely(wall, body, step);
        else finishAlongWay(wall, body, step);
        wall.showVelocity(body.velocity());
    });
}

void WallBodyMotion::takeBack(const WallHandler& walls) const {
    for (const Before& was : before)
        dynamic_cast<RigidWall&>(walls.getObject(was.wall)).takeBack(was.body, was.pose, was.velocity);
}

}  // namespace pendular
