#include "Kernel/Core/Contacts/PairSearch.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/NeighbourSearch.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/ShearOf.h"

namespace pendular::pairSearchTest {
namespace {

using support::Random;

constexpr double r = 1e-3;  // m

using Pair = std::pair<std::uint32_t, std::uint32_t>;
/// m and m/s
struct Approach {
    double gap, closing;
};
using Pairs = std::map<Pair, Approach>;
using Grains = std::vector<TranslationRecord>;

TranslationRecord grainAt(const Vector<double>& place, double radius, Random& random) {
    return {place, radius, toVector(random.inCube(0.3)), 1};
}

/// Grains about the middle of a box, also outside of it, of radii in a ratio up to this one; each seventh
/// place is a gap.
Grains randomGrains(int count, double edge, double ratio, Random& random,
                    const Vector<double>& middle = {0, 0, 0}) {
    Grains grains;
    for (int k = 0; k < count; ++k) {
        grains.push_back(grainAt(middle + toVector(random.inCube(0.5 * edge)),
                                 r * std::pow(ratio, random.uniform(0, 1)), random));
        if (k % 7 == 6) grains.back().radius = grains.back().inverseMass = 0;
    }
    return grains;
}

Pairs bruteForce(const Grains& grains, double margin, const PeriodicBox& box) {
    Pairs pairs;
    for (std::uint32_t i = 0; i < grains.size(); ++i)
        for (std::uint32_t j = i + 1; j < grains.size(); ++j) {
            const TranslationRecord &a = grains[i], &b = grains[j];
            if (a.radius == 0 || b.radius == 0) continue;
            const Vector<double> shift = box.nearest(box.wrap(b.position) - box.wrap(a.position));
            const double reach = a.radius + 0.5 * margin + (b.radius + 0.5 * margin);
            if (squaredNorm(shift) < reach * reach)
                pairs[{i, j}] = {norm(shift) - a.radius - b.radius,
                                 -dot(shift, b.velocity - a.velocity) / norm(shift)};
        }
    return pairs;
}

Pairs pairsOf(const PairSearch& search, std::size_t count) {
    Pairs pairs;
    for (std::uint32_t i = 0; i < count; ++i)
        search.forEachPartner(i, [&](std::uint32_t j, double gap, double closing) {
            EXPECT_TRUE(pairs.emplace(std::minmax(i, j), Approach{gap, closing}).second) << "found twice";
        });
    return pairs;
}

std::vector<Pair> keysOf(const Pairs& pairs) {
    std::vector<Pair> keys;
    for (const auto& [pair, approach] : pairs) keys.push_back(pair);
    return keys;
}

std::vector<Pair> pairsOf(const NeighbourSearch& search, const Grains& grains) {
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i < grains.size(); ++i)
        if (grains[i].radius > 0)
            search.forEachPartner(i, [&](std::uint32_t j) { pairs.push_back(std::minmax(i, j)); });
    std::ranges::sort(pairs);
    return pairs;
}

/// The pairs are those of brute force and of the other search, with their gaps and speeds: of distances of
/// some radii, and a box of at most a hundred of these, rounded a few times each.
void expectFound(const Grains& grains, double margin, const PeriodicBox& box = {}) {
    const PairSearch search(grains, margin, box);
    ASSERT_TRUE(search.isUsable());
    const Pairs expected = bruteForce(grains, margin, box), found = pairsOf(search, grains.size());
    ASSERT_EQ(keysOf(found), keysOf(expected));
    EXPECT_EQ(keysOf(found), pairsOf(NeighbourSearch(grains, margin, box), grains));
    double largest = 0;
    for (const TranslationRecord& grain : grains) largest = std::max(largest, grain.radius);
    for (const auto& [pair, approach] : expected) {
        EXPECT_NEAR(found.at(pair).gap, approach.gap, 1e-13 * largest);
        EXPECT_NEAR(found.at(pair).closing, approach.closing, 1e-11);
        EXPECT_TRUE(search.reaches(pair.first, pair.second) && search.reaches(pair.second, pair.first));
    }
    Random random(3);
    for (int k = 0; k < 200; ++k) {
        const auto i = static_cast<std::uint32_t>(random.uniform(0, 1) * static_cast<double>(grains.size()));
        const auto j = static_cast<std::uint32_t>(random.uniform(0, 1) * static_cast<double>(grains.size()));
        if (i == j || grains[i].radius == 0 || grains[j].radius == 0) continue;
        EXPECT_EQ(search.reaches(i, j), expected.contains(std::minmax(i, j)));
    }
}

PeriodicBox boxOf(int axes, double edge) {
    const auto along = [&](int axis) { return (axes >> axis & 1) != 0 ? edge : 0; };
    return {{-0.4 * edge, -0.5 * edge, 0.1 * edge}, {along(0), along(1), along(2)}};
}

TEST(PairSearch, findsThePairsOfRandomScenes) {
    Random random(1);
    for (int axes = 0; axes < 8; ++axes)
        for (const double ratio : {1.0, 1.9, 3.0, 30.0})
            for (const int count : {1, 2, 3, 8, 9, 16, 40, 250})
                for (const double skin : {0.0, 0.3, 3.0}) {
                    // From dense to dilute, and from a box of one cell to many.
                    const double edge = r * random.uniform(3, 15) * std::cbrt(ratio * count);
                    SCOPED_TRACE(fmt::format("axes {:03b}, ratio {}, {} grains in {} m, skin {} r", axes,
                                             ratio, count, edge, skin));
                    // A box that is shorter than two grains has no nearest image.
                    const double length =
                        std::max(random.uniform(0.5, 1) * edge, (4.1 * ratio + 2 * skin) * r);
                    expectFound(randomGrains(count, edge, ratio, random), skin * r, boxOf(axes, length));
                }
}

TEST(PairSearch, findsThePairsOfADenseHeapAndOfADiluteGas) {
    Random random(2);
    expectFound(randomGrains(1500, 20 * r, 1, random), 0.3 * r);
    expectFound(randomGrains(1500, 400 * r, 2, random), 0.5 * r);
    expectFound(randomGrains(1500, 400 * r, 2, random), 0.5 * r, boxOf(7, 300 * r));
    expectFound(randomGrains(80, 0.5 * r, 1, random), 0.3 * r);  // all in one cell
}

TEST(PairSearch, findsThePairsOfALatticeOnTheFacesOfCells) {
    const double radius = 0x1p-10;
    Random random(4);
    for (const double origin : {0.0, -0.5, 1.0})
        for (const double skin : {0.0, 0.125, 0.25})
            for (const double spacing : {1.9375, 2.0, 2.125, 2.25}) {
                Grains grains;
                for (int k = 0; k < 512; ++k)
                    grains.push_back(
                        grainAt(spacing * radius *
                                    Vector<double>{origin + k % 8, origin + k / 8 % 8, origin + k / 64},
                                radius, random));
                SCOPED_TRACE(fmt::format("origin {}, skin {}, spacing {}", origin, skin, spacing));
                expectFound(grains, skin * radius);
                const double length = 8 * spacing * radius;
                expectFound(grains, skin * radius, {{0, 0, 0}, {length, length, length}});
            }
}

TEST(PairSearch, findsThePairsOfALineAndOfAPlane) {
    Random random(5);
    for (int zero = 1; zero < 7; ++zero) {
        Grains grains = randomGrains(300, 60 * r, 2, random);
        for (TranslationRecord& grain : grains)
            for (std::size_t axis = 0; axis < 3; ++axis)
                if ((zero >> axis & 1) != 0) grain.position.*vectorAxes[axis] = 0.1;
        expectFound(grains, 0.4 * r);
    }
}

TEST(PairSearch, findsThePairsOfImagesThatSlide) {
    Random random(6);
    for (int flow = 0; flow < 3; ++flow)
        for (int gradient = 0; gradient < 3; ++gradient)
            for (const double time : {0.0, 0.7, 123.4})
                for (const double ratio : {1.0, 6.0}) {
                    if (flow == gradient) continue;
                    PeriodicBox box{{-10 * r, 20 * r, 5 * r}, {60 * r, 55 * r, 50 * r}};
                    support::shearOf(flow, gradient, time > 1 ? -0.3 : 0.4).settle(box).move(box, time);
                    SCOPED_TRACE(
                        fmt::format("flow {}, gradient {}, {} s, ratio {}", flow, gradient, time, ratio));
                    expectFound(randomGrains(400, 80 * r, ratio, random, box.middle()), 0.4 * r, box);
                }
}

TEST(PairSearch, findsGrainsThatCoincide) {
    Random random(7);
    Grains grains;
    for (int k = 0; k < 20; ++k) grains.push_back(grainAt({0.1, 0.2, 0.3}, r, random));
    const PairSearch search(grains, 0.1 * r, {});
    const Pairs found = pairsOf(search, grains.size());
    EXPECT_EQ(found.size(), 190u);
    for (const auto& [pair, approach] : found) {
        EXPECT_NEAR(approach.gap, -2 * r, 1e-15 * r);
        EXPECT_EQ(approach.closing, 0);
    }
}

// A dense block, and grains far from it: larger cells would crowd. A gas fills cells that are larger.
TEST(PairSearch, isNotForGrainsFarFromADenseHeap) {
    Random random(8);
    for (const double far : {1.0, 1e4, 1e12}) {
        Grains grains = randomGrains(1500, 20 * r, 1, random);
        grains.push_back(grainAt({far, -far, far}, r, random));
        EXPECT_FALSE(PairSearch(grains, 0.1 * r, {}).isUsable());
    }
    for (const double far : {1.0, 1e4, 1e12}) {
        Grains few{grainAt({0, 0, 0}, r, random), grainAt({far, far, far}, r, random),
                   grainAt({2.05 * r, 0, 0}, r, random)};
        SCOPED_TRACE(far);
        expectFound(few, 0.1 * r);
    }
}

TEST(PairSearch, hasNothingToFindAmongNoGrains) {
    EXPECT_TRUE(PairSearch({}, 0.1 * r, {}).isUsable());
    Random random(9);
    Grains gaps = randomGrains(9, r, 1, random);
    for (TranslationRecord& grain : gaps) grain.radius = 0;
    const PairSearch search(gaps, 0.1 * r, {});
    EXPECT_TRUE(search.isUsable());
    EXPECT_TRUE(pairsOf(search, gaps.size()).empty());
}

TEST(PairSearch, callsInTheSameOrderWithAnyNumberOfThreads) {
    Random random(10);
    const Grains grains = randomGrains(20'000, 60 * r, 3, random);
    const auto calls = [&](int threads) {
        const PairSearch search(grains, 0.3 * r, boxOf(5, 61 * r), threads);
        std::vector<std::tuple<std::uint32_t, std::uint32_t, double, double>> all;
        for (std::uint32_t i = 0; i < grains.size(); ++i)
            search.forEachPartner(i, [&](std::uint32_t j, double gap, double closing) {
                all.emplace_back(i, j, gap, closing);
            });
        return all;
    };
    const auto one = calls(1);
    EXPECT_GT(one.size(), 20'000u);
    EXPECT_TRUE(calls(3) == one);
}

}  // namespace
}  // namespace pendular::pairSearchTest
