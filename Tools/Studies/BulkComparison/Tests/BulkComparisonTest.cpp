/// The figures that are compared with LIGGGHTS and LAMMPS, and the files between them.

#include <gtest/gtest.h>

#include <fstream>

#include "SelfTests/Support/TestFolder.h"
#include "Tools/Studies/AccuracyVersusCost/BulkFigures.h"
#include "Tools/Studies/BulkComparison/FlowScene.h"

namespace pendular::bulk::bulkComparisonTest {
namespace {

// Two grains that overlap across a periodic face: F = 4/3 E* R*^(1/2) d^(3/2), and l F of the pair.
TEST(BulkComparison, findsOverlapsAcrossAFace) {
    BulkScene scene = bulkScene("bed", 1);
    const double overlap = 1e-5, r = 1e-3, width = scene.highest.x();  // m
    const PeerGrain one{GrainKind::Free, r, 2500, {0.5 * r, 1e-3, 1e-3}, Vec3D::Zero()};
    PeerGrain two = one;
    two.position.x() = width - (1.5 * r - overlap);
    const Overlaps found = overlapsOf(scene, {one, two});
    EXPECT_EQ(found.coordination, 1);
    const double modulus = 5e6 / (2 * (1 - 0.2 * 0.2)), distance = 2 * r - overlap;
    const double exact = distance * 4.0 / 3 * modulus * std::sqrt(0.5 * r) * std::pow(overlap, 1.5);
    // Positions of 1e-2 m round to 2e-18 m, 2e-13 of the overlap.
    EXPECT_NEAR(found.virial / exact, 1, 1e-12);
}

// A grain leaves in each frame: the flow is its mass over the time between frames.
TEST(BulkComparison, findsASteadyFlow) {
    for (const char* name : {"hopper", "silo"}) {
        BulkScene scene = bulkScene(name, 1);
        const PeerGrain grain{GrainKind::Free, 1e-3, 2500, {0, 0, 0.01}, Vec3D::Zero()};
        scene.grains.assign(200, grain);
        FrameFigures figures(scene);
        std::vector<PeerGrain> left = scene.grains;
        for (int k = 0; k <= 150; ++k, left.pop_back()) figures.add(scene.interval * k, left);
        ASSERT_TRUE(figures.survived());
        const double mass = 4.0 / 3 * std::numbers::pi * 1e-9 * 2500;
        const std::map<std::string, double> found = [&] {
            const auto all = figures.figures();
            return std::map<std::string, double>(all.begin(), all.end());
        }();
        EXPECT_NEAR(found.at("flow_kg/s") * scene.interval / mass, 1, 1e-9);
    }
}

// Held grains do not reach into the opening, and leave no other gap that a grain fits through.
TEST(BulkComparison, theFloorOfTheSiloHasOneOpening) {
    const BulkScene scene = bulkScene("silo", 1);
    const double r = PeerMaterial::radius, width = scene.highest.x();
    const auto roomAt = [&](double x, double y) {  // m, radius of the largest sphere in the floor there
        double room = infinity;
        for (const PeerGrain& grain : scene.grains) {
            if (grain.kind != GrainKind::Held) continue;
            const double across = std::remainder(grain.position.x() - x, width),
                         along = std::remainder(grain.position.y() - y, width);
            room = std::min(room, std::hypot(across, along) - r);
        }
        return room;
    };
    EXPECT_GT(roomAt(0.5 * width, 0.5 * width), 5 * r);
    constexpr int points = 60;
    for (int k = 0; k < points * points; ++k) {
        const double x = (k % points) * width / points, y = (k / points) * width / points;
        if (std::hypot(x - 0.5 * width, y - 0.5 * width) > 0.0065 + r) {
            EXPECT_LT(roomAt(x, y), PeerMaterial::smallest * r) << x << " " << y;
        }
    }
}

TEST(BulkComparison, aLostGrainOrARunThatEndsEarlyIsNoSurvivor) {
    const BulkScene scene = bulkScene("bed", 1);
    FrameFigures early(scene), lost(scene);
    early.add(0.5 * scene.endTime, scene.grains);
    EXPECT_FALSE(early.survived());
    auto fewer = scene.grains;
    fewer.pop_back();
    lost.add(0, fewer);
    lost.add(scene.endTime, fewer);
    EXPECT_FALSE(lost.survived());
}

TEST(BulkComparison, readsTheStartAndTheFramesThatItWrites) {
    const support::TestFolder folder;
    const std::string data = (folder.path() / "start").string(), frames = (folder.path() / "frames").string();
    const BulkScene scene = bulkScene("drum", 3);
    EXPECT_GT(scene.grains.size(), 1000u);
    writePeerData(data, scene);
    BulkScene read = bulkScene("drum", 4);
    readPeerData(data, read);
    ASSERT_EQ(read.grains.size(), scene.grains.size());
    for (std::size_t k = 0; k < read.grains.size(); ++k) {
        EXPECT_EQ(read.grains[k].kind, scene.grains[k].kind);
        EXPECT_LT((read.grains[k].position - scene.grains[k].position).norm(), 1e-17);
        EXPECT_LT((read.grains[k].velocity - scene.grains[k].velocity).norm(), 1e-15);
        EXPECT_NEAR(read.grains[k].radius / scene.grains[k].radius, 1, 1e-15);
    }
    std::ofstream file(frames);  // the last frame is cut off
    file << "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff pp\n0 1\n0 1\n0 1\n"
            "ITEM: ATOMS id x y z vx vy vz\n2 0 0 0 nan 0 0\nITEM: TIMESTEP\n8\nITEM: NUMBER OF ATOMS\n2\n";
    file.close();
    FrameFigures figures(scene);
    readPeerFrames(frames, scene, 1e-5, figures);
    EXPECT_FALSE(figures.survived());
    EXPECT_THROW(readPeerData(frames, read), InputError);
}

/// How far the corners of triangles are from the nearest of another mesh, at most (m).
double distanceOfCorners(const std::vector<Triangle>& from, const std::vector<Triangle>& to) {
    double farthest = 0;
    for (const Triangle& triangle : from)
        for (const Vector<double>& corner : triangle) {
            double nearest = infinity;
            for (const Triangle& other : to)
                for (const Vector<double>& at : other) nearest = std::min(nearest, norm(at - corner));
            farthest = std::max(farthest, nearest);
        }
    return farthest;
}

/// m, of the nearest of some points of triangles.
double distanceOf(const std::vector<Triangle>& triangles, const Vector<double>& from) {
    double nearest = infinity;
    constexpr int pieces = 5;
    for (const Triangle& t : triangles)
        for (int i = 0; i <= pieces; ++i)
            for (int k = 0; k <= pieces - i; ++k) {
                const double a = 1.0 * i / pieces, b = 1.0 * k / pieces;
                nearest = std::min(nearest, norm((1 - a - b) * t[0] + a * t[1] + b * t[2] - from));
            }
    return nearest;
}

TEST(BulkComparison, theMixerHasRoomForItsGrainsAndFitsItsPeriod) {
    UniformRandom random(1);
    const BulkScene scene = detail::mixer(random, 0.3);
    EXPECT_GT(scene.grains.size(), 100u);
    for (const PeerMesh& mesh : scene.meshes)
        for (std::size_t k = 0; k < scene.grains.size(); k += 5) {
            const PeerGrain& grain = scene.grains[k];
            EXPECT_GT(distanceOf(mesh.triangles, toVector(grain.position)), grain.radius);
        }
    const Screw screw{.tube = 0.02, .shaft = 5e-3, .edge = 0.0156, .length = 0.036, .pitch = 0.018};
    for (const Triangle& triangle : screw.rotor())
        for (const Vector<double>& corner : triangle)
            EXPECT_LT(std::hypot(corner.x, corner.y), screw.edge * (1 + 1e-14));
    std::vector<Triangle> low, high;  // those at the faces
    for (const Triangle& triangle : screw.rotor())
        for (const Vector<double>& corner : triangle) {
            if (corner.z == 0) low.push_back({corner, corner, corner});
            if (corner.z == screw.length) {
                const Vector<double> behind{corner.x, corner.y, 0};
                high.push_back({behind, behind, behind});
            }
        }
    ASSERT_FALSE(high.empty());
    EXPECT_EQ(distanceOfCorners(low, high), 0);
    EXPECT_EQ(distanceOfCorners(high, low), 0);
}

// Copies side by side: the grains of each, and meshes that meet exactly.
TEST(BulkComparison, aLargeFlowIsCopiesOfASmallOne) {
    UniformRandom random(1);
    const BulkScene one = detail::mixer(random, 0.3), all = copiesOf(one, 3);
    const double period = one.highest.z() - one.lowest.z();
    EXPECT_DOUBLE_EQ(all.highest.z(), 3 * period);
    ASSERT_EQ(all.grains.size(), 3 * one.grains.size());
    for (std::size_t k = 0; k < one.grains.size(); ++k) {
        const PeerGrain& copy = all.grains[2 * one.grains.size() + k];
        EXPECT_LT((copy.position - one.grains[k].position - Vec3D(0, 0, 2 * period)).norm(), 1e-15);
        EXPECT_EQ(copy.velocity, one.grains[k].velocity);
        EXPECT_EQ(copy.radius, one.grains[k].radius);
    }
    std::vector<Triangle> before, behind;  // at the face between the first and the second copy
    const std::vector<Triangle>& rotor = all.meshes[1].triangles;
    const std::size_t ofOne = one.meshes[1].triangles.size();
    ASSERT_EQ(rotor.size(), 3 * ofOne);
    for (std::size_t k = 0; k < 2 * ofOne; ++k)
        for (const Vector<double>& corner : rotor[k])
            if (corner.z == period) (k < ofOne ? before : behind).push_back({corner, corner, corner});
    ASSERT_FALSE(before.empty());
    EXPECT_EQ(distanceOfCorners(before, behind), 0);
}

}  // namespace
}  // namespace pendular::bulk::bulkComparisonTest
