// Species of different types in one scene: each pair has its own laws, and pays for no others.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::severalSpeciesTest {
namespace {

using scenes::boxMaterial;
using scenes::SettlingBox;

using Linear = LinearViscoelasticSpecies;
using Hertz = HertzianViscoelasticSpecies;
using Rough = HertzianViscoelasticMindlinSpecies;
using Wet = HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies;
using SmoothWet = HertzianViscoelasticLiquidBridgeWillettSpecies;
/// Laws with a torque of their own, and histories of another width than those of Mindlin.
using Rolling = Species<LinearPlasticViscoelastic, SlidingRollingTorsion>;
/// Laws that act on grains which have not touched.
using Attracting = Species<LinearViscoelastic, NoFriction, ReversibleAdhesive>;

template <class Scene>
void run(Scene& scene, std::size_t steps) {
    if (scene.getNumberOfTimeSteps() == 0) scene.initialise();
    while (scene.getNumberOfTimeSteps() < steps) scene.step();
}
std::uint64_t hashOf(const Scene& scene) { return stateHash(scene.particleHandler.store()); }
/// Without spins.
std::uint64_t hashOfMotion(const Scene& scene) {
    ParticleStore grains = scene.particleHandler.store();
    grains.hasSpin = false;
    return stateHash(grains);
}

/// Small grains and some walls of one type, large grains and the other walls of another.
template <class Small, class Large, class Between>
std::unique_ptr<SettlingBox<Small, Large>> mixedBox(int threads = 1, int layers = 4) {
    auto scene = std::make_unique<SettlingBox<Small, Large>>(layers);
    auto& species = scene->speciesHandler;
    species.template setPairType<Between>(species.getObject(0), species.getObject(1));
    scene->setNumberOfThreads(threads);
    return scene;
}

template <class A, class B>
void expectSameBesideOtherTypes() {
    SettlingBox<A> alone(3);
    SettlingBox<A, A, Simulation<A, B>> named(3), beside(3);
    auto& species = beside.speciesHandler;
    species.copyAndAddObject(boxMaterial<B>(1));  // no grain has it, and nothing is said of its pairs
    // Values of a pair, as the driver sets them.
    alone.speciesHandler.getMixedObject(0, 1)->setDissipation(0.1);
    named.speciesHandler
        .template getMixedObject<A>(named.speciesHandler.getObject(0), named.speciesHandler.getObject(1))
        ->setDissipation(0.1);
    species.template getMixedObject<A>(species.getObject(0), species.getObject(1))->setDissipation(0.1);
    for (Scene* const scene :
         {static_cast<Scene*>(&alone), static_cast<Scene*>(&named), static_cast<Scene*>(&beside)})
        run(*scene, 1500);
    EXPECT_EQ(hashOf(named), hashOf(alone));
    EXPECT_EQ(hashOfMotion(beside), hashOfMotion(alone));
    EXPECT_EQ(named.contacts().bytes(), alone.contacts().bytes());
    EXPECT_EQ(named.particleHandler.store().bytes(), alone.particleHandler.store().bytes());
}

TEST(SeveralSpecies, thatNoGrainHasChangeNoBit) {
    expectSameBesideOtherTypes<Hertz, Linear>();
    expectSameBesideOtherTypes<Hertz, Wet>();  // grains get a spin, records a torque
    expectSameBesideOtherTypes<SmoothWet, Rolling>();
    expectSameBesideOtherTypes<Wet, Rolling>();
    expectSameBesideOtherTypes<Rough, SmoothWet>();
    expectSameBesideOtherTypes<SmoothWet, Attracting>();  // other contacts are listed
    expectSameBesideOtherTypes<Attracting, Wet>();
}

TEST(SeveralSpecies, aSceneOfOneTypeHasRecordsOfThatTypeOnly) {
    static_assert(sizeof(ForceRecord) == 32 && sizeof(ForceTorqueRecord) == 64);
    static_assert(ContactStore::bytesPerContact(layoutOf<Hertz>) == 10 + 32 + 8);
    SettlingBox<Hertz> smooth(2);
    run(smooth, 500);
    const ContactMemory& memory = smooth.contacts().store().memory;
    EXPECT_TRUE(memory.records.columns.empty() && memory.torques.empty() && memory.history.columns.empty() &&
                memory.interaction.columns.empty());
    EXPECT_FALSE(memory.forces.empty());
    EXPECT_TRUE(smooth.particleHandler.store().rotation.empty());

    const auto mixed = mixedBox<Hertz, Rough, Rough>(1, 2);
    run(*mixed, 500);
    EXPECT_TRUE(mixed->contacts().store().memory.forces.empty());
    EXPECT_EQ(mixed->particleHandler.store().rotation.size(), mixed->particleHandler.getSize());
}

/// Two grains that meet along x, far from all others.
struct Meeting {
    int first, second;  // indices of species
    double y;           // m
    std::size_t grain1 = 0, grain2 = 0;
};
constexpr double radius = 1e-3, speed = 0.2;                     // m; m/s, relative
constexpr double densityOfLinear = 2000, densityOfHertz = 3000;  // kg/m^3

template <class Base>
struct Meetings : Base {
    std::vector<Meeting> meetings{{0, 0, 0.0}, {1, 1, 0.01}, {0, 1, 0.02}};

    /// Grains that are a part of a step from each other, and turn.
    void addMeetings(double step) {
        for (Meeting& m : meetings) {
            m.grain1 = addGrain(m.first, -radius, speed / 2, m.y);
            m.grain2 = addGrain(m.second, radius + 0.4 * step * speed, -speed / 2, m.y);
        }
        this->setTimeStep(step);
    }
    [[nodiscard]] double rebound(const Meeting& m) {
        return (velocity(m.grain2) - velocity(m.grain1)).x() / speed;
    }
    [[nodiscard]] Vec3D velocity(std::size_t grain) {
        return this->particleHandler.getObject(grain).getVelocity();
    }
    [[nodiscard]] Vec3D momentum() {
        Vec3D sum = Vec3D::Zero();
        for (std::size_t k = 0; k < this->particleHandler.getSize(); ++k)
            sum += this->particleHandler.getObject(k).getMass() * velocity(k);
        return sum;
    }
    double spin = 0;  // rad/s

private:
    std::size_t addGrain(int species, double x, double vx, double y) {
        SphericalParticle grain;
        grain.setSpecies(this->speciesHandler.getObject(static_cast<std::size_t>(species)));
        grain.setRadius(radius);
        grain.setPosition({x, y, 0});
        grain.setVelocity({vx, 0, 0});
        grain.setAngularVelocity({0, spin, 2 * spin});
        return this->particleHandler.copyAndAddObject(grain).getId();
    }
};

constexpr double stiffness = 1000, dissipation = 0.02;       // N/m, kg/s
constexpr double modulus = 2.8e6, restitutionOfHertz = 0.7;  // Pa

double effectiveMass(double density1, double density2) {
    const double m1 = sphereMass(radius, density1), m2 = sphereMass(radius, density2);
    return m1 * m2 / (m1 + m2);
}
/// e = exp(-pi g / w) of the damped oscillator, with g = dissipation / 2 m*, w^2 = stiffness / m* - g^2.
double restitutionOfLinear(double mass, double spring = stiffness) {
    const double rate = dissipation / (2 * mass);
    return std::exp(-std::numbers::pi * rate / std::sqrt(spring / mass - rate * rate));
}
Linear linear() {
    Linear species;
    species.setDensity(densityOfLinear);
    species.setStiffness(stiffness);
    species.setDissipation(dissipation);
    return species;
}
Hertz hertz() {
    Hertz species;
    species.setDensity(densityOfHertz);
    species.setEffectiveElasticModulusAndRestitutionCoefficient(modulus, restitutionOfHertz);
    return species;
}

/// Runs the three meetings; a touch lasts some 250 us.
template <class Between, class Set>
std::array<double, 3> rebounds(Set&& set) {
    Meetings<Simulation<Linear, Hertz>> scene;
    auto* const a = scene.speciesHandler.copyAndAddObject(linear());
    auto* const b = scene.speciesHandler.copyAndAddObject(hertz());
    scene.speciesHandler.template setPairType<Between>(b, a);
    set(*scene.speciesHandler.template getMixedObject<Between>(a, b));
    scene.addMeetings(1e-6);
    const Vec3D before = scene.momentum();
    run(scene, 1500);
    const double scale = sphereMass(radius, densityOfHertz) * speed;
    EXPECT_LT((scene.momentum() - before).norm(), 1e-14 * scale);  // some 1500 roundings of 1e-16
    return {scene.rebound(scene.meetings[0]), scene.rebound(scene.meetings[1]),
            scene.rebound(scene.meetings[2])};
}

/// At 50 steps a contact the integrator's largest error is 2e-4 of this restitution
/// (Kernel/Core/Contacts/README.md); here are more. The laws that are told apart are 0.01 from each other.
constexpr double ofSteps = 2e-4 * restitutionOfHertz;

TEST(SeveralSpecies, eachPairReboundsByItsOwnLaw) {
    const double likeLinear = restitutionOfLinear(effectiveMass(densityOfLinear, densityOfLinear));
    const double mixedMass = effectiveMass(densityOfLinear, densityOfHertz);
    ASSERT_GT(std::abs(restitutionOfLinear(mixedMass) - restitutionOfHertz), 0.01);

    const auto asLinear = rebounds<Linear>([](auto&) {});  // values of the linear species
    EXPECT_NEAR(asLinear[0], likeLinear, ofSteps);
    EXPECT_NEAR(asLinear[1], restitutionOfHertz, ofSteps);
    EXPECT_NEAR(asLinear[2], restitutionOfLinear(mixedMass), ofSteps);

    const auto asHertz = rebounds<Hertz>([](auto&) {});
    EXPECT_EQ(asHertz[0], asLinear[0]);
    EXPECT_EQ(asHertz[1], asLinear[1]);
    EXPECT_NEAR(asHertz[2], restitutionOfHertz, ofSteps);

    const auto own = rebounds<Linear>([](auto& pair) { pair.setStiffness(2 * stiffness); });
    EXPECT_NEAR(own[2], restitutionOfLinear(mixedMass, 2 * stiffness), ofSteps);
}

TEST(SeveralSpecies, aLawThatNeitherSpeciesHasIsSetForThePair) {
    Meetings<Simulation<Rough, Hertz>> scene;
    auto* const a = scene.speciesHandler.copyAndAddObject(boxMaterial<Rough>(0));
    auto* const b = scene.speciesHandler.copyAndAddObject(hertz());
    auto* const pair = scene.speciesHandler.getMixedObject<Linear>(a, b);
    pair->setStiffness(stiffness);
    pair->setDissipation(dissipation);
    scene.meetings = {{0, 1, 0}};
    scene.spin = 100;
    scene.addMeetings(1e-6);
    run(scene, 1500);
    EXPECT_NEAR(scene.rebound(scene.meetings[0]), restitutionOfLinear(effectiveMass(2500, densityOfHertz)),
                ofSteps);
    // The pair has no friction, though one of the species has.
    EXPECT_EQ(scene.particleHandler.getObject(0).getAngularVelocity(), Vec3D(0, 100, 200));
    EXPECT_EQ(scene.particleHandler.getObject(1).getAngularVelocity(), Vec3D(0, 100, 200));
}

/// The pairs of species between which a bridge was stretched. Dry smooth contacts beside them neither pull
/// nor turn.
template <class Between>
std::set<std::pair<int, int>> bridgedPairs() {
    Meetings<Simulation<Hertz, Wet>> scene;
    auto* const dry = scene.speciesHandler.copyAndAddObject(hertz());
    auto* const wet = scene.speciesHandler.copyAndAddObject(boxMaterial<Wet>(0));
    scene.speciesHandler.template setPairType<Between>(dry, wet);
    scene.spin = 100;
    scene.addMeetings(1e-6);
    scene.initialise();
    std::set<std::pair<int, int>> found;
    const ParticleStore& grains = scene.particleHandler.store();
    for (int k = 0; k < 2000; ++k) {
        scene.step();
        const ContactStore& store = scene.contacts().store();
        store.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            const ObservedContact seen = scene.contacts().observe(grains, bucket, c);
            const std::pair pair(bucket.species1, bucket.species2);
            if (seen.bridged) {
                EXPECT_GT(seen.adhesiveForce, 0);
                if (seen.separation > 0) found.insert(pair);
            }
            if (pair == std::pair(0, 0) && store.acts(c)) {
                const ForceTorqueRecord record = store.memory.records[store.slotOf(c)];
                EXPECT_EQ(norm(record.leverless), 0);
                EXPECT_EQ(seen.adhesiveForce, 0);
                EXPECT_GT(record.halfOverlap, 0);
            }
        });
    }
    EXPECT_EQ(scene.laws().bridgeVolume(0, 0), 0);
    EXPECT_EQ(scene.laws().bridgeVolume(1, 1), boxMaterial<Wet>(0).getLiquidBridgeVolume());
    return found;
}

TEST(SeveralSpecies, bridgesFormOnlyWhereThePairHasThem) {
    using Pairs = std::set<std::pair<int, int>>;
    EXPECT_EQ(bridgedPairs<Hertz>(), (Pairs{{1, 1}}));
    EXPECT_EQ(bridgedPairs<Rough>(), (Pairs{{1, 1}}));
    EXPECT_EQ(bridgedPairs<Wet>(), (Pairs{{0, 1}, {1, 1}}));
}

template <class Small, class Large, class Between>
void expectSameWithThreadsAndRestarts() {
    const support::TestFolder folder;
    const auto whole = folder.path() / "whole.h5", half = folder.path() / "half.h5",
               restarted = folder.path() / "restarted.h5";
    const auto one = mixedBox<Small, Large, Between>();
    run(*one, 800);
    one->writeRestart(half);
    std::set<int> kinds;  // of pairs between grains that touched or were bridged: like, unlike, like
    for (std::size_t steps = 900; steps <= 1500; steps += 100) {
        run(*one, steps);
        const ContactStore& store = one->contacts().store();
        store.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            if (bucket.wall < 0 && store.acts(c)) kinds.insert(bucket.species1 + bucket.species2);
        });
    }
    EXPECT_EQ(kinds.size(), 3u);
    one->writeRestart(whole);
    const auto other = mixedBox<Small, Large, Between>(2);
    run(*other, 1500);
    EXPECT_EQ(hashOf(*other), hashOf(*one));
    const auto again = mixedBox<Small, Large, Between>(3);
    again->restartFrom(half);
    again->initialise();
    again->writeRestart(restarted);
    support::expectSameState(half, restarted);
    run(*again, 1500);
    again->writeRestart(restarted);
    support::expectSameState(whole, restarted);
}

TEST(SeveralSpecies, sameBitsWithAnyThreadsAndAfterARestart) {
    expectSameWithThreadsAndRestarts<Hertz, Linear, Hertz>();
    expectSameWithThreadsAndRestarts<Hertz, Wet, Rough>();
    expectSameWithThreadsAndRestarts<SmoothWet, Rolling, SmoothWet>();
    expectSameWithThreadsAndRestarts<Attracting, Wet, Wet>();
}

TEST(SeveralSpecies, theLedgerKnowsTheLawsOfEachPair) {
    const auto scene = mixedBox<SmoothWet, Rolling, SmoothWet>();
    scene->keepEnergyLedger();
    scene->initialise();
    const EnergyLedger& ledger = scene->energyLedger();
    const double closed = ledger.closed();
    while (scene->getNumberOfTimeSteps() < 1500) scene->step();
    EXPECT_GT(ledger.plastic, 0);         // of the large ones
    EXPECT_GT(ledger.brokenAdhesion, 0);  // of the small ones
    EXPECT_GT(ledger.rolling, 0);
    EXPECT_NEAR(ledger.closed(), closed, 1e-13 * closed);  // 1500 sums, each of 1e-16

    Meetings<Simulation<Hertz, Rolling>> elastic;  // beside a plastic species that has no grains
    elastic.speciesHandler.copyAndAddObject(hertz());
    elastic.speciesHandler.copyAndAddObject(boxMaterial<Rolling>(0));
    elastic.meetings = {{0, 0, 0}};
    elastic.addMeetings(1e-6);
    elastic.keepEnergyLedger();
    run(elastic, 1500);
    EXPECT_EQ(elastic.energyLedger().plastic, 0);
    EXPECT_NE(elastic.energyLedger().stepError, 0);
}

TEST(SeveralSpecies, thePairIsTheSameFromEitherSideAndInEitherOrder) {
    const auto fieldsOf = [](bool wetFirst, int a, int b) {
        Simulation<Hertz, Wet> scene;
        auto& species = scene.speciesHandler;
        if (wetFirst) species.copyAndAddObject(boxMaterial<Wet>(0));
        species.copyAndAddObject(boxMaterial<Hertz>(1));
        if (!wetFirst) species.copyAndAddObject(boxMaterial<Wet>(0));
        species.setPairType<Wet>(species.getObject(0), species.getObject(1));
        scene.laws().mixAll();
        std::map<std::string, double> values;
        for (const FieldValue& f : scene.laws().fields(a, b)) values[std::string(f.name)] = f.value;
        return values;
    };
    const auto values = fieldsOf(false, 0, 1);
    EXPECT_EQ(fieldsOf(false, 1, 0), values);
    EXPECT_EQ(fieldsOf(true, 0, 1), values);
    EXPECT_EQ(values.at("effectiveElasticModulus"), 2 * 2e6 * 3e6 / 5e6);  // springs in series
    EXPECT_EQ(values.at("slidingFrictionCoefficient"), 0.5);               // of the one that has it
    EXPECT_EQ(values.at("liquidBridgeVolume"), 2e-12);
}

// A value that is set during a run holds from the next step on, also in a restart file.
TEST(SeveralSpecies, mayBeChangedInARun) {
    const support::TestFolder folder;
    const auto make = [] { return mixedBox<Hertz, Rough, Rough>(1, 2); };
    const auto frictionIn = [](const Scene& scene) {
        for (const FieldValue& field : scene.laws().fields(1, 1))
            if (field.name == "slidingFrictionCoefficient") return field.value;
        return unset;
    };
    const auto changed = make(), unchanged = make();
    run(*changed, 800);
    changed->speciesHandler.getObject(1)->set("slidingFrictionCoefficient", 0.05);
    run(*changed, 801);
    EXPECT_EQ(frictionIn(*changed), 0.05);
    changed->writeRestart(folder.path() / "changed.h5");
    for (const auto* scene : {&changed, &unchanged}) run(**scene, 1500);
    EXPECT_NE(hashOf(*changed), hashOf(*unchanged));
    const auto again = make();
    again->restartFrom(folder.path() / "changed.h5");
    again->initialise();
    EXPECT_EQ(frictionIn(*again), 0.05);
    run(*again, 1500);
    EXPECT_EQ(hashOf(*again), hashOf(*changed));
}

}  // namespace
}  // namespace pendular::severalSpeciesTest
