#include "Kernel/Scene/TimeStep/StepForFigure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Scene/TimeStep/ChosenTimeStep.h"
#include "Kernel/Scene/TimeStep/SoftestModulus.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"

// The step for a bulk quantity.

namespace pendular::stepForFigureTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using support::contains;
using support::isOneSentence;
using support::refusal;

using Glass = HertzianViscoelasticMindlinSpecies;
constexpr double radius = 1e-3, density = 2500, modulus = 5e6, poisson = 0.2, gravity = 9.8;  // m, kg/m^3, Pa

template <class S = Glass>
S glass(double restitution = 0.5, double friction = 0.5) {
    S species;
    species.setDensity(density);
    species.setElasticModulusAndPoissonRatio(modulus, poisson);
    if constexpr (requires { species.setEffectiveShearModulus(1.0); }) {
        species.setEffectiveShearModulus(computeEffectiveShearModulus(modulus, poisson));
        species.setSlidingFrictionCoefficient(friction);
        species.setSpringFactor(1);
    }
    species.setRestitutionCoefficient(restitution);
    return species;
}

/// Grains of 0.8 to 1 mm that fall on a plane, in a box that repeats itself.
template <class S = Glass>
struct PouredBed : FewGrains<S> {
    static constexpr int across = 4;
    static constexpr double cell = 2.2 * radius, width = across * cell;

    explicit PouredBed(int layers, unsigned seed = 1, const S& species = glass<S>())
        : FewGrains<S>(species, grainsOf(layers, seed), 1e-7, {{{0, 0, -1}, {0, 0, 0}}}) {
        this->setPeriodic(0, 0, width);
        this->setPeriodic(1, 0, width);
        this->setGravity({0, 0, -gravity});
        this->setQuiet();
    }
    static std::vector<GrainMotion> grainsOf(int layers, unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> share(-1, 1);
        std::vector<GrainMotion> grains;
        for (int z = 0; z < layers; ++z)
            for (int y = 0; y < across; ++y)
                for (int x = 0; x < across; ++x)
                    grains.push_back({.radius = radius * (0.9 + 0.1 * share(random)),
                                      .position = cell * Vec3D(x + 0.5, y + 0.5, z + 0.5),
                                      .velocity = 0.2 * Vec3D(share(random), share(random), share(random))});
        return grains;
    }
    void runFor(double seconds) {
        const double end = this->getTime() + seconds;
        while (this->getTime() < end) this->step();
    }
    /// The kinetic energy over m g d of the grains: so many diameters they could rise.
    [[nodiscard]] double agitation() {
        double energy = 0, weight = 0;
        for (std::size_t k = 0; k < this->particleHandler.getSize(); ++k) {
            const auto grain = this->particleHandler.getObject(k);
            energy += 0.5 * grain.getMass() * grain.getVelocity().squaredNorm();
            weight += grain.getMass() * gravity;
        }
        return energy / (weight * 2 * radius);
    }
    /// m, of the grains' centres in the mean: the bed's solid fraction, as its mass and width are given.
    [[nodiscard]] double meanHeight() {
        double sum = 0;
        for (std::size_t k = 0; k < this->particleHandler.getSize(); ++k)
            sum += this->particleHandler.getObject(k).getPosition().z();
        return sum / static_cast<double>(this->particleHandler.getSize());
    }
    [[nodiscard]] double contactsOfAGrain() {
        std::size_t sides = 0;
        this->contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            if (bucket.wall < 0 && this->contacts().touches(contact)) sides += 2;
        });
        return static_cast<double>(sides) / static_cast<double>(this->particleHandler.getSize());
    }
};

/// s: 1 / omega of two of the smallest grains that slide at an overlap of 5 % of their radius, omega^2 =
/// 7/2 k_t / m*, k_t = 8 G* sqrt(R* d) (Mindlin 1949).
double inverseFrequency(double smallest) {
    const double mass = 4.0 / 3 * std::numbers::pi * smallest * smallest * smallest * density,
                 tangential = 8 * computeEffectiveShearModulus(modulus, poisson) *
                              std::sqrt(0.5 * smallest * 0.05 * smallest);
    return std::sqrt(0.5 * mass / (3.5 * tangential));
}
double smallestOf(PouredBed<>& bed) { return bed.particleHandler.store().smallestRadius(); }

TEST(StepForFigure, isThatOfTheTableOverTheHighestFrequency) {
    // Dashpots make the period longer by a share of half the squared damping ratio, (ln 0.9 / pi)^2 / 2 =
    // 6e-4.
    PouredBed elastic(5, 1, glass(0.9));
    const double unit = inverseFrequency(smallestOf(elastic));
    EXPECT_NEAR(elastic.stepForError(WantedFigure::SolidFraction, 0.05).step / unit, 1.32, 1.32 * 1e-3);
    // Strong dashpots bind: so many times the limit at which they are proved to be stable.
    PouredBed damped(5, 1, glass(0.2));
    EXPECT_NEAR(damped.stepForError(WantedFigure::SolidFraction, 0.05).step / damped.stabilityLimit(), 6.2,
                1e-9);
}

TEST(StepForFigure, isNeverAboveWhatAPairStandsAndGrowsWithTheError) {
    PouredBed bed(5);
    const double most = std::numbers::sqrt2 * inverseFrequency(smallestOf(bed));
    for (const WantedFigure figure : {WantedFigure::SolidFraction, WantedFigure::Friction,
                                      WantedFigure::ContactsAtRest, WantedFigure::ContactsInFlow}) {
        double last = 0;
        for (const double error : {1e-3, 3e-3, 1e-2, 2e-2, 5e-2, 0.2}) {
            const StepForFigure found = bed.stepForError(figure, error);
            EXPECT_LT(found.step, most);
            EXPECT_GE(found.step, last);
            last = found.step;
            if (found.isKnown()) EXPECT_LE(found.measured, error);
            else EXPECT_DOUBLE_EQ(found.step, chosenTimeStep(bed));
        }
        EXPECT_GT(last, bed.stabilityLimit());
    }
}

// Where nothing was measured the usual step is taken, and the sentence says why.
TEST(StepForFigure, takesTheUsualStepInOtherScenes) {
    const auto expectUsual = [](Scene& scene, const std::string& reason) {
        const StepForFigure found = scene.stepForError(WantedFigure::SolidFraction, 0.05);
        EXPECT_FALSE(found.isKnown());
        EXPECT_DOUBLE_EQ(found.step, chosenTimeStep(scene));
        EXPECT_TRUE(contains(found.text(), reason)) << found.text();
    };
    PouredBed<HertzianViscoelasticSpecies> smooth(3);
    expectUsual(smooth, "HertzianViscoelasticSpecies was not measured");
    PouredBed verlet(3);
    verlet.setIntegrator(integrators::velocityVerlet);
    expectUsual(verlet, "VelocityVerlet was not measured");
    PouredBed fast(3);
    fast.particleHandler.getObject(0).setVelocity({0, 0, -5});
    expectUsual(fast, "of a radius, more than");
    PouredBed fine(3);
    const StepForFigure tooFine = fine.stepForError(WantedFigure::SolidFraction, 1e-3);
    EXPECT_TRUE(contains(tooFine.text(), "and not less")) << tooFine.text();
}

// Out of the range of the runs, one thing at a time.
struct OtherScene {
    std::string name;
    WantedFigure figure;
    double restitution, friction;
    void (*change)(PouredBed<>&);
    std::string reason;  // empty: in the range
};
void nothing(PouredBed<>& /*bed*/) {}
void addLargeGrain(PouredBed<>& bed, double share) {
    SphericalParticle large;
    large.setSpecies(bed.speciesHandler.getObject(0));
    large.setRadius(share * bed.particleHandler.store().smallestRadius());
    large.setPosition({0.5 * PouredBed<>::width, 0.5 * PouredBed<>::width, 0.02});
    bed.particleHandler.copyAndAddObject(large);
}
struct Draught final : StepPart {
    [[nodiscard]] std::string_view name() const override { return "draught"; }
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*context*/) override {}
};
const std::vector<OtherScene> otherScenes{
    {"likeTheRuns", WantedFigure::Friction, 0.5, 0.5, nothing, ""},
    {"smallFriction", WantedFigure::SolidFraction, 0.5, 0.2, nothing, "a friction of 0.2"},
    {"largeFriction", WantedFigure::SolidFraction, 0.5, 1, nothing, "a friction of 1,"},
    {"elastic", WantedFigure::SolidFraction, 0.95, 0.5, nothing, "a restitution of 0.95"},
    {"plastic", WantedFigure::SolidFraction, 0.02, 0.5, nothing, "a restitution of 0.02"},
    {"leastOfBeds", WantedFigure::SolidFraction, 0.1, 0.3, nothing, ""},
    {"mostOfBeds", WantedFigure::SolidFraction, 0.9, 0.8, nothing, ""},
    {"elasticDrum", WantedFigure::Friction, 0.9, 0.5, nothing, "a restitution of 0.9"},
    {"nearlyAlike", WantedFigure::SolidFraction, 0.5, 0.5, [](PouredBed<>& s) { addLargeGrain(s, 1.28); },
     ""},
    {"mixture", WantedFigure::SolidFraction, 0.5, 0.5, [](PouredBed<>& s) { addLargeGrain(s, 10); },
     "a ratio of radii of 10"},
    {"strained", WantedFigure::SolidFraction, 0.5, 0.5,
     [](PouredBed<>& s) {
         s.setGravity({0, 0, 0});
         s.setStrainRate(0, -0.1);
     },
     "nothing was measured with strain"},
    {"piston", WantedFigure::SolidFraction, 0.5, 0.5,
     [](PouredBed<>& s) {
         InfiniteWall lid;
         lid.set({0, 0, 1}, {0, 0, 0.1});
         lid.setSpecies(s.speciesHandler.getObject(0));
         s.wallHandler.copyAndAddObject(lid)->setPiston(1e-3, 0.01);
     },
     "walls that forces move"},
    {"ownPart", WantedFigure::SolidFraction, 0.5, 0.5, [](PouredBed<>& s) { s.addPart<Draught>(); },
     "a part of the driver's own"},
};

class StepForFigureOf : public testing::TestWithParam<OtherScene> {};

TEST_P(StepForFigureOf, isKnownInTheRangeOfTheRunsOnly) {
    const OtherScene& other = GetParam();
    PouredBed bed(3, 1, glass(other.restitution, other.friction));
    other.change(bed);
    const StepForFigure found = bed.stepForError(other.figure, 0.06);
    EXPECT_EQ(found.isKnown(), other.reason.empty()) << found.text();
    EXPECT_TRUE(contains(found.text(), other.reason)) << found.text();
    EXPECT_EQ(found.step == chosenTimeStep(bed), !found.isKnown()) << found.text();
}
INSTANTIATE_TEST_SUITE_P(All, StepForFigureOf, testing::ValuesIn(otherScenes),
                         [](const auto& param) { return param.param.name; });

TEST(StepForFigure, incrementalSpringsWereMeasuredInBedsAlone) {
    using Incremental = HertzianViscoelasticMindlinIncrementalSpecies;
    PouredBed<Incremental> bed(3, 1, glass<Incremental>());
    EXPECT_TRUE(bed.stepForError(WantedFigure::SolidFraction, 0.06).isKnown());
    const StepForFigure drum = bed.stepForError(WantedFigure::Friction, 0.06);
    EXPECT_TRUE(contains(drum.text(), "MindlinIncrementalSpecies was not measured in drums")) << drum.text();
}

// What comes after setStepFor() makes its step too long: the run does not begin with it.
TEST(StepForFigure, refusesWhatComesLaterWhereItsStepIsAboveTheLimit) {
    for (const bool isStiffer : {false, true}) {
        PouredBed bed(3);
        bed.setStepFor(WantedFigure::SolidFraction, 0.02);
        ASSERT_GT(bed.getTimeStep(), bed.stabilityLimit());
        if (isStiffer)
            bed.speciesHandler.getObject(0)->setElasticModulusAndPoissonRatio(4 * modulus, poisson);
        else addLargeGrain(bed, 1.6);
        const std::string sentence = refusal([&] { bed.initialise(); });
        EXPECT_TRUE(contains(sentence, "before all of the scene was there")) << sentence;
        EXPECT_EQ(contains(sentence, "because a ratio of radii"), !isStiffer) << sentence;
        EXPECT_TRUE(isOneSentence(sentence)) << sentence;
    }
}

// What comes after setStepFor() is out of the range, and softer, so that the step is not above the limit: a
// warning says so when the run begins.
TEST(StepForFigure, warnsOfWhatComesLater) {
    for (const bool isMixture : {false, true}) {
        PouredBed bed(3, 1, glass(0.9));  // weak dashpots: the step is a little above the limit
        bed.setStepFor(WantedFigure::SolidFraction, 0.012);
        bed.setQuiet(false), bed.logger.setLevel(LogLevel::None);  // warnings are kept
        if (isMixture) {
            addLargeGrain(bed, 1.6);
            Glass& softer = *bed.speciesHandler.getObject(0);
            softer.setElasticModulusAndPoissonRatio(0.1 * modulus, poisson);
            softer.setEffectiveShearModulus(computeEffectiveShearModulus(0.1 * modulus, poisson));
            ASSERT_LE(bed.getTimeStep(), bed.stabilityLimit());
        }
        bed.initialise();
        const auto warns = [&](const std::string& part) {
            return std::ranges::any_of(bed.logger.warnings(),
                                       [&](const std::string& one) { return contains(one, part); });
        };
        EXPECT_EQ(warns("before all of the scene was there: a ratio of radii"), isMixture);
        EXPECT_TRUE(isMixture || !warns("too weak dashpots"));
    }
}

TEST(StepForFigure, isTakenAndSaid) {
    PouredBed bed(3);
    bed.setStepFor(WantedFigure::SolidFraction, 0.02);
    ASSERT_TRUE(bed.getStepForFigure());
    EXPECT_DOUBLE_EQ(bed.getTimeStep(), bed.getStepForFigure()->step);
    EXPECT_TRUE(bed.acceptsUnstableTimeStep());
    EXPECT_TRUE(contains(bed.getStepForFigure()->text(), "for solid-fraction to 0.02"));
    EXPECT_FALSE(bed.getStepForError());
    bed.setTimeStep(1e-6);
    EXPECT_FALSE(bed.getStepForFigure());
}

TEST(StepForFigure, refusesBadInput) {
    PouredBed bed(3);
    for (const WantedFigure figure :
         {WantedFigure::ContactTime, WantedFigure::ContactArea, WantedFigure::Waves}) {
        const std::string sentence = refusal([&] { (void)bed.stepForError(figure, 0.02); });
        EXPECT_TRUE(isOneSentence(sentence) && contains(sentence, "single collisions")) << sentence;
    }
    for (const double error : {0.0, -1.0, 0.5, std::nan("")})
        EXPECT_TRUE(isOneSentence(refusal([&] { bed.setStepFor(WantedFigure::Friction, error); }))) << error;
    FewGrains<Glass> empty(glass(), {}, 1e-7);
    EXPECT_TRUE(isOneSentence(refusal([&] { empty.setStepFor(WantedFigure::Friction, 0.02); })));
    bed.setStepFor(WantedFigure::SolidFraction, 0.02);
    bed.initialise();
    EXPECT_TRUE(
        contains(refusal([&] { bed.setStepFor(WantedFigure::SolidFraction, 0.02); }), "bulk quantity"));
}

// A bed at rest stays at rest, above the limit up to which that is proved: its kinetic energy does not grow,
// and grains that are made to oscillate in their places by 1 mm/s, 2.5e-5 of m g d, lose that again. Overlaps
// are 1 % of a radius there, so that all of them stay in touch.
TEST(StepForFigure, aBedAtRestStaysAtRest) {
    for (const double restitution : {0.2, 0.5, 0.9}) {
        PouredBed bed(8, 1, glass(restitution));
        bed.setStepFor(WantedFigure::SolidFraction, 0.05);
        ASSERT_GT(bed.getTimeStep(), bed.stabilityLimit());
        bed.initialise();
        bed.runFor(0.4);
        double before = 0, after = 0;
        for (int k = 0; k < 50; ++k) bed.runFor(1e-3), before = std::max(before, bed.agitation());
        for (int k = 0; k < 100; ++k) bed.runFor(1e-3), after = std::max(after, bed.agitation());
        EXPECT_LT(after, std::max(before, 1e-5)) << restitution;
        for (std::size_t k = 0; k < bed.particleHandler.getSize(); ++k)
            bed.particleHandler.getObject(k).setVelocity({0, 0, k % 2 == 0 ? 1e-3 : -1e-3});
        const double kicked = bed.agitation();
        bed.runFor(0.1);
        EXPECT_LT(bed.agitation(), 0.1 * kicked) << restitution;
    }
}

// The oracle is the same scene with an eighth of the step. Starts of 1000 grains differ by 0.7 % in the
// study, so these 96 by some 2.3 %; three times that is allowed.
TEST(StepForFigure, keepsTheHeightOfABed) {
    const auto heightAt = [](double share) {
        PouredBed bed(6);
        bed.setStepFor(WantedFigure::SolidFraction, 0.02);
        bed.setTimeStep(share * bed.getTimeStep());
        bed.initialise();
        bed.runFor(0.2);
        return bed.meanHeight();
    };
    EXPECT_NEAR(heightAt(1) / heightAt(1. / 8), 1, 0.07);
}

// Ten starts: the mean deviations from runs with an eighth of the step are within what is promised and three
// standard errors of their own.
TEST(LongStepForFigure, keepsTheFiguresOfBeds) {
    constexpr double error = 0.02;
    constexpr int starts = 10;
    std::array<std::vector<double>, 2> deviations;
    for (unsigned seed = 1; seed <= starts; ++seed) {
        const auto figuresAt = [&](double share) {
            PouredBed bed(25, seed);
            bed.setStepFor(WantedFigure::ContactsAtRest, error);
            bed.setTimeStep(share * bed.getTimeStep());
            bed.initialise();
            bed.runFor(0.3);
            std::array<double, 2> sums{};
            for (int k = 0; k < 50; ++k) {
                bed.runFor(2e-3);
                sums[0] += bed.meanHeight(), sums[1] += bed.contactsOfAGrain();
            }
            return sums;
        };
        const auto found = figuresAt(1), exact = figuresAt(1. / 8);
        for (std::size_t k = 0; k < 2; ++k) deviations[k].push_back(found[k] / exact[k] - 1);
    }
    for (const std::vector<double>& one : deviations) {
        double mean = 0, square = 0;
        for (const double d : one) mean += d / starts;
        for (const double d : one) square += (d - mean) * (d - mean);
        const double standardError = std::sqrt(square / (starts * (starts - 1)));
        EXPECT_LT(std::abs(mean), error + 3 * standardError);
        EXPECT_LT(3 * standardError, error);  // else ten starts tell nothing
    }
}

}  // namespace
}  // namespace pendular::stepForFigureTest
