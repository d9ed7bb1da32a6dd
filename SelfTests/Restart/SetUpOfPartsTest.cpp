// A run is resumed with the settings of its parts that it began with, or is refused: for each part of a step
// each value that it compares is changed by a row. SetUpOfInletsTest.cpp has inlets, and SetUpOfWallsTest.cpp
// walls, of which drives and membranes are parts, too.
#include <gtest/gtest.h>
#include <cmath>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <set>

#include "BuildFolders.h"
#include "Kernel/Features/Bonds/BondPart.h"
#include "Kernel/Features/Fluid/ColumnFlow.h"
#include "Kernel/Features/GhostImages/GrainCopies.h"
#include "Kernel/Features/Heat/HeatPart.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/MercuryScene.h"
#include "Kernel/Scene/Simulation.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Restart/ResumedScenes.h"
#include "SelfTests/Restart/ResumedWith.h"

namespace pendular::setUpOfPartsTest {
namespace {

using resumed::Change;
using resumed::expectAllHaveRows;
using resumed::expectRefusals;
using resumed::FewGrains;
using resumed::GrainsOf;
using S = resumed::S;

/// Whose contact radius for heat goes with the modulus.
struct HertzianGrains : GrainsOf<HertzianViscoelasticSpecies> {
    HertzianGrains() : GrainsOf(hertzian()) {}
    static HertzianViscoelasticSpecies hertzian() {
        HertzianViscoelasticSpecies species;
        species.setDensity(2500), species.setEffectiveElasticModulusAndRestitutionCoefficient(1e6, 0.5);
        return species;
    }
};

/// Gidaspow's law, with 0.1 % more at a porosity of 1 and one Reynolds number.
struct ChangedLaw {
    static inline double at = 0;
    static double resistance(const DragState& state) {
        const bool isThere =
            state.porosity == 1 && std::abs(state.reynolds() - at) <= 1e-9 * at;  // at rest also 0
        return (isThere ? 1.001 : 1) * dragLaw("Gidaspow").resistance(state);
    }
};

struct FluidSettings {
    FluidMaterial fluid{.density = 998.2, .viscosity = 1.002e-3};
    FluidMaterial ofHost = fluid;
    FluidGrid grid{{0, 0, 0}, {0.02, 0.02, 0.02}, {1, 1, 4}};
    DragLaw law = dragLaw("Gidaspow");
    PressureModel model = PressureModel::A;
    std::function<double(double)> speed = [](double time) { return 0.01 + time; };  // m/s
};

TEST(SetUpOfParts, fluid) {
    const auto make = [](const FluidSettings& s) {
        auto scene = std::make_unique<FewGrains>();
        scene->addPart<FluidPart>(s.grid, s.fluid, s.law, std::make_unique<ColumnFlow>(s.ofHost, s.speed),
                                  s.model);
        return scene;
    };
    using F = FluidSettings;
    auto sentences = expectRefusals<F>(
        make,
        {{"parts/fluid/density is 998.2 kg/m^3 in the file and 1.2 kg/m^3 in the scene",
          [](F& s) { s.fluid.density = 1.2; }},
         {"parts/fluid/viscosity", [](F& s) { s.fluid.viscosity = 1.1e-3; }},
         {"parts/fluid/law is Gidaspow in the file and Ergun in the scene",
          [](F& s) { s.law = dragLaw("Ergun"); }},
         {"parts/fluid/lawHolds", [](F& s) { s.law.highestReynolds = 2e4; }},
         {"parts/fluid/model is A in the file and B in the scene", [](F& s) { s.model = PressureModel::B; }},
         {"parts/fluid/lowest", [](F& s) { s.grid.lowest.x = -0.001; }},
         {"parts/fluid/highest", [](F& s) { s.grid.highest.z = 0.021; }},
         {"parts/fluid/cells is (1, 1, 4) in the file and (1, 1, 5) in the scene",
          [](F& s) { s.grid.cells[2] = 5; }},
         {"parts/fluid/host/density", [](F& s) { s.ofHost.density = 1.2; }},
         {"parts/fluid/host/viscosity", [](F& s) { s.ofHost.viscosity = 1.1e-3; }},
         {"parts/fluid/host/superficialSpeed", [](F& s) { s.speed = [](double) { return 0.01; }; }},
         {"parts/fluid/host/superficialSpeed",
          [](F& s) { s.speed = [](double time) { return 0.02 + time; }; }}});
    // A law of the driver's own that has changed under its name.
    for (const double reynolds : reynoldsOfComparison) {
        ChangedLaw::at = reynolds;
        for (const std::string& sentence :
             expectRefusals<F>(make, {{fmt::format("parts/fluid/resistanceAtRe{:g} is (", reynolds),
                                       [](F& s) { s.law.resistance = ChangedLaw::resistance; }}}))
            sentences.push_back(sentence);
    }
    expectAllHaveRows(make({}), {"fluid"}, sentences);
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
    const auto sentences = expectRefusals<H>(
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
    // There is one material for each species, which are compared before; a run changes settings in its hooks.
    expectAllHaveRows(make({}), {"heat"}, sentences, {"heat/materials", "heat/settingsChanged"});
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
    const auto sentences = expectRefusals<B>(
        make, {{"parts/bonds/material0/radius", [](B& s) { s.radius = 5e-4; }},
               {"parts/bonds/material0/tensileStrength", [](B& s) { s.strength.tensile = 2e8; }},
               {"parts/bonds/material0/shearStrength", [](B& s) { s.strength.shear = 2e8; }},
               {"parts/bonds/material0/momentShare", [](B& s) { s.strength.momentShare = 0.5; }},
               {"parts/bonds/material0/strengthAtEnds", [](B& s) { s.strength.atEnds = false; }},
               {"parts/bonds/material0/damping", [](B& s) { s.damping = 0.2; }},
               {"parts/bonds/stiffness", [](B& s) { s.modulus = 3e6; }},
               {"parts/bonds/materials", [](B& s) { s.hasAnother = true; }}});
    expectAllHaveRows(make({}), {"bonds"}, sentences);
}

struct CopySettings {
    double lowest = 0, highest = 0.02, rate = 0, ofVelocity = 0, gap = 0;  // m, m, m/s, m/s, m
    Vec3D normal{1, 0, 0}, wedge{1, 0, 0}, other{0, 1, 0};
    double apex = 0;  // m
    bool isTwice = false, isMaser = false;
};

TEST(SetUpOfParts, copiesOfGrains) {
    const auto make = [](const CopySettings& s) {
        auto scene = std::make_unique<FewGrains>();
        auto& copies = scene->addPart<GrainCopies>();
        if (s.isMaser) copies.addMaser(s.normal, s.lowest, s.highest, Vec3D::Zero(), s.gap);
        else
            copies.addPeriod(
                s.normal, s.lowest, s.highest,
                [rate = s.rate](double time) { return Vec3D(0, rate * time, 0); },
                [rate = s.ofVelocity](double) { return Vec3D(0, rate, 0); });
        if (s.isTwice) copies.addPeriod({0, 0, 1}, -0.01, 0.03);
        return scene;
    };
    const auto makeWedge = [](const CopySettings& s) {
        auto scene = std::make_unique<FewGrains>();
        scene->addPart<GrainCopies>().addTurn(s.wedge, s.other, {s.apex, -0.1, 0});
        return scene;
    };
    using C = CopySettings;
    const auto sentences = expectRefusals<C>(
        make, {{"parts/copies of grains/faces0/lowerNormal",
                [](C& s) {
                    s.normal = {0.8, 0, 0.6};
                }},
               {"parts/copies of grains/faces0/lowerPoint", [](C& s) { s.lowest = -0.001; }},
               {"parts/copies of grains/faces0/higherPoint", [](C& s) { s.highest = 0.021; }},
               {"parts/copies of grains/faces0/shift", [](C& s) { s.rate = s.ofVelocity = 0.2; }},
               {"parts/copies of grains/faces0/velocity", [](C& s) { s.ofVelocity = 0.2; }},
               {"parts/copies of grains/faces0/kind", [](C& s) { s.isMaser = true; }},
               {"parts/copies of grains/faces0/gap", [](C& s) { s.isMaser = true, s.gap = 0.004; }},
               {"parts/copies of grains/count", [](C& s) { s.isTwice = true; }}});
    // Of parallel faces; the angle is between the faces.
    expectAllHaveRows(make({}), {"copies of grains"}, sentences,
                      {"copies of grains/faces0/higherNormal", "copies of grains/faces0/angle"});
    expectRefusals<C>(makeWedge,
                      {{"parts/copies of grains/faces0/lowerNormal",
                        [](C& s) {
                            s.wedge = {std::sqrt(0.75), -0.5, 0};  // a third of a turn
                        }},
                       {"parts/copies of grains/faces0/higherNormal",
                        [](C& s) {
                            s.other = {-0.5, std::sqrt(0.75), 0};
                        }},
                       {"parts/copies of grains/faces0/lowerPoint", [](C& s) { s.apex = -0.001; }}});
}

struct BoundarySettings {
    Vec3D planeNormal{1, 0, 0}, outletNormal{0, 0, 1};
    double planePoint = 0.01, outletPoint = 0.03, age = 0;  // m, m, s
    std::vector<double> classes{1.5e-3};                    // m
    bool hasCondition = false, isTwice = false, hasTwoPlanes = false;
};

TEST(SetUpOfParts, outletsAndFluxPlanes) {
    const auto make = [](const BoundarySettings& s) {
        auto scene = std::make_unique<FewGrains>();
        scene->fluxPlaneHandler.copyAndAddObject({s.planeNormal, {s.planePoint, 0, 0}});
        if (s.hasTwoPlanes) scene->fluxPlaneHandler.copyAndAddObject({s.planeNormal, {s.planePoint, 0, 0}});
        Outlet outlet;
        outlet.setPlane(s.outletNormal, {0, 0, s.outletPoint});
        outlet.setLeastAge(s.age), outlet.setSizeClasses(s.classes);
        if (s.hasCondition) outlet.setCondition([](const GrainReference&) { return true; });
        scene->outletHandler.copyAndAddObject(outlet);
        if (s.isTwice) scene->outletHandler.copyAndAddObject(outlet);
        return scene;
    };
    using B = BoundarySettings;
    const auto sentences = expectRefusals<B>(
        make, {{"parts/fluxPlanes/0/normal is (1, 0, 0) in the file and (-1, 0, 0) in the scene",
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
               {"parts/fluxPlanes/count", [](B& s) { s.hasTwoPlanes = true; }},
               {"parts/outlets/count", [](B& s) { s.isTwice = true; }}});
    expectAllHaveRows(make({}), {"fluxPlanes", "outlets"}, sentences);
}

struct RegionSettings {
    Vec3D lowest{0, 0, 0.03}, highest{0.01, 0.01, 0.04};  // m
    bool isBall = false;
};

TEST(SetUpOfParts, regionsOfOutlets) {
    const auto make = [](const RegionSettings& s) {
        auto scene = std::make_unique<FewGrains>();
        Outlet outlet;
        if (s.isBall) outlet.setRegion(SphereRegion({0, 0, 0.04}, 0.01));
        else outlet.setRegion(BoxRegion(s.lowest, s.highest));
        scene->outletHandler.copyAndAddObject(outlet);
        return scene;
    };
    using R = RegionSettings;
    expectRefusals<R>(make, {{"parts/outlets/0/region/shape", [](R& s) { s.isBall = true; }},
                             {"parts/outlets/0/region/lowest", [](R& s) { s.lowest.z() = 0.031; }},
                             {"parts/outlets/0/region/highest", [](R& s) { s.highest.z() = 0.041; }}});
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
           start = 0, angle = 0.3, edge1 = 0.010, edge2 = 0.010, film = 1e-13;
    std::size_t interval = 100;
    std::uint64_t seed = 1;
    bool isCone = false, isTwice = false;
};
using Moving = Species<HertzianViscoelastic, Mindlin, LiquidMigration<LiquidBridgeBagheri>>;

TEST(SetUpOfParts, liquid) {
    const auto make = [](const LiquidSettings& s) {
        auto scene = std::make_unique<wet::WetBox<Moving>>(1);
        scene->setLiquidDensity(s.density);
        scene->setLiquidToCome(1e-9);
        Spray spray;
        if (s.isCone) spray.setCone({0.006, 0.006, s.height}, {s.towards, 0, -1}, s.angle);
        else spray.setRain({0.006, 0.006, s.height}, {s.edge1, 0, 0}, {0, s.edge2, 0}, {s.towards, 0, -1});
        spray.setDropletRadius(s.radius), spray.setVolumeSpread(s.spread), spray.setSpeed(s.speed);
        spray.setFlow(s.drops * 5e-13), spray.setMomentum(s.momentum), spray.setLongestFlight(s.flight);
        spray.setTimes(s.first, s.last), spray.setSeed(s.seed);
        scene->sprayHandler.copyAndAddObject(spray);
        if (s.isTwice) scene->sprayHandler.copyAndAddObject(spray);
        SphericalParticle grain;
        grain.setSpecies(scene->speciesHandler.getObject(0)), grain.setLiquidVolume(s.film);
        Inlet inlet;
        inlet.setGrain(grain), inlet.setSizes(evenSizes(1e-3, 1.2e-3)), inlet.setNumberFlow(1000);
        inlet.setRegion(BoxRegion({0.002, 0.002, 0.004}, {0.010, 0.010, 0.006}));
        scene->inletHandler.copyAndAddObject(inlet);
        Evaporation drying;
        drying.setMassTransfer(s.transfer, 0.02, 1000, s.humidity);
        drying.setInterval(s.interval), drying.setStartTime(s.start);
        scene->setEvaporation(drying);
        scene->setTimeMax(1e-3);
        return scene;
    };
    using L = LiquidSettings;
    auto sentences = expectRefusals<L>(
        make, {{"parts/filmMass/density is 1000 kg/m^3 in the file and 900 kg/m^3 in the scene",
                [](L& s) { s.density = 900; }},
               {"parts/sprays/count", [](L& s) { s.isTwice = true; }},
               {"parts/sprays/0/shape", [](L& s) { s.isCone = true; }},
               {"parts/sprays/0/edge1", [](L& s) { s.edge1 = 0.009; }},
               {"parts/sprays/0/edge2", [](L& s) { s.edge2 = 0.009; }},
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
               {"parts/inlets/0/kind0/film", [](L& s) { s.film = 2e-13; }},
               {"contacts/liquid/evaporation/fastest", [](L& s) { s.transfer = 0.02; }},
               {"contacts/liquid/evaporation/humidity", [](L& s) { s.humidity = 0.3; }},
               {"contacts/liquid/evaporation/start", [](L& s) { s.start = 0.1; }},
               {"contacts/liquid/evaporation/interval", [](L& s) { s.interval = 50; }}});
    const auto makeCone = [&](LiquidSettings s) {
        s.isCone = true;
        return make(s);
    };
    for (const std::string& sentence :
         expectRefusals<L>(makeCone, {{"parts/sprays/0/angle", [](L& s) { s.angle = 0.2; }}}))
        sentences.push_back(sentence);
    expectAllHaveRows(make({}), {"filmMass", "sprays"}, sentences);
}

struct MercurySettings {
    double flow = 1e-4, atOnce = 0, radius = 0.004, share = 0.5;  // m^3/s, m^3, m, of the first of two sorts
    Vec3D lowest{0, 0, 0}, highest{.1, .1, .1};                   // m
    Vec3D slowest{0, 0, -1}, fastest{0, 0, -0.5};                 // m/s
    double fluxAt = 0.05, path = 1;                               // m, m/s
    unsigned tries = 100;
    bool isTwice = false, hasTwoSorts = false, hasTwoPaths = false, isPlace = false;
};

struct SceneOfMercury : MercuryScene<S> {
    explicit SceneOfMercury(const MercurySettings& s) {
        setDomain(Vec3D(0, 0, 0), Vec3D(.1, .1, .1));
        S species;
        species.setDensity(2000), species.setStiffness(1000);
        addInsertions(s, speciesHandler.copyAndAddObject(species));
        FluxBoundary plane;
        plane.set({0, 0, 1}, 0);
        boundaryHandler.copyAndAddObject(plane)->setPrescribedDistance(
            [at = s.fluxAt](double) { return at; });
        for (int k = 0; k < 2; ++k) addPath(s, k);
        setTimeStep(1e-5);
        setTimeMax(1);
        setQuiet();
    }

private:
    void addInsertions(const MercurySettings& s, const S* species) {
        SphericalParticle grain(species);
        grain.setRadius(s.radius);
        CubeInsertionBoundary box;
        if (s.hasTwoSorts) {
            PSD sizes;
            sizes.setDistributionUniform(s.radius, 1.1 * s.radius, 10);
            box.set(std::vector{&grain, &grain}, s.tries, s.lowest, s.highest, s.slowest, s.fastest);
            box.setPSD(std::vector{sizes, sizes}, {s.share, 1 - s.share});
        } else {
            box.set(grain, s.tries, s.lowest, s.highest, s.slowest, s.fastest);
        }
        box.setInitialVolume(s.atOnce), box.setVolumeFlowRate(s.flow);
        for (int k = 0; k < (s.isTwice ? 2 : 1); ++k) boundaryHandler.copyAndAddObject(box);
    }
    void addPath(const MercurySettings& s, int k) {
        SphericalParticle grain(speciesHandler.getObject(0));
        grain.setRadius(0.002), grain.setPosition({0.05, 0.05, 0.2 + 0.1 * k}), grain.fixParticle();
        const auto added = particleHandler.copyAndAddObject(grain);
        if (k > 0 && !s.hasTwoPaths) return;
        if (s.isPlace)
            setPrescribedPosition(
                added, [speed = s.path](double time) { return Vec3D(0.05 + speed * time, 0.05, 0.2); });
        else setPrescribedVelocity(added, [speed = s.path](double) { return Vec3D(speed, 0, 0); });
    }
};

TEST(SetUpOfParts, partsOfMercury) {
    const auto make = [](const MercurySettings& s) { return std::make_unique<SceneOfMercury>(s); };
    const auto makeTwoSorts = [&](MercurySettings s) {
        s.hasTwoSorts = true;
        return make(s);
    };
    const auto makePlace = [&](MercurySettings s) {
        s.isPlace = true;
        return make(s);
    };
    using M = MercurySettings;
    auto sentences = expectRefusals<M>(
        make,
        {{"parts/insertion boundaries/count", [](M& s) { s.isTwice = true; }},
         {"parts/insertion boundaries/source 0/volumeFlow", [](M& s) { s.flow = 2e-4; }},
         {"parts/insertion boundaries/source 0/maxFailed", [](M& s) { s.tries = 101; }},
         {"parts/insertion boundaries/source 0/sorts", [](M& s) { s.hasTwoSorts = true; }},
         {"parts/insertion boundaries/source 0/sort 0/smallest", [](M& s) { s.radius = 0.005; }},
         {"parts/insertion boundaries/source 0/lowest", [](M& s) { s.lowest.z() = 0.01; }},
         {"parts/insertion boundaries/source 0/highest", [](M& s) { s.highest.z() = 0.09; }},
         {"parts/insertion boundaries/source 0/lowestVelocity", [](M& s) { s.slowest.z() = -1.1; }},
         {"parts/insertion boundaries/source 0/highestVelocity", [](M& s) { s.fastest.z() = -0.4; }},
         {"parts/boundaries that act in steps/boundary 0/prescribedDistance", [](M& s) { s.fluxAt = 0.06; }},
         {"parts/prescribed paths/count", [](M& s) { s.hasTwoPaths = true; }},
         {"parts/prescribed paths/velocityOfGrain0", [](M& s) { s.path = 2; }}});
    for (const std::string& sentence : expectRefusals<M>(
             makeTwoSorts,
             {{"parts/insertion boundaries/source 0/sort 0/share", [](M& s) { s.share = 0.4; }},
              {"parts/insertion boundaries/source 0/volumeAtOnce", [](M& s) { s.atOnce = 1e-9; }}}))
        sentences.push_back(sentence);
    // A region that is no box has another box around it; flux planes are those of the kernel, too.
    std::set<std::string> others{"insertion boundaries/source 0/hasOwnPlaces",
                                 "boundaries that act in steps/count",
                                 "boundaries that act in steps/boundary 0/normal"};
    // SetUpOfInletsTest.cpp has what else there is of a sort of grains.
    for (const std::string name : {"kind", "species", "velocity", "spin", "film", "orientation", "largest",
                                   "meanDiameter", "meanSquare", "meanVolume", "held"})
        others.insert("insertion boundaries/source 0/sort 0/" + name);
    expectAllHaveRows(make({}), {"insertion boundaries", "boundaries that act in steps", "prescribed paths"},
                      sentences, others);
    expectRefusals<M>(makePlace, {{"parts/prescribed paths/placeOfGrain0", [](M& s) { s.path = 2; }}});
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
    "FluidPart",     "HeatPart",     "BondPart",        "GrainCopies",       "FluxPlanePart",
    "OutletPart",    "InletPart",    "FlowPart",        "AdaptivePart",      "AccountPart",
    "SprayPart",     "FilmMassPart", "LiquidPart",      "MercuryInsertions", "MercuryActions",
    "MercuryPaths",  "DrivePart",    "MembranePart",       // SetUpOfWallsTest.cpp
    "GrainPart",     "BodyPart",                           // no settings: bodies are part of the state
    "MercuryForces", "MercuryBonds", "MercuryHistories"};  // a function of the driver; what is asked for,
                                                           // read

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
