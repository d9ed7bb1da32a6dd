#pragma once

#include "Tools/Studies/LatticeBoltzmann/Measures.h"

namespace pendular::lattice {

/// A bridge between two equal spheres on the z axis, of which an eighth is computed: mirror planes through
/// the axis and half way between the spheres. Of one that begins off the axis, and may slip along x, a
/// quarter: without the plane across x.
struct BridgeCase {
    double radius = 20;     // R, nodes
    double gap = 0.625;     // S/R
    double volume = 0.133;  // V/(4 pi R^3/3): where it begins
    double wetting = 0.1;   // Delta rho
    double pressure = 0;    // gamma/R, about what the liquid has: its densities begin so
    double start = 0;       // off the axis along x, where the liquid begins, in R; 0: an eighth is computed
    FluidSettings fluid;
};

[[nodiscard]] TwoFluids beginBridge(const BridgeCase& bridge);

/// What a bridge is, in units of R; forces attract.
struct BridgeState {
    double tension;        // gamma at the mean density of the liquid and the other fluid, lattice units
    double volume;         // V/(4 pi R^3/3), inside the mid level
    double force;          // F/(gamma R): of the sphere
    double thrust;         // the same by the momentum through the mid plane and the far side
    double offAxis;        // of the centre of the liquid in the mid plane, along x, in R
    double waist;          // radius of the liquid in the mid plane, of its area, in R
    double liquid, other;  // densities of the component that prevails
    double speed;          // largest, lattice units
    double capillaryNumber;
};

/// Forces are means over 500 steps, which are made: that of one step is up to 7 % off at R = 8.
/// @param line gamma over the density
[[nodiscard]] BridgeState measure(TwoFluids& fluids, const BridgeCase& bridge, const TensionLine& line);

/// Brings the bridge to rest with its volume. Returns the steps done.
std::size_t pour(TwoFluids& fluids, const BridgeCase& bridge, double tolerance, std::size_t limit);

/// The angle in degrees at which a drop, without change along z, meets a plane of this Delta rho: of the
/// circle through the mid level 6 nodes off the plane and farther.
/// @param dropRadius of the half circle that it begins as, nodes
[[nodiscard]] double angleOnPlane(double wetting, double dropRadius, const FluidSettings& settings);
/// A drop on the pole of a sphere, degrees.
struct DropOnSphere {
    double
        angle;    // at which it meets the sphere: of the sphere through the mid level 6 nodes off and farther
    double line;  // between the pole and the line of contact, from the centre of the sphere
};
/// @param drop radius of the drop that it begins as, about the pole, in R
[[nodiscard]] DropOnSphere dropOnSphere(double wetting, double radius, double drop,
                                        const FluidSettings& settings);

}  // namespace pendular::lattice
