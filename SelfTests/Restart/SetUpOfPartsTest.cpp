// A run is resumed with the settings of its parts that it began with, or is refused: for each part of a step
// each public setting is changed. SetUpOfWallsTest.cpp has walls, of which drives and membranes are parts,
// too.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <set>

#include "BuildFolders.h"
#include "Kernel/Fluid/ColumnFlow.h"
#include "Kernel/MercuryScene.h"
#include "Kernel/Parts/BondPart.h"
#include "Kernel/Parts/GrainCopies.h"
#include "Kernel/Parts/HeatPart.h"
#include "Kernel/Simulation/Simulation.h"
#include "Kernel/Simulation/StateHash.h"
#include "Kernel/Sizes/SizeLaws.h"
#include "Kernel/State/StateArchive.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Restart/ResumedWith.h"

namespace pendular::setUpOfPartsTest {
namespace {

using resumed::Change;
using resumed::expectRefusals;
using S = LinearViscoelasticSlidingFrictionSpecies;

/// A few grains that do not touch.
template <class Species>
struct GrainsOf : Simulation<Species> {
    explicit GrainsOf(const Species& species) : glass(this->speciesHandler.copyAndAddObject(species)) {
        SphericalParticle grain;
        grain.setSpecies(glass), grain.setRadius(1e-3);
        for (int k = 0; k < 4; ++k) {
            grain.setPosition({0.003 + 0.004 * k, 0.005, 0.005 + 0.002 * k});
            grain.setVelocity({0.01, 0.002 * k, 0});
            this->particleHandler.copyAndAddObject(grain);
        }
        this->setTimeStep(2e-6);
        this->setQuiet();
    }
    Species* glass;
};

struct FewGrains : GrainsOf<S> {
    FewGrains() : GrainsOf(linear()) {}
    static S linear() {
        S species;
        species.setDensity(2500), species.setStiffness(100), species.setDissipation(1e-3);
        species.setSlidingStiffness(30), species.setSlidingFrictionCoefficient(0.5);
        return species;
    }
};

/// Whose contact radius for heat goes with the modulus.
struct HertzianGrains : GrainsOf<HertzianViscoelasticSpecies> {
    HertzianGrains() : GrainsOf(hertzian()) {}
    static HertzianViscoelasticSpecies hertzian() {
        HertzianViscoelasticSpecies species;
        species.setDensity(2500), species.setEffectiveElasticModulusAndRestitutionCoefficient(1e6, 0.5);
        return species;
    }
};

struct FluidSettings {
    FluidMaterial fluid{.density = 998.2, .viscosity = 1.002e-3};
    FluidGrid grid{{0, 0, 0}, {0.02, 0.02, 0.02}, {1, 1, 4}};
    std::string law = "Gidaspow";
    PressureModel model = PressureModel::A;
    std::function<double(double)> speed = [](double time) { return 0.01 + time; };  // m/s
};

TEST(SetUpOfParts, fluid) {
    const auto make = [](const FluidSettings& s) {
        auto scene = std::make_unique<FewGrains>();
        scene->addPart<FluidPart>(s.grid, s.fluid, dragLaw(s.law),
                                  std::make_unique<ColumnFlow>(s.fluid, s.speed), s.model);
        return scene;
    };
    using F = FluidSettings;
    expectRefusals<F>(
        make,
        {{"parts/fluid/density is 998.2 kg/m^3 in the file and 1.2 kg/m^3 in the scene",
          [](F& s) { s.fluid.density = 1.2; }},
         {"parts/fluid/viscosity", [](F& s) { s.fluid.viscosity = 1.1e-3; }},
         {"parts/fluid/law is Gidaspow in the file and Ergun in the scene", [](F& s) { s.law = "Ergun"; }},
         {"parts/fluid/model is A in the file and B in the scene", [](F& s) { s.model = PressureModel::B; }},
         {"parts/fluid/lowest", [](F& s) { s.grid.lowest.x = -0.001; }},
         {"parts/fluid/highest", [](F& s) { s.grid.highest.z = 0.021; }},
         {"parts/fluid/cells is (1, 1, 4) in the file and (1, 1, 5) in the scene",
          [](F& s) { s.grid.cells[2] = 5; }},
         {"parts/fluid/host/superficialSpeed", [](F& s) { s.speed = [](double) { return 0.01; }; }},
         {"parts/fluid/host/superficialSpeed",
          [](F& s) { s.speed = [](double time) { return 0.02 + time; }; }}});
}

struct HeatSettings {
    HeatMaterial material{.conductivity = 1, .heatCapacity = 800};
    double wall = 400;                   // K
    std::optional<double> ofWall = 0.5;  // W/(m K)
    bool holdsWall = true, heatsByContacts = false;
    Conduction law = Conduction::Constriction;
    double softening = 1;
};

TEST(SetUpOfParts, heat) {
    const auto make = [](const HeatSettings& s) {
        auto scene = std::make_unique<HertzianGrains>();
        scene->keepEnergyLedger();
        InfiniteWall floor;
        floor.set({0, 0, -1}, {0, 0, 0}), floor.setSpecies(scene->glass);
        scene->wallHandler.copyAndAddObject(floor);
        auto& heat = scene->addPart<HeatPart>(scene->particleHandler.addColumn("temperature", "K", 293));
        heat.setMaterial(scene->glass, s.material);
        if (s.holdsWall) heat.holdWall(0, s.wall, s.ofWall);
        heat.setConduction(s.law), heat.setSoftening(s.softening), heat.heatByContacts(s.heatsByContacts);
        return scene;
    };
    using H = HeatSettings;
    expectRefusals<H>(
        make,
        {{"parts/heat/species0/conductivity is 1 W/(m K) in the file and 2 W/(m K) in the scene",
          [](H& s) { s.material.conductivity = 2; }},
         {"parts/heat/species0/heatCapacity", [](H& s) { s.material.heatCapacity = 900; }},
         {"parts/heat/wall0/temperature", [](H& s) { s.wall = 300; }},
         {"parts/heat/wall0/conductivity", [](H& s) { s.ofWall = 0.6; }},
         {"parts/heat/wall0/conductivity", [](H& s) { s.ofWall.reset(); }},
         {"parts/heat/heldWalls", [](H& s) { s.holdsWall = false; }},
         {"parts/heat/conduction", [](H& s) { s.law = static_cast<Conduction>(1), s.holdsWall = false; }},
         {"parts/heat/radiusFactor", [](H& s) { s.softening = 0.1; }},
         {"parts/heat/heatByContacts", [](H& s) { s.heatsByContacts = true; }}});
}

struct BondSettings {
    double radius = 4e-4, modulus = 2e6, damping = 0.1;  // m, Pa
    BondStrength strength{.tensile = 1e8, .shear = 1e8};
    bool hasAnother = false;
};

TEST(SetUpOfParts, bonds) {
    const auto make = [](const BondSettings& s) {
        auto scene = std::make_unique<FewGrains>();
        auto& bonds = scene->addPart<BondPart>();
        const auto stiffness = [modulus = s.modulus](const BondSection& section, double length) {
            return beamBond(modulus, 0.4 * modulus, 0.9, section, length);
        };
        const BondMaterial material{
            .radius = s.radius, .stiffness = stiffness, .strength = s.strength, .damping = s.damping};
        bonds.join(0, 1, bonds.addMaterial(material));
        if (s.hasAnother) bonds.addMaterial(material);
        return scene;
    };
    using B = BondSettings;
    expectRefusals<B>(make,
                      {{"parts/bonds/material0/radius", [](B& s) { s.radius = 5e-4; }},
                       {"parts/bonds/material0/tensileStrength", [](B& s) { s.strength.tensile = 2e8; }},
                       {"parts/bonds/material0/shearStrength", [](B& s) { s.strength.shear = 2e8; }},
                       {"parts/bonds/material0/momentShare", [](B& s) { s.strength.momentShare = 0.5; }},
                       {"parts/bonds/material0/strengthAtEnds", [](B& s) { s.strength.atEnds = false; }},
                       {"parts/bonds/material0/damping", [](B& s) { s.damping = 0.2; }},
                       {"parts/bonds/stiffness", [](B& s) { s.modulus = 3e6; }},
                       {"parts/bonds/materials", [](B& s) { s.hasAnother = true; }}});
}

struct CopySettings {
    double lowest = 0, highest = 0.02, rate = 0.1;  // m, m, m/s
    Vec3D normal{1, 0, 0};
    bool isTwice = false;
};

TEST(SetUpOfParts, copiesOfGrains) {
    const auto make = [](const CopySettings& s) {
        auto scene = std::make_unique<FewGrains>();
        auto& copies = scene->addPart<GrainCopies>();
        copies.addPeriod(
            s.normal, s.lowest, s.highest, [rate = s.rate](double time) { return Vec3D(0, rate * time, 0); },
            [rate = s.rate](double) { return Vec3D(0, rate, 0); });
        if (s.isTwice) copies.addPeriod({0, 0, 1}, -0.01, 0.03);
        return scene;
    };
    using C = CopySettings;
    expectRefusals<C>(make, {{"parts/copies of grains/faces0/lowerPoint", [](C& s) { s.lowest = -0.001; }},
                             {"parts/copies of grains/faces0/higherPoint", [](C& s) { s.highest = 0.021; }},
                             {"parts/copies of grains/faces0/shift", [](C& s) { s.rate = 0.2; }},
                             {"parts/copies of grains/count", [](C& s) { s.isTwice = true; }}});
}

struct BoundarySettings {
    Vec3D planeNormal{1, 0, 0}, outletNormal{0, 0, 1};
    double planePoint = 0.01, outletPoint = 0.03, age = 0;  // m, m, s
    std::vector<double> classes{1.5e-3};                    // m
    bool hasCondition = false, hasRegion = false, isTwice = false;
};

TEST(SetUpOfParts, outletsAndFluxPlanes) {
    const auto make = [](const BoundarySettings& s) {
        auto scene = std::make_unique<FewGrains>();
        scene->fluxPlaneHandler.copyAndAddObject({s.planeNormal, {s.planePoint, 0, 0}});
        Outlet outlet;
        if (s.hasRegion) outlet.setRegion(BoxRegion({0, 0, 0.03}, {0.01, 0.01, 0.04}));
        else outlet.setPlane(s.outletNormal, {0, 0, s.outletPoint});
        outlet.setLeastAge(s.age), outlet.setSizeClasses(s.classes);
        if (s.hasCondition) outlet.setCondition([](const GrainReference&) { return true; });
        scene->outletHandler.copyAndAddObject(outlet);
        if (s.isTwice) scene->outletHandler.copyAndAddObject(outlet);
        return scene;
    };
    using B = BoundarySettings;
    expectRefusals<B>(make,
                      {{"parts/fluxPlanes/0/normal is (1, 0, 0) in the file and (-1, 0, 0) in the scene",
                        [](B& s) {
                            s.planeNormal = {-1, 0, 0};
                        }},
                       {"parts/fluxPlanes/0/offset", [](B& s) { s.planePoint = 0.011; }},
                       {"parts/outlets/0/normal",
                        [](B& s) {
                            s.outletNormal = {0, 1, 1};
                        }},
                       {"parts/outlets/0/offset", [](B& s) { s.outletPoint = 0.031; }},
                       {"parts/outlets/0/leastAge", [](B& s) { s.age = 1; }},
                       {"parts/outlets/0/hasCondition", [](B& s) { s.hasCondition = true; }},
                       {"parts/outlets/0/classBorders", [](B& s) { s.classes = {1.6e-3}; }},
                       {"parts/outlets/count", [](B& s) { s.isTwice = true; }}});
}

struct InletSettings {
    Vec3D lowest{0.001, 0.001, 0.02}, velocity{0, 0, -0.1}, spin{0, 0, 0};  // m, m/s, rad/s
    SizeDistribution sizes = evenSizes(1e-3, 1.2e-3);
    double number = 5000, first = 0, last = 1;  // 1/s, s, s
    NoRoom noRoom = NoRoom::Later;
    std::uint32_t tries = 50;
    std::uint64_t seed = 3;
    bool areWhole = true, followsFill = false, areClumps = false, areTurned = true, areHeld = false;
    double apart = 0.4;  // of the spheres of a clump, of their diameter
};

template <bool clumps>
std::unique_ptr<FewGrains> sceneWithInlet(const InletSettings& s) {
    auto scene = std::make_unique<FewGrains>();
    SphericalParticle grain;
    grain.setSpecies(scene->glass), grain.setVelocity(s.velocity), grain.setAngularVelocity(s.spin);
    if (s.areHeld) grain.setHeldAxes({.x = true});
    Clump clump(ClumpTemplate({{{0, 0, -s.apart}, 0.5}, {{0, 0, s.apart}, 0.5}}));
    clump.setSpecies(scene->glass), clump.setVelocity(s.velocity);
    Inlet inlet;
    if (clumps != s.areClumps) inlet.setClump(clump);
    else inlet.setGrain(grain);
    inlet.setSizes(s.sizes), inlet.setNumberFlow(s.number), inlet.setTimes(s.first, s.last);
    inlet.setRegion(BoxRegion(s.lowest, {0.02, 0.02, 0.04}));
    inlet.setNoRoom(s.noRoom), inlet.setTries(s.tries), inlet.setSeed(s.seed),
        inlet.setWholeGrains(s.areWhole);
    inlet.setRandomTurns(s.areTurned);
    if (s.followsFill) inlet.setFollowsFill({0, 0, 1}, 1e-3, 2e-3);
    scene->inletHandler.copyAndAddObject(inlet);
    scene->setTimeMax(1);
    return scene;
}

TEST(SetUpOfParts, inlets) {
    using I = InletSettings;
    expectRefusals<I>(
        sceneWithInlet<false>,
        {{"parts/inlets/0/region/lowest", [](I& s) { s.lowest.z() = 0.021; }},
         {"parts/inlets/0/kind0/velocity is (0, 0, -0.1) m/s in the file and (0, 0, -0.2) m/s in the scene",
          [](I& s) { s.velocity.z() = -0.2; }},
         {"parts/inlets/0/kind0/spin", [](I& s) { s.spin.x() = 1; }},
         {"parts/inlets/0/kind0/held", [](I& s) { s.areHeld = true; }},
         {"parts/inlets/0/kind0/smallest", [](I& s) { s.sizes = evenSizes(0.9e-3, 1.2e-3); }},
         {"parts/inlets/0/kind0/largest", [](I& s) { s.sizes = evenSizes(1e-3, 1.3e-3); }},
         {"parts/inlets/0/kind0/meanDiameter",
          [](I& s) { s.sizes = normalSizes(1.05e-3, 1e-4, 1e-3, 1.2e-3).sizes; }},
         {"parts/inlets/0/kind0/kind is grain in the file and clump in the scene",
          [](I& s) { s.areClumps = true; }},
         {"parts/inlets/0/numberFlow", [](I& s) { s.number = 6000; }},
         {"parts/inlets/0/firstTime", [](I& s) { s.first = 0.1; }},
         {"parts/inlets/0/lastTime", [](I& s) { s.last = 0.9; }},
         {"parts/inlets/0/lost", [](I& s) { s.noRoom = NoRoom::Lost; }},
         {"parts/inlets/0/tries", [](I& s) { s.tries = 51; }},
         {"parts/inlets/0/seed", [](I& s) { s.seed = 4; }},
         {"parts/inlets/0/wholeGrains", [](I& s) { s.areWhole = false; }},
         {"parts/inlets/0/rise", [](I& s) { s.followsFill = true; }}});
}

TEST(SetUpOfParts, inletsOfClumps) {
    using I = InletSettings;
    expectRefusals<I>(sceneWithInlet<true>,
                      {{"parts/inlets/0/kind0/spheres", [](I& s) { s.apart = 0.3; }},
                       {"parts/inlets/0/randomTurns", [](I& s) { s.areTurned = false; }}});
}

struct FlowSettings {
    double shear = 10, strain = 0, stress = 100, time = 1, largest = 0.1;  // 1/s, 1/s, Pa, s, 1/s
};

std::unique_ptr<FewGrains> inPeriods() {
    auto scene = std::make_unique<FewGrains>();
    for (const int axis : {0, 1, 2}) scene->setPeriodic(axis, 0, 0.02);
    return scene;
}

TEST(SetUpOfParts, flow) {
    using F = FlowSettings;
    expectRefusals<F>(
        [](const F& s) {
            auto scene = inPeriods();
            scene->setLeesEdwards(0, 1, s.shear);
            return scene;
        },
        {{"settings/flow/shearRate is 10 1/s in the file and 11 1/s in the scene",
          [](F& s) { s.shear = 11; }}});
    expectRefusals<F>(
        [](const F& s) {
            auto scene = inPeriods();
            scene->setStrainRate(0, s.strain);
            scene->setTargetStress(2, s.stress, s.time, s.largest);
            return scene;
        },
        {{"settings/flow/axis0/firstRate", [](F& s) { s.strain = 1; }},
         {"settings/flow/axis2/firstStress", [](F& s) { s.stress = 200; }},
         {"settings/flow/axis2/firstTime", [](F& s) { s.time = 2; }},
         {"settings/flow/axis2/firstLargestRate", [](F& s) { s.largest = 0.2; }}});
}

struct StepSettings {
    double share = 0.5, largest = 2e-5;  // s
    bool keepsLedger = true;
};

TEST(SetUpOfParts, adaptiveStepAndEnergy) {
    using A = StepSettings;
    expectRefusals<A>(
        [](const A& s) {
            auto scene = std::make_unique<FewGrains>();
            scene->setAdaptiveTimeStep(s.share, s.largest);
            scene->keepEnergyLedger(s.keepsLedger);
            return scene;
        },
        {{"settings/adaptiveStep/share", [](A& s) { s.share = 0.4; }},
         {"settings/adaptiveStep/largest", [](A& s) { s.largest = 1.5e-5; }},
         {"settings/energy/ledgerKept", [](A& s) { s.keepsLedger = false; }}});
}

struct LiquidSettings {
    double density = 1000, radius = 5e-5, spread = 0.3, speed = 5, drops = 40000, momentum = 1000,
           flight = 0.01, first = 0, last = 1, height = 0.01, towards = 0.3, transfer = 0.01, humidity = 0.2,
           start = 0;
    std::size_t interval = 100;
    std::uint64_t seed = 1;
    bool isCone = false;
};
using Moving = Species<HertzianViscoelastic, Mindlin, LiquidMigration<LiquidBridgeBagheri>>;

TEST(SetUpOfParts, liquid) {
    const auto make = [](const LiquidSettings& s) {
        auto scene = std::make_unique<wet::WetBox<Moving>>(1);
        scene->setLiquidDensity(s.density);
        scene->setLiquidToCome(1e-9);
        Spray spray;
        if (s.isCone) spray.setCone({0.006, 0.006, s.height}, {s.towards, 0, -1}, 0.3);
        else spray.setRain({0.006, 0.006, s.height}, {0.010, 0, 0}, {0, 0.010, 0}, {s.towards, 0, -1});
        spray.setDropletRadius(s.radius), spray.setVolumeSpread(s.spread), spray.setSpeed(s.speed);
        spray.setFlow(s.drops * 5e-13), spray.setMomentum(s.momentum), spray.setLongestFlight(s.flight);
        spray.setTimes(s.first, s.last), spray.setSeed(s.seed);
        scene->sprayHandler.copyAndAddObject(spray);
        Evaporation drying;
        drying.setMassTransfer(s.transfer, 0.02, 1000, s.humidity);
        drying.setInterval(s.interval), drying.setStartTime(s.start);
        scene->setEvaporation(drying);
        scene->setTimeMax(1e-3);
        return scene;
    };
    using L = LiquidSettings;
    expectRefusals<L>(make, {{"parts/filmMass/density is 1000 kg/m^3 in the file and 900 kg/m^3 in the scene",
                              [](L& s) { s.density = 900; }},
                             {"parts/sprays/0/shape", [](L& s) { s.isCone = true; }},
                             {"parts/sprays/0/middle", [](L& s) { s.height = 0.011; }},
                             {"parts/sprays/0/direction", [](L& s) { s.towards = 0.2; }},
                             {"parts/sprays/0/dropletRadius", [](L& s) { s.radius = 6e-5; }},
                             {"parts/sprays/0/volumeSpread", [](L& s) { s.spread = 0.2; }},
                             {"parts/sprays/0/speed", [](L& s) { s.speed = 6; }},
                             {"parts/sprays/0/flow", [](L& s) { s.drops = 50000; }},
                             {"parts/sprays/0/liquidDensity", [](L& s) { s.momentum = 900; }},
                             {"parts/sprays/0/longestFlight", [](L& s) { s.flight = 0.02; }},
                             {"parts/sprays/0/firstTime", [](L& s) { s.first = 0.1; }},
                             {"parts/sprays/0/lastTime", [](L& s) { s.last = 0.9; }},
                             {"parts/sprays/0/seed", [](L& s) { s.seed = 2; }},
                             {"contacts/liquid/evaporation/fastest", [](L& s) { s.transfer = 0.02; }},
                             {"contacts/liquid/evaporation/humidity", [](L& s) { s.humidity = 0.3; }},
                             {"contacts/liquid/evaporation/start", [](L& s) { s.start = 0.1; }},
                             {"contacts/liquid/evaporation/interval", [](L& s) { s.interval = 50; }}});
}

struct MercurySettings {
    double flow = 1e-4, radius = 0.004, fluxAt = 0.05, path = 1, height = 0.1;  // m^3/s, m, m, m/s, m
    unsigned tries = 100;
};

TEST(SetUpOfParts, partsOfMercury) {
    struct Into : MercuryScene<S> {
        explicit Into(const MercurySettings& s) {
            setDomain(Vec3D(0, 0, 0), Vec3D(.1, .1, .1));
            S species;
            species.setDensity(2000), species.setStiffness(1000);
            auto* const added = speciesHandler.copyAndAddObject(species);
            SphericalParticle grain(added);
            grain.setRadius(s.radius);
            CubeInsertionBoundary insertion;
            insertion.set(grain, s.tries, Vec3D(0, 0, 0), Vec3D(.1, .1, s.height));
            insertion.setVolumeFlowRate(s.flow);
            boundaryHandler.copyAndAddObject(insertion);
            FluxBoundary plane;
            plane.set({0, 0, 1}, 0);
            boundaryHandler.copyAndAddObject(plane)->setPrescribedDistance(
                [at = s.fluxAt](double) { return at; });
            grain.setRadius(0.002), grain.setPosition({0.05, 0.05, 0.2}), grain.fixParticle();
            setPrescribedVelocity(particleHandler.copyAndAddObject(grain),
                                  [speed = s.path](double) { return Vec3D(speed, 0, 0); });
            setTimeStep(1e-5);
            setTimeMax(1);
            setQuiet();
        }
    };
    const auto make = [](const MercurySettings& s) { return std::make_unique<Into>(s); };
    using M = MercurySettings;
    expectRefusals<M>(make, {{"parts/insertion boundaries/source 0/volumeFlow", [](M& s) { s.flow = 2e-4; }},
                             {"parts/insertion boundaries/source 0/maxFailed", [](M& s) { s.tries = 101; }},
                             {"parts/insertion boundaries/source 0/sort 0/", [](M& s) { s.radius = 0.005; }},
                             {"parts/insertion boundaries/source 0/highest", [](M& s) { s.height = 0.09; }},
                             {"parts/boundaries that act in steps/boundary 0/prescribedDistance",
                              [](M& s) { s.fluxAt = 0.06; }},
                             {"parts/prescribed paths/velocityOfGrain0", [](M& s) { s.path = 2; }}});
}

/// Three held grains, of which the first has the path of its velocity prescribed, the second that of its
/// place.
struct GrainsOnPaths : MercuryScene<S> {
    explicit GrainsOnPaths(double speed) {
        setDomain(Vec3D(0, 0, 0), Vec3D(.1, .1, .1));
        S species;
        species.setDensity(2000), species.setStiffness(1000);
        SphericalParticle grain(speciesHandler.copyAndAddObject(species));
        grain.setRadius(0.002), grain.fixParticle();
        for (int k = 0; k < 3; ++k) {
            grain.setPosition({0.02, 0.02 + 0.02 * k, 0.05});
            const GrainReference added = particleHandler.copyAndAddObject(grain);
            if (k == 0) setPrescribedVelocity(added, [](double time) { return Vec3D(1 + time, 0, 0); });
            if (k == 1)
                setPrescribedPosition(added,
                                      [=](double time) { return Vec3D(0.02 + speed * time, 0.04, 0.05); });
        }
        setTimeStep(1e-5);
        setTimeMax(1);
        setQuiet();
    }
};

/// Grains with a path are removed in a run. The same set-up, with all grains and paths, goes on from its
/// file, also where no step was done since; another path of a grain that is left is refused.
TEST(SetUpOfParts, pathsOfGrainsThatWereRemoved) {
    for (const std::size_t stepsSince : {0u, 4u})
        for (const auto& removed : {std::vector<std::size_t>{0}, {1}, {0, 1}, {2}}) {
            const support::TestFolder folder;
            const std::filesystem::path file = folder.path() / "begun.h5";
            GrainsOnPaths whole(1);
            whole.initialise();
            whole.step(5);
            for (const std::size_t identity : removed) whole.particleHandler.removeObject(identity);
            whole.step(stepsSince);
            whole.writeRestart(file);
            whole.step(10);
            GrainsOnPaths second(1);
            second.restartFrom(file);
            second.initialise();
            second.step(10);
            ASSERT_EQ(second.particleHandler.getSize(), 3 - removed.size());
            EXPECT_EQ(stateHash(second.particleHandler.store()), stateHash(whole.particleHandler.store()));
            const std::string sentence = support::refusal([&] {
                GrainsOnPaths other(2);
                other.restartFrom(file);
                other.initialise();
            });
            const bool isLeft = std::ranges::count(removed, 1u) == 0;
            EXPECT_EQ(support::contains(sentence, "parts/prescribed paths/placeOfGrain1"), isLeft)
                << sentence;
            EXPECT_EQ(sentence.empty(), !isLeft) << sentence;
        }
}

/// Values of functions are equal within 1e-9 of the largest finite one. An infinite one is equal to itself
/// alone, and so is one that is not set (NaN).
TEST(SetUpOfParts, valuesOfFunctionsThatAreInfinite) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const support::TestFolder folder;
    auto isTaken = [&, k = 0](const std::vector<double>& kept, const std::vector<double>& now) mutable {
        const std::filesystem::path place = folder.path() / fmt::format("{}.h5", ++k);
        Hdf5File written(place, Hdf5File::Access::Create);
        StateArchive(written, StateArchive::Direction::Write).sameValues("values", kept, "m");
        written.close();
        Hdf5File read(place, Hdf5File::Access::Read);
        const std::string sentence = support::refusal(
            [&] { StateArchive(read, StateArchive::Direction::Read).sameValues("values", now, "m"); });
        EXPECT_TRUE(sentence.empty() ||
                    (support::isOneSentence(sentence) && support::contains(sentence, " in the file and ")))
            << sentence;
        return sentence.empty();
    };
    EXPECT_TRUE(isTaken({1, inf, -inf, none}, {1, inf, -inf, none}));
    for (const double other : {-inf, 0.0, 1.0, 1e300, none}) {
        EXPECT_FALSE(isTaken({1, inf}, {1, other})) << other;
        EXPECT_FALSE(isTaken({1, other}, {1, inf})) << other;
    }
    for (const double other : {inf, 0.0, 1.0}) {
        EXPECT_FALSE(isTaken({1, none}, {1, other})) << other;
        EXPECT_FALSE(isTaken({1, other}, {1, none})) << other;
    }
    // Beside an infinite value the others are compared as without it.
    EXPECT_TRUE(isTaken({1, inf}, {1 + 0.9e-9, inf}));
    EXPECT_FALSE(isTaken({1, inf}, {1 + 1.1e-9, inf}));
    EXPECT_FALSE(isTaken({1, 2, inf}, {1.001, 2, inf}));
    EXPECT_FALSE(isTaken({1}, {1, 1}));
}

/// Every part of a step in the kernel, and where its settings are changed.
const std::set<std::string> partsThatAreTested{
    "FluidPart",     "HeatPart",     "BondPart",     "GrainCopies",       "FluxPlanePart",
    "OutletPart",    "InletPart",    "FlowPart",     "AdaptivePart",      "AccountPart",
    "SprayPart",     "FilmMassPart", "LiquidPart",   "MercuryInsertions", "MercuryActions",
    "MercuryPaths",  "DrivePart",    "MembranePart",  // SetUpOfWallsTest.cpp
    "GrainPart",     "BodyPart",                      // no settings: bodies are part of the state
    "MercuryForces", "MercuryBonds"};                 // a function of the driver; what is asked for in a run

TEST(SetUpOfParts, areThoseOfAllParts) {
    std::set<std::string> parts;
    const std::regex derived(R"(class (\w+)(?: final)? : public StepPart)");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folders::source / "Kernel")) {
        if (entry.path().extension() != ".h") continue;
        std::ifstream file(entry.path());
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        for (std::sregex_iterator at(text.begin(), text.end(), derived), end; at != end; ++at)
            parts.insert((*at)[1]);
    }
    EXPECT_EQ(parts, partsThatAreTested);
}

}  // namespace
}  // namespace pendular::setUpOfPartsTest
