/// Reduced profiles of a few springs: MindlinIncremental (one), MindlinPartialSlip (three).

#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Species/Friction/Mindlin.h"
#include "Kernel/Species/Friction/MindlinIncremental.h"
#include "Kernel/Species/Friction/MindlinPartialSlip.h"
#include "Kernel/Species/Friction/MindlinSecant.h"
#include "SelfTests/Support/Draw.h"

namespace pendular::reducedProfileTest {
namespace {

using support::Draw;

constexpr double shearModulus = 1e9, radius = 1e-3, overlap = 1e-6, friction = 0.3;  // Pa, m
constexpr double load = 2;                                                           // N

/// A contact that is moved by hand, along x, without dashpot and response.
template <class Law>
struct Moved {
    Moved() {
        law.setEffectiveShearModulus(shearModulus);
        law.setSlidingDissipation(0);
        law.setSlidingFrictionCoefficient(friction);
    }
    /// @return the force against it, N
    double move(double depth, double normalForce, double way, double effectiveRadius = radius) {
        const Slip<double> slip{.velocity = {way, 0, 0}, .timeBefore = 1, .timeAfter = 0};
        const Contact<double> contact(depth, effectiveRadius, 1e-6);
        return -Law::force(law.prepare(AnyNormalLaw{}), contact, normalForce, slip, springs).x;
    }
    /// N/m, at an overlap, without factor.
    static double stiffness(double depth) { return 8 * shearModulus * std::sqrt(radius * depth); }

    Law law;
    typename Law::template History<double> springs{};
};

template <class Law>
class ReducedProfiles : public ::testing::Test {};
using Laws = ::testing::Types<MindlinIncremental, MindlinPartialSlip>;
TYPED_TEST_SUITE(ReducedProfiles, Laws);

// Mindlin (1949): the work up to the slip 3 mu P / (16 G* a), at which all slips, is 3/5 of mu P times that.
// The springs do the same work up to there, if all of them slip by then.
TYPED_TEST(ReducedProfiles, doTheWorkOfMindlinsContact) {
    Moved<TypeParam> contact;
    const int steps = 20000;
    const double limit = friction * load, fullSlip = 1.5 * limit / contact.stiffness(overlap);
    double work = 0, before = 0;
    for (int k = 0; k < steps; ++k) {
        const double force = contact.move(overlap, load, fullSlip / steps);
        work += 0.5 * (before + force) * fullSlip / steps;
        before = force;
    }
    EXPECT_NEAR(before, limit, 1e-12);
    EXPECT_NEAR(work / (limit * fullSlip), 0.6, 1.0 / steps);  // where springs begin to slip within a step
}

TEST(ReducedProfile, ofOneSpringHasFiveSixthsOfTheStiffness) {
    EXPECT_NEAR(MindlinIncremental{}.getSpringFactor(), 5.0 / 6.0, 1e-15);
    EXPECT_EQ(Mindlin{}.getSpringFactor(), 2.0 / 3.0);
}

// A contact that closes keeps its force, one that opens loses a/a0 of it: Thornton et al. (2013).
TEST(ReducedProfile, ofOneSpringKeepsItsForceWhereItClosesAndRescalesItWhereItOpens) {
    Moved<MindlinIncremental> contact;
    const double force = contact.move(overlap, load, 0.1 * load * friction / contact.stiffness(overlap));
    EXPECT_NEAR(contact.move(2 * overlap, load, 0), force, 1e-14 * load);
    EXPECT_NEAR(contact.move(0.5 * overlap, load, 0), 0.5 * force, 1e-14 * load);
}

// The force of slip in proportion to the overlap is 2/3 of 8 G* a times the slip (Mindlin and Deresiewicz
// 1953), here times the law's factor, as far as nothing slips; the sum over the steps errs by one of them.
TYPED_TEST(ReducedProfiles, giveTwoThirdsOfTheStiffnessToSlipInProportionToTheOverlap) {
    Moved<TypeParam> contact;
    contact.law.setSlidingFrictionCoefficient(100);
    const int steps = 20000;
    const double slip = 1e-8;
    double force = 0;
    for (int k = 1; k <= steps; ++k) force = contact.move(k * overlap / steps, load, slip / steps);
    EXPECT_NEAR(force / (2.0 / 3.0 * contact.law.getSpringFactor() * contact.stiffness(overlap) * slip), 1,
                2.0 / steps);
}

/// What a contact gains (J) that is shifted at an overlap, pressed deeper, shifted back and let go: nothing
/// is put in but the work of the shifts.
template <class Law>
double gainedByPressing(double overlap, double deeper, double shift, double shearModulus, double radius) {
    Moved<Law> contact;
    contact.law.setEffectiveShearModulus(shearModulus);
    contact.law.setSlidingFrictionCoefficient(1e6);  // nothing slides
    const int steps = 100;
    double work = 0;  // of the trapezoidal rule, exact for a spring
    const auto shiftBy = [&](double depth, double way) {
        double before = contact.move(depth, load, 0, radius);
        for (int k = 0; k < steps; ++k) {
            const double after = contact.move(depth, load, way / steps, radius);
            work += 0.5 * (before + after) * way / steps;
            before = after;
        }
    };
    shiftBy(overlap, shift);
    const int presses = 10000;
    for (int k = 1; k <= presses; ++k)
        contact.move(overlap + (deeper - overlap) * k / presses, load, 0, radius);
    shiftBy(deeper, -shift);
    return -work;
}

// Mindlin's spring keeps its stretch while its stiffness k goes with the root of the overlap: the shifts put
// in k_1 s^2 / 2 and take out k_2 s^2 / 2. Increments keep the force: the same spring is at +k_1 s when the
// way back begins and at k_1 s - k_2 s after it. 1e-12: rounding of the sums.
TEST(ReducedProfile, ofOneSpringGainsNothingWherePressingAStretchedContactFeedsMindlin) {
    const double r = 1e-3, modulus = 3.75e6, s = 1e-6;  // m, Pa, m
    for (const double ratio : {1.0, 2.0, 4.0, 9.0}) {
        const double shallow = 0.01 * r, deep = ratio * shallow, effectiveRadius = 0.5 * r;
        const auto stored = [&](double factor, double overlap) {
            return 0.5 * factor * 8 * modulus * std::sqrt(effectiveRadius * overlap) * s * s;
        };
        const double first = stored(2.0 / 3, shallow), second = stored(2.0 / 3, deep);
        const auto gained = [&]<class Law>() {
            return gainedByPressing<Law>(shallow, deep, s, modulus, effectiveRadius);
        };
        EXPECT_NEAR(gained.operator()<Mindlin>(), second - first, 1e-12 * second);
        EXPECT_NEAR(gained.operator()<MindlinSecant>(), second - first, 1e-12 * second);
        const double root = std::sqrt(ratio), ofIncrements = stored(5.0 / 6, shallow);
        // In: 1. Out: force 1 times the way 2, less root of the spring.
        EXPECT_NEAR(gained.operator()<MindlinIncremental>(), (2 - root - 1) * ofIncrements,
                    1e-12 * root * ofIncrements);
        EXPECT_LE(gained.operator()<MindlinPartialSlip>(), 1e-12 * second);
        if (ratio == 4) {
            EXPECT_NEAR(second - first, 7.07e-10, 0.005e-10);  // J
        }
    }
}

/// What a cycle of the force between +most and -most (of the limit) loses, in units of the limit times the
/// slip at which all slips.
template <class Law>
double lossOfCycle(double most) {
    Moved<Law> contact;
    const double limit = friction * load, fullSlip = 1.5 * limit / contact.stiffness(overlap),
                 step = 1e-4 * fullSlip;
    double force = 0, loss = 0;
    const auto moveTo = [&](double end, double sign) {
        while (sign * force < sign * end * limit) {
            const double before = force;
            force = contact.move(overlap, load, sign * step);
            loss += 0.5 * (before + force) * sign * step / (limit * fullSlip);
        }
    };
    moveTo(most, 1);
    loss = 0;
    const double first = force;
    moveTo(-most, -1);
    moveTo(first / limit * (1 - 1e-12), 1);
    return loss;
}
/// The loss of Mindlin and Deresiewicz's contact (Johnson, Contact mechanics, 1985, equation 7.48): with z =
/// 1 - y of the slip y that gives the force, 8 (y - 2/5 (1 - z^(5/2))) - 4 y (1 - z^(3/2)).
double lossOfPartialSlip(double most) {
    const double z = std::pow(1 - most, 2.0 / 3.0), y = 1 - z;
    return 8 * (y - 0.4 * (1 - std::pow(z, 2.5))) - 4 * y * most;
}

// A vibration of small amplitude under constant load: partial slip always loses something. A single spring
// below the limit loses nothing, and three nothing below the limit of the outermost, 0.28 of it; above, 0.79
// to 1.7 of the right amount. The way is in steps of 1e-4, and a cycle closes to one of them: 4e-4 of the
// force.
TEST(ReducedProfile, losesInSmallVibrationsWhatItsSpringsSlip) {
    for (const double most : {0.1, 0.25, 0.5, 0.7}) {
        EXPECT_GT(lossOfPartialSlip(most), 0.02 * most * most * most);
        EXPECT_NEAR(lossOfCycle<Mindlin>(most), 0, 4e-4 * most) << most;
        EXPECT_NEAR(lossOfCycle<MindlinIncremental>(most), 0, 4e-4 * most) << most;
    }
    EXPECT_NEAR(lossOfCycle<MindlinPartialSlip>(0.25), 0, 4e-4 * 0.25);
    for (const double most : {0.35, 0.5, 0.6, 0.7}) {
        const double share = lossOfCycle<MindlinPartialSlip>(most) / lossOfPartialSlip(most);
        EXPECT_GT(share, 0.79) << most;
        EXPECT_LT(share, 1.7) << most;
    }
}

// Springs that a contact takes in have no stretch, and those that it sheds go with theirs: one spring never
// gets stronger by that. (Of several, one that goes may have been against the others.) The force is at most
// Coulomb's.
TYPED_TEST(ReducedProfiles, neverExceedTheLimit) {
    Draw draw(3);
    Moved<TypeParam> contact;
    double before = 0;
    for (int k = 0; k < 2000; ++k) {
        const bool slips = k % 2 == 1;
        const double depth = overlap * draw.uniform(0.01, 1), normalForce = load * draw.uniform(0, 1);
        const double force = contact.move(depth, normalForce, slips ? draw.uniform(-1, 1) * 1e-7 : 0);
        EXPECT_LE(std::abs(force), friction * normalForce * (1 + 1e-14));
        if (!slips && contact.springs.each.size() == 1) {
            EXPECT_LE(std::abs(force), std::abs(before) * (1 + 1e-12)) << k;
        }
        before = force;
    }
}

// One spring of a contact whose radius stays is the spring and slider of the other laws, dashpot included.
TEST(ReducedProfile, ofOneSpringIsTheSpringAndSlider) {
    Draw draw(4);
    MindlinIncremental::History<double> springs{};
    for (int k = 0; k < 1000; ++k) {
        const Vector<double> stretch = 1e-7 * draw.direction();
        const Slip<double> slip{.velocity = 0.01 * draw.direction(),
                                .timeBefore = 1e-6,
                                .timeAfter = 2e-6,
                                .response = draw.uniform(0, 1)};
        const double stiffness = draw.uniform(1e6, 1e7), limit = draw.uniform(0, 1);
        const double damping = draw.uniform(0, 10);
        springs.each[0].displacement = stretch;
        Vector<double> other = stretch;
        const auto one = slideProfile(stiffness, damping, limit, slip, springs);
        const auto expected = slideSpring(stiffness, damping, limit, limit, slip, other);
        EXPECT_LE(norm(one.force - expected.force), 1e-14 * (limit + norm(expected.force)));
        EXPECT_LE(norm(springs.each[0].displacement - other), 1e-14 * norm(stretch));
        EXPECT_EQ(one.slides, expected.slides);
    }
}

}  // namespace
}  // namespace pendular::reducedProfileTest
