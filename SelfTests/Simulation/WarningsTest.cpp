// Warnings reach their reader by default, once each, in drivers of any kind; likely slips of units are told
// with the number, and a scene that is right is silent.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/RunSummary.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::warningsTest {
namespace {

using support::contains;
using support::contentOf;
using support::TestFolder;
using Rough = Species<HertzianViscoelastic, Mindlin>;
template <class Bridge>
using Wet = Species<HertzianViscoelastic, NoFriction, Bridge>;

std::size_t countOf(const std::string& text, std::string_view part) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++count;
    return count;
}

template <class Action>
std::string printedBy(Action&& action) {
    testing::internal::CaptureStderr();
    try {
        action();
    } catch (const std::exception&) {}
    return testing::internal::GetCapturedStderr();
}

/// Grains that meet at 1 to 2 m/s: SummaryTest finds more than a hundred evaluations with overlaps above 0.1
/// of the effective radius.
struct Fast : scenes::SettlingBox<Rough> {
    Fast() : SettlingBox(3) { setTimeMax(2000 * 0x1p-17); }
};
constexpr std::string_view ofOverlaps = "Warning: HertzianViscoelastic: overlaps were above 0.1 of the";

TEST(Warnings, ofOverlapsComeOnceInAnyDriver) {
    Fast whole, parts, steps, quiet;
    EXPECT_EQ(countOf(printedBy([&] { whole.solve(); }), ofOverlaps), 1u);
    EXPECT_EQ(countOf(printedBy([&] {
                          for (int k = 1; k <= 4; ++k) parts.runSteps(500);
                      }),
                      ofOverlaps),
              1u);
    EXPECT_EQ(countOf(printedBy([&] {
                          steps.initialise();
                          steps.step(2000);
                          steps.completeAll();
                      }),
                      ofOverlaps),
              1u);
    quiet.setQuiet();
    EXPECT_EQ(printedBy([&] { quiet.solve(); }), "");
}

TEST(Warnings, ofOverlapsComeOnceWithASummaryToo) {
    const TestFolder folder;
    for (const bool isPrinted : {true, false}) {
        Fast scene;
        scene.setName(folder.name());
        scene.addOutput(isPrinted ? RunSummary() : RunSummary().withoutPrinting());
        EXPECT_EQ(countOf(printedBy([&] { scene.solve(); }), ofOverlaps), 1u) << isPrinted;
        EXPECT_EQ(countOf(contentOf(folder.name() + "-summary.csv"), ofOverlaps.substr(9)), 1u);
    }
}

/// A program that goes no further, and ends later, as one of Python may, was told all the same.
TEST(Warnings, ofOverlapsDoNotWaitForTheSummaryOfARunInParts) {
    const TestFolder folder;
    Fast scene;
    scene.setName(folder.name());
    scene.addOutput(RunSummary());
    EXPECT_EQ(countOf(printedBy([&] { scene.runSteps(1500); }), ofOverlaps), 1u);
    EXPECT_FALSE(scene.hasEnded());
}

/// A summary has what a quiet run did not show, in rows of one line: of the kernel and of the driver.
TEST(Warnings, areInTheSummaryOfAQuietRun) {
    const TestFolder folder;
    Fast scene;
    scene.setName(folder.name());
    scene.addOutput(EnergyFile(1e-3));
    scene.keepEnergyLedger();
    scene.setQuiet();
    for (int k = 0; k < 2; ++k) scene.logger(LogLevel::Warn, "the \"feed\",\nis {}.", "empty");
    EXPECT_EQ(printedBy([&] { scene.solve(); }), "");
    const std::string text = contentOf(folder.name() + "-summary.csv");
    EXPECT_EQ(countOf(text, "\nwarning,\"the 'feed', is empty\",\n"), 1u) << text;
    EXPECT_EQ(countOf(text, "\nwarning,HertzianViscoelastic: overlaps were above 0.1"), 1u) << text;
}

// ---- Likely slips

struct Values {
    double density = 2500, modulus = 5e6, tension = 0.07;
    double volume = 0.01;  // V*
    double radius = 1e-3;  // m
    double mesh = 0;       // m, its length; 0: none
};

/// Below the grains, and apart from them.
TriangleWall squareOf(double length, double radius) {
    const double h = 0.5 * length, z = -2 * radius - 0.01 * length;
    const std::vector<Triangle> halves{{{{-h, -h, z}, {h, -h, z}, {h, h, z}}},
                                       {{{-h, -h, z}, {h, h, z}, {-h, h, z}}}};
    TriangleWall wall;
    wall.set(halves);
    return wall;
}

/// What a scene of two grains that are apart prints at set-up.
template <class Bridge>
std::string toldOf(const Values& values) {
    Simulation<Wet<Bridge>> scene;
    Wet<Bridge> species;
    species.setDensity(values.density);
    species.setEffectiveElasticModulus(values.modulus), species.setDissipation(0.2);
    species.setSurfaceTension(values.tension), species.setContactAngle(0);
    species.setLiquidBridgeVolume(values.volume * std::pow(values.radius, 3));
    auto* const own = scene.speciesHandler.copyAndAddObject(species);
    for (const double place : {0.0, 4.0}) {
        SphericalParticle grain(own);
        grain.setRadius(values.radius);
        grain.setPosition({place * values.radius, 0, 0});
        scene.particleHandler.copyAndAddObject(grain);
    }
    if (values.mesh > 0) {
        TriangleWall wall = squareOf(values.mesh, values.radius);
        wall.setSpecies(own);
        scene.wallHandler.copyAndAddObject(wall);
    }
    scene.setTimeStep(0.1 * scene.stabilityLimit());
    testing::internal::CaptureStderr();
    const std::string refused = support::refusal([&] { scene.initialise(); });
    return testing::internal::GetCapturedStderr() + refused;
}

TEST(LikelySlips, areToldWithTheNumber) {
    const auto told = [](const Values& values, const std::vector<std::string>& parts) {
        const std::string text = toldOf<LiquidBridgeBagheri>(values);
        EXPECT_EQ(countOf(text, "Warning: "), 1u) << text;
        for (const std::string& part : parts) EXPECT_TRUE(contains(text, part));
    };
    told({.density = 2.5}, {"species 0: density = 2.5 kg/m^3", "1 g/cm^3 is 1000 kg/m^3"});
    told({.density = 7.85}, {"density = 7.85 kg/m^3", "g/cm^3"});
    told({.density = 2.5e-9}, {"density = 2.5e-09 kg/m^3", "1 t/mm^3 is 1e12 kg/m^3"});
    told({.modulus = 70}, {"effectiveElasticModulus = 70 Pa", "1 GPa is 1e9 Pa"});
    told({.tension = 72}, {"surfaceTension = 72 N/m", "1 mN/m is 0.001 N/m"});
    told({.volume = 12}, {"V* = V/R^3 = 12 ", "1 mm^3 (1 ul) is 1e-9 m^3"});
    told({.mesh = 80}, {"wall 0, a mesh: it is 80 m long, 4e+04 times", "scale of 0.001"});
    told({.mesh = 5e-5}, {"wall 0, a mesh: it is 5e-05 m long, 0.05 of the radius"});
}

/// The warning has the law's own words, too, where it is made for smaller bridges.
TEST(LikelySlips, ofBridgesAreToldWhateverTheLaw) {
    EXPECT_TRUE(contains(toldOf<LiquidBridgeWillett>({.volume = 12}), "V* = V/R^3 = 12 "));
    EXPECT_FALSE(contains(toldOf<LiquidBridgeWillett>({.volume = 9}), "V* = V/R^3"));
}

/// What is right, though it is unusual: the heaviest and lightest grains, hydrogel, mercury, a wide vessel,
/// scenes without units, and areas for densities.
TEST(LikelySlips, areNotSeenWhereTheSceneIsRight) {
    for (const Values& right :
         {Values{}, Values{.density = 22600}, Values{.density = 15}, Values{.modulus = 1e4},
          Values{.modulus = 6e10}, Values{.tension = 0.486}, Values{.volume = 0.4}, Values{.mesh = 0.5},
          Values{.mesh = 1.9}, Values{.mesh = 1e-3},
          Values{.density = 1, .modulus = 100, .tension = 5, .radius = 0.5}})
        EXPECT_EQ(toldOf<LiquidBridgeBagheri>(right), "");
}

/// Grains that a hook adds, or that are added between two parts; once, though more come, which are larger.
TEST(LikelySlips, areToldOfWhatComesInTheRun) {
    Simulation<Rough> scene;
    Rough species = scenes::boxMaterial<Rough>(0);
    auto* const glass = scene.speciesHandler.copyAndAddObject(species);
    species.setDensity(2.5);
    auto* const other = scene.speciesHandler.copyAndAddObject(species);
    const auto add = [&](const Rough* own, double radius, double x) {
        SphericalParticle grain(own);
        grain.setRadius(radius);
        grain.setPosition({x, 0, 0});
        scene.particleHandler.copyAndAddObject(grain);
    };
    const auto told = [&] { return printedBy([&] { scene.runSteps(2); }); };
    add(glass, 1e-3, 0);
    scene.setTimeStep(1e-8);
    EXPECT_EQ(told(), "");
    add(other, 1e-3, 0.01);
    const std::string first = told();
    EXPECT_EQ(countOf(first, "Warning: "), 1u) << first;
    EXPECT_TRUE(contains(first, "species 1: density = 2.5 kg/m^3")) << first;
    add(other, 2e-3, 0.02);
    EXPECT_EQ(told(), "");
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 6u);
}

TEST(LikelySlips, densitiesOfDiscsAreByArea) {
    Simulation<Rough> scene;
    scene.speciesHandler.setGrainsAreDiscs();
    Rough species = scenes::boxMaterial<Rough>(0);
    species.setDensity(2.5);  // kg/m^2
    SphericalParticle grain(scene.speciesHandler.copyAndAddObject(species));
    grain.setRadius(1e-3);
    scene.particleHandler.copyAndAddObject(grain);
    scene.particleHandler.holdAll(HeldAxes::inPlane());
    scene.setIntegrator(integrators::velocityVerlet);
    scene.setTimeStep(1e-7);
    testing::internal::CaptureStderr();
    EXPECT_EQ(support::refusal([&] { scene.initialise(); }), "");
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(contains(told, "Grains are discs"));
    EXPECT_FALSE(contains(told, "Warning"));
}

// ---- Files of another program

/// The name of this program while it lives.
struct Named {
    explicit Named(const std::string& name) { setProgramName(name); }
    Named(const Named&) = delete;
    Named& operator=(const Named&) = delete;
    ~Named() { setProgramName({}); }
};

struct Kept : scenes::SettlingBox<Rough> {
    explicit Kept(const TestFolder& folder) : SettlingBox(1) {
        setName(folder.name());
        setTimeMax(20 * 0x1p-17);
        keepRestartFile();
    }
};

/// What a program of this name prints that runs there.
std::string printedBy(const std::string& program, const TestFolder& folder) {
    const Named named(program);
    return printedBy([&] { Kept(folder).solve(); });
}

class OtherProgram : public testing::Test {
protected:
    void SetUp() override {
        if (!Hdf5File::isAvailable())
            GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    }
    const TestFolder folder;
};

TEST_F(OtherProgram, doesNotLoseItsRestartFileInSilence) {
    const auto of = [&](const std::string& program) { return printedBy(program, folder); };
    EXPECT_EQ(of("Drum"), "");
    EXPECT_EQ(of("Drum"), "") << "its own files";
    const std::string first = contentOf(folder.name() + "-restart.h5");
    const std::string told = of("Hopper");
    EXPECT_EQ(countOf(told, "Warning: "), 1u) << told;
    for (const char* part : {"of another program, Drum, and Hopper now", "run-restart-of-Drum.h5"})
        EXPECT_TRUE(contains(told, part));
    EXPECT_TRUE(contentOf(folder.name() + "-restart-of-Drum.h5") == first);
    EXPECT_TRUE(contains(contentOf(folder.name() + "-summary.csv"), "of another program"));
    EXPECT_EQ(of("Hopper"), "");
}

TEST_F(OtherProgram, doesNotLoseItToARunFromAnotherFile) {
    EXPECT_EQ(printedBy("Drum", folder), "");
    const std::string state = folder.name() + "-restart.h5", other = (folder.path() / "settled.h5").string();
    std::filesystem::copy_file(state, other);
    const std::string first = contentOf(state);
    const Named hopper("Hopper");
    Kept scene(folder);
    scene.restartFrom(other);
    EXPECT_TRUE(contains(printedBy([&] { scene.solve(); }), "run-restart-of-Drum.h5"));
    EXPECT_TRUE(contentOf(folder.name() + "-restart-of-Drum.h5") == first);
}

TEST_F(OtherProgram, isToldByADriverThatStepsByItself) {
    EXPECT_EQ(printedBy("Drum", folder), "");
    const Named hopper("Hopper");
    Kept scene(folder);
    const std::string told = printedBy([&] {
        scene.initialise();
        scene.step(3);
    });
    EXPECT_EQ(countOf(told, "Warning: "), 1u) << told;
    EXPECT_TRUE(contains(told, "of another program, Drum, and Hopper now")) << told;
}

/// A summary may say anything of its program.
TEST_F(OtherProgram, keepsItsFileInTheFolder) {
    std::ofstream(folder.name() + "-summary.csv") << "quantity,value,unit\nprogram,../../other,\n";
    std::ofstream(folder.name() + "-restart.h5") << "its state";
    EXPECT_TRUE(contains(printedBy("Hopper", folder), "of another program, ../../other, and Hopper now"));
    EXPECT_EQ(contentOf(folder.name() + "-restart-of-..-..-other.h5"), "its state");
}

}  // namespace
}  // namespace pendular::warningsTest
