// A second, independent method: the Young-Laplace equation in arc length,
//     x' = cos psi, y' = sin psi, psi' = cos psi / y - 2 H, V' = pi y^2 cos psi,
// integrated from the first contact line by the classical Runge-Kutta method, with the filling angle, H and
// the arc length found by Newton's method with differences. It shares no formula with the solver.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "SelfTests/Capillary/RandomBridges.h"

namespace pendular::shootingTest {
namespace {

using std::numbers::pi;
using State = Eigen::Vector4d;  // x, y, psi, V

State slope(const State& state, double curvature) {
    const double cosine = std::cos(state[2]);
    return {cosine, std::sin(state[2]), cosine / state[1] - 2 * curvature, pi * state[1] * state[1] * cosine};
}

State integrate(State state, double curvature, double length, int steps) {
    const double h = length / steps;
    for (int i = 0; i < steps; ++i) {
        const State k1 = slope(state, curvature);
        const State k2 = slope(state + 0.5 * h * k1, curvature);
        const State k3 = slope(state + 0.5 * h * k2, curvature);
        const State k4 = slope(state + h * k3, curvature);
        state += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return state;
}

struct Cap {
    double height, volume;
};

/// The cap of a sphere of the given curvature, cut at radius y and filling angle beta; nothing for a plane.
Cap capOf(double curvature, double y, double beta) {
    const double height = y * std::tan(0.5 * beta);
    return curvature == 0 ? Cap{0, 0} : Cap{height, pi * height * (3 * y * y + height * height) / 6};
}

struct Shot {
    double contactRadius, angle, curvature, length;  // at the first contact line; unknowns of the shooting
    [[nodiscard]] double force() const {
        return 2 * pi * contactRadius * (std::cos(angle) - curvature * contactRadius);
    }
};

Eigen::Vector4d errors(const Shot& shot, const BridgeConditions& conditions, double gap) {
    const auto& [first, second, volume] = conditions;
    const State end = integrate({0, shot.contactRadius, shot.angle, 0}, shot.curvature, shot.length, 2000);
    const double firstBeta = shot.angle + pi / 2 - first.contactAngle;
    const double secondBeta = pi / 2 - end[2] - second.contactAngle;
    const Cap firstCap = capOf(1 / first.radius, shot.contactRadius, firstBeta);
    const Cap secondCap = capOf(1 / second.radius, end[1], secondBeta);
    const double height = gap + firstCap.height + secondCap.height;
    return {(shot.contactRadius / first.radius - std::sin(firstBeta)),
            (end[1] / second.radius - std::sin(secondBeta)), end[0] / height - 1,
            (end[3] - firstCap.volume - secondCap.volume) / volume - 1};
}

Shot corrected(Shot shot, const BridgeConditions& conditions, double gap) {
    const auto unknown = [](Shot& s, int j) -> double& {
        double* const members[] = {&s.contactRadius, &s.angle, &s.curvature, &s.length};
        return *members[j];
    };
    for (int iteration = 0; iteration < 8; ++iteration) {
        const Eigen::Vector4d error = errors(shot, conditions, gap);
        Eigen::Matrix4d jacobian;
        for (int j = 0; j < 4; ++j) {
            Shot ahead = shot, behind = shot;
            const double step = 1e-6 * (std::abs(unknown(shot, j)) + (j == 1 ? 1 : 0));
            unknown(ahead, j) += step;
            unknown(behind, j) -= step;
            jacobian.col(j) = (errors(ahead, conditions, gap) - errors(behind, conditions, gap)) / (2 * step);
        }
        const Eigen::Vector4d step = -jacobian.partialPivLu().solve(error);
        for (int j = 0; j < 4; ++j) unknown(shot, j) += step[j];
        if (error.norm() < 1e-11) break;
    }
    return shot;
}

}  // namespace

TEST(Shooting, AgreesOnRandomBridges) {
    double worst = 0;
    for (const auto& [conditions, gap, ruptureGap] : randomBridges(150, degrees(150), 0.95, false)) {
        const auto bridge = solveBridge(conditions, gap);
        ASSERT_TRUE(bridge);
        const DelaunayArc& arc = bridge->arc();
        const ArcPoint start = arc.at(-arc.halfSpan);
        // Started 0.1 % beside the solution, so that an error of the solver would not stay.
        Shot shot{bridge->firstContactRadius() * 1.001, std::atan2(start.radialPart, start.axialPart) + 1e-3,
                  arc.meanCurvature * 0.999, arc.length() * 1.001};
        shot = corrected(shot, conditions, gap);
        // In these 2000 steps the method errs by 1e-11; the force is compared with the larger of itself and
        // the one at which curvature and tension terms are of one size.
        const double scale = std::abs(bridge->pinnedForce()) + 0.01 * bridge->firstContactRadius();
        worst = std::max(worst, std::abs(shot.force() - bridge->pinnedForce()) / scale);
        EXPECT_NEAR(shot.force(), bridge->pinnedForce(), 1e-7 * scale);
        EXPECT_NEAR(shot.curvature, arc.meanCurvature,
                    1e-7 * (std::abs(arc.meanCurvature) + 1 / arc.length()));
    }
    RecordProperty("largestRelativeDifference", fmt::format("{:.1e}", worst));
}

}  // namespace pendular::shootingTest
