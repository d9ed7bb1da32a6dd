// A run is resumed with walls that are set up as those that it began with: each public setting of their
// motion, of what drives them, of wear and of membranes is changed.
#include <gtest/gtest.h>

#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Restart/ResumedWith.h"

namespace pendular::setUpOfWallsTest {
namespace {

using resumed::expectRefusals;
using S = LinearViscoelasticSlidingFrictionSpecies;

struct OneGrain : Simulation<S> {
    OneGrain() {
        S species;
        species.setDensity(2500), species.setStiffness(100), species.setDissipation(1e-3);
        species.setSlidingStiffness(30), species.setSlidingFrictionCoefficient(0.5);
        glass = speciesHandler.copyAndAddObject(species);
        SphericalParticle grain;
        grain.setSpecies(glass), grain.setRadius(1e-3), grain.setPosition({0, 0, 0.005});
        particleHandler.copyAndAddObject(grain);
        setTimeStep(1e-6);
        setQuiet();
    }
    template <class W>
    void add(W wall) {
        wall.setSpecies(glass);
        wallHandler.copyAndAddObject(wall);
    }
    S* glass;
};

struct Settings {
    Vec3D point{0, 0, 0}, velocity{0, 0, 0.1}, spin{0, 0, 1}, axisAt{0, 0, 0}, belt{0.1, 0, 0};
    double mass = 1e-3, load = 0.1, time = 0.1, fastest = 0.01, friction = 0;
    double modulus = 1e6, thickness = 1e-3, density = 1000, damping = 1, pressure = 10;
    bool holdsAll = false, isDriven = true, isAnother = false;
    double held = 0;  // m/s
    double wear = 1e-12;
};
using C = resumed::Change<Settings>;

InfiniteWall floorAt(const Vec3D& point) {
    InfiniteWall wall;
    wall.set({0, 0, -1}, point);
    return wall;
}

template <class AddWall>
void expectRefusalsOf(AddWall&& addWall, const std::vector<C>& changes) {
    expectRefusals<Settings>(
        [&](const Settings& s) {
            auto scene = std::make_unique<OneGrain>();
            addWall(*scene, s);
            if (s.isAnother) scene->add(floorAt({0, 0, -0.1}));
            return scene;
        },
        changes);
}

TEST(SetUpOfWalls, motions) {
    expectRefusalsOf(
        [](OneGrain& scene, const Settings& s) {
            InfiniteWall wall = floorAt(s.point);
            wall.setVelocity(s.velocity), wall.setAngularVelocity(s.spin, s.axisAt);
            wall.setSurfaceVelocity(s.belt);
            scene.add(wall);
        },
        {{"walls/0/firstVelocity is (0, 0, 0.1) m/s in the file and (0, 0, 0.2) m/s in the scene",
          [](Settings& s) { s.velocity.z() = 0.2; }},
         {"walls/0/firstAngularVelocity", [](Settings& s) { s.spin.z() = 2; }},
         {"walls/0/firstPointOfTurning", [](Settings& s) { s.axisAt.x() = 0.001; }},
         {"walls/0/firstSurfaceVelocity", [](Settings& s) { s.belt.x() = 0.2; }},
         {"walls/count", [](Settings& s) { s.isAnother = true; }}});
}

TEST(SetUpOfWalls, pistonsAndTargetForces) {
    expectRefusalsOf(
        [](OneGrain& scene, const Settings& s) {
            InfiniteWall wall = floorAt(s.point);
            if (s.isDriven) wall.setPiston(s.mass, s.load);
            scene.add(wall);
        },
        {{"walls/0/drive/firstMass", [](Settings& s) { s.mass = 2e-3; }},
         {"walls/0/drive/firstLoad", [](Settings& s) { s.load = 0.2; }},
         {"walls/0/drive/firstKind", [](Settings& s) { s.isDriven = false; }}});
    expectRefusalsOf(
        [](OneGrain& scene, const Settings& s) {
            InfiniteWall wall = floorAt(s.point);
            wall.setTargetForce(s.load, s.time, s.fastest);
            scene.add(wall);
        },
        {{"walls/0/drive/firstLoad", [](Settings& s) { s.load = 0.2; }},
         {"walls/0/drive/firstTime", [](Settings& s) { s.time = 0.2; }},
         {"walls/0/drive/firstLargestSpeed", [](Settings& s) { s.fastest = 0.02; }}});
}

std::vector<Triangle> square() {
    using V = Vector<double>;
    const V a{-0.01, -0.01, 0}, b{0.01, -0.01, 0}, c{0.01, 0.01, 0}, d{-0.01, 0.01, 0};
    return {Triangle{a, b, c}, Triangle{a, c, d}};
}

TEST(SetUpOfWalls, slidersAndWear) {
    expectRefusalsOf(
        [](OneGrain& scene, const Settings& s) {
            TriangleWall wall;
            wall.set(square());
            if (s.isDriven)
                wall.setSlider({0, 0, 1}, {.mass = s.mass, .force = s.load, .friction = s.friction});
            scene.add(wall);
        },
        {{"firstInertia", [](Settings& s) { s.mass = 2e-3; }},
         {"firstLoad", [](Settings& s) { s.load = 0.2; }},
         {"firstFriction", [](Settings& s) { s.friction = 0.1; }},
         {"firstKind", [](Settings& s) { s.isDriven = false; }}});
    expectRefusalsOf(
        [](OneGrain& scene, const Settings& s) {
            TriangleWall wall;
            wall.set(square());
            wall.keepWear(WearLaw::reye(s.wear));
            scene.add(wall);
        },
        {{"factor", [](Settings& s) { s.wear = 2e-12; }}});
}

TEST(SetUpOfWalls, membranes) {
    expectRefusalsOf(
        [](OneGrain& scene, const Settings& s) {
            Membrane sheet;
            sheet.set(square(), {.youngsModulus = s.modulus, .thickness = s.thickness, .density = s.density});
            sheet.setDamping(s.damping), sheet.setPressure(s.pressure);
            sheet.hold([&](const Vec3D& at) { return s.holdsAll || at.x() < 0; }, {0, 0, s.held});
            scene.add(sheet);
        },
        {{"walls/0/youngsModulus", [](Settings& s) { s.modulus = 2e6; }},
         {"walls/0/thickness", [](Settings& s) { s.thickness = 2e-3; }},
         {"walls/0/density", [](Settings& s) { s.density = 1100; }},
         {"walls/0/damping", [](Settings& s) { s.damping = 2; }},
         {"walls/0/firstPressure is 10 Pa in the file and 20 Pa in the scene",
          [](Settings& s) { s.pressure = 20; }},
         {"walls/0/firstHeld", [](Settings& s) { s.holdsAll = true; }},
         {"walls/0/firstVelocities", [](Settings& s) { s.held = 0.01; }}});
}

}  // namespace
}  // namespace pendular::setUpOfWallsTest
