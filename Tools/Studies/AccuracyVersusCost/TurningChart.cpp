#include "Tools/Studies/AccuracyVersusCost/TurningChart.h"

#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Features/RigidBodies/FreeTurn.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Timing/Timing.h"

namespace pendular {

namespace {

/// A free body, or eight of them.
template <Number T>
struct Top {
    QuaternionOf<T> q{};
    Vector<T> inertia{T(1.0), T(2.0), T(3.0)}, momentum{T(1.0), T(1.6), T(1.8)};  // of w = (1, 0.8, 0.6)
};

template <Number T>
QuaternionOf<T> sum(const QuaternionOf<T>& a, const T& factor, const QuaternionOf<T>& b) {
    return {a.real + factor * b.real, a.imaginary + factor * b.imaginary};
}
/// dq/dt = q (0, w) / 2, with the spin w in the body.
template <Number T>
QuaternionOf<T> rate(const Top<T>& top, const QuaternionOf<T>& q) {
    const Vector<T> l = Axes<T>(q).turnBack(top.momentum);
    const Vector<T> half{T(0.5) * l.x / top.inertia.x, T(0.5) * l.y / top.inertia.y,
                         T(0.5) * l.z / top.inertia.z};
    return q * QuaternionOf<T>{T(0.0), half};
}

struct Splitting {
    static constexpr std::string_view name = "splitting";
    template <Number T>
    static QuaternionOf<T> step(const Top<T>& top, const T& h) {
        return turnedFreely(top.q, top.inertia, top.momentum, h);
    }
};
struct Midpoint {
    static constexpr std::string_view name = "midpoint";
    template <Number T>
    static QuaternionOf<T> step(const Top<T>& top, const T& h) {
        const QuaternionOf<T> middle = sum(top.q, T(0.5) * h, rate(top, top.q)).normalised();
        return sum(top.q, h, rate(top, middle)).normalised();
    }
};
/// The scheme of LAMMPS's fix rigid: one step and two half steps of Euler's method, extrapolated.
struct Richardson {
    static constexpr std::string_view name = "Richardson";
    template <Number T>
    static QuaternionOf<T> step(const Top<T>& top, const T& h) {
        const QuaternionOf<T> slope = rate(top, top.q);
        const QuaternionOf<T> whole = sum(top.q, h, slope).normalised();
        const QuaternionOf<T> half = sum(top.q, T(0.5) * h, slope).normalised();
        const QuaternionOf<T> halves = sum(half, T(0.5) * h, rate(top, half)).normalised();
        return QuaternionOf<T>{T(2.0) * halves.real - whole.real, T(2.0) * halves.imaginary - whole.imaginary}
            .normalised();
    }
};
struct RungeKutta {
    static constexpr std::string_view name = "Runge-Kutta";
    template <Number T>
    static QuaternionOf<T> step(const Top<T>& top, const T& h) {
        const QuaternionOf<T> a = rate(top, top.q), b = rate(top, sum(top.q, T(0.5) * h, a)),
                              c = rate(top, sum(top.q, T(0.5) * h, b)), d = rate(top, sum(top.q, h, c));
        const QuaternionOf<T> slope = sum(sum(sum(a, T(2.0), b), T(2.0), c), T(1.0), d);
        return sum(top.q, h / T(6.0), slope).normalised();
    }
};

constexpr double duration = 20;  // s

template <class Scheme>
Top<double> turned(int steps, double& energyError) {
    Top<double> top;
    const auto energy = [&] {
        const Vector<double> l = Axes<double>(top.q).turnBack(top.momentum);
        return 0.5 * (l.x * l.x / top.inertia.x + l.y * l.y / top.inertia.y + l.z * l.z / top.inertia.z);
    };
    const double before = energy();
    energyError = 0;
    for (int k = 0; k < steps; ++k) {
        top.q = Scheme::step(top, duration / steps);
        energyError = std::max(energyError, std::abs(energy() / before - 1));
    }
    return top;
}

/// rad, between two orientations
double angleBetween(const Quaternion& a, const Quaternion& b) {
    const Quaternion turn = Quaternion{a.real, -a.imaginary} * b;
    return 2 * std::atan2(norm(turn.imaginary), std::abs(turn.real));
}

/// ns for the step of one body, of eight that are turned at once
template <class Scheme>
double timeOfStep() {
    constexpr int steps = 2000;
    Top<Pack> top;
    const double time = fastest(50, [&] {
        for (int k = 0; k < steps; ++k) top.q = Scheme::step(top, Pack(1e-3));
        use(&top);
    });
    return time / steps / Pack::lanes;
}

template <class Scheme>
void chart(CsvFile& file, const Quaternion& exact) {
    const double time = timeOfStep<Scheme>(), speed = std::sqrt(1 + 0.64 + 0.36);
    for (const int perTurn : {10, 20, 50, 100, 200, 500, 1000, 2000}) {
        const int steps = static_cast<int>(std::lround(duration * speed / (2 * std::numbers::pi) * perTurn));
        double energyError = 0;
        const Top<double> top = turned<Scheme>(steps, energyError);
        file.row(Scheme::name, perTurn, angleBetween(top.q, exact), energyError, time, time * perTurn);
    }
}

}  // namespace

void chartTurning(const TurningChartOptions& options) {
    CsvFile file(options.file, "scheme,steps_per_turn,angle_error_rad,energy_error,ns_per_step,ns_per_turn");
    double energyError = 0;
    const Quaternion exact = turned<RungeKutta>(400000, energyError).q;
    chart<Splitting>(file, exact);
    chart<Midpoint>(file, exact);
    chart<Richardson>(file, exact);
    chart<RungeKutta>(file, exact);
    file.close();
}

}  // namespace pendular
