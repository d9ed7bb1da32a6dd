#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Quantum.h"

namespace pendular::contactEventTest {
namespace {

using Kind = ContactEvent::Kind;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
using scenes::FewGrains;
using scenes::SettlingBox;

constexpr double r = 1e-3;  // m

/// Takes note of what it hears.
template <class Scene>
class Listening : public Scene {
public:
    using Scene::Scene;
    void actionsOnContactEvent(const ContactEvent& event) override { heard.push_back(event); }
    std::vector<ContactEvent> heard;
};

// A wet grain meets another one and leaves it: they touch, which forms the bridge, part, and the bridge
// ruptures where it must: S_c = R (1 + theta/2) (V*^(1/3) + V*^(2/3) / 10), V* = V / R^3, where R is the
// radius of equal grains.
TEST(ContactEvent, tellsTheStoryOfAWetCollision) {
    const Wet material = scenes::boxMaterial<Wet>(0);
    Listening<FewGrains<Wet>> scene(
        material,
        std::vector<scenes::GrainMotion>{{.velocity = {0.5, 0, 0}},
                                         {.position = {2.02 * r, 0, 0}, .velocity = {-0.5, 0, 0}}},
        1e-6);
    scene.listenToContacts();
    scene.initialise();
    EXPECT_TRUE(scene.heard.empty());
    double atEnd = 0, before = 0;
    for (int k = 0; k < 3000 && scene.heard.size() < 4; ++k) {
        before = (scene.motion(1).position - scene.motion(0).position).norm() - 2 * r;
        scene.step();
        atEnd = (scene.motion(1).position - scene.motion(0).position).norm() - 2 * r;
        for (const ContactEvent& event : scene.contactEvents()) {
            EXPECT_EQ(event.particle1, 0u);
            EXPECT_EQ(event.particle2, 1u);
            EXPECT_EQ(event.wall, -1);
            if (event.kind == Kind::TouchBegins) {
                EXPECT_TRUE(before >= 0 && atEnd < 0);
            }
            if (event.kind == Kind::TouchEnds) {
                EXPECT_TRUE(before < 0 && atEnd >= 0);
            }
        }
    }
    ASSERT_EQ(scene.heard.size(), 4u);
    const Kind story[] = {Kind::TouchBegins, Kind::BridgeForms, Kind::TouchEnds, Kind::BridgeRuptures};
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(scene.heard[k].kind, story[k]) << k;
    const double cube = std::cbrt(material.getLiquidBridgeVolume()) / r;
    const double rupture = r * (1 + 0.5 * material.getContactAngle()) * (cube + cube * cube / 10);
    EXPECT_LT(before, rupture);
    EXPECT_GE(atEnd, rupture);
    EXPECT_EQ(scene.contactEventCounts().bridgesRuptured, 1u);
}

TEST(ContactEvent, costsAndTellsNothingWhereNobodyListens) {
    Listening<SettlingBox<Wet>> scene(2);
    scene.initialise();
    for (int k = 0; k < 600; ++k) scene.step();
    EXPECT_TRUE(scene.heard.empty());
    EXPECT_EQ(scene.contactEventCounts().touchesBegun, 0u);
}

// What has begun and not ended is there, through lists that are made again, removals and all; in the same
// order for any number of threads.
TEST(ContactEvent, addsUpToTheContactsThatThereAre) {
    const auto run = [](int threads) {
        auto scene = std::make_unique<Listening<SettlingBox<Wet>>>(4);
        scene->listenToContacts();
        scene->setNumberOfThreads(threads);
        scene->initialise();
        std::set<std::tuple<std::uint32_t, std::uint32_t, int>> touching, bridged;
        std::size_t heard = 0;
        for (int k = 0; k < 900; ++k) {
            if (k % 100 == 99) scene->particleHandler.removeObject(static_cast<std::size_t>(k / 100));
            scene->step();
            for (; heard < scene->heard.size(); ++heard) {
                const ContactEvent& e = scene->heard[heard];
                auto& set = e.kind == Kind::TouchBegins || e.kind == Kind::TouchEnds ? touching : bridged;
                const std::tuple key{e.particle1, e.particle2, e.wall};
                const bool begins = e.kind == Kind::TouchBegins || e.kind == Kind::BridgeForms;
                EXPECT_EQ(begins ? set.insert(key).second : set.erase(key) == 1, true);
            }
            if (k % 50 != 0) continue;
            std::set<std::tuple<std::uint32_t, std::uint32_t, int>> touchingNow, bridgedNow;
            for (const ObservedContact& c : scene->interactions()) {
                const std::tuple key{c.particle1, c.particle2, c.wall};
                if (c.touching) touchingNow.insert(key);
                if (c.bridged) bridgedNow.insert(key);
            }
            EXPECT_EQ(touching, touchingNow) << k;
            EXPECT_EQ(bridged, bridgedNow) << k;
        }
        const ContactEventCounts& counts = scene->contactEventCounts();
        EXPECT_EQ(counts.touchesBegun + counts.touchesEnded + counts.bridgesFormed + counts.bridgesRuptured,
                  scene->heard.size());
        EXPECT_GT(counts.bridgesRuptured, 10u);
        EXPECT_GT(scene->contacts().rebuildCount(), 10u);
        return scene->heard;
    };
    EXPECT_EQ(run(1), run(2));
}

// The contacts of a grain give it its force, besides its weight; also where it is held.
TEST(Interactions, ofAGrainSumToItsForce) {
    SettlingBox<Wet> scene(4);
    scene.initialise();
    for (int k = 0; k < 1200; ++k) scene.step();
    int several = 0;
    for (GrainReference grain : scene.particleHandler) {
        const auto contacts = scene.interactionsOf(grain.getId());
        several += contacts.size() > 2 ? 1 : 0;
        double scale = grain.getMass() * 9.81;
        for (const ObservedContact& c : contacts) {
            EXPECT_TRUE(c.particle1 == grain.getId() || c.particle2 == grain.getId());
            scale += norm(c.force);
            EXPECT_NEAR(dot(c.tangentialForce(), c.normal()), 0, 1e-12 * norm(c.force));
        }
        const Vec3D sum = scene.contactForceOn(grain.getId()) + grain.getMass() * Vec3D(0, 0, -9.81);
        // Of some ten roundings, and those to half a quantum.
        EXPECT_LT((sum - grain.getForce()).norm(),
                  1e-14 * scale * 10 + 5 * support::quantumOf(scene, grain.getRadius()));
    }
    EXPECT_GT(several, 10);

    FewGrains<Wet> pair(scenes::boxMaterial<Wet>(0), {{.fixed = true}, {.position = {1.99 * r, 0, 0}}}, 1e-7);
    pair.run(3);
    EXPECT_LT(pair.contactForceOn(0).x(), 0);
    EXPECT_EQ(pair.contactForceOn(0), -pair.contactForceOn(1));
    const ObservedContact contact = pair.interactions().at(0);
    EXPECT_NEAR(contact.point.x, 0.995 * r, 1e-3 * r);  // in the middle of the overlap
    EXPECT_EQ(contact.bridgeVolume, 2e-12);
    EXPECT_NEAR(contact.overlap(), 0.01 * r, 1e-3 * r);
    // Mass, centre and energies of the grains that can move.
    const double mass = pair.particleHandler.getObject(1).getMass();
    EXPECT_EQ(pair.getTotalMass(), mass);
    EXPECT_LT((pair.getCentreOfMass() - pair.motion(1).position).norm(), 1e-15 * r);
    EXPECT_NEAR(pair.getKineticEnergy() / (0.5 * mass * pair.motion(1).velocity.squaredNorm()), 1, 1e-14);
    EXPECT_EQ(pair.getTotalMomentum(), mass * pair.motion(1).velocity);
}

}  // namespace
}  // namespace pendular::contactEventTest
