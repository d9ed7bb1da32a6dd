#include <gtest/gtest.h>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Walls/WallScene.h"

// A plane at rest gives its points to eight grains at once; every other wall to one grain after the other.

namespace pendular::wallTests::planeTest {
namespace {

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

/// A plane as a shape that a user has written.
class OtherPlane : public RigidWall {
public:
    OtherPlane(const Vec3D& outward, const Vec3D& point) {
        normal = toVector(outward);
        offset = dot(normal, toVector(point));
        takePlace();
    }

protected:
    void listInBody(const Vector<double>& centre, double reach,
                    std::vector<std::uint32_t>& parts) const override {
        if (gap(centre) < reach) parts.push_back(0);
    }
    void findInBody(const Vector<double>& centre, double, std::span<const std::uint32_t>,
                    std::span<WallPoint> points) const override {
        points[0] = {normal, gap(centre), {0, 0, 0}};
    }
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override {
        return gap(from) >= 0 && gap(to) < 0;
    }
    [[nodiscard]] SurfaceExtent extent() const override {
        return {SurfaceExtent::Symmetry::Plane, offset * normal, infinity, normal};
    }

private:
    [[nodiscard]] double gap(const Vector<double>& centre) const { return offset - dot(normal, centre); }

    Vector<double> normal;
    double offset;  // m
};

template <class S>
std::uint64_t hashOfBox(bool otherPlanes, const Vec3D& surfaceVelocity, int threads) {
    scenes::SettlingBox<S> scene(10);
    scene.setQuiet();
    scene.setNumberOfThreads(threads);
    const auto planes = scene.planes;
    scene.wallHandler.clear();
    for (const auto& plane : planes) {
        const auto add = [&](auto wall) {
            wall.setSpecies(scene.speciesHandler.getObject(static_cast<std::size_t>(plane.species)));
            wall.setSurfaceVelocity(surfaceVelocity);
            EXPECT_EQ(wall.planeAtRest().has_value(), !otherPlanes);
            scene.wallHandler.copyAndAddObject(wall);
        };
        InfiniteWall wall;
        wall.set(plane.normal, plane.point);
        otherPlanes ? add(OtherPlane(plane.normal, plane.point)) : add(wall);
    }
    scene.initialise();
    scene.step(1500);
    return stateHash(scene.particleHandler.store());
}

TEST(HeavyPlaneAtRest, givesTheBitsOfAnyOtherWall) {
    for (const Vec3D& belt : {Vec3D(0, 0, 0), Vec3D(0.1, 0.05, 0)}) {
        const std::uint64_t expected = hashOfBox<Wet>(true, belt, 1);
        EXPECT_EQ(hashOfBox<Wet>(false, belt, 1), expected);
        EXPECT_EQ(hashOfBox<Wet>(false, belt, 3), expected);
    }
}

TEST(PlaneAtRest, isNoneThatMoves) {
    InfiniteWall wall;
    wall.set({0, 0, -1}, {0, 0, 0});
    EXPECT_TRUE(wall.planeAtRest().has_value());
    wall.setVelocity({0, 0, 1e-3});
    EXPECT_FALSE(wall.planeAtRest().has_value());
}

// Ten grains, so that the one that goes through is in the second block. At 200 m/s a step is 0.8 radii: no
// force of this soft grain stops it.
TEST(PlaneAtRest, tellsWhichGrainWentThroughIt) {
    std::vector<scenes::GrainMotion> grains;
    for (int k = 0; k < 10; ++k)
        grains.push_back({.radius = radius, .position = {3 * k * radius, 0, 1.5 * radius}});
    grains[9].velocity = {0, 0, -200};
    WallScene<Smooth> scene(grains);
    InfiniteWall wall;
    wall.set({0, 0, -1}, {0, 0, 0});
    scene.add(wall);
    scene.initialise();
    std::string message;
    for (int k = 0; k < 10 && message.empty(); ++k) try {
            scene.step();
        } catch (const std::runtime_error& error) {
            message = error.what();
        }
    EXPECT_NE(message.find("Particle 9 went through wall 0"), std::string::npos) << message;
}

/// A normal has a direction and no length: none is too large or too small.
TEST(Plane, hasANormalOfAnyLength) {
    const auto pushedBy = [](double length) {
        WallScene<Smooth> scene({{.radius = radius, .position = 0.99 * radius * Vec3D(-0.6, 0, 0.8)}});
        InfiniteWall wall;
        wall.set(length * Vec3D(0.6, 0, -0.8), {0, 0, 0});
        scene.add(wall);
        scene.initialise();
        scene.step();
        return scene.motion(0).velocity;
    };
    const Vec3D expected = pushedBy(1);
    EXPECT_GT(expected.norm(), 0);
    for (const double length : {1e300, 1e160, 1e-160, 1e-300})
        EXPECT_LT((pushedBy(length) - expected).norm(), 1e-12 * expected.norm()) << length;
}

}  // namespace
}  // namespace pendular::wallTests::planeTest
