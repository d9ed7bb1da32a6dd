// Brute force: the meridian as a polygon, its energy and volume as sums over frusta, and the eigenvalues of
// the second derivatives of E - p V on the displacements that keep the volume. Contact points move along
// their bodies.

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeStability.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "SelfTests/Capillary/RandomBridges.h"

namespace pendular::bridgeStabilityTest {
namespace {

using std::numbers::pi;

class Polygon {
public:
    Polygon(const CapillaryBridge& bridge, int intervals)
        : bridge_(bridge), points_(bridge.profile(intervals + 1)) {
        const int last = static_cast<int>(points_.size()) - 1;
        for (int i = 1; i < last; ++i) {
            const double dx = points_[i + 1].axial - points_[i - 1].axial;
            const double dy = points_[i + 1].radius - points_[i - 1].radius;
            const double length = std::hypot(dx, dy);
            normals_.push_back({-dy / length, dx / length});
        }
    }
    [[nodiscard]] int size() const { return static_cast<int>(points_.size()); }

    /// Energy - pressure x volume, and volume, of the displaced polygon; each divided by 2 pi.
    struct Sums {
        double potential, volume;
    };
    [[nodiscard]] Sums at(const Eigen::VectorXd& displacement) const {
        const auto& [first, second, volume] = bridge_.conditions();
        const double firstBeta = bridge_.firstFillingAngle(), secondBeta = bridge_.secondFillingAngle();
        const Contact left(first, firstBeta, points_.front().radius, displacement[0]);
        const Contact right(second, secondBeta, points_.back().radius, displacement[size() - 1]);
        double area = 0, filled = 0;
        MeridianPoint before{-left.height, left.radius};
        for (int i = 1; i < size(); ++i) {
            MeridianPoint next{bridge_.gap() + right.height, right.radius};
            if (i + 1 < size()) {
                next = points_[i];
                next.axial += displacement[i] * normals_[i - 1].axial;
                next.radius += displacement[i] * normals_[i - 1].radius;
            }
            const double dx = next.axial - before.axial, sum = next.radius + before.radius;
            area += 0.5 * sum * std::hypot(dx, next.radius - before.radius);
            filled += dx * (sum * sum - next.radius * before.radius) / 6;
            before = next;
        }
        filled -= left.volume + right.volume;
        const double energy =
            area - std::cos(first.contactAngle) * left.area - std::cos(second.contactAngle) * right.area;
        return {energy - bridge_.pressure() * filled, filled};
    }

private:
    /// A cap whose contact line has moved along the body by a distance; volume and area divided by 2 pi.
    struct Contact {
        double height, radius, volume, area;
        Contact(const WettedBody& body, double beta, double y, double along) {
            if (std::isinf(body.radius)) {
                height = volume = 0;
                radius = y + along;
            } else {
                const double angle = beta + along / body.radius;
                radius = body.radius * std::sin(angle);
                height = 2 * body.radius * std::pow(std::sin(0.5 * angle), 2);
                volume = height * (3 * radius * radius + height * height) / 12;
            }
            area = 0.5 * (radius * radius + height * height);
        }
    };

    CapillaryBridge bridge_;
    std::vector<MeridianPoint> points_;
    std::vector<MeridianPoint> normals_;
};

/// Number of negative eigenvalues on the displacements that keep the volume to first order.
int negativeModes(const CapillaryBridge& bridge) {
    const Polygon polygon(bridge, 64);
    const int n = polygon.size();
    const double step = 1e-4 * bridge.arc().length();
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd gradient(n), displacement = Eigen::VectorXd::Zero(n);
    const auto potential = [&] { return polygon.at(displacement).potential; };
    const double centre = potential();
    for (int i = 0; i < n; ++i) {
        displacement[i] = step;
        const auto ahead = polygon.at(displacement);
        displacement[i] = -step;
        const auto behind = polygon.at(displacement);
        displacement[i] = 0;
        hessian(i, i) = (ahead.potential - 2 * centre + behind.potential) / (step * step);
        gradient[i] = (ahead.volume - behind.volume) / (2 * step);
        if (i + 1 == n) break;
        double mixed = 0;  // only neighbours interact
        for (const int a : {-1, 1})
            for (const int b : {-1, 1}) {
                displacement[i] = a * step;
                displacement[i + 1] = b * step;
                mixed += a * b * potential();
            }
        displacement[i] = displacement[i + 1] = 0;
        hessian(i, i + 1) = hessian(i + 1, i) = mixed / (4 * step * step);
    }
    const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(gradient).householderQ();
    const Eigen::MatrixXd tangent = basis.rightCols(n - 1);
    const Eigen::MatrixXd projected = tangent.transpose() * hessian * tangent;
    return static_cast<int>(
        (Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(projected).eigenvalues().array() < 0).count());
}

}  // namespace

TEST(BridgeStability, ContactStiffnessIsSymmetric) {
    for (const auto& [conditions, gap, ruptureGap] : randomBridges(300, degrees(170), 0.95, false)) {
        const auto bridge = solveBridge(conditions, gap);
        ASSERT_TRUE(bridge);
        const BridgeEquations equations(conditions);
        const BridgeGeometry geometry(bridge->arc(), equations.first(), equations.second());
        const BridgeStability stability = stabilityOf(equations, bridge->arc(), geometry);
        const double first = std::sin(conditions.first.contactAngle) * stability.contactStiffness(0, 1);
        const double second = std::sin(conditions.second.contactAngle) * stability.contactStiffness(1, 0);
        // The Hessian of an energy; the two come from different rows of the same linear equations.
        EXPECT_NEAR(first, second, 1e-9 * stability.contactStiffness.norm());
    }
}

/// Along branches, past fold and loss of symmetry, far into the unstable part. Close to a change of stability
/// the polygon of 64 sides may differ: the count is compared where its neighbours on the branch have the
/// same.
TEST(BridgeStability, CountsTheModesThatBruteForceFinds) {
    int compared = 0, unstable = 0;
    for (const double angle : {10.0, 40.0, 70.0, 100.0, 130.0})
        for (const double ratio : {1.0, 0.9, 0.3})
            for (const double volume : {1e-3, 0.1, 1.0}) {
                const double first = 0.5 * (1 + ratio);
                const BridgeConditions conditions{{first, degrees(angle)},
                                                  {first / ratio, degrees(angle + (ratio < 0.5 ? 15 : 0))},
                                                  volume};
                const auto branch = traceBranch(conditions, 0, 30);
                for (std::size_t i = 1; i + 1 < branch.size(); ++i) {
                    const int modes = branch[i].unstableModes();
                    if (branch[i - 1].unstableModes() != modes || branch[i + 1].unstableModes() != modes)
                        continue;
                    if (branch[i].neckRadius() < 0.1 * branch[i].arc().length())
                        continue;  // too thin for 64 sides
                    ++compared;
                    unstable += modes > 0;
                    EXPECT_EQ(negativeModes(branch[i]), modes)
                        << angle << ' ' << ratio << ' ' << volume << " gap " << branch[i].gap();
                }
            }
    EXPECT_GT(compared, 300);
    EXPECT_GT(unstable, 50);
}

}  // namespace pendular::bridgeStabilityTest
