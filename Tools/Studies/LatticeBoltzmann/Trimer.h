#pragma once

#include "Tools/Studies/LatticeBoltzmann/Measures.h"

namespace pendular::lattice {

/// Three equal spheres at the corners of an equilateral triangle, with bridges at two pairs or at all three.
/// A quarter is computed: mirror planes through the centres (z = 0), and through that of the first sphere and
/// half way between the others (x = 0).
struct TrimerCase {
    double radius = 14;     // R, nodes
    double gap = 0.1;       // S/R, of each pair
    double volume = 0.1;    // of all liquid, V/(4 pi R^3/3): where it begins
    double wetting = 0.11;  // Delta rho
    double pressure = 0;    // gamma/R, about what the liquid has: its densities begin so
    bool isClosed = false;  // a bridge between the second and the third sphere, too
    FluidSettings fluid;
};

[[nodiscard]] TwoFluids beginTrimer(const TrimerCase& trimer);

/// In units of R and gamma.
struct TrimerState {
    double volume;  // V/(4 pi R^3/3), inside the mid level
    // What pulls the first sphere towards the others, and twice what pulls each of these to it, over sqrt(3)
    // gamma R: the force along each side that has a bridge. At rest they are alike.
    double pairForce, otherPairForce;
    double section;  // area of liquid in the plane x = 0, R^2: 0 where two bridges are separate
    bool isPocketFull,
        isThirdGapFull;  // with liquid: at the centroid; half way between the second and the third
};
/// Forces are means over 500 steps, which are made.
[[nodiscard]] TrimerState measure(TwoFluids& fluids, const TrimerCase& trimer, const TensionLine& line);

/// Adds liquid to this volume, V/(4 pi R^3/3), and lets it come to rest. Returns the steps done.
std::size_t pour(TwoFluids& fluids, const TrimerCase& trimer, double volume, double tolerance,
                 std::size_t limit);

}  // namespace pendular::lattice
