#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "Kernel/Features/Bonds/BondLaw.h"

// The forces in the section of a bond, and when it breaks by them, where it bends in two planes at once.

namespace pendular::bondSectionTest {
namespace {

constexpr double length = 2e-3, tensile = 2e5, shearing = 1e5;  // m, Pa
constexpr BondSection section{5e-4};
const BondStiffness beam = beamBond(1e8, 4e7, 0.9, section, length);

/// A bond along x whose ends are turned (rad) about y, oppositely, and about z, alike: the first bends it by
/// the moment 2 k_b a alone, the second shears it by V = k_s L b, with the moments V L / 2 on both ends.
BondState bentAndSheared(double bend, double shear) {
    const auto axes = [](double aboutY, double aboutZ) {
        return Axes<double>(Quaternion{1, {0, 0.5 * aboutY, 0.5 * aboutZ}}.normalised());
    };
    return {{length, 0, 0}, length, axes(-bend, shear), axes(bend, shear)};
}

// The moment of a beam along x: m_y the same everywhere, m_z from -V L / 2 to V L / 2. So at both ends
// sqrt(m_y^2 + (V L / 2)^2), and m_y in the middle; the sum m_y + V L / 2 would be up to sqrt(2) more. The
// small turns, 1e-6, are exact to their square, and the sums of unit vectors to 1e-16 of 1e-6.
TEST(BondSection, momentsOfTheEndsAreVectors) {
    for (const double ratio : {0.0, 0.2, 1.0, 5.0}) {
        const double bend = 1e-6, moment = 2 * beam.bending * bend;
        const double force = 2 * ratio * moment / length;  // V, N: V L / 2 is the ratio times the moment
        const BondState bond = bentAndSheared(bend, force / (beam.shear * length));
        const BondLoad load = bond.elastic(beam);
        const SectionLoad atEnds(bond, load, true), inMiddle(bond, load, false);
        EXPECT_NEAR(atEnds.bending / (moment * std::sqrt(1 + ratio * ratio)), 1, 1e-8) << ratio;
        EXPECT_NEAR(inMiddle.bending / moment, 1, 1e-8) << ratio;
        EXPECT_NEAR(atEnds.shear, force, 1e-8 * moment / length) << ratio;
    }
}

// The larger of the two ends: a cantilever with the force P across at its free end has P L at the held one,
// and nothing at the other.
TEST(BondSection, theLargerEndCounts) {
    const double p = 1e-3;  // N
    const BondState bond{{length, 0, 0}, length, Axes<double>(Quaternion{}), Axes<double>(Quaternion{})};
    for (const bool firstIsHeld : {true, false}) {
        BondLoad load{.force = {0, -p, 0}};
        (firstIsHeld ? load.torque1 : load.torque2) = {0, 0, p * length};
        EXPECT_NEAR(SectionLoad(bond, load, true).bending / (p * length), 1, 1e-14);
        EXPECT_NEAR(SectionLoad(bond, load, false).bending / (0.5 * p * length), 1, 1e-14);
    }
}

// Bent in one plane and sheared in the other, it breaks at sigma = |M| R / I with the vector's |M|, and not
// at 1/sqrt(2) of it.
TEST(BondSection, breaksByTheMomentOfTheEnd) {
    const double moment = tensile * section.inertia() / section.radius / std::sqrt(2.0);  // about y and z
    const BondState unit = bentAndSheared(1e-6, 2e-6 * 2 * beam.bending / (beam.shear * length * length));
    const BondLoad small = unit.elastic(beam);
    const double scale = moment / (2 * beam.bending * 1e-6);
    for (const auto& [share, breaks] : {std::pair{0.999, false}, std::pair{1.001, true}}) {
        const double s = share * scale;
        const BondLoad load{s * small.force, s * small.torque1, s * small.torque2};
        EXPECT_EQ(SectionLoad(unit, load, true).breaks({.tensile = tensile}, section), breaks) << share;
        EXPECT_FALSE(SectionLoad(unit, load, false).breaks({.tensile = tensile}, section)) << share;
    }
}

}  // namespace
}  // namespace pendular::bondSectionTest
