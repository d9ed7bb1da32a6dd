#include <gtest/gtest.h>

#include <deque>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"

// Grains that come and go all the time, far from those at rest: no list is needed for them, and places are
// used again.

namespace pendular::steadyFlowTest {
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
    scene.add({0, 0, 1});  // lists keep their cells from now on
    scene.step();
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

/// Settling grains of which neighbours that touch are taken away, two at a time, and others come into their
/// places from above, while blocks of contacts wake.
template <class S>
struct Thinned : scenes::SettlingBox<S> {
    explicit Thinned(bool listsAlways) : scenes::SettlingBox<S>(5), always(listsAlways) {}

    void actionsBeforeTimeStep() override {
        const std::size_t step = this->getNumberOfTimeSteps();
        if (always) {
            GrainReference any = *this->particleHandler.begin();
            any.setRadius(any.getRadius());
        }
        if (step < 500 || step % 40 != 0) return;
        for (const ObservedContact& contact : this->interactions()) {
            if (!contact.touching || contact.wall >= 0) continue;
            this->particleHandler.removeObject(contact.particle1);
            this->particleHandler.removeObject(contact.particle2);
            ++removed;
            break;
        }
        for (const double x : {0.3, 0.7}) {
            SphericalParticle grain;
            grain.setRadius(this->smallRadius);
            grain.setSpecies(this->speciesHandler.getObject(0));
            grain.setPosition({x * this->width, 0.5 * this->width, 0.013});
            bool isRoom = true;
            for (GrainReference other : this->particleHandler)
                isRoom &= (other.getPosition() - grain.getPosition()).norm() >
                          1.01 * (other.getRadius() + this->smallRadius);
            if (isRoom) this->particleHandler.copyAndAddObject(grain);
        }
    }
    bool always;
    int removed = 0;
};

template <class S>
class Thinning : public testing::Test {};
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
using Kinds = testing::Types<Rough, Species<HertzianViscoelastic>, Wet>;
TYPED_TEST_SUITE(Thinning, Kinds);

TYPED_TEST(Thinning, givesTheSameBitsHoweverOftenContactsAreListed) {
    Thinned<TypeParam> rarely(false), always(true);
    rarely.initialise();
    always.initialise();
    for (int k = 0; k < 1400; ++k) {
        rarely.step();
        always.step();
        ASSERT_EQ(stateHash(rarely.particleHandler.store()), stateHash(always.particleHandler.store())) << k;
    }
    EXPECT_GT(rarely.removed, 10);
    EXPECT_LT(rarely.contacts().rebuildCount(), 700u);
}

// A grain that is added, one that is let go, and two that are joined in a run fall from their first step on,
// with each integrator.
TEST(SteadyFlow, whatBeginsToMoveInARunHasItsWeightAtOnce) {
    for (const Integrator& scheme : integrators::all) {
        scenes::FewGrains<Rough> scene(scenes::boxMaterial<Rough>(0),
                                       {{.radius = r, .position = {0, 0, 0}, .fixed = true}}, 2e-6);
        scene.setGravity({0, 0, -9.81});
        scene.setIntegrator(scheme);
        scene.run(10);
        const auto add = [&](const Vec3D& position) {
            SphericalParticle grain;
            grain.setRadius(r);
            grain.setSpecies(scene.speciesHandler.getObject(0));
            grain.setPosition(position);
            return scene.particleHandler.copyAndAddObject(grain).getId();
        };
        scene.particleHandler.getObject(0).fixParticle(false);
        std::vector<std::uint32_t> falling{0, add({9 * r, 0, 0})};
        if (!scheme.remembersEarlier() && !scheme.contacts.springsInStep) {  // those move no bodies
            const std::uint32_t a = add({0, 9 * r, 0}), b = add({0, 11.5 * r, 0});
            scene.bodyHandler.join({a, b});
            falling.push_back(a);
        }
        for (int k = 0; k < 50; ++k) scene.step();
        for (const std::uint32_t grain : falling)
            EXPECT_NEAR(scene.motion(grain).velocity.z() / (-9.81 * 50 * scene.getTimeStep()), 1, 1e-12)
                << scheme.name << ", grain " << grain;
    }
}

}  // namespace
}  // namespace pendular::steadyFlowTest
