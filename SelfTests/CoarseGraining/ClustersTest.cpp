#include "Kernel/Analysis/Observables/Clusters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Features/ShearAndStrain/LeesEdwards.h"
#include "Kernel/Laws/Friction/NoFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/ShearOf.h"

namespace pendular::clustersTest {
namespace {

using support::Random;
using Points = std::vector<Vector<double>>;

Points randomPoints(std::size_t count, const Vector<double>& box, std::uint64_t seed) {
    Random random(seed);
    Points points;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = random.uniform(0, box.x), y = random.uniform(0, box.y);
        points.push_back({x, y, random.uniform(0, box.z)});
    }
    return points;
}

/// The first point of each point's cluster, by pairs until nothing changes.
std::vector<std::size_t> firstOfClusters(const Points& points, const PeriodicBox& box, double distance) {
    std::vector<std::size_t> first(points.size());
    std::iota(first.begin(), first.end(), std::size_t{0});
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t a = 0; a < points.size(); ++a)
            for (std::size_t b = 0; b < a; ++b) {
                if (first[a] == first[b] || !(norm(box.nearest(points[b] - points[a])) < distance)) continue;
                first[a] = first[b] = std::min(first[a], first[b]);
                changed = true;
            }
    }
    return first;
}

TEST(Clusters, areThoseOfAllPairs) {
    PeriodicBox open, periodic{{0, 0, 0}, {4, 5, 3}}, sheared = periodic, one{{0, 0, 0}, {4, 0, 0}};
    support::shearOf(0, 1, 0.5).settle(sheared).move(sheared, 1.3);
    std::uint64_t seed = 0;
    for (const PeriodicBox& box : {open, periodic, sheared, one}) {
        const Points points = randomPoints(400, {4, 5, 3}, ++seed);
        const Clusters clusters = clustersOfPoints(points, box, 0.4);
        const std::vector<std::size_t> first = firstOfClusters(points, box, 0.4);
        std::vector<std::size_t> sizes(clusters.list.size());
        for (std::size_t a = 0; a < points.size(); ++a) {
            EXPECT_EQ(clusters.of[a], clusters.of[first[a]]) << a;
            sizes[clusters.of[a]] += 1;
        }
        std::size_t firsts = 0;
        for (std::size_t a = 0; a < points.size(); ++a) firsts += first[a] == a ? 1 : 0;
        EXPECT_EQ(clusters.list.size(), firsts);
        EXPECT_GT(clusters.largest(), 5u);
        EXPECT_TRUE(std::ranges::is_sorted(sizes, std::ranges::greater{}));
        for (std::size_t k = 0; k < sizes.size(); ++k) EXPECT_EQ(clusters.list[k].size, sizes[k]);
        EXPECT_DOUBLE_EQ(clusters.aloneOfMembers() * 400, static_cast<double>(clusters.count(1)));
    }
}

/// A rod of points 0.5 m apart through a face, also through the one that slides; a ring that closes on itself
/// through a face has no end.
TEST(Clusters, knowTheirSizeThroughFacesAndWhetherTheyEnd) {
    PeriodicBox box{{0, 0, 0}, {4, 4, 4}};
    support::shearOf(0, 1, 0.5).settle(box).move(box, 0.7);
    for (const Vector<double>& along :
         {Vector<double>{0.5, 0, 0}, Vector<double>{0, 0.5, 0}, Vector<double>{0, 0, 0.5}}) {
        Points points;
        for (int k = 0; k < 5; ++k) points.push_back(box.wrap(Vector<double>{3, 3, 3} + double(k) * along));
        const Clusters clusters = clustersOfPoints(points, box, 0.6);
        ASSERT_EQ(clusters.list.size(), 1u);
        EXPECT_FALSE(clusters.list[0].isEndless);
        EXPECT_NEAR(clusters.list[0].gyrationRadius, 0.5 * std::sqrt(2.0), 1e-14);  // of -2, -1, 0, 1, 2
    }
    Points ring;
    for (int k = 0; k < 8; ++k) ring.push_back({0.5 * k, 1, 1});
    EXPECT_TRUE(clustersOfPoints(ring, box, 0.6).list[0].isEndless);
    ring.pop_back();
    EXPECT_FALSE(clustersOfPoints(ring, box, 0.6).list[0].isEndless);
}

TEST(Clusters, ofASceneAreJoinedByDistanceOrByBridges) {
    using Wet = Species<LinearViscoelastic, NoFriction, LiquidBridgeBagheri>;
    Wet wet;
    wet.setDensity(2500), wet.setStiffness(1000), wet.setDissipation(0);
    wet.setLiquidBridgeVolume(1e-12), wet.setContactAngle(0), wet.setSurfaceTension(0.07);
    // Three in a row that touch, a pair 0.05 mm apart, one alone, and one that is removed.
    scenes::FewGrains<Wet> scene(wet,
                                 {{.position = {0, 0, 0}},
                                  {.position = {0, 1, 0}},
                                  {.position = {1.999e-3, 0, 0}},
                                  {.position = {3.998e-3, 0, 0}},
                                  {.position = {0.02, 0, 0}},
                                  {.position = {0.02205, 0, 0}},
                                  {.position = {0.1, 0, 0}}},
                                 1e-6);
    scene.particleHandler.removeObject(1);
    scene.run(1);
    const Clusters bridged = clustersOfContacts(scene), near = clustersWithin(scene, 2.1e-3);
    EXPECT_EQ(bridged.ids, (std::vector<std::size_t>{0, 2, 3, 4, 5, 6}));
    EXPECT_EQ(bridged.of, (std::vector<std::size_t>{0, 0, 0, 1, 2, 3}));
    EXPECT_EQ(near.of, (std::vector<std::size_t>{0, 0, 0, 1, 1, 2}));
    EXPECT_NEAR(near.list[0].bridgeVolume, 2e-12, 1e-26);
    EXPECT_EQ(near.list[1].bridgeVolume, 0);
    EXPECT_DOUBLE_EQ(near.aloneOfMembers(), 1.0 / 6);
    EXPECT_DOUBLE_EQ(near.aloneOfClusters(), 1.0 / 3);
}

TEST(Clusters, refuseADistanceThatReachesSeveralImages) {
    const PeriodicBox box{{0, 0, 0}, {1, 0, 0}};
    for (const double distance : {0.0, -1.0, 0.51, std::nan("")})
        EXPECT_THROW((void)clustersOfPoints({}, box, distance), InputError) << distance;
    EXPECT_EQ(clustersOfPoints({}, box, 0.5).largest(), 0u);
    EXPECT_EQ(clustersOfPoints({}, box, 0.5).aloneOfMembers(), 0);
}

/// Spheres of radius 3 in a box of 128 (a solid fraction of 0.1079), joined below 6.5, in equilibrium.
struct HardSpheres {
    static constexpr double edge = 128, diameter = 6;
    PeriodicBox box{{0, 0, 0}, {edge, edge, edge}};
    Random random{11};
    Points points;
    static constexpr int cells = 21;  // along an edge, each longer than a diameter
    std::vector<std::vector<std::size_t>> members{cells * cells * cells};

    [[nodiscard]] std::size_t cellAt(const Vector<double>& p, int dx = 0, int dy = 0, int dz = 0) const {
        const auto along = [](double x, int d) { return (int(x / edge * cells) + d + cells) % cells; };
        return (along(p.z, dz) * cells + along(p.y, dy)) * cells + along(p.x, dx);
    }
    [[nodiscard]] bool isFree(const Vector<double>& p, std::size_t self) const {
        for (int k = 0; k < 27; ++k)
            for (const std::size_t other : members[cellAt(p, k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)])
                if (other != self && norm(box.nearest(points[other] - p)) < diameter) return false;
        return true;
    }
    void fill(std::size_t count) {
        while (points.size() < count) {
            const Vector<double> p = randomPoint();
            if (!isFree(p, count)) continue;
            members[cellAt(p)].push_back(points.size());
            points.push_back(p);
        }
    }
    /// One attempt for each, of up to 2 along each axis: Metropolis's Monte Carlo.
    void sweep() {
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Eigen::Vector3d d = random.inCube(2);
            const Vector<double> p = box.wrap(points[k] + toVector(d));
            if (!isFree(p, k)) continue;
            std::erase(members[cellAt(points[k])], k);
            points[k] = p;
            members[cellAt(p)].push_back(k);
        }
    }
    Vector<double> randomPoint() {
        const double x = random.uniform(0, edge), y = random.uniform(0, edge);
        return {x, y, random.uniform(0, edge)};
    }
};

struct Means {
    double alone = 0, clusters = 0, largest = 0, pairs = 0;

    void add(const Clusters& found, double weight) {
        alone += weight * static_cast<double>(found.count(1));
        clusters += weight * static_cast<double>(found.list.size());
        largest += weight * static_cast<double>(found.largest());
        pairs += weight * static_cast<double>(found.count(2));
    }
};

/// The mean number of 2000 points that are alone is known: no other one lies in a sphere of the distance. The
/// rest are means of 40 configurations by an independent program. One configuration scatters by 26 in the
/// points alone, 18 in the clusters and 4 in the largest cluster: the limits are 4 standard errors.
TEST(Clusters, ofPointsWithoutSizeAreThoseOfAnIndependentProgram) {
    Means mean;
    const PeriodicBox box{{0, 0, 0}, {128, 128, 128}};
    for (std::uint64_t seed = 0; seed < 40; ++seed)
        mean.add(clustersOfPoints(randomPoints(2000, box.length, 100 + seed), box, 6.5), 1.0 / 40);
    const double share =
        4 * std::numbers::pi / 3 * std::pow(6.5 / 128, 3);  // of the box, within the distance
    EXPECT_NEAR(mean.alone, 2000 * std::pow(1 - share, 1999), 4 * 26 / std::sqrt(40));
    EXPECT_NEAR(mean.clusters, 1074.8, 4 * 18 * std::sqrt(2.0 / 40));
    EXPECT_NEAR(mean.largest, 17.4, 4 * 4 * std::sqrt(2.0 / 40));
}

/// Hard spheres are compared with 76 configurations: 1 % is three standard errors of the first two; one
/// configuration scatters by 12 in the pairs and 0.8 in the largest cluster.
TEST(HeavyClusters, ofHardSpheresInEquilibriumAreThoseOfAnIndependentProgram) {
    HardSpheres spheres;
    spheres.fill(2000);
    for (int k = 0; k < 200; ++k) spheres.sweep();
    Means mean;
    constexpr int samples = 60;
    for (int k = 0; k < samples; ++k) {
        for (int sweep = 0; sweep < 10; ++sweep) spheres.sweep();
        mean.add(clustersOfPoints(spheres.points, spheres.box, 6.5), 1.0 / samples);
    }
    EXPECT_NEAR(mean.alone, 1459.3, 0.01 * 1459.3);
    EXPECT_NEAR(mean.clusters, 1696.9, 0.01 * 1696.9);
    const double errors = std::sqrt(1.0 / samples + 1.0 / 76);
    EXPECT_NEAR(mean.pairs, 189, 4 * 12 * errors);
    EXPECT_NEAR(mean.largest, 5.91, 4 * 0.8 * errors);
}

}  // namespace
}  // namespace pendular::clustersTest
