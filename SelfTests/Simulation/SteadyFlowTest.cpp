#include <gtest/gtest.h>

#include <deque>

#include "Kernel/Simulation/StateHash.h"
#include "Kernel/Species/Friction/Mindlin.h"
#include "Kernel/Species/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"

// Grains that come and go all the time, far from those at rest: no list is needed for them, and places are
// used again.

namespace pendular {
namespace {

using Rough = Species<HertzianViscoelastic, Mindlin>;

constexpr double r = 0x1p-10;  // m

/// Sixteen grains at rest on a floor.
std::vector<scenes::GrainMotion> floorGrains() {
    std::vector<scenes::GrainMotion> grains;
    for (int k = 0; k < 16; ++k)
        grains.push_back({.radius = r, .position = {2.5 * r * (k % 4), 2.5 * r * (k / 4), 0.9999 * r}});
    return grains;
}

struct Resting : scenes::FewGrains<Rough> {
    Resting() : FewGrains(scenes::boxMaterial<Rough>(0), floorGrains(), 2e-6, {{{0, 0, -1}, {0, 0, 0}}}) {}

    std::uint32_t add(const Vec3D& position) {
        SphericalParticle grain;
        grain.setRadius(r);
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setPosition(position);
        return particleHandler.copyAndAddObject(grain).getId();
    }
};

struct Flow : Resting {
    void actionsBeforeTimeStep() override {
        for (int k = 0; k < 3; ++k) {
            if (alive.size() == 60) {
                particleHandler.removeObject(alive.front());
                alive.pop_front();
            }
            alive.push_back(add(3 * r * Vec3D(added % 2, added / 2 % 2, 3 + added / 4 % 40)));
            ++added;
        }
    }
    std::deque<std::uint32_t> alive;
    int added = 0;
};

TEST(SteadyFlow, usesPlacesAgainWithoutALongerStore) {
    Flow flow;
    flow.initialise();
    for (int k = 0; k < 200; ++k) flow.step();
    const std::size_t lists = flow.contacts().rebuildCount(), places = flow.particleHandler.store().size();
    const std::size_t bytes = flow.particleHandler.store().bytes() + flow.contacts().bytes();
    for (int k = 0; k < 10000; ++k) flow.step();
    EXPECT_EQ(flow.added, 30600);
    EXPECT_EQ(flow.contacts().rebuildCount(), lists);
    EXPECT_EQ(flow.particleHandler.store().size(), places);
    EXPECT_EQ(flow.particleHandler.getSize(), 16u + 60u);
    // A page of the index from identities to places holds 4096 of them, and goes when all have gone.
    EXPECT_LE(flow.particleHandler.store().bytes() + flow.contacts().bytes(), bytes + 4 * 4096 * 4);
}

TEST(SteadyFlow, aGrainInAnothersPlaceIsANewOne) {
    Flow flow;
    auto column = flow.particleHandler.addColumn("age", "s", 0.5);
    flow.initialise();
    for (int k = 0; k < 30; ++k) flow.step();
    column[flow.alive.front()] = 7;
    const std::uint32_t gone = flow.alive.front(), place = flow.particleHandler.store().place[gone];
    flow.step();
    EXPECT_FALSE(flow.particleHandler.contains(gone));
    const std::uint32_t here = flow.particleHandler.store().identity[place];
    EXPECT_GT(here, gone);
    EXPECT_EQ(column[here], 0.5);
    EXPECT_EQ(flow.particleHandler.getObject(here).getVelocity(), Vec3D::Zero());
    EXPECT_TRUE(flow.interactionsOf(here).empty());
}

// The grain that takes the place of one that touched another sums none of its contacts.
TEST(SteadyFlow, theContactsOfAGrainGoWithIt) {
    Resting scene;
    scene.setGravity({0, 0, -9.81});
    scene.run(10);
    ASSERT_EQ(scene.interactions().size(), 16u);
    const std::uint32_t gone = 5, place = scene.particleHandler.placeOf(gone);
    const std::size_t lists = scene.contacts().rebuildCount();
    scene.particleHandler.removeObject(gone);
    const std::uint32_t added = scene.add({0, 0, 0.5});
    ASSERT_EQ(scene.particleHandler.placeOf(added), place);
    for (int k = 0; k < 5; ++k) {
        scene.step();
        EXPECT_EQ(scene.contactForceOn(added), Vec3D::Zero());
    }
    EXPECT_EQ(scene.contacts().rebuildCount(), lists);  // so that the old sides were there
    EXPECT_NEAR(scene.particleHandler.getObject(added).getVelocity().z() / (-9.81 * 5 * scene.getTimeStep()),
                1, 1e-12);
}

}  // namespace
}  // namespace pendular
