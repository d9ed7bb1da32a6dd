// Species types of a library that is loaded at run time are chosen by name, as those of the kernel.
#include <gtest/gtest.h>

#include <cmath>

#include "BuildFolders.h"
#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::speciesLibraryTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

const std::filesystem::path library = folders::binary / "SelfTests/libQuadraticSpring.so";

/// Loaded once in a program.
void load() {
    if (registeredSpecies().empty()) loadSpeciesLibrary(library);
}

/// Two equal grains meet at speed v: 1/2 m* v^2 = c d^3 / 3 at the largest overlap d, and they part as fast.
TEST(SpeciesLibrary, givesLawsToTheProgram) {
    load();
    constexpr double r = 1e-3, density = 2000, speed = 0.5, c = 5e6;
    for (const auto* name : {"QuadraticSpringSpecies", "QuadraticSpringMindlinSpecies"}) {
        Simulation<> scene;
        AnySpecies* const species = scene.speciesHandler.addByName(name);
        species->set("density", density);
        species->set("forceAtOverlap", {c * 1e-8, 1e-4});
        EXPECT_NEAR(species->get("coefficient"), c, 1e-9 * c);
        if (species->has("slidingFrictionCoefficient")) {
            species->set("effectiveShearModulus", 1e6);
            species->set("slidingDissipation", 0);
            species->set("slidingFrictionCoefficient", 0.5);
        }
        for (const double side : {-1, 1}) {
            SphericalParticle grain;
            grain.setSpecies(species);
            grain.setRadius(r);
            grain.setPosition({side * 1.001 * r, 0, 0});
            grain.setVelocity({-0.5 * side * speed, 0, 0});
            scene.particleHandler.copyAndAddObject(grain);
        }
        scene.setTimeStep(1e-6);
        scene.setQuiet();
        const double mass = scene.particleHandler.getObject(0).getMass();
        double deepest = 0;
        for (int k = 0; k < 2000; ++k) {
            scene.runSteps(1);
            const Vec3D gap = scene.particleHandler.getObject(1).getPosition() -
                              scene.particleHandler.getObject(0).getPosition();
            deepest = std::max(deepest, 2 * r - gap.x());
        }
        scene.finishRun();
        const double expected = std::cbrt(3 * 0.5 * mass * speed * speed / (2 * c));
        EXPECT_NEAR(deepest, expected, 1e-4 * expected);
        EXPECT_NEAR(scene.particleHandler.getObject(1).getVelocity().x(), 0.5 * speed, 1e-4 * speed);
    }
}

/// A pair of a species of the library and one of the kernel, with the laws of the library.
TEST(SpeciesLibrary, givesLawsToAPair) {
    load();
    Simulation<> scene;
    for (const auto* name : {"QuadraticSpringSpecies", "LinearViscoelasticSpecies"}) {
        AnySpecies* const species = scene.speciesHandler.addByName(name);
        species->set("density", 2000);
        species->set(species->has("stiffness") ? "stiffness" : "coefficient", 100);
    }
    scene.speciesHandler.setPairTypeByName(0, 1, "QuadraticSpringSpecies");
    scene.laws().mixAll();
    EXPECT_EQ(scene.laws().fields(0, 1).front().name, "coefficient");
    EXPECT_EQ(scene.laws().fields(0, 1).front().value, 100);
}

TEST(SpeciesLibrary, thatDoesNotFitIsRefused) {
    load();
    std::vector<std::string_view> names = registeredSpecies();
    names.resize(2);  // another test registers one more
    EXPECT_EQ(names,
              (std::vector<std::string_view>{"QuadraticSpringSpecies", "QuadraticSpringMindlinSpecies"}));
    const auto expect = [](const std::string& text, std::string_view words) {
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, words));
    };
    expect(refusal([] { loadSpeciesLibrary("no-such-library.so"); }),
           "The library of species no-such-library.so cannot be loaded");
    expect(refusal([] { loadSpeciesLibrary(library); }), "registers no species type, or was loaded before");
    expect(refusal([] { registerSpecies<Species<LinearViscoelastic>>(); }),
           "There is a species type LinearViscoelasticSpecies already");
    KernelLayout other = layoutOfThisFile();
    ++other.sizes[2];
    expect(refusal([&] { registerSpeciesType(speciesType<Species<HertzianBSHPViscoelastic>>(), other); }),
           "HertzianBSHPViscoelasticSpecies was compiled for another version of Pendular");
    Simulation<> scene;
    expect(refusal([&] { scene.speciesHandler.addByName("QuadraticSpringMindlin2Species"); }),
           "the nearest names are QuadraticSpringMindlinSpecies");
}

/// A type of the program itself is registered without a library.
TEST(SpeciesType, isRegisteredByACall) {
    load();
    using Type = Species<HertzianBSHPViscoelastic>;
    registerSpecies<Type>();
    Simulation<> scene;
    AnySpecies* const species = scene.speciesHandler.addByName(Type::name);
    EXPECT_EQ(species->getName(), Type::name);
    EXPECT_NE(species->find<HertzianBSHPViscoelastic>(), nullptr);
}

}  // namespace
}  // namespace pendular::speciesLibraryTest
