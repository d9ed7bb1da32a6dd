#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <vector>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::stabilityTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;

using Elastic = Species<LinearViscoelastic>;

constexpr double r = 1e-3, overlap = 0.04 * r;                 // m
constexpr double stiffness = 1e4;                              // N/m
constexpr int count = 20;                                      // grains
constexpr double end = 2 * count * r - (count + 1) * overlap;  // m, from wall to wall

double mass() { return sphereMass(r, 2000); }

/// A row of elastic grains pressed together between two walls, all overlaps alike, each grain with a small
/// velocity of its own (m/s, at most) along the row. No contact ever opens, so that the row is a chain of
/// linear springs.
class Chain : public FewGrains<Elastic> {
public:
    Chain(double speed, double step)
        : FewGrains(material(), grains(speed), step, {{{-1, 0, 0}, {0, 0, 0}}, {{1, 0, 0}, {end, 0, 0}}}) {}

    /// What velocity Verlet keeps of a linear system exactly, at any step below its limit: the energy (J)
    /// without (dt^2 / 8) sum m a^2. Source: from v' M v + x' (K - dt^2/4 K M^-1 K) x, the invariant of the
    /// leap-frog map of M x'' = -K x (Hairer, Lubich and Wanner (2003), Acta Numerica 12, 399, section 5: for
    /// one oscillator). The springs' length at rest, squared, is not in it: overlaps count from the pressed
    /// state.
    [[nodiscard]] double invariant() {
        double sum = 0, last = 0;  // the wall does not move
        for (int k = 0; k < count; ++k) {
            const auto grain = particleHandler.getObject(k);
            const double shift = grain.getPosition().x() - site(k), v = grain.getVelocity().x(),
                         a = grain.getForce().x() / mass();
            sum += 0.5 * mass() * (v * v - 0.25 * getTimeStep() * getTimeStep() * a * a) +
                   0.5 * stiffness * (shift - last) * (shift - last);
            last = shift;
        }
        return sum + 0.5 * stiffness * last * last;
    }
    /// m
    [[nodiscard]] double largestShift() {
        double largest = 0;
        for (int k = 0; k < count; ++k)
            largest = std::max(largest, std::abs(motion(k).position.x() - site(k)));
        return largest;
    }

private:
    static double site(int k) { return r - overlap + k * (2 * r - overlap); }
    static Elastic material() {
        Elastic species;
        species.setDensity(2000);
        species.setStiffness(stiffness);
        return species;
    }
    static std::vector<GrainMotion> grains(double speed) {
        support::Random random(5);
        std::vector<GrainMotion> row;
        for (int k = 0; k < count; ++k)
            row.push_back({.radius = r,
                           .position = {site(k), 0, 0},
                           .velocity = {random.uniform(-speed, speed), 0, 0}});
        return row;
    }
};

/// The exact limit (s) of velocity Verlet for the chain, 2 / w of its stiffest mode: with both ends held, w_j
/// = 2 sqrt(k/m) sin(j pi / (2 (n + 1))), j = 1 ... n.
double exactLimit() {
    return 1 / (std::sqrt(stiffness / mass()) * std::sin(0.5 * std::numbers::pi * count / (count + 1)));
}

/// Steps a chain and expects that its invariant stays. Rounding moves each grain and each overlap by up to
/// half an ulp of the row's length in a step; against the net force of a grain, at most 4 k A with the
/// largest shift A, that is a work of 4 k A ulp a step and grain. (In its worst sum; the errors of most steps
/// cancel.)
void expectNoDrift(Chain& chain, int steps) {
    chain.initialise();
    const double before = chain.invariant();
    double shift = 0, worst = 0;
    for (int n = 0; n < steps; ++n) {
        chain.step();
        if (n % 97 != 0) continue;
        shift = std::max(shift, chain.largestShift());
        worst = std::max(worst, std::abs(chain.invariant() - before));
    }
    const double ulp = std::numeric_limits<double>::epsilon() * end;
    const double tolerance = 4.0 * count * steps * stiffness * shift * ulp;
    EXPECT_GT(before, 0);
    EXPECT_LT(worst, tolerance);
    EXPECT_LT(tolerance, 0.01 * before);  // over all steps together
    testing::Test::RecordProperty("drift", fmt::format("{:.2g} of the energy", worst / before));
    EXPECT_LT(shift, 0.5 * overlap);  // it stayed a chain of linear springs
}

TEST(HeavyStability, nearTheLimitOfTheSceneThereIsNoDriftOfEnergy) {
    Chain probe(0, 1e-9);
    const double step = 0.9 * probe.stabilityLimit();
    // A mode's shift is at most its speed over its frequency; the softest one has w = 2 sqrt(k/m) pi / 42.
    Chain chain(0.05 * overlap * std::sqrt(stiffness / mass()), step);
    expectNoDrift(chain, 100000);
}

TEST(HeavyStability, justBelowTheExactLimitThereIsNoDriftEither) {
    const double step = 0.99 * exactLimit();
    Chain chain(3e-4 * overlap / step, step);
    chain.acceptUnstableTimeStep();
    expectNoDrift(chain, 100000);
}

TEST(Stability, justAboveTheExactLimitTheRunStopsAndLeavesItsLastState) {
    const support::TestFolder folder;
    for (double share : {1.01, 1.1, 1.5, 3.0}) {
        const double step = share * exactLimit();
        Chain chain(3e-4 * overlap / step, step);
        chain.acceptUnstableTimeStep();
        chain.setName(folder.name());
        chain.setTimeMax(20000 * step);
        std::string text;
        try {
            chain.solve();
        } catch (const RunError& stop) {
            text = stop.what();
        }
        EXPECT_TRUE(support::isOneSentence(text)) << share;
        for (const char* part : {"take", "smaller time step", "run-last-state.csv"})
            EXPECT_TRUE(support::contains(text, part)) << share;
        for (const char* file : {"-last-state.csv", "-last-contacts.csv"})
            EXPECT_TRUE(std::filesystem::remove(folder.name() + file)) << share;
        for (int k = 0; k < count; ++k) EXPECT_TRUE(chain.motion(k).position.allFinite());
    }
}

template <class S>
class StabilityOfABed : public testing::Test {
protected:
    /// Lets grains fall into a box with this time step (s); what stopped the run, or nothing.
    std::string settle(double step) {
        scene.setName(folder.name());
        scene.setTimeStep(step);
        scene.acceptUnstableTimeStep();
        scene.setTimeMax(0.5);
        try {
            scene.solve();
        } catch (const RunError& stop) {
            return stop.what();
        }
        return {};
    }
    scenes::SettlingBox<S> scene{6};
    const support::TestFolder folder;
};
using SpeciesOfBeds = testing::Types<Elastic, Species<HertzianViscoelastic, Mindlin>,
                                     Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>>;
TYPED_TEST_SUITE(StabilityOfABed, SpeciesOfBeds);

TYPED_TEST(StabilityOfABed, comesToRestBelowTheLimit) {
    ASSERT_EQ(this->settle(0.9 * this->scene.stabilityLimit()), "");
    // In the mean, not enough energy to rise by a hundredth of a radius; single smooth grains slide on for
    // long.
    double kinetic = 0, rise = 0;  // J
    for (const TranslationRecord& grain : this->scene.particleHandler.store().translation) {
        kinetic += 0.5 * squaredNorm(grain.velocity) / grain.inverseMass;
        rise += 9.81 * 0.01 * grain.radius / grain.inverseMass;
    }
    EXPECT_LT(kinetic, rise);
}

TYPED_TEST(StabilityOfABed, stopsFarAboveIt) {
    // Without damping a pair stands 2 / omega, and nothing stands twice that.
    const std::string text = this->settle(4 / std::numbers::pi * this->scene.shortestContactTime());
    EXPECT_TRUE(support::isOneSentence(text));
    EXPECT_TRUE(support::contains(text, "smaller time step"));
    EXPECT_LT(this->scene.getNumberOfTimeSteps(), 100u);
    for (const char* file : {"-last-state.csv", "-last-contacts.csv"})
        EXPECT_TRUE(std::filesystem::exists(this->folder.name() + file));
}

}  // namespace
}  // namespace pendular::stabilityTest
