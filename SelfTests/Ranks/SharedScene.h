#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <mutex>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/AdaptiveTimeStep/AdaptiveStep.h"
#include "Kernel/Features/DomainDecomposition/GrainSharing.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/StateHash.h"
#include "Tools/Reference/VirtualRanks.h"

namespace pendular::ranks {

/// Adds the grains and rigid bodies of one store to another one, as a rank gets them.
inline void addGrains(ParticleStore& to, ParticleStore& from) {
    to.hasSpin = from.hasSpin;
    to.remembersEarlier = from.remembersEarlier;
    to.remembersStart = from.remembersStart;
    if (to.columns.empty()) {
        to.columns = from.columns;
        for (GrainColumn& column : to.columns) column.values.clear();
    }
    for (const std::uint32_t place : from.place) {
        Message row;
        from.visitRow(place, [&](const auto& value) { row.add(value); });
        to.visitRow(to.addPlace(from.identity[place]), [&](auto& value) { row.take(value); });
    }
    for (std::size_t k = 0; k < from.bodies.size(); ++k) {
        Message row;
        from.bodies.writeRow(k, [&](const auto& value) { row.add(value); });
        to.bodies.takeRow([&](auto& value) { row.take(value); }, false);
    }
    to.bodies.sort();
}

/// How many events of contacts there have been, by kind.
inline auto eventCounts(const Scene& scene) {
    const ContactEventCounts counts = scene.contactEventCounts();
    std::array<std::uint64_t, sizeof(ContactEventCounts) / sizeof(std::uint64_t)> all{};
    std::memcpy(all.data(), &counts, sizeof counts);
    return all;
}

/// What a scene tells of itself as a whole: all ranks tell the same, and one scene with all grains too.
inline std::vector<double> toldBy(const Scene& scene) {
    std::vector<double> told{scene.getTime(),      scene.getTimeStep(),      scene.getShearRate(),
                             scene.getTotalMass(), scene.getKineticEnergy(), scene.getRotationalEnergy()};
    const auto tell = [&](const Vec3D& vector) { told.insert(told.end(), vector.begin(), vector.end()); };
    tell(scene.getTotalMomentum());
    tell(scene.getCentreOfMass());
    for (int axis = 0; axis < 3; ++axis) told.push_back(scene.getStrainRate(axis));
    told.push_back(static_cast<double>(scene.particleHandler.getSize()));
    told.push_back(static_cast<double>(scene.contacts().counts().acting));
    const ContactSystem& contacts = scene.contacts();
    told.push_back(contacts.overlaps().largestOverlap());
    told.push_back(contacts.capillaryNumbers().largestNumber());
    for (const std::uint64_t count :
         {contacts.overlaps().countAbove(), contacts.capillaryNumbers().countAbove()})
        told.push_back(static_cast<double>(count));
    for (const auto& entry : EnergyLedger::entries()) told.push_back(scene.energyLedger().*entry.member);
    for (std::size_t w = 0; w < scene.wallHandler.getSize(); ++w) {
        if (scene.wallHandler.isRemoved(w)) continue;
        const Wall& wall = scene.wallHandler.getObject(w);
        if (wall.keepsForces()) tell(wall.getForce()), tell(wall.getTorque());
        if (const PlaneDrive* const drive = wall.drive()) told.push_back(drive->velocity);
        if (const WallBody* const body = wall.body()) told.push_back(body->speed);
    }
    if (scene.movesLiquid()) {
        const LiquidLedger liquid = scene.liquidLedger();
        told.insert(told.end(), {liquid.unaccounted(), liquid.films, liquid.bridges, liquid.walls,
                                 liquid.removed, liquid.evaporated});
        for (std::size_t w = 0; w < scene.wallHandler.getSize(); ++w) told.push_back(scene.liquidOfWall(w));
    }
    for (const std::uint64_t count : eventCounts(scene)) told.push_back(static_cast<double>(count));
    for (std::size_t k = 0; k < scene.inletHandler.getSize(); ++k) {
        const InletCount& come = scene.inletHandler.countOf(k);
        told.insert(told.end(), {static_cast<double>(come.number), come.mass, come.lost});
    }
    for (std::size_t k = 0; k < scene.outletHandler.getSize(); ++k) {
        const GrainTally::Entry gone = scene.outletHandler.countOf(k).all();
        told.push_back(static_cast<double>(gone.number)), told.push_back(gone.mass);
    }
    for (std::size_t k = 0; k < scene.fluxPlaneHandler.getSize(); ++k) {
        const FluxCount& count = scene.fluxPlaneHandler.countOf(k);
        told.push_back(static_cast<double>(count.forwards));
        told.push_back(static_cast<double>(count.backwards));
        told.push_back(count.massForwards), told.push_back(count.massBackwards);
        tell(toEigen(count.momentumForwards)), tell(toEigen(count.momentumBackwards));
    }
    told.push_back(static_cast<double>(scene.adaptiveTimeStep().choiceCount()));
    return told;
}

/// The hash of grains, with their columns, and of all that is kept of rigid bodies.
inline std::uint64_t hashOf(const ParticleStore& grains) {
    std::uint64_t hash = stateHash(grains);
    const auto add = [&hash](std::uint64_t number) { hash = (hash ^ number) * 0x100000001b3u; };
    for (const GrainColumn& column : grains.columns)
        for (const std::uint32_t place : grains.place)
            add(std::bit_cast<std::uint64_t>(column.values[place]));
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        add(grains.bodies.numberOf(k));
        const auto* const numbers = reinterpret_cast<const double*>(&grains.bodies[k]);
        for (std::size_t n = 0; n < sizeof(RigidBody) / sizeof(double); ++n)
            add(std::bit_cast<std::uint64_t>(numbers[n]));
    }
    return hash;
}

/// What ranks have come to together.
struct Outcome {
    std::uint64_t hash = 0;                            // of the grains and bodies of all
    std::size_t grains = 0, fewest = ~std::size_t{0};  // of all ranks, and of one
    RankCounts counts;                                 // sums
    std::vector<double> told;                          // toldBy()
    bool tellTheSame = true;                           // all ranks
};

/// Runs a scene on virtual ranks. Where cuts wander, all grains are gathered on the way.
/// @param make (use) makes the scene and calls use(scene), on each rank; @param Through what a rank has
/// instead of its exchange
template <class Through = Exchange&, class Make>
Outcome runOnRanks(std::size_t ranks, const RankOptions& options, std::size_t steps, Make&& make) {
    ParticleStore all;
    Outcome outcome;
    std::mutex mutex;
    VirtualRanks(ranks).run([&](Exchange& exchange) {
        Through through(exchange);
        make([&](Scene& scene) {
            scene.setRanks(through, options);
            scene.initialise();
            if (options.cutsWander) {
                scene.step(steps / 2);
                scene.gather();
                scene.step(steps - steps / 2);
            } else {
                scene.step(steps);
            }
            const std::vector<double> told = toldBy(scene);
            ParticleStore own = scene.particleHandler.store();
            const std::lock_guard lock(mutex);
            if (outcome.told.empty()) outcome.told = told;
            outcome.tellTheSame &= outcome.told == told;
            addGrains(all, own);
            outcome.fewest = std::min(outcome.fewest, own.count());
            const RankCounts counts = scene.rankCounts();
            outcome.counts.lists = counts.lists;
            outcome.counts.migrated += counts.migrated;
            outcome.counts.asked += counts.asked;
            outcome.counts.ghosts += counts.ghosts;
            outcome.counts.heldTwice += counts.heldTwice;
            outcome.counts.unequal += counts.unequal;
        });
    });
    outcome.hash = hashOf(all);
    outcome.grains = all.count();
    return outcome;
}

inline constexpr RankOptions cutsStay{}, cutsWander{.cutsWander = true};

/// Runs the scene without ranks, for so many steps or more, until contacts have been listed five times, and
/// on so many ranks, and compares. With cuts that wander grains change their rank at each list.
/// @param isDilute perhaps no grain comes near to one of another rank
template <class Make>
void expectSameOnRanks(std::size_t leastSteps, Make&& make,
                       std::initializer_list<std::size_t> rankCounts = {1, 2, 3, 4, 7},
                       bool isDilute = false) {
    std::uint64_t expected = 0;
    std::size_t grains = 0, steps = 0;
    std::vector<double> told;
    make([&](Scene& scene) {
        scene.initialise();
        scene.step(leastSteps);
        while (scene.contacts().rebuildCount() < 5) scene.step(20);
        told = toldBy(scene);
        expected = hashOf(scene.particleHandler.store());
        grains = scene.particleHandler.getSize();
        steps = scene.getNumberOfTimeSteps();
    });
    for (const RankOptions& options : {cutsStay, cutsWander})
        for (const std::size_t count : rankCounts) {
            const Outcome found = runOnRanks(count, options, steps, make);
            SCOPED_TRACE(fmt::format("{} ranks, cuts {}", count, options.cutsWander ? "wander" : "stay"));
            EXPECT_EQ(found.hash, expected);
            EXPECT_EQ(found.grains, grains);
            EXPECT_EQ(found.told, told);
            EXPECT_TRUE(found.tellTheSame);
            EXPECT_EQ(found.counts.unequal, 0u);
            if (count == 1) continue;
            if (!isDilute) {
                EXPECT_GT(found.counts.asked, 0u);
            }
            if (options.cutsWander) {
                EXPECT_GT(found.counts.migrated, grains / 2);
            }
        }
}

}  // namespace pendular::ranks
