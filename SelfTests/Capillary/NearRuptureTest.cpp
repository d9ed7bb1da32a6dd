// Bridges up to a millionth below the rupture distance, against all meridians with a given neck: from the
// neck, of radius a, the Young-Laplace equation in arc length,
//     x' = cos psi, y' = sin psi, psi' = cos psi / y - 2 H, V' = pi y^2 cos psi,
// is integrated to either side by the classical Runge-Kutta method until it meets the body at its contact
// angle. For a given volume H follows from a, and so does the gap S(a). That is regular at the fold, where S
// is largest: the wider necks are the stable bridges. It shares no formula with the solver and asks nothing
// of its stability.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "SelfTests/Capillary/RandomBridges.h"

namespace pendular::nearRuptureTest {
namespace {

using std::numbers::pi;
using State = Eigen::Vector4d;  // x, y, psi, V
constexpr double plane = std::numeric_limits<double>::infinity();

State slope(const State& state, double curvature) {
    const double cosine = std::cos(state[2]);
    return {cosine, std::sin(state[2]), cosine / state[1] - 2 * curvature, pi * state[1] * state[1] * cosine};
}

State stepped(const State& state, double curvature, double h) {
    const State k1 = slope(state, curvature);
    const State k2 = slope(state + 0.5 * h * k1, curvature);
    const State k3 = slope(state + 0.5 * h * k2, curvature);
    const State k4 = slope(state + h * k3, curvature);
    return state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

/// The zero of a function between two places where it has opposite signs, to the given width: regula falsi,
/// where the value at an end that stays is halved.
template <class Function>
double zeroBetween(double low, double high, double width, Function function) {
    double lowValue = function(low), highValue = function(high);
    EXPECT_LE(lowValue * highValue, 0);
    for (int iteration = 0; iteration < 200; ++iteration) {
        const double next = low + (high - low) * lowValue / (lowValue - highValue), value = function(next);
        if (value == 0 || std::abs(next - high) < width) return next;
        if (value * highValue < 0) {
            low = high;
            lowValue = highValue;
        } else {
            lowValue *= 0.5;
        }
        high = next;
        highValue = value;
    }
    ADD_FAILURE() << "no zero";
    return high;
}

/// One side of a bridge: what it adds to the gap and to the volume.
struct Side {
    double gap, volume;
};

/// Below zero inside of the liquid, zero where y = r sin(beta) with beta = pi/2 - theta - psi.
double mismatch(const WettedBody& body, const State& state) {
    return state[1] / body.radius - std::cos(body.contactAngle + state[2]);
}

Side sideOf(const WettedBody& body, double neck, double curvature) {
    constexpr int turns = 150;  // steps for a radian of psi, or for a neck's radius
    State state{0, neck, 0, 0};
    for (;;) {
        const double turning = std::abs(std::cos(state[2]) / state[1] - 2 * curvature) + 1 / state[1];
        const double h = 1.0 / turns / turning;
        const State next = stepped(state, curvature, h);
        if (!(next[2] > 0)) return {0, 1e9};  // past a bulge: it does not get there
        if (mismatch(body, next) >= 0) {
            const double part = zeroBetween(
                0, h, 1e-14 * h, [&](double s) { return mismatch(body, stepped(state, curvature, s)); });
            state = stepped(state, curvature, part);
            break;
        }
        state = next;
    }
    const double beta = pi / 2 - body.contactAngle - state[2], y = state[1];
    const double height = std::isinf(body.radius) ? 0 : y * std::tan(0.5 * beta);
    return {state[0] - height, state[3] - pi * height * (3 * y * y + height * height) / 6};
}

/// A bridge of given volume by the radius of its neck.
struct Necked {
    double curvature, gap;

    [[nodiscard]] double force(double neck) const { return 2 * pi * neck * (1 - curvature * neck); }
};

Necked withNeck(const BridgeConditions& conditions, double neck) {
    const auto sides = [&](double curvature) {
        const Side first = sideOf(conditions.first, neck, curvature);
        const Side second = sideOf(conditions.second, neck, curvature);
        return Side{first.gap + second.gap, first.volume + second.volume};
    };
    // The variable is the curvature of the meridian at the neck, 1/a - 2 H, times a: the volume falls with
    // it.
    const auto curvature = [&](double logarithm) { return 0.5 * (1 - std::exp(logarithm)) / neck; };
    const double found = curvature(zeroBetween(-4, 10, 1e-13, [&](double logarithm) {
        return std::log(std::max(sides(curvature(logarithm)).volume, 1e-300) / conditions.volume);
    }));
    return {found, sides(found).gap};
}

double gapOf(const BridgeConditions& conditions, double neck) { return withNeck(conditions, neck).gap; }

/// The neck of the given volume that is farthest apart.
/// @param near a neck radius near it
double neckAtFold(const BridgeConditions& conditions, double near) {
    constexpr double h = 1e-4;  // the gap is flat there: its error goes with the square of the neck's
    return zeroBetween(0.97 * near, 1.03 * near, 1e-9 * near, [&](double a) {
        return gapOf(conditions, a * (1 - h)) - gapOf(conditions, a * (1 + h));
    });
}

/// F over gamma of the bridge at a gap with a neck wider than the given one, which is farther apart.
double forceOfWiderNeck(const BridgeConditions& conditions, double gap, double narrow) {
    double wide = 1.02 * narrow;
    while (gapOf(conditions, wide) > gap) wide *= 1.1;
    const double neck =
        zeroBetween(narrow, wide, 1e-12 * narrow, [&](double a) { return gapOf(conditions, a) - gap; });
    return withNeck(conditions, neck).force(neck);
}

constexpr double shares[] = {0.9, 0.99, 0.998, 0.999, 0.9999, 1 - 1e-6};

BridgeConditions pairOf(double ratio, double firstAngle, double secondAngle, double volume) {
    const double larger = ratio > 0 ? 0.5 * (1 + ratio) / ratio : plane;
    return {{0.5 * (1 + ratio), degrees(firstAngle)}, {larger, degrees(secondAngle)}, volume};
}

}  // namespace

// 7 ratios of radii from equal ones to a plane, 8 angles, 14 volumes: 784 bridges.
TEST(NearRupture, AStableBridgeIsFoundUpToAMillionthBelowIt) {
    int rows = 0;
    for (const double ratio : {1.0, 0.9999, 0.9, 0.6, 0.3, 0.1, 0.0})
        for (const double angle : {0.0, 15.0, 30.0, 45.0, 60.0, 90.0, 130.0, 180.0})
            for (int k = 0; k < 14; ++k) {
                const BridgeConditions conditions = pairOf(ratio, angle, angle, std::pow(10, -7 + 0.5 * k));
                SCOPED_TRACE(testing::Message() << ratio << ' ' << angle << ' ' << conditions.volume);
                const auto rupture = findRupture(conditions);
                ASSERT_TRUE(rupture);
                ++rows;
                std::optional<CapillaryBridge> last;
                for (const double share : shares) {
                    const double gap = share * rupture->last.gap();
                    const auto cold = solveBridge(conditions, gap);
                    ASSERT_TRUE(cold) << share;
                    EXPECT_EQ(cold->unstableModes(), 0) << share;
                    const auto warm = solveBridge(conditions, gap, last ? &*last : nullptr);
                    ASSERT_TRUE(warm) << share;
                    EXPECT_EQ(warm->unstableModes(), 0) << share;
                    last = warm;
                }
            }
    EXPECT_EQ(rows, 784);
}

// RK4 with 150 steps a radian errs by some 1e-11; near the fold the force goes with the root of the gap, so
// that an error e of the gap is e / (2 sqrt(1 - S/S_c)) of it: 1e-8 at a millionth. The unstable bridge is
// farther away by 2 sqrt(1 - S/S_c): 2e-3.
TEST(NearRupture, TheForceIsThatOfTheWiderNeck) {
    const auto compare = [](const BridgeConditions& conditions) {
        SCOPED_TRACE(testing::Message() << conditions.first.radius << ' ' << conditions.first.contactAngle
                                        << ' ' << conditions.second.contactAngle << ' ' << conditions.volume);
        const auto rupture = findRupture(conditions);
        ASSERT_TRUE(rupture);
        const double end = rupture->last.gap();
        double narrow = 0;
        if (rupture->mode == RuptureMode::Fold) {
            narrow = neckAtFold(conditions, rupture->last.neckRadius());
            EXPECT_NEAR(end / gapOf(conditions, narrow), 1, 1e-9);
        }
        for (const double share : shares) {
            // Where symmetry is lost each side meets its body at two places that become one: nearer to it the
            // steps do not tell them apart. The force is linear there.
            if (rupture->mode == RuptureMode::SymmetryLoss && share > 0.998) break;
            const double gap = share * end;
            const auto bridge = solveBridge(conditions, gap);
            ASSERT_TRUE(bridge) << share;
            if (rupture->mode == RuptureMode::SymmetryLoss) narrow = 0.999 * bridge->neckRadius();
            EXPECT_NEAR(bridge->pinnedForce() / forceOfWiderNeck(conditions, gap, narrow), 1, 1e-6) << share;
        }
    };
    for (const double ratio : {1.0, 0.625, 0.0})
        for (const double angle : {0.0, 10.0, 25.0})
            for (const double volume : {1e-4, 0.1}) compare(pairOf(ratio, angle, angle, volume));
    for (const double angle : {40.0, 65.0})  // beyond, unequal bodies have bridges without a neck
        for (const double volume : {1e-4, 0.1}) compare(pairOf(1, angle, angle, volume));
    compare(pairOf(0.8, 0, 40, 0.05));
    compare(pairOf(0.0, 50, 20, 0.05));
    compare(pairOf(0.4, 70, 10, 1e-3));
}

// Found by a branch that another program followed past the fold.
TEST(NearRupture, AgreesWithOtherPrograms) {
    const auto equal = findRupture({{1, 0}, {1, 0}, 0.01});
    EXPECT_NEAR(equal->last.gap(), 0.219049, 5e-7);
    const double theta = degrees(15);
    const auto bridge = solveBridge({{0.8125, theta}, {1.3, theta}, 0.1}, 0.49704);
    ASSERT_TRUE(bridge);
    // The gap is known to its digits. 0.12028 is the force of the unstable bridge.
    EXPECT_NEAR(bridge->arc().forceLength(), 0.128975, 5e-6);
}

}  // namespace pendular::nearRuptureTest
