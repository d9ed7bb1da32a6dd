#include "Kernel/Features/CurvedWalls/CurvedSheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::curvedSheetTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

/// A torus around z: u along the ring, v around the tube.
SurfaceFormula torus(double ring, double tube) {
    const double full = 2 * std::numbers::pi;
    return {fmt::format("Torus of {} and {}", ring, tube),
            {0, 0},
            {full, full},
            {24, 12},
            [=](double u, double v) {
                const Vec3D out(std::cos(u), std::sin(u), 0), along(-out.y(), out.x(), 0), up(0, 0, 1);
                const double c = std::cos(v), s = std::sin(v), r = ring + tube * c;
                return SurfaceJet{r * out + tube * s * up,   r * along,
                                  tube * (c * up - s * out), -r * out,
                                  -tube * s * along,         -tube * (c * out + s * up)};
            }};
}

struct Sheet : CurvedSheet {
    explicit Sheet(double thickness = 0, double ring = 2) { set(torus(ring, 0.5), thickness); }
    [[nodiscard]] bool crosses(const Vec3D& a, const Vec3D& b) const {
        return isCrossedInBody(toVector(a), toVector(b));
    }
};

// Against the closed form, inside and outside of the tube.
TEST(CurvedSheet, hasTheNearestPoint) {
    UniformRandom random(3);
    SphericalParticle grain;
    grain.setRadius(0.4);
    double distance = 0;
    Vec3D normal;
    int touching = 0;
    const Sheet thin, thick(0.1);
    for (int k = 0; k < 2000; ++k) {
        const Vec3D at(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-1, 1));
        const Vec3D onRing = Vec3D(at.x(), at.y(), 0).normalized() * 2;
        const double fromTube = (at - onRing).norm() - 0.5;
        grain.setPosition(at);
        for (const double thickness : {0.0, 0.1}) {
            const double expected = std::abs(fromTube) - thickness;
            const bool touches = (thickness > 0 ? thick : thin).getDistanceAndNormal(grain, distance, normal);
            ASSERT_EQ(touches, expected < 0.4) << at.transpose();
            if (!touches) continue;
            ++touching;
            EXPECT_NEAR(distance, expected, 1e-12);
            const Vec3D across = (onRing - at).normalized() * (fromTube < 0 ? -1 : 1);
            EXPECT_LT((normal - across).norm(), 1e-6 + 1e-12 / std::abs(fromTube));
        }
    }
    EXPECT_GT(touching, 800);
}

TEST(CurvedSheet, knowsWhatGoesThrough) {
    const Sheet thin;
    EXPECT_TRUE(thin.crosses({2.55, 0, 0}, {2.45, 0, 0}));
    EXPECT_TRUE(thin.crosses({2.45, 0.1, 0}, {2.6, 0.1, 0.1}));
    EXPECT_FALSE(thin.crosses({2.7, 0, 0}, {2.55, 0, 0}));
    const Sheet thick(0.1);
    EXPECT_TRUE(thick.crosses({2.65, 0, 0}, {2.55, 0, 0}));
    EXPECT_FALSE(thick.crosses({2.55, 0, 0}, {2.52, 0, 0}));
}

/// A roof over x from 0 to 2, whose ridge is at x = 1, z = 1; of two pieces.
SurfaceFormula roof() {
    return {"Roof",
            {0, 0},
            {2, 1},
            {4, 1},
            [](double u, double v) {
                const double slope = u < 1 ? 1 : -1;
                return SurfaceJet{{u, v, 1 + slope * (u - 1)},
                                  {1, 0, slope},
                                  {0, 1, 0},
                                  Vec3D::Zero(),
                                  Vec3D::Zero(),
                                  Vec3D::Zero()};
            },
            {2, 1}};
}

// The nearest point of what goes straight through a ridge is on it, where no way is across.
TEST(CurvedSheet, knowsWhatGoesThroughABend) {
    struct Roof : Sheet {
        Roof() { set(roof(), 0); }
    } wall;
    EXPECT_TRUE(wall.crosses({1, 0.5, 1.05}, {1.01, 0.5, 0.9}));
    EXPECT_TRUE(wall.crosses({1, 0.5, 0.95}, {1, 0.5, 1.02}));
    EXPECT_FALSE(wall.crosses({0.98, 0.5, 1.05}, {1.02, 0.5, 1.05}));
    EXPECT_FALSE(wall.crosses({2.1, 0.5, 0}, {1.95, 0.5, -0.1}));  // round its end
}

TEST(CurvedSheet, refusesAPointThatIsNotFinite) {
    SurfaceFormula hole = torus(2, 0.5);
    hole.at = [at = hole.at](double u, double v) {
        SurfaceJet jet = at(u, v);
        if (u > 3 && u < 3.5) jet.point.y() = std::nan("");
        return jet;
    };
    const std::string text = refusal([&] { CurvedSheet().set(hole, 0); });
    EXPECT_TRUE(isOneSentence(text) && contains(text, "is not finite")) << text;
}

// A smooth ball inside the tube swings about its lowest place with the energy that it has.
TEST(CurvedSheet, keepsEnergyOfWhatSlidesOnIt) {
    Simulation<LinearViscoelasticSpecies> scene;
    LinearViscoelasticSpecies species;
    species.setDensity(1000), species.setStiffness(1e6);
    auto own = scene.speciesHandler.copyAndAddObject(species);
    Sheet sheet;
    sheet.setSpecies(own);
    scene.wallHandler.copyAndAddObject(sheet);
    SphericalParticle ball(own);
    ball.setRadius(0.1);
    const double angle = 0.3;  // around the ring, from its lowest place, as gravity is along -x
    ball.setPosition({-2.4 * std::cos(angle), 2.4 * std::sin(angle), 0});
    auto moving = scene.particleHandler.copyAndAddObject(ball);
    scene.setGravity({-10, 0, 0});
    scene.setQuiet();
    scene.setTimeStep(2e-4);
    const double height = moving.getPosition().x();
    double lowest = 0, most = 0;
    scene.runTo(0.01);
    for (int k = 1; k <= 40; ++k) {
        scene.runTo(0.01 + 0.05 * k);
        const double energy =
            0.5 * moving.getVelocity().squaredNorm() + 10 * (moving.getPosition().x() - height);
        most = std::max(most, std::abs(energy));
        lowest = std::min(lowest, moving.getPosition().x());
        EXPECT_NEAR(moving.getPosition().head<2>().norm(), 2.4, 0.01);
        EXPECT_NEAR(moving.getPosition().z(), 0, 1e-9);
    }
    EXPECT_NEAR(lowest, -2.4, 0.02);
    // The weight sinks it by m g / k, and it bounces as high at the start: m g^2 / k of energy per mass.
    EXPECT_LT(most, 3 * 10 * 10 * moving.getMass() / 1e6);
    scene.finishRun();
}

TEST(CurvedSheet, isThatOfTheRestartFile) {
    const support::TestFolder folder;
    const std::string file = (folder.path() / "restart.h5").string();
    const auto make = [](double ring) {
        auto scene = std::make_unique<Simulation<LinearViscoelasticSpecies>>();
        LinearViscoelasticSpecies species;
        species.setDensity(1000), species.setStiffness(1e6);
        auto own = scene->speciesHandler.copyAndAddObject(species);
        Sheet sheet(0.1, ring);
        sheet.setSpecies(own);
        scene->wallHandler.copyAndAddObject(sheet);
        SphericalParticle ball(own);
        ball.setRadius(0.1);
        scene->particleHandler.copyAndAddObject(ball);
        scene->setTimeStep(1e-4), scene->setQuiet();
        return scene;
    };
    const auto first = make(2), same = make(2), other = make(2.5);
    first->initialise();
    first->writeRestart(file);
    same->restartFrom(file), other->restartFrom(file);
    EXPECT_EQ(refusal([&] { same->initialise(); }), "");
    const std::string text = refusal([&] { other->initialise(); });
    EXPECT_TRUE(isOneSentence(text) && contains(text, "Torus of 2.5 and 0.5")) << text;
}

TEST(CurvedSheet, isRefusedWithoutASize) {
    CurvedSheet sheet;
    EXPECT_TRUE(contains(refusal([&] { sheet.set(torus(2, 0.5), -1); }), "thickness"));
    SurfaceFormula line = torus(2, 0.5);
    line.high[1] = line.low[1];
    const std::string curve = refusal([&] { sheet.set(line, 0); });
    EXPECT_TRUE(isOneSentence(curve) && contains(curve, "a curve needs one above 0")) << curve;
    EXPECT_EQ(refusal([&] { sheet.set(line, 0.1); }), "");
    const std::string far = refusal([&] { sheet.set(torus(std::nan(""), 0.5), 0.1); });
    EXPECT_TRUE(isOneSentence(far) && contains(far, "not finite")) << far;
}

}  // namespace
}  // namespace pendular::curvedSheetTest
