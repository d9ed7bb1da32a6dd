// A floor of several walls at one level, whose edges meet to round-off, is one plane: no call joins them.
#include <gtest/gtest.h>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Walls/SeamScene.h"

namespace pendular::onePlaneTest {
namespace {

using namespace wallTests;
using scenes::GrainMotion;

constexpr double half = 0.03;  // m, of the floor
constexpr double gravity = 9.81;

/// What corners of walls are off by, in each direction (m).
struct Misfit {
    double inPlane, height;
};

/// Four meshes in a grid of two by two, each of squares of its own size, whose corners are off by chance, and
/// which are a gap apart, or overlap by it.
std::vector<TriangleWall> fourMeshes(const Misfit& off) {
    support::Random random(7);
    std::vector<TriangleWall> made;
    for (int k = 0; k < 4; ++k) {
        std::vector<Triangle> triangles = parallelogram(at(k % 2 == 0 ? -half : 0, k < 2 ? -half : 0, 0),
                                                        at(half, 0, 0), at(0, half, 0), 2 + k, 5 - k);
        for (Triangle& triangle : triangles)
            for (Vector<double>& corner : triangle) {
                const Vec3D by = random.inCube(1);
                corner += Vector<double>{off.inPlane * by.x(), off.inPlane * by.y(), off.height * by.z()};
            }
        made.push_back(mesh(triangles));
    }
    return made;
}

/// A half of the floor as a mesh, which lies on a plane that goes on beside it; or is that of another one.
std::vector<TriangleWall> halfMesh(const Misfit& off) {
    return {mesh(parallelogram(at(0, -half, off.height), at(half, 0, 0), at(0, 2 * half, 0), 3, 2))};
}

/// Grains that cross a seam, go over the corner where four meshes meet, and go along a seam; none meets
/// another one.
std::vector<GrainMotion> grains() {
    constexpr double z = radius - 2e-7;
    return {
        {.radius = radius, .position = {-6e-3, -8e-3, z}, .velocity = {0.5, 0.03, 0}},
        {.radius = radius, .position = {-5e-3, -5e-3, z}, .velocity = {0.4, 0.4, 0}, .spin = {-200, 200, 0}},
        {.radius = radius, .position = {3e-3, 0, z}, .velocity = {0.5, 0, 0}},
        {.radius = radius, .position = {-4e-3, 9e-3, z}, .velocity = {-0.1, -0.6, 0}, .spin = {0, 300, 80}}};
}

/// m/s and rad/s times m, by which the motions of two scenes differ at most.
template <class S>
double farthestApart(WallScene<S>& found, WallScene<S>& expected, int steps) {
    found.setQuiet(), expected.setQuiet();
    found.initialise(), expected.initialise();
    double worst = 0;
    for (int k = 0; k < steps; ++k) {
        found.step(), expected.step();
        for (std::size_t g = 0; g < grains().size(); ++g) {
            const GrainMotion a = found.motion(g), b = expected.motion(g);
            worst = std::max({worst, (a.velocity - b.velocity).norm(), radius * (a.spin - b.spin).norm()});
        }
        EXPECT_EQ(found.touching(), expected.touching()) << "step " << k;
    }
    return worst;
}

/// A grain whose floor is higher by h gets a push of k h for the time of a contact, which is some h omega in
/// speed, omega = sqrt(k / m) at the overlap at rest; friction gives 2.5 times that to the surface. Each of
/// the four grains crosses at most twenty edges of squares. A grain that goes along a crack of width w rolls
/// off its middle with at most w sqrt(g / R): a slope of w / (2 R) over w.
double tolerance(const Misfit& off) {
    constexpr double omega = 3e4;  // 1/s, above that of the overlaps here
    return 1e-11 + 2 * off.inPlane * std::sqrt(gravity / radius) + 20 * 2.5 * omega * off.height;
}

template <class S>
S wet() {
    S species = material<S>();
    if constexpr (requires { species.setLiquidBridgeVolume(1.0); }) {
        species.setLiquidBridgeVolume(1e-12);
        species.setContactAngle(0.2);
        species.setSurfaceTension(0.07);
    }
    return species;
}

template <class S>
class OnePlane : public testing::Test {};
using SpeciesOfAllKinds =
    testing::Types<Smooth, Dry, Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>>;
TYPED_TEST_SUITE(OnePlane, SpeciesOfAllKinds);

template <class S>
void expectOnePlane(const std::vector<TriangleWall>& meshes, bool withPlane, bool planeFirst,
                    const Misfit& off) {
    const Vec3D weight{0, 0, -gravity};
    WallScene<S> found(grains(), wet<S>(), weight), expected(grains(), wet<S>(), weight);
    expected.add(flat);
    if (withPlane && planeFirst) found.add(flat);
    for (const TriangleWall& each : meshes) found.add(each);
    if (withPlane && !planeFirst) found.add(flat);
    EXPECT_LT(farthestApart(found, expected, 8000), tolerance(off)) << off.inPlane << ' ' << off.height;
    EXPECT_GT(found.motion(0).position.x(), 1e-3);
    EXPECT_GT(found.motion(1).position.x(), 1e-3);
    EXPECT_LT(found.motion(3).position.y(), -1e-3);
}

constexpr Misfit misfits[] = {{0, 0}, {1e-13, 0}, {1e-10, 1e-15}};

TYPED_TEST(OnePlane, fourMeshesAre) {
    for (const Misfit& off : misfits) expectOnePlane<TypeParam>(fourMeshes(off), false, false, off);
}

TYPED_TEST(OnePlane, aMeshAndAnInfiniteWallAre) {
    for (const bool planeFirst : {false, true})
        for (const double height : {0.0, 1e-15, -1e-15}) {
            const Misfit off{0, std::abs(height)};
            expectOnePlane<TypeParam>(halfMesh({0, height}), true, planeFirst, off);
        }
}

TYPED_TEST(OnePlane, fourMeshesOnAnInfiniteWallAre) {
    for (const Misfit& off : misfits) expectOnePlane<TypeParam>(fourMeshes(off), true, true, off);
}

}  // namespace
}  // namespace pendular::onePlaneTest
