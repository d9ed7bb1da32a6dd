#include "Kernel/Scene/TimeStep/StepForError.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "Kernel/Features/Laws.h"
#include "Kernel/Foundation/Base/Host.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::stepForErrorTest {
namespace {

using scenes::FewGrains;
using support::contains;
using support::isOneSentence;
using support::refusal;

constexpr double radius = 1e-3, density = 2500, speed = 0.2, restitution = 0.5;  // m, kg/m^3, m/s, 1
const double massOfGrain = 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;

LinearViscoelasticSpecies linear() {
    LinearViscoelasticSpecies species;
    species.setDensity(density);
    species.setStiffnessAndRestitutionCoefficient(1e4, restitution, massOfGrain);
    return species;
}
HertzianViscoelasticMindlinSpecies hertz() {
    HertzianViscoelasticMindlinSpecies species;
    species.setDensity(density);
    species.setElasticModulusAndPoissonRatio(5e6, 0.25);
    species.setEffectiveShearModulus(computeEffectiveShearModulus(5e6, 0.25));
    species.setSlidingFrictionCoefficient(0.5);
    species.setRestitutionCoefficient(restitution);
    return species;
}

/// Two grains a gap (m) from each other, which meet at the speed above.
template <class S>
struct TwoGrains : FewGrains<S> {
    explicit TwoGrains(const S& species, double gap = 1e-3)
        : FewGrains<S>(species,
                       {{.position = {-radius - gap / 2, 0, 0}, .velocity = {speed / 2, 0, 0}},
                        {.position = {radius + gap / 2, 0, 0}, .velocity = {-speed / 2, 0, 0}}},
                       1e-7) {
        this->setQuiet();
    }
};

/// The same, and more far away: the stability limit is that of a bed.
struct ManyGrains : TwoGrains<HertzianViscoelasticMindlinSpecies> {
    ManyGrains() : TwoGrains(hertz()) {
        for (int k = 0; k < 20; ++k) {
            SphericalParticle grain(speciesHandler.getLastObject());
            grain.setRadius(radius);
            grain.setPosition({0, 0.1 + 0.01 * k, 0});
            particleHandler.copyAndAddObject(grain);
        }
    }
};

/// The largest error of the coefficient of restitution of the closed form, over beginnings of the touch.
double errorOfRebound(double step, const Integrator& integrator) {
    double largest = 0;
    for (int k = 0; k < 40; ++k) {
        TwoGrains<LinearViscoelasticSpecies> scene(linear(), (2 + k / 40.0) * step * speed);
        scene.setIntegrator(integrator);
        scene.acceptUnstableTimeStep();
        scene.setTimeStep(step);
        scene.initialise();
        while (scene.getTime() < 1e-3) scene.step();  // a contact takes some 8e-5 s
        const double parting = scene.particleHandler.getObject(1).getVelocity().x() -
                               scene.particleHandler.getObject(0).getVelocity().x();
        largest = std::max(largest, std::abs(parting / speed - restitution));
    }
    return largest;
}

// Against e of the closed form. It is looked at between the steps that were looked at as well, and the errors
// of neighbouring lengths of the step differ by less than half of the error.
TEST(StepForError, keepsToTheErrorThatIsAskedFor) {
    for (const Integrator& integrator : {integrators::predictedVelocityVerlet, integrators::velocityVerlet})
        for (const double asked : {0.05, 0.01, 0.003}) {
            TwoGrains<LinearViscoelasticSpecies> scene(linear());
            scene.setIntegrator(integrator);
            const StepForError found = scene.stepForError(asked, speed);
            EXPECT_LE(found.largest, asked);
            EXPECT_LE(errorOfRebound(found.step, integrator), 1.5 * asked) << integrator.name << asked;
            // A step that is twice as long and more is not as exact.
            EXPECT_GT(errorOfRebound(2.5 * found.byCollisions, integrator), asked)
                << integrator.name << asked;
        }
}

// 10 steps a contact give 1 %, and 26 give 0.1 %, of head-on collisions (Kernel/Core/Motion/README.md, found
// by another program); the step is one of a ladder of 1.25, and the last of its rung.
TEST(StepForError, isThatOfTheChartOfCollisions) {
    TwoGrains<LinearViscoelasticSpecies> scene(linear());
    const double contact = linearContactTime(1e4, linear().getDissipation(), massOfGrain / 2);
    EXPECT_NEAR(contact / scene.stepForError(0.01, speed).byCollisions, 10, 3);
    EXPECT_NEAR(contact / scene.stepForError(0.001, speed).byCollisions, 26, 8);
}

TEST(StepForError, isNotLongerThanBedsStand) {
    ManyGrains scene;
    const double ofFastest = 0.9 * scene.shortestContactTime() / std::numbers::pi;
    const StepForError loose = scene.stepForError(0.1, speed);
    EXPECT_DOUBLE_EQ(loose.step, std::min(ofFastest, loose.byCollisions));
    EXPECT_GT(loose.step, scene.stabilityLimit());
    EXPECT_LE(scene.stepForError(0.009, speed).step, scene.stabilityLimit());
    scene.setIntegrator(integrators::velocityVerlet);
    EXPECT_DOUBLE_EQ(scene.stepForError(0.1, speed).byBeds, ofFastest / 2);
    scene.setIntegrator(integrators::adamsMoulton);
    EXPECT_LE(scene.stepForError(0.1, speed).step, scene.stabilityLimit());
}

// Their laws are those of the scene, which must not be touched by the collisions.
TEST(StepForError, leavesTheSceneAsItIs) {
    const auto run = [](auto choose) {
        ManyGrains scene;
        choose(scene);
        scene.initialise();
        for (int k = 0; k < 2000; ++k) scene.step();
        return scene.particleHandler.getObject(0).getVelocity();
    };
    double step = 0;
    const Vec3D chosen = run([&](auto& scene) {
        scene.setStepFor(0.05, speed);
        step = scene.getTimeStep();
        EXPECT_EQ(step, scene.getStepForError()->step);
        EXPECT_TRUE(scene.acceptsUnstableTimeStep());
    });
    const Vec3D given = run([&](auto& scene) {
        scene.setTimeStep(step);
        scene.acceptUnstableTimeStep();
    });
    EXPECT_EQ(chosen, given);
    EXPECT_LT(chosen.x(), 0);  // it has met the other
}

// The speed of a fall through the height of the grains is that of a collision.
TEST(StepForError, takesTheSpeedOfTheScene) {
    TwoGrains<HertzianViscoelasticMindlinSpecies> scene(hertz());
    EXPECT_NEAR(scene.stepForError(0.1).speed, speed / 2, 1e-12);  // the largest of a grain
    for (std::size_t k = 0; k < 2; ++k) scene.particleHandler.getObject(k).setVelocity(Vec3D::Zero());
    const std::string sentence = refusal([&] { (void)scene.stepForError(0.1); });
    EXPECT_TRUE(isOneSentence(sentence));
    EXPECT_TRUE(contains(sentence, "at rest"));
}

// Grains of 10 um radius that a neck holds: they stay together below some 15 mm/s.
TEST(StepForError, standsGrainsThatStayTogether) {
    HertzianViscoelasticJKRSpecies species;
    species.setDensity(density);
    species.setElasticModulusAndPoissonRatio(1e9, 0.25);
    species.setRestitutionCoefficient(0.9);
    species.setWorkOfAdhesion(0.05);
    species.setAdhesionModulus(species.getEffectiveElasticModulus());
    Simulation<HertzianViscoelasticJKRSpecies> scene;
    scene.setQuiet();
    const auto* added = scene.speciesHandler.copyAndAddObject(species);
    for (const double x : {0.0, 1e-4}) {
        SphericalParticle grain(added);
        grain.setRadius(1e-5);
        grain.setPosition({x, 0, 0});
        scene.particleHandler.copyAndAddObject(grain);
    }
    const StepForError slow = scene.stepForError(0.01, 1e-3), fast = scene.stepForError(0.01, 1);
    EXPECT_TRUE(slow.together);
    EXPECT_FALSE(fast.together);
    EXPECT_LE(fast.largest, 0.01);
}

// A bridge that reaches far: grains leave it at 0.21 m/s, long after the touch. (With a cap on the time they
// counted as staying together.)
TEST(StepForError, waitsUntilALongBridgeIsDrawnOut) {
    HertzianViscoelasticLiquidBridgeWillettSpecies species;
    species.setDensity(density);
    species.setElasticModulusAndPoissonRatio(1e9, 0.25);
    species.setRestitutionCoefficient(0.3);
    species.setLiquidBridgeVolume(2e-10);
    species.setContactAngle(0.2);
    species.setSurfaceTension(0.07);
    TwoGrains<HertzianViscoelasticLiquidBridgeWillettSpecies> scene(species);
    const StepForError found = scene.stepForError(0.03, 1);
    EXPECT_FALSE(found.together);
    EXPECT_GT(found.largest, 0);
    EXPECT_LE(found.largest, 0.03);
}

/// What is found for two grains that creep: they are overdamped, or sinter.
template <class S>
void expectTheLimit(const char* name, const S& species, bool together) {
    TwoGrains<S> scene(species);
    const StepForError found = scene.stepForError(0.02, speed);
    // Each exact collision, of four, ends after a hundred touches of 2000 steps, and the way to the touch is
    // a few steps. (Friction makes a touch of the normal up to sqrt(7/2) times as long as the half period
    // that is resolved.) At other angles they may part: as much again and again for other steps.
    const std::size_t exact = 4 * 102 * 2000 * 19 / 10;
    EXPECT_LE(found.steps, together ? exact : 3 * exact) << name;
    EXPECT_GT(found.steps, 0u) << name;
    EXPECT_GT(found.step, 0) << name;
    EXPECT_LE(found.step, found.limit) << name;
    EXPECT_EQ(found.limit, scene.stabilityLimit()) << name;
    EXPECT_EQ(found.known, !together) << name;
    EXPECT_EQ(found.together, together) << name;
    ASSERT_TRUE(found.creeping) << name;
    EXPECT_FALSE(found.creeping->atWall) << name;
    EXPECT_TRUE(contains(found.text(), "species 0 with species 0 creep")) << found.text();
    EXPECT_EQ(contains(found.text(), "error is not known"), together) << found.text();
}

// Bodies that neither part nor are drawn back have no end of their collision: these took minutes, or for
// ever.
TEST(HeavyStepForError, endsWhereBodiesCreep) {
    HertzianViscoelasticMindlinSpecies dashpots = hertz();
    dashpots.setDissipation(5 * std::sqrt(5.0));  // of which sqrt(5) is critical; they part at 75 degrees
    expectTheLimit("Hertz, 5 times critical", dashpots, false);

    LinearViscoelasticSpecies springs = linear();
    springs.setDissipation(3 * std::sqrt(2 * 1e4 * massOfGrain));  // of which the root is critical
    expectTheLimit("linear, 3 times critical", springs, false);

    Species<Sinter, NoFriction, NoAdhesion> sinter;
    sinter.setDensity(density);
    sinter.setStiffnessAndRestitutionCoefficient(1e3, restitution, massOfGrain);
    sinter.setUnloadingStiffnessMax(5e3), sinter.setCohesionStiffness(1e3);
    sinter.setPenetrationDepthMax(0.1);
    sinter.setSinterAdhesion(0.1), sinter.setSinterRate(100);
    sinter.setSinterType(SinterType::GrainBoundaryDiffusion);
    expectTheLimit("Sinter", sinter, true);

    HertzianViscoelasticParhamiMcMeekingSinterSpecies necks;
    necks.setDensity(density);
    necks.setEffectiveElasticModulus(5e6), necks.setDissipation(0.5);
    necks.setAdhesionCoefficient(1), necks.setViscosityCoefficient(1e16);
    necks.setSlidingViscosityCoefficient(1e12);
    expectTheLimit("ParhamiMcMeekingSinter", necks, true);
}

// At a wall, and in the log: setStepFor() takes the step.
TEST(HeavyStepForError, setsTheLimitWhereBodiesCreepAtAWall) {
    HertzianViscoelasticMindlinSpecies dashpots = hertz();
    dashpots.setDissipation(20 * std::sqrt(5.0));
    FewGrains<HertzianViscoelasticMindlinSpecies> scene(dashpots, {{.position = {0, 0, 1.1 * radius}}}, 1e-7,
                                                        {{{0, 0, -1}, {0, 0, 0}}});
    scene.setQuiet();
    scene.setStepFor(0.1, 1e-3);
    EXPECT_LE(scene.getTimeStep(), scene.stabilityLimit());
    EXPECT_FALSE(scene.acceptsUnstableTimeStep());
    ASSERT_TRUE(scene.getStepForError() && scene.getStepForError()->creeping);
}

/// Two grains of a soft species and two of one that is 1e7 times as stiff.
struct SoftAndStiff : Simulation<LinearViscoelasticSpecies> {
    static constexpr double softest = 1, stiffest = 1e7;  // N/m
    /// @param dissipationOf (N/m) kg/s
    explicit SoftAndStiff(const std::function<double(double)>& dissipationOf) {
        setQuiet();
        for (const double stiffness : {softest, stiffest}) {
            LinearViscoelasticSpecies species;
            species.setDensity(density);
            species.setStiffness(stiffness);
            species.setDissipation(dissipationOf(stiffness));
            const auto* added = speciesHandler.copyAndAddObject(species);
            for (const double x : {0.0, 3 * radius}) {
                SphericalParticle grain(added);
                grain.setRadius(radius);
                grain.setPosition({x, 0, stiffness > softest ? 3 * radius : 0});
                particleHandler.copyAndAddObject(grain);
            }
        }
    }
};

// A soft pair that a step of a stiff one resolves a thousand times and more: it was refused as one that needs
// more steps than that.
TEST(StepForError, takesTheStepOfTheStiffestPair) {
    SoftAndStiff scene([](double) { return 1e-4; });
    const StepForError found = scene.stepForError(0.05, 0.01);
    EXPECT_TRUE(found.known);
    EXPECT_LE(found.largest, 0.05);
    // pi sqrt(m / 2 / k) of the stiff pair, in five steps at least.
    EXPECT_LE(found.step, std::numbers::pi * std::sqrt(massOfGrain / 2 / SoftAndStiff::stiffest) / 5);
}

// Species mix to soft springs beside the stiff one's dashpots, some 1000 times critical: no number of steps
// in a period of the springs resolves them.
TEST(StepForError, takesTheRelaxationTimeOfBodiesThatCreep) {
    SoftAndStiff scene([](double stiffness) { return std::sqrt(0.1 * stiffness * massOfGrain); });
    const StepForError found = scene.stepForError(0.05, 0.01);
    ASSERT_TRUE(found.creeping);
    EXPECT_EQ(found.creeping->species1, 0u);
    EXPECT_EQ(found.creeping->species2, 1u);
    EXPECT_LE(found.step, found.limit);
    EXPECT_LT(found.steps, 20'000'000u);
}

/// Two clumps of two spheres that overlap, which meet at one contact.
struct TwoClumps : Simulation<HertzianViscoelasticMindlinSpecies> {
    /// @param turns rad, of each against the line of approach; @param gap m, on it
    /// @param mass the share of that of the spheres
    TwoClumps(std::array<double, 2> turns, double gap, double mass = 1) {
        setQuiet();
        const auto* species = speciesHandler.copyAndAddObject(hertz());
        const std::vector<Ball> spheres{{{-0.6 * radius, 0, 0}, radius}, {{0.6 * radius, 0, 0}, radius}};
        BodyMass ofSpheres = ClumpTemplate(spheres).massOf(density, 1);
        ofSpheres.mass *= mass, ofSpheres.inertia *= mass;
        Clump clump{ClumpTemplate(spheres, ofSpheres)};
        clump.setSpecies(species);
        for (const double side : {-1.0, 1.0}) {
            const double turn = turns[side < 0 ? 0 : 1];
            clump.setOrientation(Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vec3D::UnitZ())));
            clump.setVelocity({-side * speed / 2, 0, 0});
            clump.setPosition({side * (0.5 * gap + radius * (1 + 0.6 * std::abs(std::cos(turn)))), 0, 0});
            bodyHandler.copyAndAddObject(clump);
        }
    }
    /// m/s: velocities and rim speeds some time after the touch.
    [[nodiscard]] std::vector<double> motionAfter(double step) {
        setTimeStep(step);
        acceptUnstableTimeStep();
        initialise();
        while (getTime() < 2e-3) {
            this->step();
            for (std::uint32_t k = 0; k < 4; ++k)
                if (contactForceOn(k) != Vec3D::Zero()) touched.insert(k);
        }
        std::vector<double> motion;
        for (std::size_t k = 0; k < 2; ++k) {
            const BodyReference body = bodyHandler.getObject(k);
            const Vec3D velocity = body.getVelocity(), rim = radius * body.getAngularVelocity();
            motion.insert(motion.end(), {velocity.x(), velocity.y(), rim.z()});
        }
        return motion;
    }
    std::set<std::uint32_t> touched;  // spheres: two where the clumps meet at one contact
};

// At a contact a clump has at least the mass of one grain of it, so that it parts later than the single
// grains whose collisions were computed; whatever its pose. (An eighth more for angles between those that
// were computed, and for the step that stands for the exact one.)
TEST(StepForError, keepsToItsErrorInCollisionsOfClumps) {
    constexpr double asked = 0.01;
    const double step = TwoClumps({0, 0}, 1e-5).stepForError(asked, speed).byCollisions;
    for (const std::array turns :
         {std::array{0.0, 0.0}, {0.7, -0.7}, {1.5, 0.4}, {1.2, -0.5}, {0.3, 1.2}, {0.9, -0.9}, {0.5, 0.0}})
        for (int k = 0; k < 4; ++k) {
            const double gap = (2 + k / 4.0) * step * speed;
            TwoClumps fine(turns, gap);
            const std::vector<double> exact = fine.motionAfter(step / 50),
                                      found = TwoClumps(turns, gap).motionAfter(step);
            EXPECT_EQ(fine.touched.size(), 2U);
            EXPECT_LT(exact[0], 0);
            for (std::size_t c = 0; c < exact.size(); ++c)
                EXPECT_LE(std::abs(found[c] - exact[c]) / speed, 1.125 * asked)
                    << turns[0] << ' ' << turns[1];
        }
}

/// m/s: velocities and rim speeds of two grains after they have met at an angle (degrees).
std::vector<double> afterOblique(double degrees, double gap, double step) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec3D half = 0.5 * speed * Vec3D(std::cos(angle), std::sin(angle), 0);
    FewGrains<HertzianViscoelasticMindlinSpecies> scene(
        hertz(),
        {{.position = {-radius - gap / 2, 0, 0}, .velocity = half},
         {.position = {radius + gap / 2, 0, 0}, .velocity = -half}},
        step);
    scene.setQuiet();
    scene.acceptUnstableTimeStep();
    scene.initialise();
    for (bool touched = false;;) {
        scene.step();
        const bool touches = scene.contactForceOn(0) != Vec3D::Zero();
        if (touched && !touches) break;
        touched |= touches;
    }
    const scenes::GrainMotion motion = scene.motion(1);
    return {2 * motion.velocity.x(), 2 * motion.velocity.y(), radius * motion.spin.z()};
}

// Also at angles between those that are computed, and nearly along the surface: half of all grains that meet
// by chance do so at more than 45 degrees.
TEST(StepForError, keepsToItsErrorAtAllAngles) {
    constexpr double asked = 0.01;
    const double step =
        TwoGrains<HertzianViscoelasticMindlinSpecies>(hertz()).stepForError(asked, speed).step;
    for (const double degrees : {8.0, 22.0, 30.0, 52.0, 60.0, 68.0, 80.0}) {
        const double normal = speed * std::cos(degrees * std::numbers::pi / 180);
        const std::vector<double> exact = afterOblique(degrees, 2 * step * normal, step / 100);
        for (int k = 0; k < 8; ++k) {
            const std::vector<double> found = afterOblique(degrees, (2 + k / 8.0) * step * normal, step);
            for (std::size_t c = 0; c < exact.size(); ++c)
                EXPECT_LE(std::abs(found[c] - exact[c]) / speed, asked) << degrees;
        }
    }
}

// Grains at 3 m/s sink in by a fifth of their radius here, and at 75 degrees slide past each other: the line
// between their centres turns, and what moves along the first one may come back. An error ten times as large
// needs no more than a third of the steps, as the order of the scheme is 1 to 2.
TEST(StepForError, knowsGrainsThatSlidePastFromThoseDrawnBack) {
    TwoGrains<HertzianViscoelasticMindlinSpecies> scene(hertz());
    const StepForError fine = scene.stepForError(0.01, 3), rough = scene.stepForError(0.1, 3);
    EXPECT_LE(fine.largest, 0.01);
    EXPECT_GT(rough.byCollisions, 3 * fine.byCollisions);
}

// A body that was given a tenth of the mass parts three times as soon.
TEST(StepForError, refusesBodiesThatAreLighterThanTheirGrains) {
    EXPECT_TRUE(refusal([] { (void)TwoClumps({0, 0}, 1e-5).stepForError(0.01, speed); }).empty());
    const std::string sentence = refusal([] {
        (void)TwoClumps({0, 0}, 1e-5, 0.1).stepForError(0.01, speed);
    });
    EXPECT_TRUE(isOneSentence(sentence));
    EXPECT_TRUE(contains(sentence, "rigid body 0 (its particle 0) moves at a contact as a mass of"));
}

TEST(StepForError, isForgottenWithItsStep) {
    ManyGrains scene;
    scene.setStepFor(0.1, speed);
    EXPECT_TRUE(scene.getStepForError());
    scene.setTimeStep(1e-6);
    EXPECT_FALSE(scene.getStepForError());
    scene.setStepFor(0.001, speed);
    EXPECT_FALSE(scene.acceptsUnstableTimeStep());  // no longer
    scene.setIntegrator(integrators::velocityVerlet);
    EXPECT_FALSE(scene.getStepForError());
    scene.initialise();
    EXPECT_TRUE(contains(refusal([&] { scene.setStepFor(0.1, speed); }), "time step for an error"));
}

// As Ctrl-C in Python: collisions that creep take seconds.
TEST(StepForError, canBeInterrupted) {
    struct Interrupted {};
    ManyGrains scene;
    setInterruption([] { throw Interrupted{}; });
    EXPECT_THROW(scene.setStepFor(0.1, speed), Interrupted);
    setInterruption({});
    EXPECT_FALSE(scene.getStepForError());
    scene.setStepFor(0.1, speed);
    EXPECT_TRUE(scene.getStepForError());
}

TEST(StepForError, saysWhatIsLost) {
    ManyGrains scene;
    EXPECT_TRUE(contains(scene.stepForError(0.1, speed).text(), "times the stability limit"));
    EXPECT_TRUE(contains(scene.stepForError(0.001, speed).text(), "below the stability limit"));
}

TEST(StepForError, refusesWhatCannotBe) {
    TwoGrains<HertzianViscoelasticMindlinSpecies> scene(hertz());
    for (const double error : {0.0, -1.0, 0.2, std::nan("")})
        EXPECT_TRUE(isOneSentence(refusal([&] { (void)scene.stepForError(error, speed); }))) << error;
    EXPECT_TRUE(contains(refusal([&] { (void)scene.stepForError(2, speed); }), "error = 2 is out of range"));
    for (const double given : {0.0, -1.0, infinity})
        EXPECT_TRUE(isOneSentence(refusal([&] { (void)scene.stepForError(0.1, given); }))) << given;
    Simulation<HertzianViscoelasticMindlinSpecies> empty;
    empty.speciesHandler.copyAndAddObject(hertz());
    EXPECT_TRUE(contains(refusal([&] { (void)empty.stepForError(0.1, speed); }), "no grains yet"));
    const std::string tooFast = refusal([&] { (void)scene.stepForError(0.1, 300); });
    EXPECT_TRUE(contains(tooFast, "give a lower speed"));
    // First-order errors of a dashpot.
    TwoGrains<LinearViscoelasticSpecies> damped(linear());
    damped.setIntegrator(integrators::velocityVerlet);
    EXPECT_TRUE(contains(refusal([&] { (void)damped.stepForError(2e-4, speed); }), "steps in a contact"));
}

}  // namespace
}  // namespace pendular::stepForErrorTest
