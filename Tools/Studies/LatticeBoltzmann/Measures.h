#pragma once

#include <functional>
#include <vector>

#include "Tools/Studies/LatticeBoltzmann/TwoFluids.h"

namespace pendular::lattice {

/// The two phases that a flat interface separates: the densities of the component that prevails, and of the
/// other one.
struct Phases {
    double majority = 0.70, minority = 0.04;
};

/// Densities at a signed distance from the surface of the first component, negative within it: where a run
/// begins.
[[nodiscard]] Densities phaseAt(double distance, const Phases& phases = {});

/// A flat interface at rest.
struct FlatInterface {
    double majority, minority;  // densities
    double tension;             // gamma
};

/// The sum of P_nn - P_tt over a box with two interfaces: the definition of gamma (Kirkwood and Buff, J.
/// Chem. Phys. 17 (1949) 338), with the exact pressure of the lattice's pairs. The interface lies at 45
/// degrees: one along an axis has a tension that depends by 0.5 % on where between two nodes it is.
[[nodiscard]] FlatInterface flatInterface(const FluidSettings& settings, const Phases& phases = {});

/// gamma at a density of the component that prevails: the straight line through two flat interfaces, at 0.721
/// and 0.756 for G = 0.1 and tau = 1, which are about those of drops and bridges.
class TensionLine {
public:
    explicit TensionLine(const FluidSettings& settings);
    [[nodiscard]] double at(double majority) const;

private:
    FlatInterface low, high;
};

/// Where the density of the first component passes a level, between neighbours along the axes of the lattice,
/// of fluid both.
[[nodiscard]] std::vector<Vector<double>> crossings(const TwoFluids& fluids, double level);

/// Calls function(node, share) for each node with a share of its cube in which the first component is denser
/// than a level: what a plane with the gradient there cuts off, to first order.
void forEachVolumeAbove(const TwoFluids& fluids, double level,
                        const std::function<void(const Node&, double)>& function);
/// The volume in the box in which the first component is denser than a level: the sum of these shares.
[[nodiscard]] double volumeAbove(const TwoFluids& fluids, double level);

/// A sphere, or a circle where all points have the same z, whose centre lies on the line through `axis` along
/// `direction`: the least squares of |x|^2 - R^2 (I. Kasa, IEEE Trans. Instrum. Meas. 25 (1976) 8).
struct FittedCircle {
    double along;  // of the centre, from `axis`
    double radius;
};
[[nodiscard]] FittedCircle fitOnLine(const std::vector<Vector<double>>& points, const Vector<double>& axis,
                                     const Vector<double>& direction);

/// A node well inside the liquid, and one far outside.
struct Probes {
    Node liquid, other;
};
/// The mean of the densities of the first component at both: where the surface is.
[[nodiscard]] double midLevel(const TwoFluids& fluids, const Probes& probes);
/// Adds liquid, and takes as much of the other fluid, until the volume inside the mid level is the wanted one
/// (nodes^3, in the box) to within a share, four times in a row. Returns the steps done.
std::size_t addLiquidUntil(TwoFluids& fluids, const Probes& probes, double wanted, double tolerance,
                           std::size_t limit);
/// The last node of the box along all axes.
[[nodiscard]] Node lastNode(const TwoFluids& fluids);
/// The radius (nodes) of the cylinder that, between two spheres on its axis, has a volume (nodes^3).
/// @param radii, gap nodes
[[nodiscard]] double cylinderBetween(const std::array<double, 2>& radii, double gap, double volume);

/// Makes steps until `value` changes by less than `tolerance` over `window` steps, or to the limit. Returns
/// the steps done.
std::size_t settle(TwoFluids& fluids, const std::function<double()>& value, double tolerance,
                   std::size_t window, std::size_t limit);

}  // namespace pendular::lattice
