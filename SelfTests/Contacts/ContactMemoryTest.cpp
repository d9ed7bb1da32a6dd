#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/TimeIntegration.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Adhesion/IrreversibleAdhesive.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/SlidingRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearPlasticViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/ContactKey.h"

namespace pendular::contactMemoryTest {
namespace {

using scenes::SettlingBox;
using support::ContactKey;
using support::keyOf;

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

constexpr double r = 1e-3;  // m

/// Runs a scene with a contact system of the test's own, so that the test chooses the skin.
template <class S>
struct Settling {
    explicit Settling(double skin) : scene(6) {
        scene.speciesHandler.mixAll();
        system.prepare(scene.laws(), scene.wallHandler, {}, SkinChoice::fixed(skin), false);
        step(0);
    }
    void step(double length) {
        auto& grains = scene.particleHandler.store();
        system.refresh(grains, std::sqrt(TimeIntegration::begin(grains, length)), 0);
        system.computeForces(grains, length);
        TimeIntegration::finish(grains, system.store(), {0, 0, -9.81}, length);
    }
    void advance(int steps) {
        for (int k = 0; k < steps; ++k) step(scene.getTimeStep());
    }

    SettlingBox<S> scene;
    ContactSystem system;
};

/// This species remembers what every kind of law remembers.
using PlasticRolling = Species<LinearPlasticViscoelastic, SlidingRollingTorsion, IrreversibleAdhesive>;

template <class S>
void expectTrajectoriesIndependentOfTheSkin() {
    Settling<S> always(0), rarely(0.5 * r);
    // Until grains have met, bridges have ruptured, and contacts have slid.
    always.advance(1000);
    rarely.advance(1000);
    EXPECT_EQ(always.system.rebuildCount(), 1001u);
    EXPECT_LT(rarely.system.rebuildCount(), 100u);
    EXPECT_GT(rarely.system.rebuildCount(), 5u);
    int stretched = 0;
    always.system.store().forEachListed([&](const Bucket& bucket, std::uint32_t c) {
        const ObservedContact seen = always.system.observe(always.scene.particleHandler.store(), bucket, c);
        stretched += seen.bridged && seen.separation > 0 ? 1 : 0;
    });
    EXPECT_GT(stretched, 10);
    for (std::size_t k = 0; k < always.scene.particleHandler.getSize(); ++k) {
        const auto a = always.scene.particleHandler.getObject(k),
                   b = rarely.scene.particleHandler.getObject(k);
        EXPECT_EQ(a.getPosition(), b.getPosition()) << k;
        EXPECT_EQ(a.getVelocity(), b.getVelocity()) << k;
        EXPECT_EQ(a.getAngularVelocity(), b.getAngularVelocity()) << k;
    }
}

// Bit for bit: a grain sums its contacts in the order of its partners, however they are listed.
TEST(ContactMemory, makesTrajectoriesIndependentOfTheSkin) { expectTrajectoriesIndependentOfTheSkin<Wet>(); }
TEST(ContactMemory, ofAllKindsOfLawsMakesTrajectoriesIndependentOfTheSkin) {
    expectTrajectoriesIndependentOfTheSkin<PlasticRolling>();
}

struct Memory {
    Vector<double> spring{0, 0, 0};
    double bridgeForce = 0, lastForce = 0;
    bool touching = false, bridged = false, closing = false;

    bool operator==(const Memory&) const = default;
};

std::map<ContactKey, Memory> memories(Settling<Wet>& run) {
    std::map<ContactKey, Memory> result;
    const auto& store = run.system.store();
    const auto& identity = run.scene.particleHandler.store().identity;
    run.system.store().forEachListed([&](const Bucket& bucket, std::uint32_t c) {
        const BlockState& state = store.states[c / Pack::lanes];
        const auto bit = [&](std::uint8_t bits) { return (bits >> (c % Pack::lanes) & 1) != 0; };
        if (!bit(state.touching) && !bit(state.bridged)) return;
        const ContactBlock& block = store.blocks[c / Pack::lanes];
        if (bucket.wall < 0) {
            EXPECT_LT(identity[block.first[c % Pack::lanes]], identity[block.second[c % Pack::lanes]]);
        }
        ContactNumbers history, interaction;
        store.memory.history.get(store.slotOf(c), history.data());
        store.memory.interaction.get(store.slotOf(c), interaction.data());
        const Vector<double> spring = memoryFrom<Mindlin::History<double>>(history.data()).displacement;
        result[keyOf(store, identity, bucket, c)] = {
            spring,
            memoryFrom<LiquidBridgeBagheri::Interaction<double>>(interaction.data()).contactForce,
            store.normalForceOf(c),
            bit(state.touching),
            bit(state.bridged),
            bit(state.closing)};
    });
    return result;
}

TEST(ContactMemory, isCarriedOverARebuildBitForBit) {
    Settling<Wet> run(0.1 * r);
    run.advance(900);
    auto& grains = run.scene.particleHandler.store();
    const auto before = memories(run);
    EXPECT_GT(before.size(), 100u);
    EXPECT_TRUE(std::ranges::any_of(before, [](const auto& m) { return m.second.spring.x != 0; }));
    const auto records = [&] {
        std::vector<TranslationRecord> byIdentity;
        for (std::uint32_t place : grains.place) byIdentity.push_back(grains.translation[place]);
        return byIdentity;
    };
    run.system.refresh(grains, 1, 0);
    EXPECT_EQ(memories(run), before);
    EXPECT_TRUE(std::ranges::any_of(before, [](const auto& m) { return std::get<0>(m.first) >= 0; }));

    // Turned upside down, grains are sorted in another order; nothing else happens to the pairs.
    const PlaceIndex placesBefore = grains.place;
    for (TranslationRecord& grain : grains.translation) grain.position = -grain.position;
    const auto expected = records();
    run.system.refresh(grains, 1, 0);
    const auto pairsOf = [](std::map<ContactKey, Memory> all) {
        std::erase_if(all, [](const auto& m) { return std::get<0>(m.first) >= 0; });
        return all;
    };
    EXPECT_EQ(pairsOf(memories(run)), pairsOf(before));
    EXPECT_NE(grains.place, placesBefore);
    const auto found = records();
    for (std::uint32_t k = 0; k < grains.size(); ++k) {
        EXPECT_EQ(grains.identity[grains.place[k]], k);
        EXPECT_EQ(found[k].position, expected[k].position);
        EXPECT_EQ(found[k].velocity, expected[k].velocity);
        EXPECT_EQ(found[k].radius, expected[k].radius);
    }
}

TEST(ContactMemory, forgetsContactsThatHaveEnded) {
    Settling<Wet> run(0.1 * r);
    run.advance(900);
    auto& grains = run.scene.particleHandler.store();
    ASSERT_GT(memories(run).size(), 100u);
    for (TranslationRecord& grain : grains.translation) grain.position *= 100;
    run.scene.wallHandler.clear();
    run.system.refresh(grains, 1, 0);
    run.system.computeForces(grains, 1e-6);
    EXPECT_TRUE(memories(run).empty());
    run.system.store().forEachListed(
        [&](const Bucket&, std::uint32_t c) { EXPECT_EQ(squaredNorm(run.system.store().forceOf(c)), 0); });
}

}  // namespace
}  // namespace pendular::contactMemoryTest
