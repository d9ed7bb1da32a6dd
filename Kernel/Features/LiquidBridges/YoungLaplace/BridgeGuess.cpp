#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeGuess.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pendular {

namespace {

using std::numbers::pi;

/// A circular arc across the gap: tangent angles at its ends, and lengths.
struct CircularArc {
    double middleAngle, halfTurn;
    double length, sagitta, segment;  // of the arc; of the middle below its ends; area between arc and chord

    /// height: between its ends along the axis; starts at angle `from`, ends at `to`.
    CircularArc(double from, double to, double height) {
        middleAngle = std::clamp(0.5 * (from + to), -1.2, 1.2);
        halfTurn = std::clamp(0.5 * (to - from), -2.4, 2.4);
        const double chord = height / std::cos(middleAngle);
        const double h = halfTurn;
        const bool flat = std::abs(h) < 1e-3;
        const double sine = std::sin(h), cosine = std::cos(h);
        length = flat ? chord : chord * h / sine;
        sagitta = std::cos(middleAngle) * chord * (flat ? h / 4 : (1 - cosine) / (2 * sine));
        segment = chord * chord * (flat ? h / 6 : (h - sine * cosine) / (4 * sine * sine));
    }
};

double fillingAngle(double curvature, double radius) { return std::asin(std::min(curvature * radius, 0.95)); }

}  // namespace

DelaunayArc guessArc(const BridgeConditions& conditions, double gap) {
    const double first = 1 / conditions.first.radius, second = 1 / conditions.second.radius;
    const double bend = 0.5 * (first + second);  // the gap grows as S + bend y^2
    double volume = conditions.volume / pi;
    double radius = 0;
    for (int iteration = 0;; ++iteration) {
        // volume = S y^2 + bend y^4 / 2
        const double square = 2 * volume / (gap + std::sqrt(gap * gap + 2 * bend * volume));
        radius = std::sqrt(square);
        const double height = gap + bend * square;
        const double from = fillingAngle(first, radius) + conditions.first.contactAngle - pi / 2;
        const double to = pi / 2 - fillingAngle(second, radius) - conditions.second.contactAngle;
        const CircularArc arc(from, to, height);
        if (iteration == 2) {
            const double middle = std::max(radius - arc.sagitta, 0.2 * radius);
            const double turning = 2 * arc.halfTurn / arc.length;
            const double curvature = 0.5 * (std::cos(arc.middleAngle) / middle - turning);
            DelaunayArc guess{middle * std::sin(arc.middleAngle), middle * std::cos(arc.middleAngle),
                              curvature, 0};
            guess.halfSpan = 0.5 * guess.parameterAt(arc.length);
            const double limit = 0.25 * pi / std::max(std::abs(curvature), 1e-300);
            guess.halfSpan = guess.parameterAt(std::min(0.5 * arc.length, limit));
            return guess;
        }
        volume = std::max(conditions.volume / pi + 2 * radius * arc.segment, 0.3 * conditions.volume / pi);
    }
}

}  // namespace pendular
