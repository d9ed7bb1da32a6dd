#include "Tools/Studies/LatticeBoltzmann/Measures.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Concepts/Field.h"

namespace pendular::lattice {

Densities phaseAt(double distance, const Contents& contents) {
    const double share = 0.5 - 0.5 * std::tanh(distance / 1.3);  // about as wide as the interface at G = 0.1
    const auto& [liquid, other] = contents;
    return {other[0] + share * (liquid[0] - other[0]), other[1] + share * (liquid[1] - other[1])};
}

Densities phaseAt(double distance, const Phases& phases) {
    return phaseAt(distance,
                   Contents{{phases.majority, phases.minority}, {phases.minority, phases.majority}});
}

Contents contentsAt(double pressure) {
    return {{0.70 + 5.7 * pressure, 0.0366 - 0.63 * pressure}, {0.0366 + 0.47 * pressure, 0.70}};
}

FlatInterface flatInterface(const FluidSettings& settings, const Phases& phases) {
    constexpr int length = 32;
    const double period = length / std::numbers::sqrt2;
    TwoFluids fluids({{length, length, 1}, {Sides::Periodic, Sides::Periodic, Sides::Periodic}}, {}, settings,
                     [&](const Vector<double>& place) {
                         const double across = std::fmod((place.x + place.y) / std::numbers::sqrt2, period);
                         return phaseAt(std::abs(across - 0.5 * period) - 0.25 * period, phases);
                     });
    fluids.steps(5000);
    const Densities middle = fluids.densityAt({length / 4, length / 4, 0});
    return {middle[0], middle[1], fluids.pressureSums().xy / (length * std::numbers::sqrt2)};
}

TensionLine::TensionLine(const FluidSettings& settings)
    : low(flatInterface(settings, {0.67, 0.04})), high(flatInterface(settings, {0.70, 0.04})) {}

double TensionLine::at(double majority) const {
    const double slope = (high.tension - low.tension) / (high.majority - low.majority);
    return low.tension + slope * (majority - low.majority);
}

std::vector<Vector<double>> crossings(const TwoFluids& fluids, double level) {
    std::vector<Vector<double>> points;
    fluids.grid().forEachNode([&](const Node& node) {
        if (fluids.solidAt(node) >= 0) return;
        const double here = fluids.densityAt(node)[0];
        for (const std::size_t i : {1, 3, 5}) {
            const Node next = neighbour(node, i);
            const Seen seen = fluids.grid().seenAt(next);
            if (seen.node != next || fluids.solidAt(next) >= 0) continue;
            const double there = fluids.densityAt(next)[0];
            if ((here < level) == (there < level)) continue;
            points.push_back(placeOf(node) + (level - here) / (there - here) * vectorOf(velocities[i]));
        }
    });
    return points;
}

/// |n_x| + |n_y| + |n_z| of the gradient, and its length: from neighbours that are fluid.
static std::array<double, 2> gradientNorms(const TwoFluids& fluids, const Node& node) {
    double sum = 0, squares = 0;
    for (const std::size_t i : {1, 3, 5}) {
        double difference = 0, distance = 0;
        for (const std::size_t side : {i, opposite(i)}) {
            const Node next = neighbour(node, side);
            if (fluids.solidAt(next) >= 0) continue;
            const double there = fluids.densityAt(fluids.grid().seenAt(next).node)[0];
            difference += (side == i ? 1 : -1) * (there - fluids.densityAt(node)[0]);
            distance += 1;
        }
        if (distance > 0) difference /= distance;
        sum += std::abs(difference), squares += difference * difference;
    }
    return {sum, std::sqrt(squares)};
}

void forEachVolumeAbove(const TwoFluids& fluids, double level,
                        const std::function<void(const Node&, double)>& function) {
    fluids.grid().forEachNode([&](const Node& node) {
        if (fluids.solidAt(node) >= 0) return;
        const double above = fluids.densityAt(node)[0] - level;
        const double spread = gradientNorms(fluids, node)[0];  // of the density, over the cube
        const double share = spread > 0 ? std::clamp(0.5 + above / spread, 0.0, 1.0) : (above > 0 ? 1 : 0);
        if (share > 0) function(node, share);
    });
}

double volumeAbove(const TwoFluids& fluids, double level) {
    double volume = 0;
    forEachVolumeAbove(fluids, level, [&](const Node&, double share) { volume += share; });
    return volume;
}

FittedCircle fitOnLine(const std::vector<Vector<double>>& points, const Vector<double>& axis,
                       const Vector<double>& direction) {
    // |x - a|^2 = 2 (x - a).n h + (R^2 - h^2): linear in h and R^2 - h^2.
    Eigen::MatrixX2d left(static_cast<Eigen::Index>(points.size()), 2);
    Eigen::VectorXd right(left.rows());
    for (Eigen::Index k = 0; k < left.rows(); ++k) {
        const Vector<double> from = points[static_cast<std::size_t>(k)] - axis;
        left(k, 0) = 2 * dot(from, direction), left(k, 1) = 1;
        right(k) = squaredNorm(from);
    }
    const Eigen::Vector2d found = left.colPivHouseholderQr().solve(right);
    return {found[0], std::sqrt(found[1] + found[0] * found[0])};
}

double midLevel(const TwoFluids& fluids, const Probes& probes) {
    return 0.5 * (fluids.densityAt(probes.liquid)[0] + fluids.densityAt(probes.other)[0]);
}

Node lastNode(const TwoFluids& fluids) {
    const Node& nodes = fluids.grid().box().nodes;
    return {nodes[0] - 1, nodes[1] - 1, nodes[2] - 1};
}

/// Multiplies the first component in the liquid, and takes as much of the second one outside.
static void addLiquid(TwoFluids& fluids, double level, double share, double volume) {
    double rest = -volume;
    fluids.grid().forEachNode([&](const Node& node) { rest += fluids.solidAt(node) < 0 ? 1 : 0; });
    fluids.scale([&](const Node& node) -> Densities {
        return fluids.densityAt(node)[0] > level ? Densities{1 + share, 1}
                                                 : Densities{1, 1 - share * volume / rest};
    });
}

/// How many steps are made between two looks at a run.
constexpr std::size_t window = 500;

static std::size_t addLiquidUntil(TwoFluids& fluids, const Probes& probes, const Rest& rest,
                                  std::size_t limit) {
    std::size_t done = 0;
    for (int within = 0; within < 4 && done < limit; done += window) {
        fluids.steps(window);
        const double level = midLevel(fluids, probes);
        const double volume = volumeAbove(fluids, level), lack = rest.volume / volume - 1;
        within = std::abs(lack) < rest.tolerance ? within + 1 : 0;
        if (within == 0)
            addLiquid(fluids, level, std::clamp(lack, -0.1, 0.1), volume);  // more would be a shock
    }
    return done;
}

std::size_t bringToRest(TwoFluids& fluids, const Probes& probes, const Rest& rest, std::size_t limit) {
    fluids.setFriction(0.1 / rest.radius);
    std::size_t done = addLiquidUntil(fluids, probes, rest, limit / 2);
    fluids.setFriction(0);
    const double unit = 0.05 * rest.radius / 4;  // about gamma R, of the part that is computed
    Vector<double> before{infinity, 0, 0};
    while (done < limit) {
        const Vector<double> now = meanOver(fluids, window, rest.force);
        done += window;
        if (norm(now - before) < 2e-4 * std::max(norm(now), unit)) break;
        before = now;
    }
    return done;
}

double cylinderBetween(const std::array<double, 2>& radii, double gap, double volume) {
    const auto cap = [](double radius, double distance) {
        return radius - std::sqrt(std::max(0.0, radius * radius - distance * distance));
    };
    const auto volumeWithin = [&](double radius) {
        constexpr int rings = 400;
        double sum = 0;
        for (int k = 0; k < rings; ++k) {
            const double middle = (k + 0.5) * radius / rings;
            sum += 2 * std::numbers::pi * middle * (gap + cap(radii[0], middle) + cap(radii[1], middle)) *
                   radius / rings;
        }
        return sum;
    };
    double low = 0, high = 2 * std::max(radii[0], radii[1]);
    for (int k = 0; k < 50; ++k) {
        const double middle = 0.5 * (low + high);
        (volumeWithin(middle) < volume ? low : high) = middle;
    }
    return low;
}

Vector<double> meanOver(TwoFluids& fluids, std::size_t steps, const std::function<Vector<double>()>& value) {
    constexpr std::size_t stride = 5;
    Vector<double> sum{0, 0, 0};
    for (std::size_t k = 0; k < steps / stride; ++k) {
        fluids.steps(stride);
        sum += value();
    }
    return static_cast<double>(stride) / static_cast<double>(steps) * sum;
}

std::size_t settle(TwoFluids& fluids, const std::function<double()>& value, double tolerance,
                   std::size_t window, std::size_t limit) {
    double before = value();
    for (std::size_t done = 0; done < limit;) {
        fluids.steps(window), done += window;
        const double now = value();
        if (std::abs(now - before) < tolerance) return done;
        before = now;
    }
    return limit;
}

}  // namespace pendular::lattice
