#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/NeighbourSearch.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::farGrainTest {
namespace {

using support::Random;

constexpr double r = 1e-3;  // m
constexpr double skin = 0.15 * r;

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

struct Grains {
    std::vector<TranslationRecord> list;

    void add(const Vec3D& place, double radius = r) {
        list.push_back({toVector(place), radius, {0, 0, 0}, 1});
    }
    /// A dense block of grains about a place.
    void addBlock(const Vec3D& place, int edge, std::uint64_t seed) {
        Random random(seed);
        for (int k = 0; k < edge * edge * edge; ++k)
            add(place + 1.9 * r * Vec3D(k % edge, k / edge % edge, k / (edge * edge)) +
                random.inCube(0.2 * r));
    }
    [[nodiscard]] NeighbourSearch search(const PeriodicBox& box = {}) const { return {list, skin, box}; }

    [[nodiscard]] Pairs bruteForce(const PeriodicBox& box = {}) const {
        Pairs pairs;
        for (std::uint32_t i = 0; i < list.size(); ++i)
            for (std::uint32_t j = i + 1; j < list.size(); ++j) {
                const double reach = list[i].radius + list[j].radius + skin;
                const Vector<double> a = box.wrap(list[i].position), b = box.wrap(list[j].position);
                if (squaredNorm(box.nearest(b - a)) < reach * reach) pairs.emplace(i, j);
            }
        return pairs;
    }
};

Pairs found(const NeighbourSearch& search) {
    Pairs pairs;
    for (std::uint32_t i = 0; i < search.grainCount(); ++i)
        search.forEachPartner(i, [&](std::uint32_t j) {
            EXPECT_TRUE(pairs.emplace(std::min(i, j), std::max(i, j)).second) << "found twice";
        });
    return pairs;
}

/// All pairs are found, and a grain meets no more others in its cell than in a dense block: eight times as
/// many of half the size fit there, and grids that repeat themselves lay a few blocks over each other.
void expectFound(const Grains& grains, const PeriodicBox& box = {}) {
    const NeighbourSearch search = grains.search(box);
    const Pairs pairs = grains.bruteForce(box);
    EXPECT_GT(pairs.size(), 100u);
    EXPECT_EQ(found(search), pairs);
    EXPECT_LT(search.crowding(), 40);
}

TEST(FarGrain, doesNotCrowdTheOthersIntoOneCell) {
    for (double far : {1e-1, 1e2, 1e4, 1e9, 1e12})
        for (const Vec3D& direction : {Vec3D(1, 0, 0), Vec3D(0, -1, 0.3), Vec3D(-1, -1, -1)}) {
            Grains grains;
            grains.addBlock({0.01, -0.02, 0.03}, 9, 1);
            for (int k = 1; k < 4; ++k) grains.add(far * k * direction, (k + 1) * r);
            SCOPED_TRACE(far);
            expectFound(grains);
        }
}

TEST(FarGrain, mayBeHalfOfThem) {
    for (double far : {1.0, 1e6}) {
        Grains grains;
        grains.addBlock({0, 0, 0}, 8, 1);
        grains.addBlock(far * Vec3D(1, -2, 3), 8, 2);
        SCOPED_TRACE(far);
        expectFound(grains);
    }
}

TEST(FarGrain, mayBeInAStreamThatFallsFromABed) {
    Grains grains;
    grains.addBlock({0, 0, 0}, 9, 1);
    Random random(4);
    for (int k = 0; k < 600; ++k)
        grains.add(
            {random.uniform(0, 2 * r), random.uniform(0, 2 * r), -4.9 * std::pow(random.uniform(0, 10), 2)});
    expectFound(grains);
}

TEST(FarGrain, mayBeSoInASceneThatRepeatsItself) {
    for (int axes : {1, 2, 5, 6})
        for (double length : {0.03, 0.0501, 3.0, 1e5}) {
            const auto along = [&](int axis) { return (axes >> axis & 1) != 0 ? length : 0; };
            const PeriodicBox box{{-0.01, -0.01, -0.01}, {along(0), along(1), along(2)}};
            Grains grains;
            grains.addBlock({-0.013, -0.012, -0.011}, 8, 1);
            for (double far : {1e3, -1e7, 1e11}) grains.add({far, -2 * far, far});
            SCOPED_TRACE(fmt::format("axes {:03b}, length {}", axes, length));
            expectFound(grains, box);
        }
}

TEST(FarGrain, ofEverySizeIsFound) {
    Random random(8);
    Grains grains;
    for (int k = 0; k < 700; ++k) {
        const double radius = r * std::pow(50, random.uniform(0, 1) * random.uniform(0, 1));
        grains.add(random.inCube(0.03) + 1e5 * Vec3D(k % 2, k % 3, 0), radius);
    }
    const NeighbourSearch search = grains.search();
    EXPECT_EQ(found(search), grains.bruteForce());
}

/// A grain is shot out of a bed: the others do not notice, and the run goes on. Sums in another order: 1e-16
/// of each force, over some hundred steps.
TEST(FarGrain, leavesTheBedAsItIs) {
    using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
    scenes::SettlingBox<Wet> bed(4);
    bed.initialise();
    for (double far : {1e4, 4.4e6}) {  // 1e6 boxes, and nearly as far as grains of 1 mm may be
        scenes::SettlingBox<Wet> scene(4), expected(4);
        SphericalParticle grain;
        grain.setSpecies(scene.speciesHandler.getObject(0));
        grain.setRadius(r);
        grain.setPosition({0.3 * far, -far, far});
        grain.setVelocity({0, -90, 90});  // 0.7 radii a step
        scene.particleHandler.copyAndAddObject(grain);
        scene.wallHandler.clear(), expected.wallHandler.clear();  // no wall in its way
        scene.initialise();
        expected.initialise();
        for (int n = 0; n < 400; ++n) scene.step(), expected.step();
        for (std::size_t k = 0; k < expected.particleHandler.getSize(); ++k) {
            const auto a = scene.particleHandler.getObject(k), b = expected.particleHandler.getObject(k);
            EXPECT_LT((a.getPosition() - b.getPosition()).norm(), 1e-12 * r);
            EXPECT_LT((a.getVelocity() - b.getVelocity()).norm(), 1e-11);
        }
        EXPECT_TRUE(scene.particleHandler.getObject(64).getPosition().allFinite());
        EXPECT_GT(scene.particleHandler.getObject(64).getPosition().norm(), far);
    }
}

}  // namespace
}  // namespace pendular::farGrainTest
