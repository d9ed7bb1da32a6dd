// Species that are chosen by name at run time, and what is refused of scenes of several types.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Features/Laws.h"
#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::namedSpeciesTest {
namespace {

using scenes::boxMaterial;
using support::contains;
using support::isOneSentence;
using support::refusal;

using Linear = LinearViscoelasticSpecies;
using Hertz = HertzianViscoelasticSpecies;
using Wet = HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies;

void expectSentence(const std::string& text, const std::vector<std::string>& words) {
    EXPECT_TRUE(isOneSentence(text));
    for (const std::string& word : words) EXPECT_TRUE(contains(text, word));
}

/// Sixteen grains of two species that fall onto a plane.
template <class Scene, class First, class Second>
std::uint64_t hashOfFall(Scene& scene, const First* first, const Second* second) {
    for (int k = 0; k < 16; ++k) {
        SphericalParticle grain;
        if (k % 2 == 0) grain.setSpecies(first);
        else grain.setSpecies(second);
        grain.setRadius(1e-3);
        grain.setPosition(
            {2.1e-3 * (k % 4), 2.1e-3 * (k / 4 % 2), 1.1e-3 + 2.1e-3 * (k / 8) + 1e-4 * (k % 3)});
        grain.setVelocity({k % 2 == 0 ? 0.3 : -0.3, 0, -0.5});
        scene.particleHandler.copyAndAddObject(grain);
    }
    InfiniteWall wall;
    wall.set({0, 0, -1}, {0, 0, 0});
    wall.setSpecies(first);
    scene.wallHandler.copyAndAddObject(wall);
    scene.setGravity({0, 0, -9.81});
    scene.setTimeStep(5e-6);
    scene.initialise();
    for (int k = 0; k < 2000; ++k) scene.step();
    return stateHash(scene.particleHandler.store());
}

/// All fields that are set, by their names.
void copyFields(AnyLaws& to, AnyLaws& from) {
    for (const NamedField& field : from.fields())
        if (isSet(*field.value)) to.set(field.name, *field.value);
}
template <class S>
AnySpecies* addNamed(Simulation<>& scene, const S& species) {
    AnySpecies* const added = scene.speciesHandler.addByName(S::name);
    SpeciesInScene<S> source(species, 0, nullptr);
    added->set("density", species.getDensity());
    copyFields(*added, source);
    return added;
}

template <class A, class B>
void expectSameByName() {
    const A a = boxMaterial<A>(0);
    const B b = boxMaterial<B>(1);
    Simulation<A, B> typed;
    const auto* first = typed.speciesHandler.copyAndAddObject(a);
    const auto* second = typed.speciesHandler.copyAndAddObject(b);
    typed.speciesHandler.template setPairType<B>(first, second);
    Simulation<> named;
    AnySpecies *const one = addNamed(named, a), *const two = addNamed(named, b);
    named.speciesHandler.setPairTypeByName(0, 1, B::name);
    EXPECT_EQ(hashOfFall(named, one, two), hashOfFall(typed, first, second));
}

TEST(NamedSpecies, giveTheBitsOfTheirTypes) {
    expectSameByName<Linear, Hertz>();
    expectSameByName<Hertz, Wet>();

    Simulation<Wet> typed;
    const Wet* const species = typed.speciesHandler.copyAndAddObject(boxMaterial<Wet>(0));
    Simulation<> named;
    AnySpecies* const same = addNamed(named, boxMaterial<Wet>(0));
    EXPECT_EQ(same->get("density"), 2500);
    EXPECT_EQ(same->get("liquidBridgeVolume"), 2e-12);
    EXPECT_TRUE(same->has("surfaceTension") && !same->has("stiffness"));
    EXPECT_EQ(hashOfFall(named, same, same), hashOfFall(typed, species, species));
}

TEST(NamedSpecies, pairsHaveTheirOwnValues) {
    Simulation<> scene;
    addNamed(scene, boxMaterial<Linear>(0));
    addNamed(scene, boxMaterial<Hertz>(0));
    AnyLaws* const pair = scene.speciesHandler.setPairTypeByName(1, 0, Linear::name);
    pair->set("stiffness", 77);
    scene.laws().mixAll();
    EXPECT_EQ(scene.laws().fields(0, 1)[0].name, "stiffness");
    EXPECT_EQ(scene.laws().fields(0, 1)[0].value, 77);
    EXPECT_EQ(scene.laws().fields(1, 0)[1].value, boxMaterial<Linear>(0).getDissipation());
}

TEST(NamedSpecies, everyInstantiatedOneCanBeAdded) {
    ASSERT_GE(instantiatedSpecies().size(), 10u);
    Simulation<> scene;
    for (const std::string_view name : instantiatedSpecies())
        EXPECT_EQ(scene.speciesHandler.addByName(name)->getName(), name);
    EXPECT_EQ(scene.speciesHandler.getSize(), instantiatedSpecies().size());
    EXPECT_EQ(scene.speciesHandler.getObject(3)->getIndex(), 3);
}

/// The laws that the page recommends; with the bridges that it recommends, too.
TEST(NamedSpecies, theRecommendedOnesAreInstantiated) {
    Simulation<> scene;
    for (const std::string_view adhesion : {"", "LiquidBridgeBagheri", "LiquidBridgeYoungLaplace"})
        EXPECT_EQ(refusal([&] {
                      scene.speciesHandler.addByName(
                          fmt::format("HertzianViscoelasticMindlinIncremental{}Species", adhesion));
                  }),
                  "");
}

/// A species of the kernel that is not compiled in is not unknown.
TEST(NamedSpecies, whatIsNotCompiledInIsRefusedWithTheWayToGetIt) {
    Simulation<> scene;
    scene.speciesHandler.addByName(Linear::name);
    for (const std::string name : {"HertzianViscoelasticMindlinPartialSlipSpecies",
                                   "HertzianBSHPViscoelasticSlidingFrictionJKRSpecies",
                                   "SinterMindlinIncrementalRollingTorsionDMTSpecies"}) {
        EXPECT_TRUE(isSpeciesOfTheKernel(name));
        const std::vector<std::string> words{name, "is not compiled into this program",
                                             "registerSpecies<Type>()", "loadSpeciesLibrary()"};
        for (const std::string& text : {refusal([&] { scene.speciesHandler.addByName(name); }), refusal([&] {
                                            scene.speciesHandler.setPairTypeByName(0, 0, name);
                                        })}) {
            EXPECT_TRUE(isOneSentence(text));
            for (const std::string_view word : words) EXPECT_TRUE(contains(text, word));
        }
    }
    // As MercuryDPM spells it.
    EXPECT_TRUE(contains(refusal([&] {
                             scene.speciesHandler.addByName(
                                 "LinearPlasticViscoelasticLiquidBridgeWilletSpecies");
                         }),
                         "LinearPlasticViscoelasticLiquidBridgeWillettSpecies is a species of Pendular"));
    for (const std::string_view name :
         {"", "Species", "MindlinSpecies", "HertzianViscoelasticMindlinPartialSlip",
          "HertzianViscoelasticMindlinMindlinSpecies",
          "HertzianViscoelasticLiquidBridgeBagheriMindlinSpecies"})
        EXPECT_FALSE(isSpeciesOfTheKernel(name)) << name;
    for (const std::string_view name : instantiatedSpecies()) EXPECT_TRUE(isSpeciesOfTheKernel(name)) << name;
}

TEST(NamedSpecies, wrongNamesAndValuesAreRefused) {
    Simulation<> scene;
    expectSentence(refusal([&] { scene.speciesHandler.addByName("LinearViscoelasticSpezies"); }),
                   {"instantiated species", "LinearViscoelasticSpezies", "LinearViscoelasticSpecies"});
    AnySpecies* const species = scene.speciesHandler.addByName(Linear::name);
    expectSentence(refusal([&] { species->set("stifness", 1); }),
                   {Linear::name.data(), "stifness", "stiffness"});
    expectSentence(refusal([&] { species->set("stiffness", -1); }),
                   {"LinearViscoelastic", "stiffness", "N/m"});
    expectSentence(refusal([&] { species->set("stiffness", std::nan("")); }), {"stiffness", "not set"});
    expectSentence(refusal([&] { species->set("density", 0); }), {"density", "kg/m^3"});
    expectSentence(refusal([&] { scene.speciesHandler.setPairTypeByName(0, 1, Linear::name); }),
                   {"There is no species 1"});
    expectSentence(refusal([&] { scene.laws().mixAll(); }), {"density", "not set"});
    expectSentence(refusal([&] { Simulation<>().laws().mixAll(); }), {"no species"});
}

struct Two : Simulation<Linear, Hertz> {
    Linear* linear = speciesHandler.copyAndAddObject(boxMaterial<Linear>(0));
    Hertz* hertz = speciesHandler.copyAndAddObject(boxMaterial<Hertz>(0));

    Two() { setTimeStep(1e-6); }
    template <class S>
    void addGrain(const S* species, double x, bool fixed = false) {
        SphericalParticle grain;
        grain.setSpecies(species);
        grain.setRadius(1e-3);
        grain.setPosition({x, 0, 0});
        if (fixed) grain.fixParticle();
        particleHandler.copyAndAddObject(grain);
    }
    template <class S>
    void addWall(const S* species) {
        InfiniteWall wall;
        wall.set({0, 0, -1}, {0, 0, -0.1});
        wall.setSpecies(species);
        wallHandler.copyAndAddObject(wall);
    }
};

TEST(SeveralSpecies, aPairThatCanTouchNeedsLaws) {
    const std::vector<std::string> words{Linear::name.data(), Hertz::name.data(), "setPairType<Type>(a, b)"};
    {
        Two scene;  // grains of both
        scene.addGrain(scene.linear, 0), scene.addGrain(scene.hertz, 0.1);
        expectSentence(refusal([&] { scene.initialise(); }), words);
        expectSentence(refusal([&] { static_cast<void>(scene.stabilityLimit()); }), words);
        scene.speciesHandler.setPairType<Hertz>(scene.linear, scene.hertz);
        EXPECT_NO_THROW(scene.initialise());
    }
    {
        Two scene;  // a grain and a wall
        scene.addGrain(scene.linear, 0), scene.addWall(scene.hertz);
        expectSentence(refusal([&] { scene.initialise(); }), words);
    }
    {
        Two scene;  // two that cannot touch
        scene.addGrain(scene.linear, 0), scene.addWall(scene.linear);
        EXPECT_NO_THROW(scene.initialise());
    }
    {
        Two scene;  // both are held where they are
        scene.addGrain(scene.linear, 0, true), scene.addGrain(scene.hertz, 3e-3, true);
        EXPECT_NO_THROW(scene.initialise());
    }
}

TEST(SeveralSpecies, aGrainAddedInTheRunNeedsLawsToo) {
    Two scene;
    scene.addGrain(scene.linear, 0);
    scene.initialise();
    scene.addGrain(scene.hertz, 2.0001e-3);
    try {
        for (int k = 0; k < 3; ++k) scene.step();
        ADD_FAILURE() << "went on";
    } catch (const RunError& error) {
        expectSentence(error.what(), {"setPairType<Type>(a, b)"});
    }
}

TEST(SeveralSpecies, aPairHasOneTypeAndAllItsFields) {
    Two scene;
    scene.speciesHandler.setPairType<Linear>(scene.linear, scene.hertz);
    scene.speciesHandler.setPairType<Linear>(scene.hertz, scene.linear);  // the same
    expectSentence(refusal([&] { scene.speciesHandler.setPairType<Hertz>(scene.hertz, scene.linear); }),
                   {Linear::name.data(), Hertz::name.data()});
    Two other;
    using Plastic = LinearPlasticViscoelasticSpecies;
    auto* const pair = other.speciesHandler.getMixedObject<Plastic>(other.linear, other.hertz);
    other.addGrain(other.linear, 0);
    expectSentence(refusal([&] { other.initialise(); }), {"LinearPlasticViscoelastic", "not set"});
    pair->setPlasticParameters(150, 500, 20, 0.01);
    pair->setDissipation(2e-3);
    EXPECT_NO_THROW(other.initialise());
}

TEST(SeveralSpecies, aFileOfOtherTypesIsRefused) {
    const support::TestFolder folder;
    const auto file = folder.path() / "two.h5";
    Two scene;
    scene.speciesHandler.setPairType<Linear>(scene.linear, scene.hertz);
    scene.addGrain(scene.linear, 0), scene.addGrain(scene.hertz, 0.1);
    scene.initialise();
    scene.writeRestart(file);
    const auto refused = [&](Scene& other) {
        other.restartFrom(file);
        return refusal([&] { other.initialise(); });
    };
    Two otherPair;
    otherPair.speciesHandler.setPairType<Hertz>(otherPair.linear, otherPair.hertz);
    expectSentence(refused(otherPair), {"0-1", "name", Linear::name.data(), Hertz::name.data()});
    Two otherValue;
    otherValue.speciesHandler.getMixedObject<Linear>(otherValue.linear, otherValue.hertz)->setStiffness(7);
    expectSentence(refused(otherValue), {"0-1", "stiffness", "7"});
    Simulation<> otherType;
    addNamed(otherType, boxMaterial<Hertz>(0)), addNamed(otherType, boxMaterial<Hertz>(0));
    otherType.setTimeStep(1e-6);
    expectSentence(refused(otherType), {"name", Linear::name.data(), Hertz::name.data()});
}

TEST(SeveralSpecies, grainsKeepTheSpinTheyWereGivenBeforeFrictionWasAdded) {
    Simulation<> scene;
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.copyAndAddObject(boxMaterial<Hertz>(0)));
    grain.setRadius(1e-3);
    grain.setAngularVelocity({1, 2, 3});
    scene.particleHandler.copyAndAddObject(grain);
    scene.setTimeStep(1e-6);
    Simulation<> smooth;
    grain.setSpecies(smooth.speciesHandler.copyAndAddObject(boxMaterial<Hertz>(0)));
    smooth.particleHandler.copyAndAddObject(grain);
    smooth.setTimeStep(1e-6);
    const auto* const rough = scene.speciesHandler.copyAndAddObject(boxMaterial<Wet>(0));
    scene.speciesHandler.setPairType<Hertz>(scene.speciesHandler.getObject(0), rough);
    scene.initialise(), smooth.initialise();
    EXPECT_EQ(scene.particleHandler.getObject(0).getAngularVelocity(), Vec3D(1, 2, 3));
    EXPECT_TRUE(smooth.particleHandler.store().rotation.empty());
}

}  // namespace
}  // namespace pendular::namedSpeciesTest
