#include "Tools/Studies/LatticeBoltzmann/Measures.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace pendular::lattice {

Densities phaseAt(double distance, const Phases& phases) {
    const double mean = 0.5 * (phases.majority + phases.minority),
                 half = 0.5 * (phases.majority - phases.minority);
    const double profile = std::tanh(distance / 1.3);  // about as wide as the interface at G = 0.1
    return {mean - half * profile, mean + half * profile};
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

double volumeAbove(const TwoFluids& fluids, double level) {
    double volume = 0;
    fluids.grid().forEachNode([&](const Node& node) {
        if (fluids.solidAt(node) >= 0) return;
        const double above = fluids.densityAt(node)[0] - level;
        const double spread = gradientNorms(fluids, node)[0];  // of the density, over the cube
        volume += spread > 0 ? std::clamp(0.5 + above / spread, 0.0, 1.0) : (above > 0 ? 1 : 0);
    });
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
