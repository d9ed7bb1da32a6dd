/// Reduced profiles of a few springs: MindlinIncremental (one), MindlinPartialSlip (three); and rolling and
/// torsion beside them.

#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Laws/Friction/CombinedLaws.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/MindlinIncremental.h"
#include "Kernel/Laws/Friction/MindlinPartialSlip.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Friction/MindlinSecant.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
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

struct Torques {
    double rolling, torsion;  // N, over R*, against the turn
};

/// A contact that is turned by hand, about an axis in its plane (rolling) and about its normal (torsion),
/// without dashpots and response.
template <class Law>
struct Turned {
    explicit Turned(double coefficient) {
        law.setEffectiveShearModulus(shearModulus);
        law.setSlidingDissipation(0);
        law.setRollingFrictionCoefficient(coefficient);
        law.setTorsionFrictionCoefficient(coefficient);
    }
    /// @param way m, R* times the turn, about both axes
    Torques turn(double depth, double way) {
        const Slip<double> turning{.velocity = {way, 0, way}, .timeBefore = 1, .timeAfter = 0};
        const Contact<double> contact(depth, radius, 1e-6);
        const auto forces =
            Law::rotate(law.prepare(AnyNormalLaw{}), contact, load, {0, 0, 1}, turning, springs);
        return {-forces.rolling.force.x, -forces.torsion.force.z};
    }

    Law law;
    typename Law::template History<double> springs{};
};

/// What the two springs gain (J) where a contact is turned by a way (m) at an overlap (m), pressed deeper,
/// turned back and let go.
template <class Law>
Torques gainedByPressingATurnedContact(double shallow, double deep, double way) {
    Turned<Law> contact(1e6);  // nothing slides
    const int steps = 100;
    Torques work{};  // of the trapezoidal rule, exact for a spring
    const auto turnBy = [&](double depth, double whole) {
        Torques before = contact.turn(depth, 0);
        for (int k = 0; k < steps; ++k) {
            const Torques after = contact.turn(depth, whole / steps);
            work.rolling += 0.5 * (before.rolling + after.rolling) * whole / steps;
            work.torsion += 0.5 * (before.torsion + after.torsion) * whole / steps;
            before = after;
        }
    };
    turnBy(shallow, way);
    const int presses = 1000;
    for (int k = 1; k <= presses; ++k) contact.turn(shallow + (deep - shallow) * k / presses, 0);
    turnBy(deep, -way);
    return {-work.rolling, -work.torsion};
}

// Springs of rolling (lever R*) and torsion (2 R*, so four times as stiff) with Mindlin's stiffness k = 8 G*
// a. Those that keep their stretch gain (k_2 - k_1) s^2 / 2, as the sliding spring above; those that keep
// their force put in k_1 s^2 / 2 and take out (2 k_1 - k_2) s^2 / 2. 1e-11: rounding of the sums over 1000
// steps.
TEST(RollingTorsionOfAnyLaw, gainsNothingBesideIncrements) {
    const double s = 1e-7;  // m
    for (const double ratio : {1.0, 4.0, 9.0}) {
        const double root = std::sqrt(ratio);
        const double stored = 0.5 * 8 * shearModulus * std::sqrt(radius * overlap) * s * s;
        const auto expect = [&](const Torques& gained, double expected) {
            EXPECT_NEAR(gained.rolling, expected * stored, 1e-11 * root * stored);
            EXPECT_NEAR(gained.torsion, 4 * expected * stored, 4e-11 * root * stored);
        };
        const double deep = ratio * overlap;
        expect(gainedByPressingATurnedContact<MindlinRollingTorsion>(overlap, deep, s), root - 1);
        expect(gainedByPressingATurnedContact<MindlinIncrementalRollingTorsion>(overlap, deep, s), 1 - root);
        expect(gainedByPressingATurnedContact<MindlinPartialSlipRollingTorsion>(overlap, deep, s), 1 - root);
    }
}

// A spring with a stiffness of its own, k, does not follow the contact: the torque stays k s.
TEST(RollingTorsionOfAnyLaw, leavesSpringsOfAConstantStiffness) {
    Turned<MindlinIncrementalRollingTorsion> contact(1e6);
    const double k = 1e4, s = 1e-7;  // N/m, m
    contact.law.setRollingStiffness(k), contact.law.setTorsionStiffness(k);
    contact.turn(overlap, s);
    for (const double depth : {4 * overlap, 9 * overlap, 0.25 * overlap}) {
        const Torques now = contact.turn(depth, 0);
        EXPECT_NEAR(now.rolling / (k * s), 1, 1e-14);
        EXPECT_NEAR(now.torsion / (4 * k * s), 1, 1e-14);
    }
}

/// Bit for bit: the tangential force and what the contact remembers of it are those of the law itself.
template <class Law>
void expectTheSameSliding() {
    using Composed = WithRollingTorsion<Law>;
    Draw draw(7);
    Law alone;
    Composed composed;
    for (const auto& field : Law::fields())
        alone.*field.member = composed.*field.member = field.unit == "Pa"    ? 1e9
                                                       : field.unit == "N/m" ? 1e5
                                                                             : field.range.lowest + 0.3;
    composed.setRollingFrictionCoefficient(0.2), composed.setTorsionFrictionCoefficient(0.1);
    composed.setRollingStiffness(1e4), composed.setTorsionStiffness(1e4);
    typename Law::template History<double> springs{};
    typename Composed::template History<double> both{};
    int slid = 0;
    for (int k = 0; k < 1000; ++k) {
        const Contact<double> contact(overlap * draw.uniform(0.2, 1), radius, 1e-6);
        const Slip<double> slip{.velocity = {draw.uniform(-1, 1), draw.uniform(-1, 1), 0},
                                .timeBefore = 1e-7,
                                .timeAfter = 1e-7,
                                .response = 1e-3};
        const double push = load * draw.uniform(0, 1);
        const auto one = sliderForce<Law>(alone.prepare(AnyNormalLaw{}), contact, push, slip, springs);
        const auto other = Composed::slide(composed.prepare(AnyNormalLaw{}), contact, push, slip, both);
        Composed::rotate(composed.prepare(AnyNormalLaw{}), contact, push, {0, 0, 1}, slip, both);
        for (const auto axis : {&Vector<double>::x, &Vector<double>::y, &Vector<double>::z}) {
            ASSERT_EQ(one.force.*axis, other.force.*axis) << Composed::name << " " << k;
            ASSERT_EQ(springs.slidingSpring().*axis, both.slidingSpring().*axis) << Composed::name;
        }
        slid += one.slides ? 1 : 0;
    }
    EXPECT_TRUE(slid > 100 && slid < 1000) << Composed::name << " " << slid;
}

TEST(RollingTorsionOfAnyLaw, doesNotChangeTheSliding) {
    expectTheSameSliding<Mindlin>();
    expectTheSameSliding<MindlinIncremental>();
    expectTheSameSliding<MindlinPartialSlip>();
    expectTheSameSliding<SlidingFriction>();
}

// At a contact radius that stays, the torques are those of MindlinRollingTorsion with the same numbers, bit
// for bit, where the springs hold and where they slide.
TEST(RollingTorsionOfAnyLaw, hasTheTorquesOfMindlinRollingTorsion) {
    Draw draw(8);
    Turned<MindlinRollingTorsion> one(0.1);
    Turned<MindlinIncrementalRollingTorsion> other(0.1);
    const double limit = 0.1 * load;  // N, of rolling
    int slid = 0;
    for (int k = 0; k < 1000; ++k) {
        const double way = draw.uniform(-1, 1) * limit / (8 * shearModulus * std::sqrt(radius * overlap));
        const Torques expected = one.turn(overlap, way), found = other.turn(overlap, way);
        ASSERT_EQ(found.rolling, expected.rolling);
        ASSERT_EQ(found.torsion, expected.torsion);
        slid += std::abs(found.rolling) > 0.999 * limit ? 1 : 0;
    }
    EXPECT_TRUE(slid > 100 && slid < 900) << slid;
}

}  // namespace
}  // namespace pendular::reducedProfileTest
