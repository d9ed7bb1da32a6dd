#include "Kernel/Features/FluxPlanes/FluxPlane.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Features/FluxPlanes/FluxInFlow.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

std::size_t FluxPlaneHandler::copyAndAddObject(const FluxPlane& described) {
    if (hasBegun) throw InputError("Simulation: flux planes can only be added before the run begins.");
    Plane plane;
    plane.normal = checkedDirection("FluxPlane", "length of the normal", described.normal);
    plane.offset = dot(plane.normal, checkedVector("FluxPlane", "point", described.point, "m"));
    planes.push_back(plane);
    return planes.size() - 1;
}

const FluxCount& FluxPlaneHandler::countOf(std::size_t number) const {
    if (number >= planes.size())
        throw InputError(fmt::format("There is no flux plane {}; the scene has {} (counted from 0).", number,
                                     planes.size()));
    return planes[number].count;
}

void FluxPlaneHandler::begin(const PeriodicBox& periodic) {
    hasBegun = true;
    const std::array<double, 3> periods{periodic.length.x, periodic.length.y, periodic.length.z};
    for (std::size_t p = 0; p < planes.size(); ++p) {
        Plane& plane = planes[p];
        const std::array<double, 3> normal{plane.normal.x, plane.normal.y, plane.normal.z};
        for (std::size_t k = 0; k < 3; ++k) {
            if (periods[k] == 0 || normal[k] == 0) continue;
            if (std::abs(normal[k]) < 1)
                throw InputError(
                    fmt::format("flux plane {}: its normal is inclined to {}, along which the scene repeats "
                                "itself; it must be along it or across it.",
                                p, "xyz"[k]));
            plane.period = periods[k];
            plane.axis = static_cast<int>(k);
        }
    }
}

void FluxPlaneHandler::beforeMotion(const ParticleStore& grains, const PeriodicBox& periodic) {
    boxFrom = periodic;
    for (Plane& plane : planes) plane.before = plane.count;
    from.resize(grains.size());
    for (std::size_t k = 0; k < grains.size(); ++k) from[k] = grains.translation[k].position;
    bodiesFrom.resize(grains.bodies.size());
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) bodiesFrom[k] = grains.bodies[k].position;
}

void FluxPlaneHandler::findCrossings(const Plane& plane, const ParticleStore& grains,
                                     const PeriodicBox& periodic, double step) {
    crossings.clear();
    if (!periodic.imagesMove) {
        findCrossingsAtRest(plane, grains);
    } else if (step > 0) {
        const FluxInFlow flow(boxFrom, periodic, step, {plane.normal, plane.offset, plane.axis});
        for (std::uint32_t k = 0; k < grains.ownSize(); ++k) {
            const TranslationRecord& grain = grains.translation[k];
            if (!(grain.radius > 0) || grains.bodies.contains(grains.identity[k])) continue;
            flow.forEachPassage(from[k], grain.position, [&](double times, const Vector<double>& way) {
                crossings.push_back({grains.identity[k], k, RigidBodies::none, times, way});
            });
        }
        for (std::uint32_t k = 0; k < grains.bodies.size(); ++k) {
            const std::uint32_t first = grains.bodies.membersOf(k).front().grain;
            flow.forEachPassage(bodiesFrom[k], grains.bodies[k].position,
                                [&](double times, const Vector<double>& way) {
                                    crossings.push_back({first, grains.place[first], k, times, way});
                                });
        }
    }
    // Places depend on the list of contacts, sums must not. A grain may pass twice in a step.
    std::ranges::stable_sort(crossings, {}, &Crossing::identity);
}

void FluxPlaneHandler::findCrossingsAtRest(const Plane& plane, const ParticleStore& grains) {
    const Vector<double> normal = plane.normal;
    const double offset = plane.offset, period = plane.period;
    // The number of images of the plane, or of the one plane, that lie behind a body changes by 1 at each.
    const auto collect = [&](auto&& imagesBehind) {
        const auto timesOf = [&](const Vector<double>& before, const Vector<double>& now) {
            return imagesBehind(dot(normal, now) - offset) - imagesBehind(dot(normal, before) - offset);
        };
        for (std::uint32_t k = 0; k < grains.ownSize(); ++k) {
            const TranslationRecord& grain = grains.translation[k];
            const double times = timesOf(from[k], grain.position);
            if (times != 0 && grain.radius > 0 && !grains.bodies.contains(grains.identity[k]))
                crossings.push_back(
                    {grains.identity[k], k, RigidBodies::none, times, grain.position - from[k]});
        }
        for (std::uint32_t k = 0; k < grains.bodies.size(); ++k) {
            const Vector<double>& now = grains.bodies[k].position;
            const std::uint32_t first = grains.bodies.membersOf(k).front().grain;
            if (const double times = timesOf(bodiesFrom[k], now); times != 0)
                crossings.push_back({first, grains.place[first], k, times, now - bodiesFrom[k]});
        }
    };
    if (period > 0) collect([=](double distance) { return std::floor(distance / period); });
    else collect([](double distance) { return distance >= 0 ? 1.0 : 0.0; });
}

/// The velocity is the way over the step: that of the grain is the one that contacts are to see, with most
/// integrators that of the end of the step. A way errs by 1e-16 of its place.
void FluxPlaneHandler::OneWay::add(const Crossing& crossing, double ofMass, double ofLiquid, double step) {
    const double times = std::abs(crossing.times);
    number += static_cast<std::uint64_t>(times);
    mass.add(times * ofMass);
    momentum.add((times * ofMass) * ((1 / step) * crossing.way));
    liquid.add(times * ofLiquid);
}

void FluxPlaneHandler::OneWay::addOfOthers(const AllRanks& ranks) {
    number = ranks.sum(number);
    ranks.addUp({&mass, &liquid, &momentum.x, &momentum.y, &momentum.z});
}

void FluxPlaneHandler::count(Plane& plane, ParticleHandler& particles, double step,
                             const std::function<double(std::uint32_t)>& liquidOf,
                             const AllRanks& ranks) const {
    const ParticleStore& grains = ParticleHandler::Inside::grainsInStep(particles);
    OneWay forwards, backwards;
    for (const Crossing& crossing : crossings) {
        OneWay& way = crossing.times > 0 ? forwards : backwards;
        if (crossing.body == RigidBodies::none) {
            way.add(crossing, particles.massAt(crossing.place), liquidOf(crossing.place), step);
            continue;
        }
        double liquid = 0;  // m^3
        for (const BodyMember& member : grains.bodies.membersOf(crossing.body))
            liquid += liquidOf(grains.place[member.grain]);
        way.add(crossing, grains.bodies[crossing.body].mass, liquid, step);
    }
    for (OneWay* const way : {&forwards, &backwards}) way->addOfOthers(ranks);
    FluxCount& all = plane.count;
    all.forwards += forwards.number;
    all.backwards += backwards.number;
    all.massForwards += forwards.mass.value();
    all.massBackwards += backwards.mass.value();
    all.momentumForwards += forwards.momentum.value();
    all.momentumBackwards += backwards.momentum.value();
    all.liquidForwards += forwards.liquid.value();
    all.liquidBackwards += backwards.liquid.value();
}

void FluxPlaneHandler::afterMotion(ParticleHandler& particles, const PeriodicBox& periodic, double step,
                                   const std::function<double(std::uint32_t)>& liquidOf,
                                   const AllRanks& ranks) {
    const ParticleStore& grains = ParticleHandler::Inside::grainsInStep(particles);
    for (Plane& plane : planes) {
        findCrossings(plane, grains, periodic, step);
        if (ranks.any(!crossings.empty())) count(plane, particles, step, liquidOf, ranks);
    }
}

void FluxPlaneHandler::takeBack() {
    for (Plane& plane : planes) plane.count = plane.before;
}

void FluxPlaneHandler::compareSetUp(StateArchive& archive) const {
    archive.same("count", planes.size());
    for (std::size_t k = 0; k < planes.size(); ++k)
        archive.group(std::to_string(k), [&] {
            archive.sameRecord<double>("normal", planes[k].normal);
            archive.same("offset", planes[k].offset, "m");
        });
}

void FluxPlaneHandler::visitState(StateArchive& archive) {
    for (std::size_t k = 0; k < planes.size(); ++k)
        archive.group(std::to_string(k), [&] {
            Plane& plane = planes[k];
            archive.value("forwards", plane.count.forwards);
            archive.value("backwards", plane.count.backwards);
            archive.finite("massForwards", plane.count.massForwards);
            archive.finite("massBackwards", plane.count.massBackwards);
            archive.finite("momentumForwards", plane.count.momentumForwards);
            archive.finite("momentumBackwards", plane.count.momentumBackwards);
            archive.finite("liquidForwards", plane.count.liquidForwards);
            archive.finite("liquidBackwards", plane.count.liquidBackwards);
        });
}

}  // namespace pendular
