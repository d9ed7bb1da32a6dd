#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "Tools/Studies/LatticeBoltzmann/Grid.h"
#include "Tools/Studies/LatticeBoltzmann/Solid.h"

namespace pendular::lattice {

/// The densities of the two components at a node.
using Densities = std::array<double, 2>;

struct PressureSums {
    double xx = 0, yy = 0, zz = 0, xy = 0;
};

struct FluidSettings {
    double coupling = 0.1;  // G, with the degeneracies 2 and 1: 3.6 with the weights of the lattice
    int threads = 1;
    double friction =
        0;  // share of the momentum that is taken from each node in each step: for coming to rest
};

/// Kinematic, of both components: (2 tau - 1)/6 for tau = 1.
inline constexpr double viscosity = 1.0 / 6;

/// Two fluids that repel each other on a D3Q19 lattice: X. Shan and H. Chen, Phys. Rev. E 47 (1993) 1815, as
/// in Yang, Sega and Harting, AIChE J. 67 (2021) e17350, equations 3 to 14:
/// - each component relaxes to the equilibrium of second order at u' + tau F/rho, u' the common velocity. tau
/// is 1:
///   what leaves a node is that equilibrium, and no population is stored, only a density and a velocity;
/// - F = -psi(x) G sum_i g_i psi'(x + c_i) c_i of the other component, psi = 1 - exp(-rho) (rho0 = 1), g as
/// degeneracy();
/// - populations are thrown back half way to a solid, with its momentum if it moves: A. J. C. Ladd, J. Fluid
/// Mech. 271
///   (1994) 285;
/// - the outer shell of a solid holds a virtual fluid: the mean of the fluid nodes beside it, plus Delta rho
/// of the
///   first component and minus Delta rho of the second, not below 0 (equations 13 and 14).
/// Everything is in lattice units. The bits do not depend on the number of threads.
class TwoFluids {
public:
    /// At rest, with these densities. Throws InputError for settings that cannot be.
    TwoFluids(const Box& box, std::vector<Solid> solids, const FluidSettings& settings,
              const std::function<Densities(const Vector<double>&)>& begin);

    void step();
    void steps(std::size_t count);
    void setFriction(double friction) { settings_.friction = friction; }

    [[nodiscard]] const Grid& grid() const { return grid_; }
    [[nodiscard]] const FluidSettings& settings() const { return settings_; }
    /// The number of the solid that has this node, or -1: fluid. Also for nodes just beyond the box.
    [[nodiscard]] int solidAt(const Node& node) const { return solidOf[grid_.at(node)]; }
    [[nodiscard]] Densities densityAt(const Node& node) const;
    /// rho/3 of both + 12 G psi psi': the equation of state.
    [[nodiscard]] double pressureAt(const Node& node) const;
    /// Of both together: momentum with half of the force, over density.
    [[nodiscard]] Vector<double> velocityAt(const Node& node) const;
    [[nodiscard]] double largestSpeed() const;
    /// Of each component, over all fluid nodes.
    [[nodiscard]] Densities mass() const;
    [[nodiscard]] std::vector<SolidForce> solidForces() const;
    /// Momentum along an axis that crosses its first (false) or last (true) mirror plane in a step, towards
    /// larger coordinates: pressure times area. Throws InputError where the sides are no mirrors.
    [[nodiscard]] double thrustThroughSide(std::size_t axis, bool isLast) const;
    /// The sum over the box of the pressure tensor: moving populations, and pairs of nodes.
    [[nodiscard]] PressureSums pressureSums() const;
    /// Solids in other places, as many as before: for those that move through the lattice. A node that one
    /// uncovers gets the mean of the fluid nodes beside it, at the solid's velocity. Then each component gets
    /// back the mass that it is to have, in proportion to what is there, on all nodes where it prevails:
    /// links that move make mass on one side of a solid and take it on the other, as the nodes that it covers
    /// and uncovers do in return. Returns what was added to each.
    /// @param wanted mass(), as it was before the solids moved for the first time
    Densities moveSolids(std::vector<Solid> moved, const Densities& wanted);
    /// Multiplies the densities of each fluid node by what function(node) says.
    void scale(const std::function<Densities(const Node&)>& function);

private:
    struct Span {
        std::size_t begin, count;      // sites in a row, whole packs, with few that are not of fluid
        std::size_t firstHole, holes;  // these few
        std::size_t firstLink, links;
    };
    using Field = std::vector<double>;
    struct Component {
        Field density, psi;
        std::array<Field, 3> velocity;  // of the equilibrium that leaves a node; while it streams, momentum
        Field base;                     // density (1 - 1.5 velocity^2); all are 0 where no fluid is, but psi
        Field nextDensity;
        std::array<Field, 3> nextMomentum;
    };
    struct Ghost {
        std::size_t to, from;
        std::array<double, 3> sign;  // of the velocity, in a mirror
    };
    /// A population that a solid throws back to the site of fluid from which it came.
    struct Link {
        std::size_t site, direction;  // in which it comes back
        int solid;
        double factor;  // times the density: what a moving solid adds to it
    };
    struct Shell {
        std::size_t site, firstNeighbour, neighbours;
        double wetting;
    };

    void layOut();
    void findSolids();
    void addToSpans(const Node& node);
    void addLinks(const Node& node);
    void addShell(const Node& node);
    void setEquilibrium(std::size_t site, const Densities& rho, const Vector<double>& velocity = {0, 0, 0});
    void uncover(const Node& node, const std::vector<int>& before);
    void forEachSpan(const std::function<void(const Span&)>& function) const;
    void stream(const Span& span);
    void throwBack(Component& own, const Span& span) const;
    void findPsi();
    void collide(const Span& span);
    void fillGhosts();
    /// What leaves a node in a direction: the equilibrium, equation 6.
    [[nodiscard]] double population(const Component& own, std::size_t direction, std::size_t site) const;
    [[nodiscard]] Vector<double> forceOn(std::size_t component, std::size_t site) const;

    Grid grid_;
    std::vector<Solid> solids;
    FluidSettings settings_;
    std::vector<int> solidOf;  // by site, ghosts included
    std::vector<Span> spans;   // of fluid
    std::vector<std::size_t> holes;
    std::vector<Ghost> ghosts;
    std::vector<Link> links;
    std::vector<Shell> shells;
    std::vector<std::size_t> shellNeighbours;
    std::array<Component, 2> components;
};

}  // namespace pendular::lattice
