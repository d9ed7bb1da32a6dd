#include "Kernel/Features/DomainDecomposition/GrainExtents.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "SelfTests/Support/Random.h"

namespace pendular::grainExtentsTest {
namespace {

struct Sphere {
    Vector<double> position;
    double radius;
    std::size_t rank;
};

Vector<double> placeIn(support::Random& random) {
    const double x = random.uniform(0, 1), y = random.uniform(0, 1);
    return {x, y, random.uniform(0, 1)};
}

/// Spheres of sizes up to 1:100 in a box of 1 m, of which each belongs to one of four ranks: to the nearest
/// of four points.
std::vector<Sphere> randomSpheres(support::Random& random, double smallest) {
    std::vector<Vector<double>> centres;
    for (int rank = 0; rank < 4; ++rank) centres.push_back(placeIn(random));
    std::vector<Sphere> spheres;
    for (int k = 0; k < 40; ++k) {
        const Vector<double> place = placeIn(random);
        const double share = random.uniform(0, 1);
        const auto nearest =
            std::ranges::min_element(centres, {}, [&](const auto& c) { return squaredNorm(c - place); });
        spheres.push_back({place, smallest * std::pow(100, share * share * share),
                           static_cast<std::size_t>(nearest - centres.begin())});
    }
    return spheres;
}

/// Periodic along some axes, or sheared.
PeriodicBox randomBox(support::Random& random) {
    PeriodicBox box;
    for (double* const length : {&box.length.x, &box.length.y, &box.length.z})
        if (random.uniform(0, 1) < 0.6) *length = 1;
    if (box.length.x > 0 && box.length.y > 0 && random.uniform(0, 1) < 0.5) {
        box.across = {0, 1, 0};
        box.imageShift = {random.uniform(0, 1), 1, 0};
    }
    return box;
}

// A rank must get all spheres that are nearer to one of its own than the reach, whichever images these are;
// of others it gets few enough.
TEST(GrainExtents, findAllNeighbours) {
    support::Random random(1);
    std::size_t needed = 0, asked = 0, all = 0;
    for (int round = 0; round < 10000; ++round) {
        const PeriodicBox box = randomBox(random);
        const std::vector<Sphere> spheres = randomSpheres(random, 2e-3);
        const double reach = random.uniform(0, 0.02);
        const double largest = std::ranges::max(spheres, {}, &Sphere::radius).radius;
        std::vector<GrainExtents> extents(4);
        for (const Sphere& s : spheres) extents[s.rank].add(box.wrap(s.position), s.radius, largest);
        const std::vector<Vector<double>> images = imageOffsets(box);
        for (const Sphere& s : spheres)
            for (std::size_t rank = 0; rank < 4; ++rank) {
                if (rank == s.rank) continue;
                const bool isNear = std::ranges::any_of(spheres, [&](const Sphere& other) {
                    return other.rank == rank &&
                           norm(box.nearest(other.position - s.position)) < s.radius + other.radius + reach;
                });
                const Vector<double> inside = box.wrap(s.position);
                const bool isAsked = std::ranges::any_of(images, [&](const Vector<double>& offset) {
                    return extents[rank].areNear(inside + offset, s.radius, reach);
                });
                EXPECT_TRUE(isAsked || !isNear) << "round " << round;
                ++all;
                needed += isNear ? 1 : 0;
                asked += isAsked ? 1 : 0;
            }
    }
    EXPECT_GT(needed, 1000u);
    EXPECT_LT(asked, all / 2);
}

TEST(GrainExtents, areOfTheirOwnSizes) {
    GrainExtents extents;
    EXPECT_TRUE(extents.areEmpty());
    extents.add({0, 0, 0}, 1, 1);
    extents.add({10, 0, 0}, 0.01, 1);
    EXPECT_FALSE(extents.areEmpty());
    EXPECT_TRUE(extents.areNear({1.05, 0, 0}, 0.01, 0.05));
    EXPECT_TRUE(extents.areNear({10.05, 0, 0}, 0.01, 0.05));
    EXPECT_FALSE(extents.areNear({9, 0, 0}, 0.01, 0.05)) << "the large one is not there";
}

}  // namespace
}  // namespace pendular::grainExtentsTest
