#pragma once

#include "Tools/Studies/LatticeBoltzmann/Measures.h"

namespace pendular::lattice {

/// A bridge between two spheres on the z axis, of any radii and Delta rho, of which a quarter is computed:
/// mirror planes through the axis.
struct PairCase {
    std::array<double, 2> radius{20, 20};     // nodes, of the lower and the upper one
    std::array<double, 2> wetting{0.1, 0.1};  // Delta rho
    double gap = 12;                          // nodes
    double volume = 4500;                     // nodes^3
    double pressure = 0;  // gamma over the mean radius, about what the liquid has: its densities begin so
    double room = 0;      // nodes, by which the gap is to grow
    FluidSettings fluid;
};

/// In lattice units, of the whole bridge; forces attract.
struct PairState {
    double tension, volume;
    std::array<double, 2> force;  // on each sphere, means over 500 steps, which are made
    double liquid, other;         // densities of the component that prevails
};

[[nodiscard]] TwoFluids beginPair(const PairCase& pair);
/// Pours the volume in, and lets it come to rest. Returns the steps done.
std::size_t pour(TwoFluids& fluids, const PairCase& pair, double tolerance, std::size_t limit);
[[nodiscard]] PairState measure(TwoFluids& fluids, const PairCase& pair, const TensionLine& line);

/// Two spheres that part at a speed until their bridge breaks, and what is left on each.
struct Parting {
    double speed = 0.005;  // nodes a step, of one against the other
};
struct PartingRow {
    double gap, volume;           // nodes, nodes^3
    std::array<double, 2> force;  // on each sphere, attract, over gamma
};
struct PartingEnd {
    double gap;                   // where the bridge broke, nodes; not a number where it did not
    std::array<double, 2> share;  // of the liquid, on the lower and the upper sphere
    double corrected;             // of the liquid, given or taken in all so that its mass stays (TwoFluids)
};
/// @param note called for each tenth of a node
[[nodiscard]] PartingEnd part(TwoFluids& fluids, const PairCase& pair, const Parting& parting,
                              const TensionLine& line, const std::function<void(const PartingRow&)>& note);

}  // namespace pendular::lattice
