#include "Kernel/Features/MovingWalls/PlaneMotion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Core/Contacts/GrainMasses.h"
#include "Kernel/Features/Servos/DampedServo.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {
namespace {

using PlaneStep = PlaneMotion::Step;

/// Calls function(number, wall, drive) for each plane that is moved by forces.
template <class Function>
void forEachDriven(const WallHandler& walls, Function&& function) {
    for (const auto& [number, wall] : walls.present()) {
        PlaneDrive* const drive = wall->drive();
        if (!drive) continue;
        if (auto* const plane = dynamic_cast<InfiniteWall*>(wall.get())) function(number, *plane, *drive);
    }
}

/// m/s^2, by the forces of the last step, the load and the weight.
double accelerationOf(const Wall& wall, const PlaneDrive& drive, const Vector<double>& gravity) {
    const Vector<double> normal = wall.drivenNormal();
    return (dot(toVector(wall.getForce()), normal) - drive.asked.load) / drive.asked.mass +
           dot(gravity, normal);
}

/// Takes a piston's velocity to the start of the forces; returns its shift (m).
double beginPiston(const Wall& wall, PlaneDrive& drive, const PlaneStep& step) {
    const Integrator& s = step.scheme;
    drive.acceleration = accelerationOf(wall, drive, step.gravity);
    if (drive.steps == 0) drive.earlier = drive.acceleration;  // as of grains: no step before the first
    const double h = step.length, a = drive.acceleration, e = drive.earlier, v = drive.velocity;
    drive.velocity = v + h * (s.velocity0 * a + s.velocity1 * e);
    return h * (v + h * (s.position0 * a + s.position1 * e));
}

/// Gives a plane the velocity that its servo asks for; returns the plane's shift (m).
double beginServo(const ContactSystem& contacts, const ParticleStore& grains, std::size_t number,
                  const Wall& wall, PlaneDrive& drive, const PlaneStep& step) {
    constexpr double looksInTime = 100;
    const PlaneDriveSettings& asked = drive.asked;
    const auto interval =
        static_cast<std::uint64_t>(std::clamp(std::round(asked.time / step.length / looksInTime), 1.0, 1e15));
    if (drive.steps % interval == 0) {
        // A bed is as soft as its layers one after the other: at least a contact's share of all grains.
        const double layers = static_cast<double>(contacts.ranks().sum(grains.count())) /
                              static_cast<double>(std::max<std::uint64_t>(drive.touches, 1));
        const SpringAndDashpot own = wallStiffness(contacts, grains, static_cast<int>(number));
        // A time below a step: the mass of the grains leaves no room for a gain near 2.
        const double ofStep = own.spring * std::max(0.0, step.length - asked.time);
        lookBesideDashpots(drive.servo, dot(toVector(wall.getForce()), wall.drivenNormal()), asked.load,
                           own.spring, own.dashpot + ofStep, static_cast<double>(interval) * step.length,
                           asked.time, asked.time * std::max(servoDriftTimes, 4 * layers),
                           asked.largestSpeed);
    }
    drive.velocity = drive.servo.speed;
    return step.length * drive.velocity;
}

std::string nameOfPlane(std::size_t wall, const PlaneDrive& drive) {
    return fmt::format("wall {}, a {},", wall, drive.isPiston() ? "piston" : "plane with a target force");
}

/// m, from a plane to the farthest surface of a grain before it; negative where none is before it.
double farthestGrain(const InfiniteWall& wall, const ParticleStore& grains, const AllRanks& ranks) {
    double farthest = -infinity;
    const Vector<double> normal = wall.drivenNormal();
    const double offset = dot(normal, wall.pointOnPlane());
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        const double gap = offset - dot(normal, grain.position);
        if (grain.inverseMass > 0 && gap > 0) farthest = std::max(farthest, gap + grain.radius);
    }
    return ranks.largest(farthest);
}

/// A plane that goes towards grains which it never meets: they may fall with it for a while, to a floor.
void refuseEndlessWay(std::size_t number, const InfiniteWall& wall, PlaneDrive& drive,
                      const ParticleStore& grains, const AllRanks& ranks, const PlaneStep& step) {
    if (drive.touches > 0) {
        drive.travelled = drive.farthest = 0;
        return;
    }
    if (drive.travelled <= step.smallestRadius) return;
    if (drive.farthest == 0)
        drive.farthest = drive.travelled + 20 * std::max(farthestGrain(wall, grains, ranks), 0.0);
    if (drive.travelled <= drive.farthest) return;
    throw RunError(fmt::format(
        "At time {:.6g} s {} has gone {:.4g} m towards the grains and met none: they go away from "
        "it; put it next to them, or give it its load when they are there.",
        step.time, nameOfPlane(number, drive), drive.travelled));
}

}  // namespace

bool PlaneMotion::canMove(const Wall& wall) { return dynamic_cast<const InfiniteWall*>(&wall) != nullptr; }

SpringAndDashpot wallStiffness(const ContactSystem& contacts, const ParticleStore& grains, int wall) {
    ExactSum springs, dashpots;
    const ContactStore& store = contacts.store();
    const GrainMasses masses(grains, contacts.laws());  // of held grains and those of rigid bodies, too
    for (const Bucket& bucket : store.buckets) {
        if (bucket.wall != wall) continue;
        const int a = bucket.species1, b = bucket.species2;
        const bool resists = contacts.laws().ofPair(a, b).resistsMotion;
        for (std::uint32_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c) {
            if (!store.acts(c)) continue;
            const double overlap = -contacts.observe(grains, bucket, c).separation;
            const TranslationRecord& grain = grains.translation[store.firstOf(c)];
            const Bodies bodies{grain.radius, infinity};
            if (overlap > 0) springs.add(contacts.laws().normalStiffness(a, b, bodies, overlap));
            if (!(overlap > 0 || resists)) continue;
            const PressedPair pair{bodies, masses(store.firstOf(c)), std::max(overlap, 1e-6 * grain.radius)};
            ContactStiffness found;
            contacts.laws().ofPair(a, b).stiffnesses(a, b, {&pair, 1}, {&found, 1});
            dashpots.add(found.normal.dashpot);
        }
    }
    contacts.ranks().addUp({&springs, &dashpots});
    return {springs.value(), dashpots.value()};
}

void PlaneMotion::begin(const WallHandler& walls, const ContactSystem& contacts, const ParticleStore& grains,
                        const PlaneStep& step) {
    before.clear();
    forEachDriven(walls, [&](std::size_t number, InfiniteWall& wall, PlaneDrive& drive) {
        before.push_back({number, drive, wall.getPose(), drive.velocity * wall.drivenNormal()});
    });
    forEachDriven(walls, [&](std::size_t number, InfiniteWall& wall, PlaneDrive& drive) {
        refuseEndlessWay(number, wall, drive, grains, contacts.ranks(), step);
        const double start = drive.velocity;
        double shift = 0;  // m
        drive.waits = !contacts.ranks().any(grains.count() > 0);
        if (!drive.waits)
            shift = drive.isPiston() ? beginPiston(wall, drive, step)
                                     : beginServo(contacts, grains, number, wall, drive, step);
        else if (step.bringsGrains) drive.velocity = 0;
        else
            throw RunError(
                fmt::format("At time {:.6g} s {} has no grains to move against, and no inlet brings any; "
                            "remove the wall, or "
                            "give it a velocity, when the grains have gone.",
                            step.time, nameOfPlane(number, drive)));
        if (!(std::abs(shift) <= step.smallestRadius))
            throw RunError(fmt::format(
                "At time {:.6g} s {} moves at {:.4g} m/s, farther in a step of {:.4g} s than the smallest "
                "radius, {:.4g} m: take a smaller time step, a heavier piston, or a smaller load or speed.",
                step.time, nameOfPlane(number, drive), std::abs(shift) / step.length, step.length,
                step.smallestRadius));
        if (drive.touches == 0) drive.travelled = std::max(0.0, drive.travelled - shift);
        drive.meanVelocity = drive.seenVelocity = drive.velocity;
        drive.startVelocity = start;
        const Vector<double> normal = wall.drivenNormal();
        wall.goOn(shift * normal);
        wall.showVelocity(drive.velocity * normal);
    });
}

void PlaneMotion::finish(const WallHandler& walls, const PlaneStep& step) {
    forEachDriven(walls, [&](std::size_t, InfiniteWall& wall, PlaneDrive& drive) {
        ++drive.steps;
        if (!drive.isPiston() || drive.waits) return;
        const Integrator& s = step.scheme;
        const double now = accelerationOf(wall, drive, step.gravity);
        drive.velocity +=
            s.corrector * step.length * (now - s.now * drive.acceleration + s.earlier * drive.earlier);
        drive.meanVelocity = 0.5 * (drive.startVelocity + drive.velocity);
        drive.earlier = drive.acceleration;
        drive.acceleration = now;
        wall.showVelocity(drive.velocity * wall.drivenNormal());
    });
}

void PlaneMotion::takeBack(const WallHandler& walls) const {
    for (const Before& was : before) {
        auto& wall = dynamic_cast<InfiniteWall&>(walls.getObject(was.wall));
        *wall.drive() = was.drive;
        wall.takeBack(was.pose, was.velocity);
    }
}

}  // namespace pendular
