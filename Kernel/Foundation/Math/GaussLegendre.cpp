#include "Kernel/Foundation/Math/GaussLegendre.h"

#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <vector>

namespace pendular {

namespace {

constexpr int largestCount = 64;

struct LegendreValue {
    long double value, slope;
};

/// P_n and its derivative by the three-term recurrence n P_n = (2n-1) x P_(n-1) - (n-1) P_(n-2).
LegendreValue legendre(int degree, long double x) {
    long double before = 1, value = x;
    for (int n = 2; n <= degree; ++n) {
        const long double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
    }
    return {value, degree * (x * value - before) / (x * x - 1)};
}

std::vector<QuadratureNode> makeRule(int count) {
    std::vector<QuadratureNode> nodes(count);
    for (int k = 0; k < (count + 1) / 2; ++k) {
        // Tricomi's estimate is close enough for Newton's method to converge to the k-th root.
        long double x = std::cos(std::numbers::pi_v<long double> * (k + 0.75L) / (count + 0.5L));
        for (int iteration = 0; iteration < 6; ++iteration) {
            const auto [value, slope] = legendre(count, x);
            x -= value / slope;
        }
        const long double slope = legendre(count, x).slope;
        const auto weight = static_cast<double>(2 / ((1 - x * x) * slope * slope));
        nodes[k] = {static_cast<double>(-x), weight};
        nodes[count - 1 - k] = {static_cast<double>(x), weight};
    }
    if (count % 2 == 1) nodes[count / 2].position = 0;
    return nodes;
}

}  // namespace

std::span<const QuadratureNode> gaussLegendre(int count) {
    static std::array<std::vector<QuadratureNode>, largestCount + 1> rules;
    static std::array<std::once_flag, largestCount + 1> made;
    if (count < 1) count = largestCount + 1;  // refused by at()
    std::vector<QuadratureNode>& rule = rules.at(count);
    std::call_once(made[count], [&] { rule = makeRule(count); });
    return rule;
}

}  // namespace pendular
