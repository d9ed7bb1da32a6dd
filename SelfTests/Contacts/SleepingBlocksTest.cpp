#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/CombinedLaws.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/ShearedCloud.h"
#include "SelfTests/Support/ContactKey.h"

// Blocks of contacts without memory sleep until two of their bodies can have come near enough, and sleep on
// where nothing has begun then. The reference is brute force: all pairs of grains, in each step.

namespace pendular::sleepingBlocksTest {
namespace {

using scenes::ShearedCloud;
using support::ContactKey;
using support::keyOf;

using Smooth = Species<LinearViscoelastic>;
using Viscous = Species<HertzianViscoelastic, Mindlin, ViscousLiquidBridgeWillett>;

/// The pairs of grains that are nearer than this (m), by the arithmetic of the kernel.
std::set<ContactKey> pairsWithin(const Scene& scene, double gap) {
    const ParticleStore& grains = scene.particleHandler.store();
    const PeriodicBox& box = scene.contacts().periodicBox();
    std::set<ContactKey> found;
    for (std::uint32_t i = 0; i < grains.size(); ++i)
        for (std::uint32_t j = 0; j < i; ++j) {
            const TranslationRecord &a = grains.translation[i], &b = grains.translation[j];
            if (a.radius == 0 || b.radius == 0) continue;
            const double reach = a.radius + b.radius + gap;
            if (squaredNorm(box.nearest(b.position - a.position)) < reach * reach)
                found.insert({-1, std::min(grains.identity[i], grains.identity[j]),
                              std::max(grains.identity[i], grains.identity[j])});
        }
    return found;
}
/// The pairs that the contacts say touch, or are bridged.
std::set<ContactKey> pairsOf(const Scene& scene, bool bridged) {
    const ContactStore& store = scene.contacts().store();
    std::set<ContactKey> found;
    store.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
        if (bucket.wall < 0 && (bridged ? store.isBridged(c) : store.touches(c)))
            found.insert(keyOf(store, scene.particleHandler.store().identity, bucket, c));
    });
    return found;
}

/// Counts how often blocks that were looked at in vain were given another gap.
class GapWatch {
public:
    void look(const Scene& scene) {
        const ContactStore& store = scene.contacts().store();
        if (scene.contacts().rebuildCount() == list)
            for (std::size_t b = 0; b < store.blockCount(); ++b)
                count += store.slots[b] == ContactStore::asleep && store.gaps[b] != gaps[b] ? 1 : 0;
        list = scene.contacts().rebuildCount();
        gaps = store.gaps;
    }
    std::size_t count = 0;

private:
    std::size_t list = 0;
    std::vector<double> gaps;
};

/// So stiff that fast grains do not overlap deeply.
Smooth stiffMaterial() {
    Smooth material = scenes::boxMaterial<Smooth>(0);
    material.setStiffness(3000);
    return material;
}

template <class S>
class FastCloud : public ShearedCloud<S> {
public:
    explicit FastCloud(std::optional<double> shearRate, const S& material = scenes::boxMaterial<S>(0),
                       int threads = 1)
        : ShearedCloud<S>(shearRate, 1, material) {
        this->setQuiet();
        this->setNumberOfThreads(threads);
        for (GrainReference grain : this->particleHandler) {
            const Vec3D flow = this->shearFlowAt(grain.getPosition());
            grain.setVelocity(flow + 30 * (grain.getVelocity() - flow));
        }
    }
};

constexpr int steps = 250;

/// @param change (scene, step) between two steps
template <class Change>
void expectAllTouchesFound(Scene& scene, Change&& change) {
    GapWatch gaps;
    std::size_t touches = 0;
    scene.initialise();
    for (int k = 0; k < steps; ++k) {
        change(scene, k);
        scene.step();
        const std::set<ContactKey> expected = pairsWithin(scene, 0);
        ASSERT_EQ(pairsOf(scene, false), expected) << "step " << k;
        touches += expected.size();
        gaps.look(scene);
    }
    EXPECT_GT(touches, 0u);
    EXPECT_GT(scene.contacts().rebuildCount(), 2u);
    EXPECT_GT(gaps.count, 200u);
}
void expectAllTouchesFound(Scene& scene) {
    expectAllTouchesFound(scene, [](Scene&, int) {});
}

TEST(SleepingBlocks, missNoTouch) {
    for (const int threads : {1, 3}) {
        FastCloud<Smooth> scene({}, stiffMaterial(), threads);
        expectAllTouchesFound(scene);
    }
}
TEST(SleepingBlocks, missNoTouchInShear) {
    FastCloud<Smooth> scene(600.0, stiffMaterial());
    expectAllTouchesFound(scene);
}
TEST(SleepingBlocks, missNoTouchInStrain) {
    FastCloud<Smooth> scene({}, stiffMaterial());
    scene.setStrainRate(0, 100);
    scene.setStrainRate(1, -150);
    expectAllTouchesFound(scene);
}

/// Grains leave, others come into the places that they leave, and some are moved or grow.
TEST(SleepingBlocks, missNoTouchOfGrainsThatComeAndGo) {
    FastCloud<Smooth> scene({}, stiffMaterial());
    expectAllTouchesFound(scene, [](Scene& changed, int k) {
        if (k % 7 != 0) return;
        const auto at = static_cast<std::uint32_t>(37 * k % 512);
        ParticleHandler& particles = changed.particleHandler;
        if (!particles.contains(at)) return;
        const GrainReference gone = particles.getObject(at);
        SphericalParticle grain;
        grain.setSpecies(static_cast<Simulation<Smooth>&>(changed).speciesHandler.getObject(0));
        grain.setRadius(0.5 * gone.getRadius());
        grain.setPosition(gone.getPosition());
        grain.setVelocity(-gone.getVelocity());
        particles.removeObject(at);
        particles.copyAndAddObject(grain);
    });
}

/// Pairs of which some meet head-on and others part, all as fast as the fastest grain: the pairs that part
/// give their blocks to look at in vain, and nothing of the way is left when the others touch.
TEST(SleepingBlocks, missNoTouchOfTheFastest) {
    constexpr double r = 1e-3, speed = 1;  // m, m/s
    support::Random random(6);
    std::size_t touches = 0;
    GapWatch gaps;
    for (int repeats = 0; repeats < 20; ++repeats) {
        std::vector<scenes::GrainMotion> grains;
        for (int k = 0; k < 40; ++k) {
            const Vec3D middle(0, 0, 20 * r * k), towards = random.direction();
            const double gap = random.uniform(0.02, 0.6) * r;
            const double sign = random.uniform(0, 1) < 0.5 ? 1 : -1;
            for (const double side : {-1., 1.})
                grains.push_back({.radius = r,
                                  .position = middle + side * (r + 0.5 * gap) * towards,
                                  .velocity = -sign * side * speed * towards});
        }
        scenes::FewGrains<Smooth> scene(stiffMaterial(), grains, 1e-6);
        scene.setQuiet();
        scene.initialise();
        for (int k = 0; k < 350; ++k) {
            scene.step();
            const std::set<ContactKey> expected = pairsWithin(scene, 0);
            ASSERT_EQ(pairsOf(scene, false), expected) << "step " << k;
            touches += expected.size();
            gaps.look(scene);
        }
    }
    EXPECT_GT(touches, 10000u);
    EXPECT_GT(gaps.count, 15u);
}

/// Bridges that form before a touch, at the gap at which films meet.
TEST(SleepingBlocks, missNoFilmsThatMeet) {
    constexpr double gap = 2e-5;  // m
    Viscous material = scenes::boxMaterial<Viscous>(0);
    material.setViscosity(1e-3);
    material.setRoughness(1e-6);
    material.setFilmContactGap(gap);
    FastCloud<Viscous> scene({}, material);
    GapWatch gaps;
    scene.initialise();
    for (int k = 0; k < steps; ++k) {
        scene.step();
        ASSERT_EQ(pairsOf(scene, false), pairsWithin(scene, 0)) << "step " << k;
        const std::set<ContactKey> bridged = pairsOf(scene, true);
        for (const ContactKey& pair : pairsWithin(scene, gap)) ASSERT_TRUE(bridged.contains(pair)) << k;
        gaps.look(scene);
    }
    EXPECT_GT(gaps.count, 100u);
}

}  // namespace
}  // namespace pendular::sleepingBlocksTest
