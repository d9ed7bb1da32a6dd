#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Laws/Adhesion/DMT.h"
#include "Kernel/Laws/Adhesion/IrreversibleAdhesive.h"
#include "Kernel/Laws/Adhesion/JKR.h"
#include "Kernel/Laws/Adhesion/ReversibleAdhesive.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Laws/Species/SpeciesHandler.h"
#include "SelfTests/Support/Draw.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::solidAdhesionTest {
namespace {

using support::Draw;

constexpr double pi = std::numbers::pi;

double hertz(double modulus, double radius, double overlap) {
    return overlap > 0 ? 4.0 / 3 * modulus * std::sqrt(radius * overlap) * overlap : 0;
}

/// One JKR contact, by the equations of Johnson, Kendall and Roberts in the contact radius a.
struct Neck {
    double modulus, radius, work;  // E* in Pa, R* in m, w in J/m^2

    [[nodiscard]] double overlap(double a) const {
        return a * a / radius - std::sqrt(2 * pi * work * a / modulus);
    }
    [[nodiscard]] double force(double a) const {
        return 4 * modulus * a * a * a / (3 * radius) - std::sqrt(8 * pi * work * modulus * a * a * a);
    }
    /// The radius at which the stable branch ends at a given displacement: d(overlap)/da = 0.
    [[nodiscard]] double smallestRadius() const {
        return std::cbrt(pi * work * radius * radius / (8 * modulus));
    }
    [[nodiscard]] double zeroLoadRadius() const {
        return std::cbrt(4.5 * pi * work * radius * radius / modulus);
    }
    [[nodiscard]] JKRInteraction<double> prepare() const {
        JKR law;
        law.setWorkOfAdhesion(work);
        law.setAdhesionModulus(modulus);
        return law.prepare(Bodies{2 * radius, 2 * radius});
    }
    /// The elastic force of a Hertzian normal law less the attraction.
    [[nodiscard]] double composed(double d) const { return hertz(modulus, radius, d) - prepare().force(-d); }
};

Neck randomNeck(Draw& draw) {
    return {draw.logarithmic(1e5, 1e11), draw.logarithmic(1e-7, 1e-2), draw.logarithmic(1e-3, 1)};
}

// The neck is found to 3e-11, x^6 of it to 2e-10 of F_c and of the force; overlaps up to 100 a_0^2 / R* take
// another 1e-13 by the difference to Hertz. At the end of the branch the root of the overlap loses half of
// the digits: there the tolerance is the change of F, with dF/dx = 24 x^5 - 12 x^2 = -2.4 (in F_c), by the x
// that roundings of 3e-16 of the overlap hide, sqrt(3e-16 / 1.8) = 1.3e-8.
TEST(JKR, composedForceIsThatOfTheTheory) {
    Draw draw(1);
    for (int k = 0; k < 300; ++k) {
        const Neck neck = randomNeck(draw);
        const double end = neck.smallestRadius(), pullOff = 1.5 * pi * neck.work * neck.radius;
        for (const double share : {1.0, 1 + 1e-9, 1 + 1e-6, 1.001, 1.1, 1.5, 2.0, 3.0, 10.0, 30.0}) {
            const double expected = neck.force(share * end), d = neck.overlap(share * end);
            const double hidden = share < 1.0001 ? 4e-8 : 0;
            EXPECT_NEAR(neck.composed(d), expected, (5e-10 + hidden) * pullOff + 5e-10 * std::abs(expected))
                << share;
        }
        EXPECT_NEAR(neck.prepare().range() / -neck.overlap(end), 1, 1e-13);
    }
}

// Pull-off 3/2 pi w R* at a = (1/2)^(2/3) a_0, 5/9 of it where the neck snaps, 8/9 at the first touch; no
// force at d = a_0^2 / (3 R*). The largest pull is flat: 1e-4 of the way off it changes by 1e-8.
TEST(JKR, neckHasItsPublishedPoints) {
    const Neck neck{1e9, 1e-5, 0.05};
    const double pullOff = 1.5 * pi * 0.05 * 1e-5, a0 = neck.zeroLoadRadius(), length = a0 * a0 / 1e-5;
    double largest = 0;
    for (int k = 0; k <= 10000; ++k)
        largest = std::max(largest, -neck.composed(neck.prepare().range() * (1e-4 * k - 1)));
    EXPECT_NEAR(largest / pullOff, 1, 1e-7);
    EXPECT_NEAR(neck.composed(-neck.prepare().range()) / pullOff, -5.0 / 9, 1e-7);
    EXPECT_NEAR(neck.composed(0) / pullOff, -8.0 / 9, 1e-9);
    EXPECT_NEAR(neck.composed(length / 3) / pullOff, 0, 1e-9);
}

TEST(JKR, withoutWorkIsNothing) {
    JKR law;
    law.setWorkOfAdhesion(0);
    law.setAdhesionModulus(1e9);
    EXPECT_EQ(law.range(Bodies{1e-3}), 0);
    for (const double separation : {-1e-4, 0.0, 1e-4})
        EXPECT_EQ(law.prepare(Bodies{1e-3}).force(separation), 0);
}

// E* of the pair is that of the pair's normal law, also where that is set for the pair alone.
TEST(JKR, takesTheModulusOfAHertzianNormalLaw) {
    using Sticky = Species<HertzianViscoelastic, NoFriction, JKR>;
    SpeciesHandler<Sticky> handler;
    for (const double modulus : {1e6, 3e6}) {
        Sticky species;
        species.setDensity(2000);
        species.setEffectiveElasticModulus(modulus);
        species.setWorkOfAdhesion(0.1);
        handler.copyAndAddObject(species);
    }
    handler.mixAll();
    EXPECT_EQ(handler.mixture(0, 0).getAdhesionModulus(), 1e6);
    EXPECT_EQ(handler.mixture(0, 1).getAdhesionModulus(), handler.mixture(0, 1).getEffectiveElasticModulus());
    handler.getMixedObject(0, 1)->setEffectiveElasticModulus(7e6);
    handler.mixAll();
    EXPECT_EQ(handler.mixture(1, 0).getAdhesionModulus(), 7e6);

    using Linear = Species<LinearViscoelastic, NoFriction, JKR>;
    Linear linear;
    linear.setDensity(2000);
    linear.setStiffness(100);
    linear.setWorkOfAdhesion(0.1);
    SpeciesHandler<Linear> linearHandler;
    auto* added = linearHandler.copyAndAddObject(linear);
    EXPECT_TRUE(support::contains(support::refusal([&] { linearHandler.mixAll(); }), "adhesionModulus"));
    added->setAdhesionModulus(1e6);
    EXPECT_EQ(support::refusal([&] { linearHandler.mixAll(); }), "");
}

// 2 pi R* w in contact: the pull-off force of Derjaguin, Muller and Toporov, at overlap 0. Outside it is van
// der Waals' F_0 / (1 + S/z_0)^2 except for 1 % of F_0 that goes from nothing at contact to all at the range.
TEST(DMT, pullsWithTwoPiTimesRadiusAndWork) {
    const double work = 0.05, distance = 4e-10, z = distance;
    DMT law;
    law.setWorkOfAdhesion(work);
    law.setSurfaceDistance(distance);
    for (const Bodies bodies : {Bodies{2e-6, 3e-6}, Bodies{2e-6}}) {
        const double contactForce = 2 * pi * work * bodies.effectiveRadius();
        const auto contact = law.prepare(bodies);
        EXPECT_NEAR(contact.force(0) / contactForce, 1, 1e-14);
        EXPECT_EQ(contact.range(), 9 * distance);
        EXPECT_NEAR(contact.force(contact.range()) / contactForce, 0, 1e-15);
        for (const double s : {0.1, 1.0, 3.0, 8.0}) {
            const double exact = contactForce / std::pow(1 + s, 2);
            EXPECT_LT(contact.force(s * z), exact);
            EXPECT_GT(contact.force(s * z), exact - 0.01 * contactForce);
        }
    }
    law.setWorkOfAdhesion(0);
    EXPECT_EQ(law.range(Bodies{1e-6}), 0);
}

TEST(AdhesionRamp, fallsLinearlyToZeroAtItsRange) {
    const auto expectRamp = []<class Law>(Law law) {
        law.setAdhesionForceMax(3e-4);
        law.setAdhesionStiffness(60);
        const auto contact = law.prepare(Bodies{1e-3});
        EXPECT_NEAR(contact.range() / 5e-6, 1, 1e-15);
        EXPECT_EQ(contact.force(0), 3e-4);
        EXPECT_NEAR(contact.force(2e-6), 1.8e-4, 1e-18);
        EXPECT_NEAR(contact.force(contact.range()), 0, 1e-19);
    };
    expectRamp(ReversibleAdhesive{});
    expectRamp(IrreversibleAdhesive{});
}

}  // namespace
}  // namespace pendular::solidAdhesionTest
