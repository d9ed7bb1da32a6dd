#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "Kernel/Features/RigidBodies/FreeTurn.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/SharedData.h"

// A body without forces, against Jacobi's solution in elliptic functions.

namespace pendular::freeTopTest {
namespace {

/// Jacobi's functions of a parameter m = k^2, by descending Landen transformations (Abramowitz and Stegun
/// 16.4): to round-off.
struct Jacobi {
    double sn, cn, dn;

    Jacobi(double u, double m) {
        std::array<double, 16> a{1}, c{std::sqrt(m)};
        double b = std::sqrt(1 - m);
        int n = 0;
        for (; n < 15 && std::abs(c[n]) > 1e-17; ++n) {
            a[n + 1] = 0.5 * (a[n] + b), c[n + 1] = 0.5 * (a[n] - b);
            b = std::sqrt(a[n] * b);
        }
        double phase = std::ldexp(a[n] * u, n);
        for (; n > 0; --n) phase = 0.5 * (phase + std::asin(c[n] * std::sin(phase) / a[n]));
        sn = std::sin(phase), cn = std::cos(phase);
        dn = std::sqrt(1 - m * sn * sn);
    }
};

/// A top of moments 1, 2, 3 kg m^2 with the highest energy side L^2 > 2 E I_2, which begins where its second
/// spin is zero: w = (A cn, B sn, C dn) of Omega t (Landau and Lifshitz, Mechanics, section 37).
struct ExactTop {
    static constexpr double i1 = 1, i2 = 2, i3 = 3;
    double a, b, c, omega, m;

    ExactTop(double w1, double w3) {
        const double twoE = i1 * w1 * w1 + i3 * w3 * w3, l2 = i1 * i1 * w1 * w1 + i3 * i3 * w3 * w3;
        EXPECT_GT(l2, twoE * i2);
        a = std::sqrt((twoE * i3 - l2) / (i1 * (i3 - i1)));
        b = std::sqrt((twoE * i3 - l2) / (i2 * (i3 - i2)));
        c = std::sqrt((l2 - twoE * i1) / (i3 * (i3 - i1)));
        omega = std::sqrt((i3 - i2) * (l2 - twoE * i1) / (i1 * i2 * i3));
        m = (i2 - i1) * (twoE * i3 - l2) / ((i3 - i2) * (l2 - twoE * i1));
    }
    /// rad/s, in the body. With the signs of Euler's equations for positive w1 and w3: w2' = (I3 - I1) w3 w1
    /// / I2 > 0.
    [[nodiscard]] Vector<double> spinAt(double time) const {
        const Jacobi j(omega * time, m);
        return {a * j.cn, b * j.sn, c * j.dn};
    }
};

RigidBody topOf(const Vector<double>& spin) {
    RigidBody body{.mass = 1, .inertia = {1, 2, 3}};
    body.setSpin(spin);
    return body;
}
Vector<double> ownSpin(const RigidBody& body) { return body.orientation.turnBack(body.spin()); }

// Some 1000 turns. A symmetric splitting follows a nearby top, whose frequencies differ by some (w h)^2 / 12
// (an independent program has 0.024 (w h)^2 in 20 s): its phase runs away evenly, with the square of the
// step.
TEST(FreeTop, isThatOfJacobiOver1000Turns) {
    const ExactTop exact(0.9, 1.1);
    const double speed = std::sqrt(0.9 * 0.9 + 1.1 * 1.1), turn = 2 * std::numbers::pi / speed;
    const double time = 1000 * turn;
    const auto error = [&](int steps) {
        RigidBody body = topOf({0.9, 0, 1.1});
        const Vector<double> momentum = body.angularMomentum;
        double largest = 0;
        for (int k = 1; k <= 1000 * steps; ++k) {
            turnFreely(body, turn / steps);
            if (k % (100 * steps) == 0)
                largest = std::max(largest, norm(ownSpin(body) - exact.spinAt(k * turn / steps)));
        }
        EXPECT_EQ(body.angularMomentum, momentum);
        return largest;
    };
    const double coarse = error(800), fine = error(1600);
    EXPECT_NEAR(coarse / fine, 4, 0.05);
    EXPECT_LT(fine, std::pow(2 * std::numbers::pi / 1600, 2) / 12 * speed * time);
}

// The closed form itself, and the orientation, against independent numbers of 15 digits.
TEST(FreeTop, hasTheSpinAndTheOrientationOfTheTables) {
    const std::string file = "scenes-and-shapes/top_free.csv";
    if (!support::hasSharedData(file)) GTEST_SKIP() << support::withoutSharedData(file);
    std::ifstream table(support::sharedData(file));
    int compared = 0;
    for (std::string line; std::getline(table, line);) {
        if (!line.starts_with("\"A: I=(1,2,3), w0=(1,0.8,0.6)\",")) continue;
        std::istringstream rest(line.substr(line.find("\",") + 2));
        std::array<double, 8> row{};
        char comma = 0;
        for (double& value : row) rest >> value >> comma;
        const auto error = [&](int steps) {
            RigidBody body = topOf({1, 0.8, 0.6});
            for (int k = 0; k < steps; ++k) turnFreely(body, row[0] / steps);
            const Quaternion& q = body.orientation;
            const auto distance = [&](double sign) {
                return (q.real - sign * row[4]) * (q.real - sign * row[4]) +
                       squaredNorm(q.imaginary - sign * Vector<double>{row[5], row[6], row[7]});
            };
            const double turned = std::min(distance(1), distance(-1));  // a quarter of the angle squared
            return std::sqrt(4 * turned +
                             squaredNorm(ownSpin(body) - Vector<double>{row[1], row[2], row[3]}));
        };
        const auto steps = static_cast<int>(1000 * row[0]);  // 4400 a turn
        const double coarse = error(steps), fine = error(2 * steps);
        EXPECT_NEAR(coarse / fine, 4, 0.1) << row[0];
        EXPECT_LT(fine, 1e-6 * row[0]);
        ++compared;
    }
    EXPECT_GE(compared, 3);
}

// A turn about the axis in the middle grows off it by exp(rate t), rate = w sqrt((I2 - I1)(I3 - I2)/(I1 I3)):
// the linear Euler equations. From 1e-6 to 1e-3 that holds to the square of the amplitude, 1e-6.
TEST(FreeTop, isUnstableAboutTheMiddleAxisAtTheRateOfEuler) {
    const double rate = std::sqrt(1.0 / 3), time = std::log(1000) / rate;
    RigidBody body = topOf({1e-6, 1, -1e-6 * rate});
    constexpr int steps = 200000;
    for (int k = 0; k < steps; ++k) turnFreely(body, time / steps);
    const Vector<double> spin = ownSpin(body);
    EXPECT_NEAR(spin.x / 1e-3, 1, 1e-5);
    EXPECT_NEAR(spin.z / (-1e-3 * rate), 1, 1e-5);
    // About the two others it stays where it was.
    for (const Vector<double>& stable : {Vector<double>{1, 1e-6, 1e-6}, Vector<double>{1e-6, 1e-6, 1}}) {
        RigidBody top = topOf(stable);
        double largest = 0;
        for (int k = 0; k < steps; ++k) {
            turnFreely(top, time / steps);
            largest = std::max(largest, norm(ownSpin(top) - stable));
        }
        EXPECT_LT(largest, 1e-5);
    }
}

// Nearly a sphere, a thin rod, a flat disc: nothing is lost, and the axis of symmetry keeps its angle.
TEST(FreeTop, keepsMomentumAndEnergyAtTheEdges) {
    for (const Vector<double>& inertia :
         {Vector<double>{1, 1 + 1e-12, 1 + 2e-12}, Vector<double>{1e-8, 1, 1}, Vector<double>{1, 1, 2}}) {
        RigidBody body{.mass = 1, .inertia = inertia};
        body.setSpin({1, 0.3, 0.2});
        const double energy = body.rotationalEnergy();
        double largest = 0;
        for (int k = 0; k < 20000; ++k) {
            turnFreely(body, 0.01);
            largest = std::max(largest, std::abs(body.rotationalEnergy() / energy - 1));
        }
        // Bounded by some (w h)^2 / 12; a rod's fast turn about itself is exact in the splitting.
        EXPECT_LT(largest, 1e-4 / 12 + 1e-10);
        EXPECT_NEAR(body.orientation.real * body.orientation.real + squaredNorm(body.orientation.imaginary),
                    1, 1e-15);
    }
}

// Eight at once are the same eight, bit for bit.
TEST(FreeTop, isTheSameInEachLaneOfAPack) {
    std::array<double, 8> x{}, y{}, z{};
    for (int k = 0; k < 8; ++k) x[k] = 1 + 0.1 * k, y[k] = 0.3 - 0.05 * k, z[k] = 0.7 * k;
    const Vector<Pack> momentum{Pack::fromLanes(x), Pack::fromLanes(y), Pack::fromLanes(z)};
    QuaternionOf<Pack> q{Pack(0.6), {Pack(0.8), Pack(0.0), Pack(0.0)}};
    q = turnedFreely<Pack>(q, {Pack(1.0), Pack(2.0), Pack(2.5)}, momentum, Pack(0.1));
    for (std::size_t k = 0; k < 8; ++k) {
        const Quaternion one = turnedFreely<double>({0.6, {0.8, 0, 0}}, {1, 2, 2.5}, {x[k], y[k], z[k]}, 0.1);
        EXPECT_EQ(one.real, q.real[k]);
        EXPECT_EQ(one.imaginary, (Vector<double>{q.imaginary.x[k], q.imaginary.y[k], q.imaginary.z[k]}));
    }
}

}  // namespace
}  // namespace pendular::freeTopTest
