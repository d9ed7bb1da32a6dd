// The step of the contacts with a wall that forces move, whose contacts lie on several ranks.
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <vector>

#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "Tools/Reference/VirtualRanks.h"

namespace pendular::movedWallStepTest {
namespace {

using Linear = Species<LinearViscoelastic>;

/// A layer of grains between a floor and a light lid.
struct UnderALid : scenes::FewGrains<Linear> {
    static constexpr double r = 1e-3, overlap = 1e-5;  // m
    static constexpr int side = 6;

    UnderALid() : FewGrains(material(), layer(), 1e-7, {{{0, 0, -1}, {0, 0, 0}}}) {
        setQuiet();
        acceptUnstableTimeStep();
        InfiniteWall lid;
        lid.set({0, 0, 1}, {0, 0, 2 * r - 2 * overlap});
        lid.setSpecies(speciesHandler.getObject(0));
        lid.setPiston(2 * sphereMass(r, 2500), side * side * 1000 * overlap);
        wallHandler.copyAndAddObject(lid);
    }
    static Linear material() {
        Linear species;
        species.setDensity(2500), species.setStiffness(1000), species.setDissipation(1e-3);
        return species;
    }
    static std::vector<scenes::GrainMotion> layer() {
        std::vector<scenes::GrainMotion> grains;
        for (int k = 0; k < side * side; ++k)
            grains.push_back(
                {.radius = r, .position = {2.5 * r * (k % side), 2.5 * r * (k / side), r - overlap}});
        return grains;
    }
};

/// All 36 contacts of the lid count, on whatever rank they are: 36 k / M and more, and the same bits.
TEST(MovedWallStep, isTheSameOnAnyNumberOfRanks) {
    std::vector<double> found;
    std::mutex mutex;
    const auto run = [&](Exchange* exchange) {
        UnderALid scene;
        if (exchange) scene.setRanks(*exchange, ranks::cutsWander);
        scene.initialise();
        scene.step(30);
        const double step = scene.stableStepOfContacts();
        const std::lock_guard lock(mutex);
        found.push_back(step);
    };
    run(nullptr);
    for (const std::size_t count : {2u, 3u})
        VirtualRanks(count).run([&](Exchange& exchange) { run(&exchange); });
    ASSERT_EQ(found.size(), 6u);
    const double ofLid = 36 * 1000 / (2 * sphereMass(UnderALid::r, 2500));
    EXPECT_LT(found[0], 2 / std::sqrt(ofLid));
    EXPECT_GT(found[0], 1 / std::sqrt(ofLid));
    for (const double step : found) EXPECT_EQ(step, found[0]);
}

}  // namespace
}  // namespace pendular::movedWallStepTest
