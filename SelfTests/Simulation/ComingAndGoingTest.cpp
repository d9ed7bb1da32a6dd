#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/GrainSizes.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Grains that are added, changed and removed during a run.

namespace pendular::comingAndGoingTest {
namespace {

using scenes::endOf;
using scenes::SettlingBox;
using support::contains;
using support::isOneSentence;
using support::TestFolder;

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
using Smooth = Species<LinearViscoelastic>;

/// A wet box in which grains fall from above and others are taken away, by the number of the step only.
class Flow : public SettlingBox<Wet> {
public:
    explicit Flow(int numberOfThreads = 1) : SettlingBox(4) {
        setNumberOfThreads(numberOfThreads);
        age = particleHandler.addColumn("age", "s");
        SphericalParticle grain;
        grain.setRadius(smallRadius);
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setPosition({-0.5 * width, 0.5 * width, 0.013});
        grain.fixParticle();
        lone = particleHandler.copyAndAddObject(grain).getId();
    }
    void actionsBeforeTimeStep() override {
        const std::size_t step = getNumberOfTimeSteps();
        if (step % 50 == 49) add(step);
        if (step % 70 == 69) remove(step);
        // A grain that gets the size that it has, whose force is summed again then: one beside the box, which
        // loses no partner.
        if (listsAlways) particleHandler.getObject(lone).setRadius(smallRadius);
        for (GrainReference grain : particleHandler) (*age)[grain.getId()] += getTimeStep();
    }
    [[nodiscard]] std::uint64_t hash() const { return stateHash(particleHandler.store()); }
    void steps(int count) {
        for (int k = 0; k < count; ++k) step();
    }

    bool listsAlways = false;
    std::optional<GrainColumnReference> age;
    std::size_t lone = 0;

private:
    void add(std::size_t step) {
        SphericalParticle grain;
        grain.setRadius(smallRadius);
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setPosition({0.25 * width * static_cast<double>(1 + step / 50 % 3), 0.5 * width, 0.0135});
        grain.setVelocity({0.1, 0, -1});
        grain.setAngularVelocity({0, 30, 0});
        bool isFree = true;
        for (GrainReference other : particleHandler)
            isFree &= (other.getPosition() - grain.getPosition()).norm() > other.getRadius() + smallRadius;
        if (isFree) particleHandler.copyAndAddObject(grain);
    }
    void remove(std::size_t step) {
        std::size_t nth = step % particleHandler.getSize();
        for (GrainReference grain : particleHandler)
            if (nth-- == 0 && grain.getId() != lone) return particleHandler.removeObject(grain.getId());
    }
};

TEST(ComingAndGoing, givesTheSameBitsForAnyThreadsAndLists) {
    Flow one;
    one.initialise();
    one.steps(1200);
    EXPECT_GT(one.particleHandler.store().nextIdentity(), 65u + 10u);
    EXPECT_LT(one.particleHandler.getSize(), one.particleHandler.store().nextIdentity() - 10u);
    for (const int threads : {2, 3}) {
        Flow several(threads);
        several.initialise();
        several.steps(300);
        Flow alone;
        alone.initialise();
        alone.steps(300);
        EXPECT_EQ(several.hash(), alone.hash()) << threads;
    }
    Flow always;
    always.listsAlways = true;
    always.initialise();
    always.steps(1200);
    EXPECT_GT(always.contacts().rebuildCount(), 1200u);
    EXPECT_LT(one.contacts().rebuildCount(), 400u);
    EXPECT_EQ(always.hash(), one.hash());
}

TEST(ComingAndGoing, goesOnAfterARestartBitForBit) {
    const TestFolder folder;
    const auto file = [&](const char* name) { return folder.path() / name; };
    for (const int middle : {0, 69, 500}) {
        Flow whole;
        whole.initialise();
        whole.steps(middle);
        whole.writeRestart(file("half.h5"));
        whole.steps(800 - middle);
        whole.writeRestart(file("whole.h5"));
        Flow restarted;
        restarted.restartFrom(file("half.h5"));
        restarted.initialise();
        restarted.writeRestart(file("again.h5"));
        support::expectSameState(file("half.h5"), file("again.h5"));
        restarted.steps(800 - middle);
        restarted.writeRestart(file("restarted.h5"));
        support::expectSameState(file("whole.h5"), file("restarted.h5"));
    }
}

TEST(ComingAndGoing, aColumnFollowsItsGrains) {
    Flow flow;
    flow.initialise();
    flow.steps(400);
    // A grain's age is the time since it came: those of the start have the time of the run.
    for (GrainReference grain : flow.particleHandler) {
        const double age = (*flow.age)[grain.getId()];
        if (grain.getId() <= flow.lone) {
            EXPECT_NEAR(age, flow.getTime(), 1e-12);
        } else {
            EXPECT_LT(age, flow.getTime() - 49 * flow.getTimeStep() + 1e-12);
        }
    }
    EXPECT_TRUE(isOneSentence(support::refusal([&] { flow.particleHandler.addColumn("age", "s"); })));
    EXPECT_TRUE(isOneSentence(support::refusal([&] { flow.particleHandler.addColumn("a b", "s"); })));
}

Smooth smooth(double stiffness = 1000) {
    Smooth species;
    species.setDensity(2000);
    species.setStiffness(stiffness);
    species.setDissipation(0);
    return species;
}
constexpr double r = 1e-3;     // m
constexpr double step = 1e-6;  // s

template <class S>
using Hooked = scenes::HookedGrains<S>;

// Two grains that press on a third between them; without it they move on with what they have, freely.
TEST(ComingAndGoing, theContactsOfARemovedGrainEnd) {
    Hooked<Smooth> scene(smooth(), {{.position = {-1.96 * r, 0, 0}}, {}, {.position = {1.96 * r, 0, 0}}},
                         step);
    scene.initialise();
    for (int k = 0; k < 10; ++k) scene.step();
    EXPECT_GT(scene.particleHandler.getObject(2).getForce().x(), 0);
    scene.particleHandler.removeObject(1);
    for (int k = 0; k < 2; ++k) scene.step();
    EXPECT_EQ(scene.particleHandler.getSize(), 2u);
    for (const std::size_t k : {0, 2})
        EXPECT_EQ(scene.particleHandler.getObject(k).getForce(), Vec3D(0, 0, 0));
    const std::string text = support::refusal([&] { (void)scene.particleHandler.getObject(1); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "Particle 1 was removed"));
    EXPECT_TRUE(isOneSentence(support::refusal([&] { scene.particleHandler.removeObject(1); })));
    EXPECT_TRUE(isOneSentence(support::refusal([&] { scene.particleHandler.removeObject(7); })));
    // Its number is not given again.
    EXPECT_EQ(scene.particleHandler.copyAndAddObject(scene.grain(r, {0, 1, 0})).getId(), 3u);
}

// A step of velocity Verlet moves by h v + h^2 a / 2. A grain beside a falling one that comes and goes far
// away has no influence on a bit of it.
TEST(ComingAndGoing, ofFarGrainsChangesNothing) {
    const std::vector<scenes::GrainMotion> pair{{}, {.position = {1.99 * r, 0, 0}}};
    Hooked<Smooth> alone(smooth(), pair, step), visited(smooth(), pair, step);
    visited.hook = [](Hooked<Smooth>& scene) {
        const std::size_t n = scene.getNumberOfTimeSteps();
        scene.particleHandler.copyAndAddObject(scene.grain(r, {0.1, 3 * r * static_cast<double>(n % 10), 0}));
        if (n >= 10) scene.particleHandler.removeObject(n - 10 + 2);
    };
    alone.run(500);
    visited.run(500);
    for (const std::size_t k : {0, 1}) {
        EXPECT_EQ(alone.motion(k).position, visited.motion(k).position);
        EXPECT_EQ(alone.motion(k).velocity, visited.motion(k).velocity);
    }
    EXPECT_EQ(visited.particleHandler.getSize(), 12u);
    EXPECT_LT(visited.contacts().rebuildCount(), 20u);  // most came without a list of their own
    EXPECT_LT(visited.particleHandler.store().size(), 600u);
}

// Memory follows the grains that there are, not those that there have been.
TEST(ComingAndGoing, doesNotGrow) {
    Hooked<Smooth> scene(smooth(), {}, step);
    scene.setGravity({0, 0, -1000});  // so that lists are made
    scene.hook = [](Hooked<Smooth>& s) {
        const std::size_t n = s.getNumberOfTimeSteps();
        s.particleHandler.copyAndAddObject(s.grain(r, {3 * r * static_cast<double>(n % 100), 0, 0}));
        if (n >= 100) s.particleHandler.removeObject(n - 100);
    };
    scene.initialise();
    std::size_t bytesThen = 0;
    for (int k = 0; k < 30000; ++k) {
        scene.step();
        if (k == 10000) bytesThen = scene.particleHandler.store().bytes() + scene.contacts().bytes();
    }
    EXPECT_EQ(scene.particleHandler.getSize(), 100u);
    // Besides gaps until the next list: some bytes for each thousand of grains that are gone.
    EXPECT_LT(scene.particleHandler.store().bytes() + scene.contacts().bytes(), 2 * bytesThen + 4096);
}

TEST(ComingAndGoing, aSceneMayBeginWithoutGrains) {
    Hooked<Smooth> scene(smooth(), {}, step, {{{0, 0, -1}, {0, 0, 0}}});
    scene.hook = [](Hooked<Smooth>& s) {
        if (s.getNumberOfTimeSteps() == 3) s.particleHandler.copyAndAddObject(s.grain(r, {0, 0, 0.99 * r}));
        if (s.getNumberOfTimeSteps() == 6)
            s.particleHandler.copyAndAddObject(s.grain(0.9 * r, {0, 0, 5 * r}));
    };
    scene.run(20);
    EXPECT_EQ(scene.particleHandler.getSize(), 2u);
    EXPECT_GT(scene.particleHandler.getObject(0).getForce().z(), 0);
}

// A hook may add a grain and take it away again at once, with another one behind it, and with an integrator
// that remembers the step before the last.
TEST(ComingAndGoing, mayHappenInOneHook) {
    for (const Integrator& scheme : {integrators::predictedVelocityVerlet, integrators::adamsMoulton}) {
        Hooked<Smooth> scene(smooth(), {}, step);
        scene.setIntegrator(scheme);
        scene.setGravity({0, 0, -9.81});
        scene.hook = [](Hooked<Smooth>& s) {
            if (s.getNumberOfTimeSteps() % 5 != 0) return;
            const double x = 3 * r * static_cast<double>(s.getNumberOfTimeSteps());
            const auto first = s.particleHandler.copyAndAddObject(s.grain(r, {x, 0, 0}));
            s.particleHandler.copyAndAddObject(s.grain(r, {x, 3 * r, 0}));
            s.particleHandler.removeObject(first.getId());
        };
        scene.run(50);
        EXPECT_EQ(scene.particleHandler.getSize(), 10u);
        // Each falls freely: v = -g t for the steps since it came, the first of which has no acceleration
        // yet.
        for (GrainReference grain : scene.particleHandler)
            EXPECT_LT(grain.getVelocity().z(), 0.1 * -9.81 * step);
    }
}

// The ledger has what grains bring and take, and their contacts, as given by the driver.
TEST(ComingAndGoing, isInTheLedgerOfTheEnergy) {
    Hooked<Smooth> scene(smooth(), {{.position = {-1.96 * r, 0, 0}}, {}, {.position = {1.96 * r, 0, 0}}},
                         step);
    scene.keepEnergyLedger();
    scene.run(5);
    const double before = scene.energyLedger().elastic;
    // 1/2 k d^2 for both contacts, of which a little has gone into motion.
    EXPECT_NEAR((before + scene.energyLedger().kinetic) / (1000 * 0.04 * r * 0.04 * r), 1, 1e-6);
    EXPECT_GT(before, 0.99 * 1000 * 0.04 * r * 0.04 * r);
    EXPECT_NEAR(scene.energyUnaccountedFor(), 0, 1e-6 * before);
    scene.particleHandler.removeObject(1);
    for (int k = 0; k < 100; ++k) scene.step();
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_EQ(ledger.elastic, 0);
    EXPECT_NEAR(ledger.driver / before, -1, 0.01);
    // The force of the last step still acts for half a step: 1/2 h F v, with v = F h n / m after n steps.
    const double force = 1000 * 0.04 * r, mass = scene.particleHandler.getObject(0).getMass();
    EXPECT_NEAR(scene.energyUnaccountedFor(), 0, 2 * 0.5 * step * force * (force * 6 * step / mass));
}

// ---- What set-up refuses is refused in a run, with the same sentence.

Hooked<Smooth> twoGrains(double timeStep = step) {
    return {smooth(), {{}, {.position = {3 * r, 0, 0}}}, timeStep};
}

TEST(ChangeInARun, aGrainTooSmallForTheTimeStepIsRefused) {
    const double limit = [] { return twoGrains().stabilityLimit(); }();
    auto scene = std::make_unique<Hooked<Smooth>>(
        smooth(), std::vector<scenes::GrainMotion>{{}, {.position = {3 * r, 0, 0}}}, 0.9 * limit);
    const std::string text = endOf<Smooth>(*scene, [](auto& s) {
        s.particleHandler.copyAndAddObject(s.grain(r / 20, {0, 5 * r, 0}));
    });
    EXPECT_TRUE(contains(text, "is above the stability limit")) << text;
    EXPECT_TRUE(contains(text, "acceptUnstableTimeStep()")) << text;
    // The limit can be asked for before: k/m* grows by 20^3 for the small one against a large one, or
    // another.
    std::vector<SphericalParticle> toCome{scene->grain(r / 20, {0, 0, 0})};
    EXPECT_LT(scene->stabilityLimit(toCome), 0.05 * limit);
    EXPECT_GT(scene->stabilityLimit(toCome), 0);
}

TEST(ChangeInARun, overlapsOfGrainsAndWallsThatCameLaterAreRefused) {
    auto scene = std::make_unique<Hooked<Smooth>>(
        smooth(), std::vector<scenes::GrainMotion>{{}, {.position = {3 * r, 0, 0}}}, step);
    std::string text = endOf<Smooth>(*scene, [](auto& s) {
        s.particleHandler.copyAndAddObject(s.grain(r, {0, 1.8 * r, 0}));
    });
    EXPECT_TRUE(contains(text, "particle 0 and particle 2: initial overlap = 0.0002 m is 20 %")) << text;

    Hooked<Smooth> moved(smooth(), {{}, {.position = {3 * r, 0, 0}}}, step);
    text = endOf<Smooth>(moved, [](auto& s) { s.particleHandler.getObject(1).setPosition({1.8 * r, 0, 0}); });
    EXPECT_TRUE(contains(text, "initial overlap")) << text;

    Hooked<Smooth> walled(smooth(), {{}, {.position = {3 * r, 0, 0}}}, step);
    text = endOf<Smooth>(walled, [](auto& s) {
        InfiniteWall wall;
        wall.setSpecies(s.speciesHandler.getObject(0));
        wall.set({0, 0, -1}, {0, 0, -0.8 * r});
        s.wallHandler.copyAndAddObject(wall);
    });
    EXPECT_TRUE(contains(text, "wall 0: initial overlap = 0.0002 m is 20 %")) << text;
}

TEST(ChangeInARun, aGrainTooLargeForThePeriodIsRefused) {
    Hooked<Smooth> scene(smooth(), {{}, {.position = {3 * r, 0, 0}}}, step);
    scene.setPeriodic(0, 0, 10 * r);
    const std::string text = endOf<Smooth>(scene, [](auto& s) {
        s.particleHandler.copyAndAddObject(s.grain(3 * r, {0, 30 * r, 0}));
    });
    EXPECT_TRUE(contains(text, "periodic length along x")) << text;
}

TEST(ChangeInARun, whatCanOnlyBeSetUpIsRefused) {
    for (const auto& action : std::vector<std::function<void(Hooked<Smooth>&)>>{
             [](auto& s) { s.setPeriodic(0, 0, 1); },
             [](auto& s) { s.setIntegrator(integrators::velocityVerlet); },
             [](auto& s) { s.keepEnergyLedger(); },
             [](auto& s) {
                 dynamic_cast<InfiniteWall&>(s.wallHandler.getObject(0)).set({0, 0, -1}, {0, 0, 0});
             }}) {
        Hooked<Smooth> scene(smooth(), {{.position = {0, 0, 1}}}, step, {{{0, 0, -1}, {0, 0, 0}}});
        const std::string text = endOf<Smooth>(scene, action);
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, "run"));
    }
}

TEST(ChangeInARun, aTimeStepThatIsSetGoesOnFromTheTimeThatItIs) {
    Hooked<Smooth> scene(smooth(), {{.velocity = {1, 0, 0}}}, step);
    scene.run(1000);
    EXPECT_EQ(scene.getTime(), 1000 * step);
    scene.setTimeStep(0.5 * step);
    EXPECT_EQ(scene.getTime(), 1000 * step);
    for (int k = 0; k < 1000; ++k) scene.step();
    EXPECT_NEAR(scene.getTime(), 1500 * step, 1e-18);
    EXPECT_NEAR(scene.motion(0).position.x(), 1500 * step, 1e-15);
    // This goes in solve(), too, with a new end.
    Hooked<Smooth> solved(smooth(), {{.velocity = {1, 0, 0}}}, step);
    EXPECT_EQ(endOf<Smooth>(solved, [](auto& s) { s.setTimeStep(0.25 * step), s.setTimeMax(10 * step); }),
              "");
    EXPECT_NEAR(solved.getTime(), 10 * step, 1e-18);
    EXPECT_EQ(solved.getNumberOfTimeSteps(), 5u + 20u);
    // And one above the limit is refused.
    Hooked<Smooth> tooLarge(smooth(), {{}, {.position = {3 * r, 0, 0}}}, step);
    EXPECT_TRUE(contains(endOf<Smooth>(tooLarge, [](auto& s) { s.setTimeStep(1); }), "stability limit"));
}

TEST(ChangeInARun, ofASpeciesHoldsFromTheNextStepOn) {
    // Overlapping grains: the force is k d.
    Hooked<Smooth> scene(smooth(), {{.fixed = true}, {.position = {1.99 * r, 0, 0}}}, 1e-9);
    scene.initialise();
    scene.step();
    const double before = scene.particleHandler.getObject(1).getForce().x();
    scene.speciesHandler.getObject(0)->setStiffness(2000);
    scene.step();
    EXPECT_NEAR(scene.particleHandler.getObject(1).getForce().x() / before, 2, 1e-6);
    // Density: the mass follows.
    const double mass = scene.particleHandler.getObject(1).getMass();
    scene.speciesHandler.getObject(0)->setDensity(4000);
    scene.step();
    EXPECT_NEAR(scene.particleHandler.getObject(1).getMass() / mass, 2, 1e-12);
    // What set-up refuses.
    Hooked<Smooth> stiff(smooth(), {{}, {.position = {3 * r, 0, 0}}}, step);
    EXPECT_TRUE(
        contains(endOf<Smooth>(stiff, [](auto& s) { s.speciesHandler.getObject(0)->setStiffness(1e12); }),
                 "stability limit"));
}

Wet wet() {
    Wet species = scenes::boxMaterial<Wet>(0);
    return species;
}

// A bridge that is stretched has the force of the new surface tension: it is proportional to it.
TEST(ChangeInARun, ofTheSurfaceTensionReachesBridgesThatThereAre) {
    Hooked<Wet> scene(wet(), {{.fixed = true}, {.position = {1.9999 * r, 0, 0}}}, 1e-9);
    scene.initialise();
    scene.step();
    scene.particleHandler.getObject(1).setPosition({2.05 * r, 0, 0});
    scene.step();
    scene.particleHandler.getObject(1).setVelocity(Vec3D::Zero());
    scene.step();
    const double before = scene.particleHandler.getObject(1).getForce().x();
    EXPECT_LT(before, 0);
    scene.speciesHandler.getObject(0)->setSurfaceTension(0.035);
    scene.step();
    EXPECT_NEAR(scene.particleHandler.getObject(1).getForce().x() / before, 0.5, 1e-5);
}

TEST(ChangeInARun, ofARadiusTakesTheMassWithIt) {
    Hooked<Smooth> scene(smooth(), {{.fixed = true}, {.position = {2.01 * r, 0, 0}}}, 1e-9);
    scene.initialise();
    scene.step();
    const double mass = scene.particleHandler.getObject(1).getMass();
    scene.particleHandler.getObject(1).setRadius(1.02 * r);
    for (int k = 0; k < 2; ++k) scene.step();  // the first one stands for the start of the touch
    EXPECT_NEAR(scene.particleHandler.getObject(1).getMass() / mass, 1.02 * 1.02 * 1.02, 1e-12);
    EXPECT_NEAR(scene.particleHandler.getObject(1).getForce().x() / (1000 * 0.01 * r), 1, 1e-6);
    // Held, and let go.
    scene.particleHandler.getObject(1).fixParticle();
    for (int k = 0; k < 10; ++k) scene.step();
    const Vec3D held = scene.motion(1).position;
    for (int k = 0; k < 10; ++k) scene.step();
    EXPECT_EQ(scene.motion(1).position, held);
    scene.particleHandler.getObject(1).fixParticle(false);
    for (int k = 0; k < 10; ++k) scene.step();
    EXPECT_GT(scene.motion(1).position.x(), held.x());
}

TEST(ChangeInARun, survivesARestart) {
    const TestFolder folder;
    const auto make = [] {
        return std::make_unique<Hooked<Wet>>(
            wet(), std::vector<scenes::GrainMotion>{{}, {.position = {1.99 * r, 0, 0}}}, 1e-6);
    };
    auto whole = make();
    whole->run(10);
    whole->speciesHandler.getObject(0)->setSurfaceTension(0.03);
    whole->setTimeStep(0.5e-6);
    for (int k = 0; k < 10; ++k) whole->step();
    whole->writeRestart(folder.path() / "half.h5");
    for (int k = 0; k < 50; ++k) whole->step();
    auto again = make();
    again->restartFrom(folder.path() / "half.h5");
    again->initialise();
    EXPECT_EQ(again->speciesHandler.getObject(0)->getSurfaceTension(), 0.03);
    EXPECT_EQ(again->getTimeStep(), 0.5e-6);
    for (int k = 0; k < 50; ++k) again->step();
    EXPECT_EQ(again->getTime(), whole->getTime());
    EXPECT_EQ(stateHash(again->particleHandler.store()), stateHash(whole->particleHandler.store()));
}

// A restart file between a change and the next step: it is that of a run in which both have happened.
TEST(ChangeInARun, isInARestartFileThatIsWrittenAtOnce) {
    const TestFolder folder;
    const std::vector<scenes::GrainMotion> grains{
        {}, {.position = {1.99 * r, 0, 0}}, {.position = {0, 5 * r, 0}}};
    const auto make = [&] { return std::make_unique<Hooked<Wet>>(wet(), grains, 1e-6); };
    for (const auto& change : std::vector<std::function<void(Hooked<Wet>&)>>{
             [](auto& s) {
                 s.particleHandler.getObject(1).setPosition({50 * r, 0, 0});
             },
             [](auto& s) { s.particleHandler.getObject(1).setRadius(1.005 * r); },
             [](auto& s) { s.particleHandler.getObject(1).fixParticle(); },
             [](auto& s) { s.particleHandler.removeObject(0); },
             [](auto& s) { s.speciesHandler.getObject(0)->setSurfaceTension(0.03); }}) {
        auto whole = make(), again = make();
        whole->run(20);
        change(*whole);
        whole->writeRestart(folder.path() / "changed.h5");
        for (int k = 0; k < 50; ++k) whole->step();
        again->restartFrom(folder.path() / "changed.h5");
        again->initialise();
        for (int k = 0; k < 50; ++k) again->step();
        EXPECT_EQ(stateHash(again->particleHandler.store()), stateHash(whole->particleHandler.store()));
    }
}

// ---- Walls

TEST(WallsInARun, withAMotionBeginItWhereTheyAre) {
    for (const bool byFunction : {false, true}) {
        Hooked<Smooth> scene(smooth(), {{}}, step);
        scene.run(1000);
        InfiniteWall wall;
        wall.setSpecies(scene.speciesHandler.getObject(0));
        wall.set({0, 0, -1}, {0, 0, -2 * r});
        if (byFunction)
            wall.setMotion([](double time) {
                Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
                pose.translation().z() = 0.5 * time;
                return pose;
            });
        else wall.setVelocity({0, 0, 0.5});
        InfiniteWall* added = scene.wallHandler.copyAndAddObject(wall);
        EXPECT_NEAR(added->getPose().shift.z, 0, 1e-18);
        for (int k = 0; k < 100; ++k) scene.step();
        EXPECT_NEAR(added->getPose().shift.z, 0.5 * 100 * step, 1e-15);
    }
}

TEST(WallsInARun, areRemovedWithTheirContacts) {
    Hooked<Smooth> scene(smooth(), {{.position = {0, 0, 0.99 * r}}, {.position = {0, 3 * r, 0.99 * r}}}, step,
                         {{{0, 0, -1}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, 1}}});
    scene.keepEnergyLedger();
    scene.run(5);
    EXPECT_GT(scene.particleHandler.getObject(0).getForce().z(), 0);
    scene.wallHandler.removeObject(0);
    for (int k = 0; k < 2; ++k) scene.step();
    EXPECT_EQ(scene.particleHandler.getObject(0).getForce(), Vec3D(0, 0, 0));
    EXPECT_EQ(scene.wallHandler.getSize(), 2u);
    EXPECT_TRUE(isOneSentence(support::refusal([&] { scene.wallHandler.removeObject(0); })));
    EXPECT_TRUE(isOneSentence(support::refusal([&] { scene.wallHandler.removeObject(5); })));
    // All of them, and another: as many as before, and another wall.
    scene.wallHandler.clear();
    for (const double z : {-5 * r, -6 * r}) {
        InfiniteWall wall;
        wall.setSpecies(scene.speciesHandler.getObject(0));
        wall.set({0, 0, -1}, {0, 0, z});
        scene.wallHandler.copyAndAddObject(wall);
    }
    for (int k = 0; k < 2; ++k) scene.step();
    EXPECT_EQ(scene.particleHandler.getObject(0).getForce(), Vec3D(0, 0, 0));
}

// A pair of two grains of a size occurs only where there are two of this size.
TEST(SceneCheck, looksAtPairsThatCanOccur) {
    SizeRange sizes;
    sizes.add(3);
    EXPECT_EQ(sizes.count, 1u);
    sizes.add(1);
    EXPECT_EQ(sizes.partnersOf(1), (std::array<double, 2>{3, 3}));
    EXPECT_EQ(sizes.partnersOf(3), (std::array<double, 2>{1, 1}));
    sizes.add(2);
    EXPECT_EQ(sizes.partnersOf(1), (std::array<double, 2>{2, 3}));
    sizes.add(1);
    EXPECT_EQ(sizes.partnersOf(1), (std::array<double, 2>{1, 3}));
    EXPECT_TRUE(sizes.holds(1) && sizes.holds(2) && !sizes.holds(3) && !sizes.holds(0.5));
}

}  // namespace
}  // namespace pendular::comingAndGoingTest
