// What a change of bodies, laws or the time step during a run does to contacts, events, energies and
// restarts.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Features/SpeciesByName/SeveralSpeciesHandler.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/AnyMaterial.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::changeInARunTest {
namespace {

using scenes::endOf;
using scenes::GrainMotion;
using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

using Kind = ContactEvent::Kind;
using Smooth = Species<LinearViscoelastic>;
using Rolling = Species<LinearViscoelastic, SlidingRollingTorsion>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
template <class S>
using Hooked = scenes::HookedGrains<S>;

constexpr double r = 1e-3;          // m
constexpr double step = 1e-6;       // s
constexpr double stiffness = 1000;  // N/m
constexpr double density = 2000;    // kg/m^3

Smooth smooth(double springConstant = stiffness) {
    Smooth species;
    species.setDensity(density);
    species.setStiffness(springConstant);
    species.setDissipation(0);
    return species;
}

// ---- The first grain of a scene

TEST(FirstGrainInARun, isCheckedLikeThoseOfTheSetUp) {
    // It may not move its radius in a step,
    Hooked<Smooth> fast(smooth(), {}, step);
    std::string text = endOf<Smooth>(fast, [](auto& s) {
        s.particleHandler.copyAndAddObject(s.grain(r, {0, 0, 0}, {2 * r / step, 0, 0}));
    });
    EXPECT_TRUE(contains(text,
                         "particle 0 moves at 2000 m/s, farther in a step of 1e-06 s than the smallest "
                         "radius, 0.001 m"));
    // nor that of a smaller one that comes later.
    Hooked<Smooth> smaller(smooth(), {}, step);
    smaller.run(3);
    smaller.particleHandler.copyAndAddObject(smaller.grain(r, {0, 0, 0}));
    smaller.steps(3);
    smaller.particleHandler.copyAndAddObject(smaller.grain(r / 4, {0, 5 * r, 0}, {0.5 * r / step, 0, 0}));
    text.clear();
    try {
        smaller.step();
    } catch (const RunError& error) {
        text = error.what();
    }
    EXPECT_TRUE(contains(text,
                         "particle 1 moves at 500 m/s, farther in a step of 1e-06 s than the smallest "
                         "radius, 0.00025 m"));
    // Nor may it overlap a wall, or be too small for the step.
    Hooked<Smooth> walled(smooth(), {}, step, {{{0, 0, -1}, {0, 0, 0}}});
    text = endOf<Smooth>(walled, [](auto& s) {
        s.particleHandler.copyAndAddObject(s.grain(r, {0, 0, 0.8 * r}));
    });
    EXPECT_TRUE(contains(text, "particle 0 and wall 0: initial overlap = 0.0002 m is 20 %"));
    Hooked<Smooth> tiny(smooth(), {}, step);
    text = endOf<Smooth>(tiny, [](auto& s) {
        s.particleHandler.copyAndAddObject(s.grain(r / 50, {0, 0, 0}));
    });
    EXPECT_TRUE(contains(text, "is above the stability limit"));
}

// Grains that come into an empty scene and meet: the list was infinitely wide. Without a dashpot equal grains
// exchange their velocities, up to the error of the step, (h w)^2 with w^2 = 2 k / m: 2e-4.
TEST(FirstGrainInARun, meetsTheSecondOne) {
    Hooked<Smooth> scene(smooth(), {}, step);
    scene.hook = [](auto& s) {
        if (s.getNumberOfTimeSteps() == 3)
            s.particleHandler.copyAndAddObject(s.grain(r, {0, 0, 0}, {1, 0, 0}));
        if (s.getNumberOfTimeSteps() == 5)
            s.particleHandler.copyAndAddObject(s.grain(r, {2.5 * r, 0, 0}, {-1, 0, 0}));
    };
    scene.run(1500);
    EXPECT_NEAR(scene.motion(0).velocity.x(), -1, 1e-3);
    EXPECT_NEAR(scene.motion(1).velocity.x(), 1, 1e-3);
    EXPECT_GT(scene.contacts().rebuildCount(), 2u);
}

// ---- Contacts that a change takes apart

struct PartingChange {
    const char* name;
    std::function<void(Hooked<Smooth>&)> change;
};

// They end in order: with an event, and with their energy given back to the driver. The force of the last
// step acts on for half a step: the account lacks 1/2 h F v.
TEST(ContactOfAChangedGrain, endsWhereTheChangeTakesItApart) {
    for (const auto& [name, change] : std::vector<PartingChange>{
             {"far",
              [](auto& s) {
                  s.particleHandler.getObject(1).setPosition({50 * r, 0, 0});
              }},
             {"near",
              [](auto& s) {
                  s.particleHandler.getObject(1).setPosition({2.0001 * r, 0, 0});
              }},
             {"smaller", [](auto& s) { s.particleHandler.getObject(1).setRadius(0.9 * r); }},
             {"held", [](auto& s) { s.particleHandler.getObject(1).fixParticle(); }}}) {
        SCOPED_TRACE(name);
        Hooked<Smooth> scene(smooth(), {{.fixed = true}, {.position = {1.98 * r, 0, 0}}}, step);
        scene.keepEnergyLedger();
        scene.listenToContacts();
        scene.run(5);
        scene.heard.clear();
        const EnergyLedger before = scene.energyLedger();
        const double force = scene.particleHandler.getObject(1).getForce().x(),
                     speed = scene.motion(1).velocity.x();
        EXPECT_GT(before.elastic, 0.4 * stiffness * std::pow(0.02 * r, 2));
        change(scene);
        scene.step();
        ASSERT_EQ(scene.heard.size(), 1u);
        EXPECT_EQ(scene.heard[0], (ContactEvent{0, 1, -1, 0, Kind::TouchEnds}));
        EXPECT_EQ(scene.energyLedger().elastic, 0);
        EXPECT_EQ(scene.energyLedger().stepError, before.stepError);
        // The mass of the one that is made smaller goes with the driver, too.
        EXPECT_NEAR(scene.energyLedger().total(), before.total(), 2 * step * force * speed);
        EXPECT_LT(2 * step * force * speed, 0.01 * before.elastic);
        scene.steps(3);
        EXPECT_EQ(scene.heard.size(), 1u);
    }
}

// Contacts with bridges end so, too, and contacts at walls.
TEST(ContactOfAChangedGrain, endsWithItsBridgeAndAtWalls) {
    Hooked<Wet> wet(scenes::boxMaterial<Wet>(0), {{}, {.position = {1.99 * r, 0, 0}}}, step);
    wet.listenToContacts();
    wet.run(5);
    wet.heard.clear();
    wet.particleHandler.getObject(0).setPosition({-3 * r, 0, 0});
    wet.step();
    ASSERT_EQ(wet.heard.size(), 2u);
    EXPECT_EQ(wet.heard[0].kind, Kind::TouchEnds);
    EXPECT_EQ(wet.heard[1].kind, Kind::BridgeRuptures);
    EXPECT_EQ(wet.contactEventCounts().bridgesRuptured, 1u);

    Hooked<Smooth> walled(smooth(), {{.position = {0, 0, 0.99 * r}}}, step, {{{0, 0, -1}, {0, 0, 0}}});
    walled.listenToContacts();
    walled.run(5);
    walled.heard.clear();
    walled.particleHandler.getObject(0).fixParticle();
    walled.step();
    ASSERT_EQ(walled.heard.size(), 1u);
    EXPECT_EQ(walled.heard[0], (ContactEvent{0, ContactEvent::none, 0, 0, Kind::TouchEnds}));
}

// One that is moved and still touches goes on: with the friction that it has built up.
TEST(ContactOfAChangedGrain, goesOnWhereItStillTouches) {
    Hooked<Wet> scene(scenes::boxMaterial<Wet>(0), {{.fixed = true}, {.position = {1.99 * r, 0, 0}}}, step);
    scene.listenToContacts();
    scene.particleHandler.getObject(1).setVelocity({0, 0.1, 0});
    scene.run(20);
    const auto spring = [&] {
        const ContactSystem& contacts = scene.contacts();
        double length = 0;
        contacts.forEachActing(scene.particleHandler.store(), [&](const Bucket&, std::uint32_t contact) {
            length = contacts.springLength(contact);
        });
        return length;
    };
    const double before = spring();
    EXPECT_GT(before, 1e-7);
    scene.heard.clear();
    GrainReference grain = scene.particleHandler.getObject(1);
    grain.setPosition(grain.getPosition() + Vec3D(1e-8, 0, 0));
    grain.setRadius(0.9999 * r);
    scene.step();
    EXPECT_NEAR(spring() / before, 1, 0.2);
    EXPECT_TRUE(scene.heard.empty());
}

// ---- Overlaps that a change makes

TEST(OverlapOfAChangedGrain, isRefusedAsAtSetUp) {
    const auto pair = [](double distance, bool held) {
        return std::make_unique<Hooked<Smooth>>(
            smooth(),
            std::vector<GrainMotion>{{.fixed = held}, {.position = {distance, 0, 0}, .fixed = held}}, step);
    };
    auto swelling = pair(2.01 * r, false), letGo = pair(1.8 * r, true), shrinking = pair(1.8 * r, true);
    std::string text =
        endOf<Smooth>(*swelling, [](auto& s) { s.particleHandler.getObject(1).setRadius(1.21 * r); });
    EXPECT_TRUE(
        contains(text, "particle 0 and particle 1: initial overlap = 0.0002 m is 20 % of the smaller"));
    text = endOf<Smooth>(*letGo, [](auto& s) { s.particleHandler.getObject(0).fixParticle(false); });
    EXPECT_TRUE(
        contains(text, "particle 0 and particle 1: initial overlap = 0.0002 m is 20 % of the smaller"));
    // A held pair has no contact; and what is within the bound goes on.
    EXPECT_EQ(endOf<Smooth>(*shrinking, [](auto& s) { s.particleHandler.getObject(1).setRadius(0.9 * r); }),
              "");
    auto little = pair(1.99 * r, true);
    EXPECT_EQ(endOf<Smooth>(*little, [](auto& s) { s.particleHandler.getObject(1).fixParticle(false); }), "");
    EXPECT_GT(little->motion(1).velocity.x(), 0);
}

// ---- Walls

InfiniteWall floorOf(Hooked<Smooth>& scene) {
    InfiniteWall wall;
    wall.setSpecies(scene.speciesHandler.getObject(0));
    wall.set({0, 0, -1}, {0, 0, -5 * r});
    wall.setVelocity({0, 0, 0.5});
    return wall;
}

TEST(WallOfAResumedRun, beginsItsMotionWhenItIsAdded) {
    const TestFolder folder;
    const auto file = folder.path() / "run.h5";
    Hooked<Smooth> whole(smooth(), {{}}, step), again(smooth(), {{}}, step);
    whole.run(1000);
    whole.writeRestart(file);
    again.restartFrom(file);
    again.initialise();
    for (Hooked<Smooth>* scene : {&whole, &again}) {
        const InfiniteWall* added = scene->wallHandler.copyAndAddObject(floorOf(*scene));
        EXPECT_EQ(added->getPose().shift.z, 0);
        scene->steps(100);
        EXPECT_NEAR(added->getPose().shift.z, 0.5 * 100 * step, 1e-15);
    }
}

TEST(WallInARun, hasItsNewSpeciesFromTheNextStepOn) {
    const auto make = [](double otherStiffness) {
        auto scene = std::make_unique<Hooked<Smooth>>(
            smooth(), std::vector<GrainMotion>{{.position = {0, 0, 0.99 * r}}}, step,
            std::vector<scenes::PlaneAt>{{{0, 0, -1}, {0, 0, 0}}});
        scene->speciesHandler.copyAndAddObject(smooth(otherStiffness));
        return scene;
    };
    const auto change = [](Hooked<Smooth>& s) {
        dynamic_cast<InfiniteWall&>(s.wallHandler.getObject(0)).setSpecies(s.speciesHandler.getObject(1));
    };
    auto scene = make(3 * stiffness), same = make(3 * stiffness);
    for (const auto& s : {scene.get(), same.get()}) s->run(2);
    change(*scene);
    for (const auto& s : {scene.get(), same.get()}) s->step();
    // Of the overlap, which is another one after the step: the new force acts in both halves of it.
    const auto stiffnessOf = [](Hooked<Smooth>& s) {
        const ObservedContact seen = s.interactions().at(0);
        return seen.normalForce / seen.overlap();
    };
    // The harmonic mean of k and 3 k.
    EXPECT_NEAR(stiffnessOf(*scene) / stiffnessOf(*same), 1.5, 1e-12);
    auto stiff = make(stiffness);
    stiff->speciesHandler.getMixedObject(0, 1)->setStiffness(1e12);  // no grain or wall of this pair yet
    EXPECT_TRUE(contains(endOf<Smooth>(*stiff, change), "is above the stability limit"));
}

/// A wall that shakes along its normal.
class Shaken : public Hooked<Smooth> {
public:
    Shaken(double frequency, double amplitude, bool turns = false) : Hooked<Smooth>(smooth(), {{}}, 1e-5) {
        InfiniteWall wall;
        wall.setSpecies(speciesHandler.getObject(0));
        wall.set({0, 0, -1}, {0, 0, -5 * r});
        wall.setMotion([=](double time) {
            const double phase = std::sin(2 * std::numbers::pi * frequency * time);
            Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
            if (turns) pose.rotate(Eigen::AngleAxisd(amplitude * phase, Vec3D::UnitY()));
            else pose.translation().z() = amplitude * phase;
            return pose;
        });
        wallHandler.copyAndAddObject(wall);
    }
};

TEST(WallOfAResumedRun, hasTheFunctionThatItHad) {
    const TestFolder folder;
    const auto file = folder.path() / "run.h5";
    const auto refusalOf = [&](const Shaken& given, double frequency, double amplitude, bool turns = false) {
        const_cast<Shaken&>(given).writeRestart(file);
        Shaken other(frequency, amplitude, turns);
        other.restartFrom(file);
        const std::string text = refusal([&] { other.initialise(); });
        if (!text.empty()) {
            EXPECT_TRUE(isOneSentence(text));
        }
        return text;
    };
    Shaken scene(50, 1e-4);
    scene.run(0);
    EXPECT_TRUE(contains(refusalOf(scene, 60, 1e-4), "walls/0/velocity is (0, 0, 0.0314"));
    scene.steps(1234);
    EXPECT_EQ(refusalOf(scene, 50, 1e-4), "");
    EXPECT_TRUE(contains(refusalOf(scene, 50, 2e-4), "walls/0/pose is (0, 0, "));
    EXPECT_TRUE(contains(refusalOf(scene, 50, 1e-4, true), "function of setMotion()"));
}

// ---- Time steps

// An event's hook is called when the step has been counted: what it sets holds from the next step on. A grain
// that flies freely at 1 m/s has gone as far as the time says.
TEST(TimeStepThatAnEventSets, holdsFromTheNextStepOn) {
    const TestFolder folder;
    const auto file = folder.path() / "run.h5";
    const auto make = [] {
        auto scene = std::make_unique<Hooked<Smooth>>(
            smooth(),
            std::vector<GrainMotion>{{.position = {0, 0.1, 0}, .velocity = {1, 0, 0}},
                                     {.velocity = {1, 0, 0}},
                                     {.position = {2.0105 * r, 0, 0}}},
            step);
        scene->listenToContacts();
        scene->onEvent = [](auto& s) {
            if (s.heard.size() == 1) s.setTimeStep(0.5 * step);
        };
        return scene;
    };
    auto whole = make();
    whole->initialise();
    while (whole->heard.empty()) whole->step();
    const std::size_t atEvent = whole->getNumberOfTimeSteps();
    EXPECT_NEAR(whole->getTime(), static_cast<double>(atEvent) * step, 1e-18);
    // In the step in which 0.0105 r at 1 m/s are gone.
    EXPECT_EQ(atEvent, 11u);
    whole->writeRestart(file);
    whole->steps(100);
    EXPECT_NEAR(whole->getTime(), (static_cast<double>(atEvent) + 50) * step, 1e-18);
    EXPECT_NEAR(whole->motion(0).position.x(), whole->getTime(), 1e-17);
    auto again = make();
    again->restartFrom(file);
    again->initialise();
    again->onEvent = {};
    again->steps(100);
    EXPECT_EQ(again->getTime(), whole->getTime());
    EXPECT_EQ(stateHash(again->particleHandler.store()), stateHash(whole->particleHandler.store()));
}

/// The sentence with which a pair's run ends that takes another step, and whether one with the adaptive step
/// is refused for the same reason.
template <class S>
std::string endOfOtherStep(const S& species, const Integrator& scheme, double other, bool& refusesAdaptive) {
    const auto make = [&] {
        auto scene = std::make_unique<Hooked<S>>(
            species, std::vector<GrainMotion>{{}, {.position = {1.99 * r, 0, 0}}}, step);
        scene->setIntegrator(scheme);
        scene->setQuiet();
        return scene;
    };
    auto adaptive = make(), changed = make();
    adaptive->setAdaptiveTimeStep(0.9);
    refusesAdaptive = contains(refusal([&] { adaptive->initialise(); }), "steps of one length");
    return endOf<S>(*changed, [=](auto& s) { s.setTimeStep(other); });
}

// Adams' formulas have the weights of equal steps, and a viscous bridge pays for the step to come: in steps
// of other lengths both would be wrong without a word.
TEST(TimeStepOfOneLength, staysWhatItWas) {
    const auto wet = scenes::boxMaterial<Wet>(0);
    Species<HertzianViscoelastic, Mindlin, ViscousLiquidBridgeWillett> viscous;
    viscous = support::anyMaterial<decltype(viscous)>();
    bool refusesAdaptive = false;
    const auto expectRefused = [&](const std::string& text) {
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, "time step = 1e-06 s cannot be changed to 5e-07 s in the run"));
        EXPECT_TRUE(contains(text, "steps of one length"));
        EXPECT_TRUE(refusesAdaptive);
    };
    expectRefused(endOfOtherStep(wet, integrators::adamsMoulton, 0.5 * step, refusesAdaptive));
    expectRefused(endOfOtherStep(viscous, integrators::predictedVelocityVerlet, 0.5 * step, refusesAdaptive));
    // A step of the same length is no change.
    EXPECT_EQ(endOfOtherStep(viscous, integrators::predictedVelocityVerlet, step, refusesAdaptive), "");
    for (const Integrator& scheme :
         {integrators::predictedVelocityVerlet, integrators::springsInStep, integrators::velocityVerlet}) {
        EXPECT_EQ(endOfOtherStep(wet, scheme, 0.5 * step, refusesAdaptive), "") << scheme.name;
        EXPECT_FALSE(refusesAdaptive);
    }
}

TEST(TimeStep, thatIsSetBeforeTheFirstStepOfARunSurvivesARestart) {
    const TestFolder folder;
    const auto file = folder.path() / "run.h5";
    const auto make = [] {
        auto scene = std::make_unique<Hooked<Smooth>>(
            smooth(), std::vector<GrainMotion>{{.velocity = {1, 0, 0}}}, step);
        scene->hook = [](auto& s) {
            if (s.getNumberOfTimeSteps() == 0) s.setTimeStep(0.5 * step);
        };
        return scene;
    };
    auto whole = make(), again = make();
    whole->run(10);
    EXPECT_EQ(whole->getTime(), 10 * 0.5 * step);
    whole->writeRestart(file);
    again->restartFrom(file);
    EXPECT_EQ(refusal([&] { again->initialise(); }), "");
    EXPECT_EQ(again->getTimeStep(), 0.5 * step);
    EXPECT_EQ(again->getTime(), whole->getTime());
}

// ---- Laws

Rolling rolling() {
    Rolling species;
    species.setDensity(density);
    species.setStiffness(stiffness);
    species.setDissipation(0);
    species.setSlidingStiffness(300);
    species.setSlidingFrictionCoefficient(0.5);
    species.setRollingStiffness(300);
    species.setRollingFrictionCoefficient(0.3);
    return species;
}

// A grain that turns on another one, and gets a species without friction: from then on its spin stays.
TEST(ContactOfAnotherLaw, knowsNothingOfTheOneBefore) {
    Simulation<Rolling, Smooth> scene;
    const auto* rough = scene.speciesHandler.copyAndAddObject(rolling());
    const auto* slippery = scene.speciesHandler.copyAndAddObject(smooth());
    scene.speciesHandler.setPairType<Smooth>(rough, slippery);
    for (const bool isLower : {true, false}) {
        SphericalParticle grain;
        grain.setSpecies(rough);
        grain.setRadius(r);
        if (isLower) grain.fixParticle();
        else grain.setPosition({0, 0, 1.999 * r});
        if (!isLower) grain.setAngularVelocity({20, 0, 0});
        scene.particleHandler.copyAndAddObject(grain);
    }
    scene.setTimeStep(step);
    scene.listenToContacts();
    scene.initialise();
    const auto steps = [&](int count) {
        for (int k = 0; k < count; ++k) scene.step();
    };
    GrainReference grain = scene.particleHandler.getObject(1);
    const auto spin = [&] { return grain.getAngularVelocity().x(); };
    steps(10);
    const double before = spin();
    steps(1);
    EXPECT_GT(std::abs(spin() - before), 1e-6 * std::abs(before));
    const auto isWithoutTorque = [&] {
        for (const TorqueRecord& record : scene.contacts().store().memory.torques)
            if (record.torque.x != 0 || record.torque.y != 0 || record.torque.z != 0) return false;
        return true;
    };
    EXPECT_FALSE(isWithoutTorque());
    grain.setSpecies(slippery);
    steps(1);  // the torque of the last step acts on for half of it
    // One contact has ended and another one has begun.
    ASSERT_EQ(scene.contactEvents().size(), 2u);
    EXPECT_EQ(scene.contactEvents()[0].kind, Kind::TouchEnds);
    EXPECT_EQ(scene.contactEvents()[1].kind, Kind::TouchBegins);
    EXPECT_TRUE(isWithoutTorque());
    const double after = spin();
    steps(20);
    EXPECT_EQ(spin(), after);
    EXPECT_GT(grain.getForce().z(), 0);  // it touches still
}

// A value of a pair that no law can have: all pairs keep what they had, and the run ends with the last state.
TEST(MixtureThatIsRefused, leavesThePairsAsTheyWere) {
    SpeciesHandler<Smooth> one;
    one.copyAndAddObject(smooth());
    one.copyAndAddObject(smooth(3 * stiffness));
    one.mixAll();
    one.getObject(0)->setStiffness(2 * stiffness);
    one.getMixedObject(0, 1)->stiffnessConstant = -1;
    EXPECT_TRUE(contains(refusal([&] { one.mixAll(); }), "stiffness = -1 N/m"));
    EXPECT_EQ(one.mixture(0, 0).getStiffness(), stiffness);
    EXPECT_EQ(one.mixture(0, 1).getStiffness(), 1.5 * stiffness);
    EXPECT_EQ(one.mixture(1, 1).getStiffness(), 3 * stiffness);
    EXPECT_TRUE(one.hasChanges());

    Simulation<Smooth, Rolling> several;
    auto* first = several.speciesHandler.copyAndAddObject(smooth());
    auto* second = several.speciesHandler.copyAndAddObject(rolling());
    auto* pair = several.speciesHandler.getMixedObject<Smooth>(first, second);
    several.laws().mixAll();
    first->setStiffness(2 * stiffness);
    pair->stiffnessConstant = -1;
    EXPECT_TRUE(contains(refusal([&] { several.laws().mixAll(); }), "stiffness = -1 N/m"));
    for (const auto& [a, b] : {std::pair(0, 0), std::pair(0, 1), std::pair(1, 1)})
        EXPECT_EQ(several.laws().fields(a, b).at(0).value, stiffness) << a << b;
    EXPECT_TRUE(several.laws().hasChanges());

    Hooked<Smooth> scene(smooth(), {{}, {.position = {1.99 * r, 0, 0}}}, step);
    EXPECT_TRUE(contains(
        endOf<Smooth>(scene, [](auto& s) { s.speciesHandler.getMixedObject(0, 0)->stiffnessConstant = -1; }),
        "stiffness = -1 N/m"));
    EXPECT_EQ(scene.interactions().size(), 1u);
}

// ---- Restarts

// What has ended before a restart file is written is told in the next step, by the run that goes on too.
TEST(EventBeforeTheNextStep, isInTheRestartFile) {
    const TestFolder folder;
    const auto file = folder.path() / "run.h5";
    const auto make = [] {
        auto scene = std::make_unique<Hooked<Wet>>(
            scenes::boxMaterial<Wet>(0),
            std::vector<GrainMotion>{{}, {.position = {1.99 * r, 0, 0}}, {.position = {3.98 * r, 0, 0}}},
            step, std::vector<scenes::PlaneAt>{{{0, 0, -1}, {0, 0, -0.99 * r}}});
        scene->listenToContacts();
        return scene;
    };
    auto whole = make(), again = make();
    whole->run(20);
    whole->particleHandler.removeObject(0);                                  // a wall and a grain
    whole->particleHandler.getObject(2).setPosition({3.98 * r, 0, 20 * r});  // these, too
    whole->writeRestart(file);
    again->restartFrom(file);
    again->initialise();
    for (const auto& scene : {whole.get(), again.get()}) {
        scene->heard.clear();
        scene->step();
        EXPECT_EQ(scene->heard.size(), 8u);
    }
    EXPECT_EQ(again->heard, whole->heard);
    EXPECT_EQ(again->contactEventCounts().touchesEnded, whole->contactEventCounts().touchesEnded);
    EXPECT_EQ(again->contactEventCounts().bridgesRuptured, 4u);
}

TEST(SurroundingsOfAResumedRun, areThoseThatItHad) {
    const TestFolder folder;
    const auto file = folder.path() / "run.h5";
    const auto make = [](const Vec3D& gravity, double period) {
        auto scene = std::make_unique<Hooked<Smooth>>(smooth(), std::vector<GrainMotion>{{}}, step);
        scene->setGravity(gravity);
        if (period > 0) scene->setPeriodic(1, 0, period);
        return scene;
    };
    const auto refusalBy = [&](const Vec3D& gravity, double period) {
        auto other = make(gravity, period);
        other->restartFrom(file);
        const std::string text = refusal([&] { other->initialise(); });
        if (!text.empty()) {
            EXPECT_TRUE(isOneSentence(text));
        }
        return text;
    };
    const Vec3D earth(0, 0, -9.81), moon(0, 0, -1.62);
    auto scene = make(earth, 0.5);
    scene->run(10);
    scene->writeRestart(file);
    EXPECT_EQ(refusalBy(earth, 0.5), "");
    EXPECT_TRUE(
        contains(refusalBy(moon, 0.5), "gravity/z is -9.81 m/s^2 in the file and -1.62 m/s^2 in the"));
    EXPECT_TRUE(contains(refusalBy(earth, 0.25), "periodicLength/y is 0.5 m in the file and 0.25 m in the"));
    EXPECT_TRUE(contains(refusalBy(earth, 0), "periodicLength/y is 0.5 m in the file and 0 m in the scene"));
    // What the run has changed, it goes on with.
    scene->setGravity(moon);
    scene->writeRestart(file);
    auto again = make(earth, 0.5);
    again->restartFrom(file);
    again->initialise();
    EXPECT_EQ(again->getGravity(), moon);
}

// Numbers of grains are 32 bits with a sign in files.
TEST(NumberOfAGrain, isAtMost2147483647) {
    const TestFolder folder;
    const auto file = folder.path() / "grains.h5";
    const auto write = [&](std::uint32_t next) {
        writeRestartFile(file, [&](StateArchive& archive) {
            std::vector<TranslationRecord> translation;
            std::vector<RotationRecord> rotation;
            std::vector<Vector<double>> acceleration;
            std::vector<EarlierAcceleration> earlier;
            std::vector<std::uint16_t> species;
            std::vector<std::uint32_t> identity;
            archive.column<double>("translation", translation);
            archive.column<double>("rotation", rotation);
            archive.column<double>("acceleration", acceleration);
            archive.column<double>("earlier", earlier);
            archive.column<std::uint16_t>("species", species);
            archive.column<std::uint32_t>("identity", identity);
            archive.value("nextIdentity", next);
            std::string columns;
            archive.text("columnNames", columns);
            archive.group("bodies", [&] { RigidBodies().visitState(archive, ParticleStore()); });
        });
    };
    Hooked<Smooth> scene(smooth(), {}, step);
    const auto read = [&] {
        readRestartFile(file, [&](StateArchive& archive) { scene.particleHandler.visitState(archive); });
    };
    write(2147483647);
    read();
    EXPECT_EQ(scene.particleHandler.copyAndAddObject(scene.grain(r, {0, 0, 0})).getId(), 2147483647u);
    const std::string text = refusal([&] {
        scene.particleHandler.copyAndAddObject(scene.grain(r, {0, 3 * r, 0}));
    });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "the number of a grain must be at most 2147483647"));
    write(2147483649);
    EXPECT_TRUE(contains(refusal(read), "nextIdentity is above 2^31"));
}

}  // namespace
}  // namespace pendular::changeInARunTest
