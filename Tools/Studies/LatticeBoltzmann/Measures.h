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

/// Densities of the two components in the liquid, and in the fluid around it.
struct Contents {
    Densities liquid, other;
};
/// Those at rest where the liquid has more pressure, by so much in lattice units: straight lines through what
/// drops of R = 10 to 40 have at G = 0.1. From densities that are not so, liquid condenses or dissolves for
/// some R^2/viscosity steps.
[[nodiscard]] Contents contentsAt(double pressure);
[[nodiscard]] Densities phaseAt(double distance, const Contents& contents);

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
/// and 0.756 for G = 0.1, which are about those of drops and bridges.
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
/// What a run brings to rest: this volume of liquid (nodes^3, in the box) to within a share, and a force on
/// the solid of a radius.
struct Rest {
    double volume, tolerance, radius;
    std::function<Vector<double>()> force;  // lattice units
};
/// Adds liquid, and takes as much of the other fluid, until the volume inside the mid level is the wanted
/// one, four times in a row. This has friction, without which the sound of the beginning takes R^2 steps to
/// die out. Then makes steps until the mean force over 500 of them changes by less than 2e-4, or to the
/// limit. Returns the steps done.
std::size_t bringToRest(TwoFluids& fluids, const Probes& probes, const Rest& rest, std::size_t limit);
/// The last node of the box along all axes.
[[nodiscard]] Node lastNode(const TwoFluids& fluids);
/// The radius (nodes) of the cylinder that, between two spheres on its axis, has a volume (nodes^3).
/// @param radii, gap nodes
[[nodiscard]] double cylinderBetween(const std::array<double, 2>& radii, double gap, double volume);

/// The mean of `value` over steps that are made: of each fifth one. A lattice has modes that change their
/// sign from step to step, and sound that runs to and fro in the box; both die out slowly.
[[nodiscard]] Vector<double> meanOver(TwoFluids& fluids, std::size_t steps,
                                      const std::function<Vector<double>()>& value);

/// Makes steps until `value` changes by less than `tolerance` over `window` steps, or to the limit. Returns
/// the steps done.
std::size_t settle(TwoFluids& fluids, const std::function<double()>& value, double tolerance,
                   std::size_t window, std::size_t limit);

}  // namespace pendular::lattice
