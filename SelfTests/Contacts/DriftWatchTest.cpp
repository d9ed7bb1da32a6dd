#include "Kernel/Core/Contacts/DriftWatch.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "Kernel/Foundation/Math/EigenConversion.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/ShearOf.h"

namespace pendular::driftWatchTest {
namespace {

using support::Random;

constexpr double r = 1e-3;  // m

ParticleStore grainsIn(double edge, int count, double ratio, Random& random) {
    ParticleStore grains;
    for (int k = 0; k < count; ++k)
        grains.translation.push_back(
            {toVector(random.inCube(0.5 * edge)), r * std::pow(ratio, random.uniform(0, 1)), {0, 0, 0}, 1});
    return grains;
}

double gapOf(const TranslationRecord& a, const TranslationRecord& b, const PeriodicBox& box) {
    return norm(box.nearest(b.position - a.position)) - a.radius - b.radius;
}

/// m: a flow that shears, turns and shakes, by at most some amount.
Vector<double> displacementAt(const Vector<double>& place, double shake, const Vector<double>& flow,
                              double shear, Random& random) {
    return flow + Vector<double>{shear * place.y, 0, -0.3 * shear * place.x} + toVector(random.inCube(shake));
}

// No pair that was farther apart than the range has come nearer to it than by the approach, for all pairs,
// also of grains that are nobody's neighbours, as long as no grain has come farther than the reach.
TEST(DriftWatch, boundsTheApproachOfAllPairs) {
    Random random(1);
    std::size_t known = 0;
    for (int axes = 0; axes < 8; ++axes)
        for (const double ratio : {1.0, 3.0})
            for (const int count : {2, 30, 300})
                for (const double speed : {0.0, 0.3, 2.0}) {
                    const double edge = r * ratio * random.uniform(4, 9) * std::cbrt(count),
                                 length = 1.1 * edge;
                    const auto along = [&](int axis) { return (axes >> axis & 1) != 0 ? length : 0; };
                    const PeriodicBox box{{-0.5 * length, -0.5 * length, -0.5 * length},
                                          {along(0), along(1), along(2)}};
                    SCOPED_TRACE(
                        fmt::format("axes {:03b}, ratio {}, {} grains, {} r", axes, ratio, count, speed));
                    ParticleStore grains = grainsIn(edge, count, ratio, random);
                    const ParticleStore before = grains;
                    const double range = random.uniform(0.1, 1) * r;
                    DriftWatch watch;
                    watch.begin(grains, box, range);
                    if (!watch.knows()) continue;
                    ++known;
                    const Vector<double> flow = speed * toVector(random.inCube(r));
                    double farthest = 0, atWalls = 0;
                    std::vector<std::uint8_t> flags(grains.size());
                    for (std::size_t k = 0; k < grains.size(); ++k) {
                        const Vector<double> d = displacementAt(before.translation[k].position, 0.05 * r,
                                                                flow, 0.3 * r / edge, random);
                        grains.translation[k].position = box.wrap(grains.translation[k].position + d);
                        farthest = std::max(farthest, norm(d));
                        flags[k] = k % 3 == 0;
                        if (flags[k] != 0) atWalls = std::max(atWalls, norm(d));
                    }
                    const DriftWatch::Drift drift = watch.drift(grains, flags);
                    EXPECT_NEAR(drift.farthest, farthest, 1e-13 * length);
                    EXPECT_NEAR(drift.atWalls, atWalls, 1e-13 * length);
                    if (drift.farthest > watch.reach()) continue;
                    // By how much a pair is nearer than allowed, at most.
                    double tooNear = 0;
                    for (std::size_t i = 0; i < grains.size(); ++i)
                        for (std::size_t j = 0; j < i; ++j) {
                            if (gapOf(before.translation[i], before.translation[j], box) < range) continue;
                            const double gap = gapOf(grains.translation[i], grains.translation[j], box);
                            tooNear = std::max(tooNear, range - drift.approach - gap);
                        }
                    EXPECT_LE(tooNear, 1e-12 * length);
                    // They flow together: what they approach is less than twice their way.
                    EXPECT_LE(drift.approach, 2 * farthest + 1e-13 * length);
                }
    EXPECT_GT(known, 80u);
}

TEST(DriftWatch, givesTheSameBitsForAnyNumberOfThreads) {
    Random random(7);
    constexpr double edge = 60 * r;
    const PeriodicBox box{{-0.5 * edge, -0.5 * edge, -0.5 * edge}, {edge, 0, edge}};
    ParticleStore grains = grainsIn(edge, 5000, 1.5, random);
    const ParticleStore before = grains;
    std::vector<std::uint8_t> flags(grains.size());
    for (std::size_t k = 0; k < grains.size(); ++k) {
        grains.translation[k].position = box.wrap(grains.translation[k].position +
                                                  displacementAt({0, 0, 0}, 0.1 * r, {r, 0, 0}, 0, random));
        flags[k] = k % 3 == 0;
    }
    DriftWatch alone;
    alone.begin(before, box, 0.5 * r);
    ASSERT_TRUE(alone.knows());
    const DriftWatch::Drift expected = alone.drift(grains, flags);
    EXPECT_GT(expected.approach, 0);
    for (const int threads : {2, 3, 4}) {
        DriftWatch watch;
        watch.begin(before, box, 0.5 * r, threads);
        for (int again = 0; again < 2; ++again) {
            const DriftWatch::Drift drift = watch.drift(grains, flags, threads);
            EXPECT_EQ(drift.approach, expected.approach);
            EXPECT_EQ(drift.farthest, expected.farthest);
            EXPECT_EQ(drift.atWalls, expected.atWalls);
        }
        EXPECT_EQ(watch.reach(), alone.reach());
    }
}

TEST(DriftWatch, seesNoApproachWhereAllMoveAlike) {
    Random random(2);
    ParticleStore grains = grainsIn(40 * r, 500, 1.5, random);
    const PeriodicBox box{{-20 * r, -20 * r, -20 * r}, {40 * r, 40 * r, 0}};
    DriftWatch watch;
    watch.begin(grains, box, 0.2 * r);
    ASSERT_TRUE(watch.knows());
    const Vector<double> way{1.1 * r, -0.7 * r, 0.4 * r};
    for (TranslationRecord& grain : grains.translation) grain.position = box.wrap(grain.position + way);
    const DriftWatch::Drift drift = watch.drift(grains, {});
    EXPECT_LT(drift.approach, 1e-12 * r);
    EXPECT_NEAR(drift.farthest, norm(way), 1e-12 * r);
    EXPECT_EQ(drift.atWalls, 0);
}

// Those that have gone, come later or taken another one's place do not count.
TEST(DriftWatch, countsTheGrainsThatWereThere) {
    Random random(3);
    ParticleStore grains = grainsIn(20 * r, 50, 1, random);
    DriftWatch watch;
    watch.begin(grains, {}, 0.2 * r);
    grains.translation[7].position.x += 0.3 * r;
    EXPECT_NEAR(watch.drift(grains, {}).approach, 0.3 * r, 1e-12 * r);
    grains.translation[7].radius = 0;
    grains.translation[8].position.x += r;
    watch.forget(8);
    grains.translation.push_back({{1, 1, 1}, r, {0, 0, 0}, 1});
    EXPECT_EQ(watch.drift(grains, {}).farthest, 0);
    EXPECT_EQ(watch.drift(grains, {}).approach, 0);
}

TEST(DriftWatch, isNotForImagesThatMove) {
    Random random(4);
    const ParticleStore grains = grainsIn(20 * r, 50, 1, random);
    PeriodicBox box{{-10 * r, -10 * r, -10 * r}, {20 * r, 20 * r, 20 * r}};
    DriftWatch watch;
    watch.begin(grains, box, 0.2 * r);
    EXPECT_TRUE(watch.knows());
    support::shearOf(0, 1, 0.5).settle(box).move(box, 0.3);
    watch.begin(grains, box, 0.2 * r);
    EXPECT_FALSE(watch.knows());
    watch.begin(grains, {}, 0.2 * r);
    EXPECT_TRUE(watch.knows());
    watch.end();
    EXPECT_FALSE(watch.knows());
}

}  // namespace
}  // namespace pendular::driftWatchTest
