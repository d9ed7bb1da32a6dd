#include "Kernel/Core/Step/Conflicts.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "BuildFolders.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/MercuryNames.h"
#include "Kernel/Scene/Simulation.h"
#include "Kernel/Scene/SuperquadricSimulation.h"
#include "SelfTests/Support/AnyMaterial.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::conflictsTest {
namespace {

using Wet = HertzianViscoelasticMindlinLiquidMigrationWillettSpecies;
using Viscous = HertzianViscoelasticMindlinViscousLiquidBridgeWillettSpecies;

constexpr double radius = 1e-3;  // m

template <class S>
S material() {
    S species;
    species.setDensity(2500);
    support::setNormal(species, {});
    support::setFriction(species, {});
    support::setAdhesion(species, {});
    if constexpr (requires { species.setViscosity(1e-3); }) species.setViscosity(1e-3);
    return species;
}

std::vector<Triangle> sheetBelow() {
    std::vector<Triangle> sheet = membraneSheet(4, 4, 2e-3);
    for (Triangle& triangle : sheet)
        for (Vector<double>& corner : triangle) corner.z -= 0.02;
    return sheet;
}

/// Two grains that are far from all that a feature adds.
template <class S>
struct PlainScene : Simulation<S> {
    PlainScene() {
        this->setQuiet();
        own = this->speciesHandler.copyAndAddObject(material<S>());
        SphericalParticle grain;
        grain.setSpecies(own);
        grain.setRadius(radius);
        for (const double x : {0.0, 3e-3}) {
            grain.setPosition({x, 0, 0});
            this->particleHandler.copyAndAddObject(grain);
        }
        this->setTimeStep(1e-8);
    }
    S* own;
};

template <class Shape, class S>
Shape* addWall(PlainScene<S>& scene, Shape wall) {
    wall.setSpecies(scene.own);
    return scene.wallHandler.copyAndAddObject(wall);
}

template <class S>
void addFloor(PlainScene<S>& scene, bool driven) {
    InfiniteWall floor;
    floor.set({0, 0, -1}, {0, 0, -0.05});
    InfiniteWall* const added = addWall(scene, floor);
    if (driven) added->setPiston(1, 1);
}

template <class S>
void addWornWall(PlainScene<S>& scene) {
    TriangleWall wall;
    wall.set(sheetBelow());
    wall.keepWear(WearLaw::finnie(1e-3, 1e9));
    addWall(scene, wall);
}

/// @param scene with its species as `own`
template <class Scene>
void addRotor(Scene& scene) {
    InfiniteCylinder wall;
    wall.set({0, 1, 0}, {0, 0, 0}, 1, CylinderSide::Inside);
    wall.setRotor({0, 1, 0}, {0, 0, 0}, {.inertia = 1});
    wall.setSpecies(scene.own);
    scene.wallHandler.copyAndAddObject(wall);
}

/// @param scene with its species as `own`
template <class Scene>
void addInlet(Scene& scene) {
    Inlet inlet;
    inlet.setRegion(BoxRegion({-0.01, -0.01, 0.02}, {0.01, 0.01, 0.04}));
    inlet.setSizes(evenSizes(2 * radius, 2.1 * radius));
    SphericalParticle grain;
    grain.setSpecies(scene.own);
    inlet.setGrain(grain);
    inlet.setNumberFlow(10);
    scene.inletHandler.copyAndAddObject(inlet);
}

template <class S>
void addSpray(PlainScene<S>& scene) {
    Spray spray;
    spray.setCone({0, 0, 0.03}, {0, 0, 1}, 0.5);
    spray.setDropletRadius(1e-4);
    spray.setSpeed(1);
    spray.setFlow(1e-9);
    scene.sprayHandler.copyAndAddObject(spray);
}

template <class S>
void setPeriods(PlainScene<S>& scene) {
    for (const int axis : {0, 1, 2}) scene.setPeriodic(axis, -0.1, 0.1);
}

/// Gives a scene a feature as a driver does.
template <class S>
void give(PlainScene<S>& scene, Feature feature) {
    switch (feature) {
        case Feature::Walls:
            return addFloor(scene, false);
        case Feature::WallsInStrain: {
            InfiniteWall side;
            side.set({-1, 0, 0}, {-0.05, 0, 0});
            return static_cast<void>(addWall(scene, side));
        }
        case Feature::DrivenWalls:
            return addFloor(scene, true);
        case Feature::TurnedWalls:
            return addRotor(scene);
        case Feature::Membranes: {
            Membrane wall;
            wall.set(sheetBelow(), {.youngsModulus = 1e6, .thickness = 3e-4, .density = 1000});
            return static_cast<void>(addWall(scene, wall));
        }
        case Feature::ImpactWear:
            return addWornWall(scene);
        case Feature::HeldGrains:
            return scene.particleHandler.getObject(0).fixParticle();
        case Feature::RigidBodies:
            return static_cast<void>(scene.bodyHandler.join({0, 1}));
        case Feature::PeriodicFaces:
            return setPeriods(scene);
        case Feature::Shear:
            return setPeriods(scene), scene.setLeesEdwards(0, 1, 1);
        case Feature::Strain:
            return setPeriods(scene), scene.setStrainRate(2, 0.1);
        case Feature::StressServo:
            return setPeriods(scene), scene.setTargetStress(2, 100, 0.1);
        case Feature::Gravity:
        case Feature::GravityAlongGradient:
            return scene.setGravity({0, -9.81, 0});
        case Feature::EarlierAccelerations:
            return scene.setIntegrator(integrators::adamsMoulton);
        case Feature::SpringsInStep:
            return scene.setIntegrator(integrators::springsInStep);
        case Feature::AdaptiveStep:
            return scene.setAdaptiveTimeStep(0.9);
        case Feature::FilmMass:
            return scene.setLiquidDensity(1000);
        case Feature::Sprays:
            return addSpray(scene);
        case Feature::Inlets:
            return addInlet(scene);
        case Feature::Outlets: {
            Outlet outlet;
            outlet.setPlane({0, 0, 1}, {0, 0, 0.05});
            return static_cast<void>(scene.outletHandler.copyAndAddObject(outlet));
        }
        case Feature::FluxPlanes:
            return static_cast<void>(
                scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{1, 0, 0}, {1.5e-3, 0, 0}}));
        case Feature::ViscousBridges:
        case Feature::Superquadrics:
            return;  // by the type of the scene
        default:
            FAIL() << "no scene of this test has " << nameOf(feature);
    }
}

struct Ellipsoids : SuperquadricSimulation<HertzianViscoelasticMindlinSpecies> {
    Ellipsoids() {
        setQuiet();
        own = speciesHandler.copyAndAddObject(material<HertzianViscoelasticMindlinSpecies>());
        SuperquadricGrain grain(Superquadric{1e-3, 1e-3, 2e-3});
        grain.setSpecies(own);
        superquadricHandler.copyAndAddObject(grain);
        setTimeStep(1e-8);
    }
    HertzianViscoelasticMindlinSpecies* own;
};

std::string refusalOfEllipsoids(Feature with) {
    return support::refusal([&] {
        Ellipsoids scene;
        if (with != Feature::TurnedWalls)  // a cylinder is not repeated
            for (const int axis : {0, 1, 2}) scene.setPeriodic(axis, -0.1, 0.1);
        if (with == Feature::StressServo) scene.setTargetStress(2, 100, 0.1);
        else if (with == Feature::AdaptiveStep) scene.setAdaptiveTimeStep(0.9);
        else if (with == Feature::TurnedWalls) addRotor(scene);
        else if (with == Feature::Inlets) addInlet(scene);
        scene.initialise();
    });
}

template <class S>
std::string refusalOf(std::initializer_list<Feature> features) {
    return support::refusal([&] {
        PlainScene<S> scene;
        for (const Feature feature : features) give(scene, feature);
        scene.initialise();
    });
}

std::string refusalOf(const Conflict& conflict) {
    if (conflict.b == Feature::ViscousBridges) return refusalOf<Viscous>({conflict.a});
    return refusalOf<Wet>({conflict.a, conflict.b});
}

// Before a step, so that positions belong to the time.
TEST(Conflicts, areRefusedInTheRunBeforeTheGrainsMove) {
    PlainScene<Wet> scene;
    give(scene, Feature::Shear);
    scene.particleHandler.getObject(0).setVelocity({1, 0, 0});
    scene.initialise();
    scene.step();
    const Vec3D place = scene.particleHandler.getObject(0).getPosition();
    EXPECT_GT(place.x(), 0);
    scene.particleHandler.getObject(1).fixParticle();
    EXPECT_THROW(scene.step(), RunError);
    EXPECT_EQ(scene.getTime(), 1e-8);
    EXPECT_EQ(scene.particleHandler.getObject(0).getPosition(), place);
}

TEST(Conflicts, areRefusedWithTheirSentence) {
    for (const Conflict& conflict : conflicts()) {
        const std::string told = refusalOf(conflict);
        SCOPED_TRACE(fmt::format("{} and {}: {}", nameOf(conflict.a), nameOf(conflict.b), told));
        EXPECT_TRUE(support::isOneSentence(told));
        for (const std::string_view part :
             {nameOf(conflict.a), nameOf(conflict.b), conflict.why, conflict.advice})
            EXPECT_TRUE(support::contains(told, part));
    }
}

TEST(Conflicts, areTheOnlyReason) {
    // Each feature alone is taken by the scenes of this test.
    for (const Conflict& conflict : conflicts())
        for (const Feature feature : {conflict.a, conflict.b}) {
            if (feature == Feature::ViscousBridges) continue;
            EXPECT_EQ(refusalOf<Wet>({feature}), "") << nameOf(feature);
        }
    EXPECT_EQ(refusalOf<Viscous>({}), "");
}

TEST(Conflicts, areNoneOfSuperquadrics) {
    for (const Feature feature : {Feature::Superquadrics, Feature::StressServo, Feature::AdaptiveStep,
                                  Feature::TurnedWalls, Feature::Inlets})
        EXPECT_EQ(refusalOfEllipsoids(feature), "") << nameOf(feature);
}

TEST(Conflicts, standInTheTableOnce) {
    for (const Conflict& one : conflicts())
        EXPECT_EQ(std::ranges::count_if(conflicts(),
                                        [&](const Conflict& other) {
                                            return (one.a == other.a && one.b == other.b) ||
                                                   (one.a == other.b && one.b == other.a);
                                        }),
                  1)
            << nameOf(one.a) << ", " << nameOf(one.b);
}

TEST(Conflicts, tellWhichWallOrGrainItIs) {
    EXPECT_TRUE(support::contains(refusalOf<Wet>({Feature::HeldGrains, Feature::Shear}), "(particle 0)"));
    EXPECT_TRUE(support::contains(refusalOf<Wet>({Feature::WallsInStrain, Feature::Strain}), "(wall 0)"));
    EXPECT_TRUE(support::contains(refusalOf<Wet>({Feature::DrivenWalls, Feature::AdaptiveStep}), "(wall 0)"));
}

TEST(Conflicts, areThoseOfThePage) {
    std::ifstream file(folders::source / "Kernel/Core/Step/README.md");
    std::stringstream page;
    page << file.rdbuf();
    EXPECT_NE(page.str().find(conflictMatrix()), std::string::npos) << "The page should have this:\n\n"
                                                                    << conflictMatrix();
}

}  // namespace
}  // namespace pendular::conflictsTest
