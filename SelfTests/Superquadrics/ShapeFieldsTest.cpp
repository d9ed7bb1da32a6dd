#include <gtest/gtest.h>

#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Analysis/Output/ShapeFields.h"
#include "Kernel/Features/Superquadrics/ExtremeContact.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"
#include "SelfTests/Support/TestFolder.h"
#include "Tools/Snapshot/Compose.h"

// Superquadrics in files and pictures, and what their contacts are at most.

namespace pendular::shapeFieldsTest {
namespace {

using scenes::FewSuperquadrics;
using Smooth = Species<LinearViscoelastic>;

Smooth soft() {
    Smooth s;
    s.setDensity(2500);
    s.setStiffness(1000);
    s.setDissipation(0);
    return s;
}

// A prolate ellipsoid: the distance of a normal line from the centre is at most a - c, about an axis with the
// moment m (a^2 + c^2) / 5; its Gauss radius is at most a, at the equator. Of an oblate one a^2 / c at the
// pole. The faces of sharp shapes are flat.
TEST(ExtremeContact, isThatOfEllipsoidsInClosedForm) {
    const double a = 2, c = 1;
    const ExtremeContact prolate = extremeContact({c, c, a, 2, 2}), oblate = extremeContact({a, a, c, 2, 2});
    EXPECT_NEAR(prolate.turning, 5 * (a - c) * (a - c) / (a * a + c * c), 0.011);
    EXPECT_GE(prolate.turning, 5 * (a - c) * (a - c) / (a * a + c * c));
    EXPECT_NEAR(prolate.radii, 1.01, 1e-12);
    EXPECT_NEAR(oblate.radii, 1.01 * a / c, 1e-12);
    EXPECT_EQ(extremeContact({1, 1, 1, 6, 6}).radii, SuperquadricGeometry::mostRadii);
    EXPECT_NEAR(extremeContact({1, 1, 1, 2, 2}).turning, 0, 1e-30);
    // A force along the rim turns a sphere by r^2 / I = 5/2 of 1/m; at the tips of a prolate ellipsoid by
    // 5 a^2 / (a^2 + c^2), and about its axis by 5/2 at the equator.
    EXPECT_NEAR(extremeContact({1, 1, 1, 2, 2}).sliding, 1.01 * 2.5, 1e-12);
    EXPECT_NEAR(prolate.sliding, 1.01 * 5 * a * a / (a * a + c * c), 1e-12);
}

/// The volume that a closed surface of polygons holds, positive if these are seen in a ring from outside.
double volumeOf(const PolyData& surface) {
    double sum = 0;
    std::size_t begin = 0;
    for (const std::int32_t end : surface.ends) {
        const auto corner = [&](std::size_t k) {
            return surface.points[static_cast<std::size_t>(surface.corners[begin + k])];
        };
        for (std::size_t k = 1; begin + k + 1 < static_cast<std::size_t>(end); ++k)
            sum += dot(corner(0), cross(corner(k), corner(k + 1))) / 6;
        begin = static_cast<std::size_t>(end);
    }
    return sum;
}

// The corners are on the surface, so the polygons hold less than the shape; of a sphere with 12 circles of 20
// corners less by 1 - (sin x / x)^2 of some 0.16 rad to both sides, 2 to 4 %.
TEST(ShapeFields, areTheTrueSurfaces) {
    for (const int exponent : {2, 4, 8}) {
        const Superquadric shape{1e-3, 1.5e-3, 0.7e-3, exponent, exponent};
        FewSuperquadrics<Smooth> scene(soft(), {{shape, {0.01, 0.02, 0}}}, 1e-6);
        scene.initialise();
        const ParticleStore& grains = scene.particleHandler.store();
        const PolyData surface = shapeSurfaces(grains, scene.superquadricHandler);
        EXPECT_LT(volumeOf(surface), shape.volume());
        EXPECT_GT(volumeOf(surface), 0.95 * shape.volume()) << exponent;
        for (const Vector<double>& point : surface.points) {
            const auto term = [&](double x, double half) { return std::pow(std::abs(x / half), exponent); };
            EXPECT_NEAR(term(point.x - 0.01, 1e-3) + term(point.y - 0.02, 1.5e-3) + term(point.z, 0.7e-3), 1,
                        1e-9);
        }
    }
}

TEST(ShapeFields, areInFilesAndPictures) {
    const support::TestFolder folder;
    Superquadric shape{1e-3, 1.5e-3, 0.7e-3, 4, 3};
    const Eigen::Quaterniond turn = Eigen::Quaterniond(1, 2, -1, 0.5).normalized();
    FewSuperquadrics<Smooth> scene(
        soft(), {{shape, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, turn}, {{1e-3, 1e-3, 1e-3}, {0, 0, 0.01}}}, 1e-6);
    scene.setName((folder.path() / "run").string());
    scene.addOutput(ParaViewOutput());
    scene.setQuiet();
    scene.setTimeMax(1e-5);
    scene.solve();
    const auto frames = snapshot::framesOf(folder.path() / "run.pvd");
    ASSERT_FALSE(frames.empty());
    const snapshot::Frame frame = snapshot::readFrame(frames[0]);
    const auto solid = snapshot::Solids(frame.grains)[0];
    ASSERT_TRUE(solid.has_value());
    EXPECT_EQ(solid->n1, 4);
    EXPECT_EQ(solid->n2, 3);
    const Vec3D expected = 1.5e-3 * (turn * Vec3D::UnitY());  // the fields are floats
    EXPECT_LT(norm(solid->axes[1] - toVector(expected)), 1e-9);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "run-shapes-000000000.vtp"));
    snapshot::View view;
    view.field = "none";
    const snapshot::Picture picture = snapshot::compose(frame, view, {});
    const snapshot::Camera camera = snapshot::cameraOn(snapshot::outline(picture), {0, -1, 0}, 640, 480, 0);
    const std::string text = snapshot::PovScene(picture, camera).text();
    EXPECT_NE(text.find("superellipsoid { <0.6666667,0.5>"), std::string::npos);
    EXPECT_NE(text.find("sphere { 0,1 pigment"), std::string::npos);
}

}  // namespace
}  // namespace pendular::shapeFieldsTest
