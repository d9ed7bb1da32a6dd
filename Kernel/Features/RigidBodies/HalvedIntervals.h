#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "Kernel/Foundation/Math/GaussLegendre.h"

namespace pendular {

/// Values at a height, and from how large numbers each was made: they are right to some 1e-16 of those.
template <std::size_t count>
struct ValuesAtHeight {
    std::array<double, count> values{}, sizes{};
};

/// Integrates several functions of a height at once: Gauss-Legendre rules of 8 and of 16 nodes, on intervals
/// that are halved until the two agree. The sum of the absolute differences is given as the error, as the
/// rule of 16 nodes is the better one.
///
/// Near a pole of a sphere areas go as the height, and near the end of a circle angles as its root: with
/// z = low + (high - low) (3 t^2 - 2 t^3) both are smooth in t.
///
/// The work is bounded: differences that are round-off are none, and after a number of halvings the
/// intervals stay as they are; the error then tells what is missing.
template <std::size_t count>
class HalvedIntervals {
public:
    using Values = std::array<double, count>;

    /// @param permitted errors of the whole; @param most halvings in all
    HalvedIntervals(const Values& permitted, std::size_t most) : tolerances(permitted), halvingsLeft(most) {}

    /// @param share of the permitted errors that this interval may have
    /// @param at gives ValuesAtHeight of a height
    template <class Function>
    void add(double low, double high, double share, Function&& at) {
        std::vector<Interval> waiting{{low, high, share, 0}};
        while (!waiting.empty()) {
            const Interval i = waiting.back();
            waiting.pop_back();
            const Rule coarse = rule(i, 8, at), fine = rule(i, 16, at);
            bool agrees = true;
            for (std::size_t k = 0; k < count; ++k)
                agrees &= std::abs(fine.values[k] - coarse.values[k]) <=
                          std::max(i.share * tolerances[k], roundOff * fine.sizes[k]);
            if (!agrees && i.depth < deepest && halvingsLeft > 0) {
                --halvingsLeft;
                const double middle = 0.5 * (i.low + i.high);
                waiting.push_back({middle, i.high, 0.5 * i.share, i.depth + 1});
                waiting.push_back({i.low, middle, 0.5 * i.share, i.depth + 1});
                continue;
            }
            for (std::size_t k = 0; k < count; ++k) {
                sums[k] += fine.values[k];
                errors[k] += std::abs(fine.values[k] - coarse.values[k]);
            }
        }
    }

    Values sums{}, errors{};

private:
    using Rule = ValuesAtHeight<count>;
    struct Interval {
        double low, high, share;
        int depth;
    };
    static constexpr int deepest = 30;
    static constexpr double roundOff = 1e-14;

    template <class Function>
    static Rule rule(const Interval& interval, int nodes, Function&& at) {
        Rule result{};
        const double width = interval.high - interval.low;
        for (const QuadratureNode& node : gaussLegendre(nodes)) {
            const double t = 0.5 * (1 + node.position);
            const double z = interval.low + width * t * t * (3 - 2 * t);
            const double weight = 0.5 * node.weight * width * 6 * t * (1 - t);
            const ValuesAtHeight<count> found = at(z);
            for (std::size_t k = 0; k < count; ++k) {
                result.values[k] += weight * found.values[k];
                result.sizes[k] += weight * found.sizes[k];
            }
        }
        return result;
    }

    Values tolerances;
    std::size_t halvingsLeft;
};

}  // namespace pendular
