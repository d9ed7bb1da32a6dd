/// The exact contact with partial slip against the closed forms of Mindlin (1949) and of Mindlin and
/// Deresiewicz (1953), as in Johnson (1985), Contact Mechanics, section 7.2, and the measured impacts of
/// Kharaz, Gorham and Salman (2001).

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "BuildFolders.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "Tools/Reference/ElasticImpact.h"

namespace pendular::partialSlipTest {
namespace {

constexpr int springs = 500;
/// The error of the sum over the springs, at most, over the force of full sliding: see PartialSlipContact.
constexpr double error = 0.9 / (springs * springs);

const PartialSlipConditions glass{1e-3, 3e10, 0.7e10, 0.3};
constexpr double depth = 1e-6;  // m

/// A contact that is pressed to an overlap before it slips; the curve of Mindlin (1949) is
/// Q = mu P (1 - (1 - y)^(3/2)), y the slip over 3 mu P / (16 G* a) (Johnson, equation 7.42).
struct Pressed {
    explicit Pressed(double overlap = depth, double largest = depth) : contact(glass, largest, springs) {
        contact.move(overlap, {0, 0, 0});
    }
    double slide(double slip) {  // returns the force against it, N
        contact.move(contact.overlap(), {slip, 0, 0});
        return -contact.tangentialForce().x;
    }
    PartialSlipContact contact;
};
double limit(double overlap = depth) { return glass.friction * glass.normalForce(overlap); }
double fullSlip(double overlap = depth) {
    return 3 * limit(overlap) / (16 * glass.shearModulus * glass.contactRadius(overlap));
}
double mindlin(double y) { return limit() * (1 - std::pow(std::max(1 - y, 0.0), 1.5)); }

TEST(PartialSlip, isMindlinsCurveUnderConstantLoad) {
    for (const double part : {0.01, 0.1, 0.3, 0.5, 0.8, 0.99, 1.0, 1.5}) {
        Pressed at;
        EXPECT_NEAR(at.slide(part * fullSlip()) / limit(), mindlin(part) / limit(), error) << part;
    }
    // The sum of the normal springs is Hertz's force, and the contact sticks within c = a (1 - y)^(1/2):
    // Johnson, equation 7.40, to one spring.
    Pressed at;
    at.slide(0.36 * fullSlip());
    EXPECT_NEAR(at.contact.stickingPart(), 0.8, 1.0 / springs);
}

// The steps of a path along a line do not matter.
TEST(PartialSlip, ofManyMovesIsThatOfOne) {
    Pressed one, many;
    double force = 0;
    for (int k = 0; k < 1000; ++k) force = many.slide(0.6e-3 * fullSlip());
    EXPECT_NEAR(one.slide(0.6 * fullSlip()), force, 1e-12 * limit());
}

// Unloading from Q0 at y0 follows Q = Q0 - 2 f((y0 - y)/2), f the first curve (Masing's rule; Johnson,
// equation 7.47), and the loop closes. Its area is the loss of a cycle. With z = 1 - y0, in units of mu P
// times the slip 3 mu P/(16 G* a), it is 8 (y0 - 2/5 (1 - z^(5/2))) - 4 y0 (1 - z^(3/2)) (Johnson,
// equation 7.48, in the slip).
TEST(PartialSlip, losesWhatMindlinAndDeresiewiczSay) {
    const int steps = 4000;
    for (const double most : {0.1, 0.5, 0.9}) {
        Pressed at;
        const double first = at.slide(most * fullSlip());
        double loss = 0, before = first, y = most;
        for (int k = 0; k < 2 * steps; ++k) {
            const double step = (k < steps ? -1 : 1) * 2 * most / steps;
            const double force = at.slide(step * fullSlip());
            y += step;
            loss += 0.5 * (force + before) * step / limit();
            before = force;
            if (k < steps) {
                EXPECT_NEAR(force / limit(), (first - 2 * mindlin(0.5 * (most - y))) / limit(), 3 * error);
            }
        }
        EXPECT_NEAR(before / limit(), first / limit(), 2 * error);
        const double z = 1 - most;
        const double expected = 8 * (most - 0.4 * (1 - std::pow(z, 2.5))) - 4 * most * (1 - std::pow(z, 1.5));
        // The sum of the springs over the length of the loop, and its trapezoids: steps of 2 y0 / steps
        // squared over 12, times the curvature of the curve, 3/8 (1 - y0)^(-1/2), 1.2 at most.
        EXPECT_NEAR(loss, expected, 4 * most * (3 * error + 0.1 * std::pow(2 * most / steps, 2))) << most;
    }
}

// A small cycle loses Q0^3 / (36 a mu P G*), the first term of the loop (Johnson, equation 7.49).
TEST(PartialSlip, lossOfASmallCycleIsCubic) {
    const double most = 0.01;
    PartialSlipContact contact(glass, depth, 20 * springs);
    contact.move(depth, {0, 0, 0});
    contact.move(depth, {most * fullSlip(), 0, 0});
    const double largest = -contact.tangentialForce().x;
    double loss = 0, before = largest;
    for (int k = 0; k < 4000; ++k) {
        const double slip = (k < 2000 ? -1 : 1) * 1e-3 * most * fullSlip();
        contact.move(depth, {slip, 0, 0});
        loss += 0.5 * (-contact.tangentialForce().x + before) * slip;
        before = -contact.tangentialForce().x;
    }
    const double expected =
        std::pow(largest, 3) / (36 * glass.contactRadius(depth) * limit() * glass.shearModulus);
    // The series of the loop goes on with 1 + y0 + 0.8 y0^2. Those that slip are 50 springs, from 0.995 a on,
    // and their sum errs by some (1/50)^2.
    EXPECT_NEAR(loss / expected, 1 + most, 0.001);
}

// Mindlin and Deresiewicz (1953): load and slip that grow together from nothing, with 4 G* slip < mu E*
// overlap, do not slip, and the force is 2/3 of 8 G* a times the slip: the mean of the stiffness.
TEST(PartialSlip, slipInProportionToTheOverlapMakesTwoThirdsOfTheStiffness) {
    const double slip = 0.7 * depth * glass.friction / glass.stiffnessRatio();
    for (const int moves : {1, 7}) {
        PartialSlipContact contact(glass, depth, springs);
        for (int k = 1; k <= moves; ++k) contact.move(k * depth / moves, {slip / moves, 0, 0});
        EXPECT_NEAR(-contact.tangentialForce().x,
                    2.0 / 3.0 * 8 * glass.shearModulus * glass.contactRadius(depth) * slip,
                    2 * error * limit());
        EXPECT_EQ(contact.stickingPart(), 1);
    }
}

// Any path whose slip grows faster than mu E* / (4 G*) times the overlap ends in the state of constant load:
// Q = mu (P(d) - P(d - slip 4 G* / (mu E*))), Jaeger's form of Mindlin's curve. An overlap that then grows
// alone changes nothing; one that falls leaves Q = mu (P(d) - P(d - slip ...)) with the new d, as if it had
// been so from the start.
TEST(PartialSlip, dependsOnTheEndOfAPathThatSlipsAllTheWay) {
    const double unit = depth * glass.friction / glass.stiffnessRatio();
    const auto jaeger = [&](double overlap, double slip) {
        return glass.friction * (glass.normalForce(overlap) -
                                 glass.normalForce(overlap - slip * glass.stiffnessRatio() / glass.friction));
    };
    PartialSlipContact contact(glass, depth, springs);
    contact.move(0.5 * depth, {0, 0, 0});
    contact.move(0.6 * depth, {0.3 * unit, 0, 0});
    const double force = -contact.tangentialForce().x;
    EXPECT_NEAR(force, jaeger(0.6 * depth, 0.3 * unit), 3 * error * limit());
    contact.move(depth, {0, 0, 0});
    EXPECT_NEAR(-contact.tangentialForce().x, force, 1e-12 * limit());
    contact.move(0.45 * depth, {0, 0, 0});
    EXPECT_NEAR(-contact.tangentialForce().x, jaeger(0.45 * depth, 0.3 * unit), 3 * error * limit());
}

// A contact that slips all over has Coulomb's force against its slip, in any direction, after any path.
TEST(PartialSlip, ofALongWayIsCoulombs) {
    Pressed at;
    at.contact.move(0.3 * depth, {5 * fullSlip(), 0, 0});
    for (int k = 0; k < 100; ++k) at.contact.move(depth, {0, 0.1 * fullSlip(), 0});
    // The old direction decays as exp(-way / full slip of a spring), at most 1.5 full slips.
    EXPECT_NEAR(at.contact.tangentialForce().y / limit(), -1, 2 * error + std::exp(-2 * 10 / 1.5));
    at.contact.move(-depth, {0, 0, 0});
    EXPECT_EQ(at.contact.tangentialForce(), (Vector<double>{0, 0, 0}));
    EXPECT_EQ(at.contact.normalForce(), 0);
}

TEST(PartialSlip, refusesWhatIsNoContact) {
    EXPECT_THROW(PartialSlipContact({-1, 1, 1, 0.3}, 1), InputError);
    EXPECT_THROW(PartialSlipContact({1, 1, 1, std::nan("")}, 1), InputError);
    EXPECT_THROW(PartialSlipContact(glass, 0), InputError);
    PartialSlipContact contact(glass, depth);
    EXPECT_THROW(contact.move(1.01 * depth, {0, 0, 0}), InputError);
    EXPECT_THROW(contact.move(std::nan(""), {0, 0, 0}), InputError);
}

// Impacts --------------------------------------------------------------------------------------------------

constexpr int steps = 2000;

/// The rebound of an elastic impact, in the numbers of Maw, Barber and Fawcett (1976), Wear 38, 101: psi =
/// kappa s / (mu v) with the slip s and the speed v along the normal, kappa = 4 G* / E*. Their 4 chi is 7
/// kappa.
double psiAfter(const PartialSlipConditions& conditions, double psiBefore, int stepsOfContact = steps,
                int springsOfContact = springs) {
    const ElasticImpact impact{.conditions = conditions, .mass = 1e-5, .approach = 0.1};
    const double unit = conditions.friction * impact.approach / conditions.stiffnessRatio();
    PartialSlipContact contact(conditions, 1.001 * impact.largestOverlap(), springsOfContact);
    const auto after = impact.solve({{psiBefore * unit, 0, 0}, {0, 0, 0}, 0}, contact, stepsOfContact);
    EXPECT_NEAR(after.normal / impact.approach, 1, 10.0 / (stepsOfContact * stepsOfContact));
    // Angular momentum about the contact point: rim = 5/2 of the change of the velocity.
    EXPECT_NEAR(after.rim.x, 2.5 * (after.velocity.x - psiBefore * unit), 1e-12 * psiBefore * unit);
    return after.slip().x / unit;
}

// Without a restitution the body never leaves.
TEST(PartialSlipImpact, endsWhereBodiesDoNotPart) {
    for (const double restitution : {0.0, 1e-300}) {
        const ElasticImpact impact{
            .conditions = glass, .mass = 1e-5, .approach = 0.1, .restitution = restitution};
        PartialSlipContact contact(glass, 1.001 * impact.largestOverlap(), springs);
        const std::string sentence = support::refusal([&] {
            (void)impact.solve({{0, 0, 0}, {0, 0, 0}, 0}, contact, 50);
        });
        EXPECT_TRUE(support::isOneSentence(sentence)) << sentence;
        EXPECT_TRUE(support::contains(sentence, "ElasticImpact: restitution = ")) << sentence;
    }
}

// From psi = 4 chi - 1 on an impact slides throughout, and its slip falls by 7 mu v: psi by 4 chi. Below, it
// does not.
TEST(PartialSlipImpact, slidesThroughoutFromMawsLimitOn) {
    const double slidesBy = 7 * glass.stiffnessRatio();
    for (const double psi : {slidesBy - 0.99, slidesBy, slidesBy + 3})
        // The impulse of the leapfrog, (2.9 pi / steps)^2 of it, and the sum over the springs.
        EXPECT_NEAR(psiAfter(glass, psi), psi - slidesBy,
                    20.0 / (steps * steps) * slidesBy + 2 * error * slidesBy)
            << psi;
    EXPECT_GT(psiAfter(glass, slidesBy - 1.5), -1.5 + 0.01);
}

// Without slip (psi -> 0) the slip's rate until the greatest overlap obeys v'' = -7/2 * 8 G* a v / m. With
// y = (overlap / greatest)^(5/2) that is the hypergeometric equation with c = 3/5, a + b = 1/10, a b = -21/20
// kappa, so that at y = 1 (Gauss) v = v0 G(c) G(1/2) / (G(c - a) G(c - b)): an impact that is just turned.
TEST(PartialSlipImpact, withoutSlipIsGausssHypergeometricFunction) {
    for (const double ratio : {0.5, 0.8, 1.0}) {
        const PartialSlipConditions rough{1e-3, 1e9, 0.25e9 * ratio, 1e4};
        const ElasticImpact impact{.conditions = rough, .mass = 1e-5, .approach = 0.1};
        PartialSlipContact contact(rough, 1.001 * impact.largestOverlap(), springs);
        const double root = std::sqrt(0.01 + 4 * 1.05 * ratio), a = 0.5 * (0.1 + root),
                     b = 0.5 * (0.1 - root);
        const double expected =
            std::tgamma(0.6) * std::sqrt(std::numbers::pi) / (std::tgamma(0.6 - a) * std::tgamma(0.6 - b));
        double largest = 0, speedThere = 0;
        const double h = impact.contactTime() / steps;
        impact.solve({{0.1, 0, 0}, {0, 0, 0}, 0}, contact, steps,
                     [&](double overlap, const Vector<double>& slip, const Vector<double>&) {
                         if (overlap <= largest) return;
                         largest = overlap;
                         speedThere = slip.x / h;
                     });
        // Seen at a step: the speed changes by up to 7/2 * 8 G* a (largest way) / m in half of one, some 3 /
        // steps.
        EXPECT_NEAR(speedThere / 0.1, expected, 5.0 / steps) << ratio;
    }
}

TEST(PartialSlipImpact, convergesTo1e5) {
    for (const double psi : {0.1, 0.9, 1.5, 3.0}) {
        const double finest = psiAfter(glass, psi, 4 * steps, 4 * springs);
        EXPECT_NEAR(psiAfter(glass, psi), finest, 1e-5 * (1 + psi)) << psi;
    }
}

// The measured restitution along the plane, without a free number: to an rms of 0.013. The best single spring
// (ChungOoiTest) has 0.036.
TEST(PartialSlipImpact, isMeasured) {
    const double poissonRatio = 0.23, modulus = 3.8e11, radius = 2.5e-3;
    const PartialSlipConditions oxide{radius, modulus / (1 - poissonRatio * poissonRatio),
                                      0.5 * modulus / ((1 + poissonRatio) * (2 - poissonRatio)), 0.092};
    const auto rows = support::rowsOf(
        support::contentOf(folders::source / "Drivers/ObliqueImpact/kharaz-2001-measured.csv"));
    double squares = 0;
    int measured = 0;
    for (const auto& row : rows) {
        if (row.at("quantity") != "e_t") continue;
        const double angle = std::stod(row.at("incidence_deg")) * std::numbers::pi / 180;
        const ElasticImpact impact{.conditions = oxide,
                                   .mass = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3) * 4000,
                                   .approach = 3.9 * std::cos(angle),
                                   .restitution = 0.98};
        PartialSlipContact contact(oxide, 1.001 * impact.largestOverlap(), springs);
        const double sideways = 3.9 * std::sin(angle);
        const auto after = impact.solve({{sideways, 0, 0}, {0, 0, 0}, 0}, contact, steps);
        squares += std::pow(after.velocity.x / sideways - std::stod(row.at("value")), 2);
        ++measured;
    }
    ASSERT_EQ(measured, 10);
    EXPECT_LT(std::sqrt(squares / measured), 0.5 * 0.036);
}

}  // namespace
}  // namespace pendular::partialSlipTest
