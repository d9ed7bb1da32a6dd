#include "Kernel/Features/DomainDecomposition/Bisection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pendular {

void Bisection::cut(Exchange& exchange, std::span<const Point> own, std::span<const double> shares) {
    Message message;
    for (const Point& point : own) message.add(point);
    std::vector<Point> all;
    for (Message& from : exchange.swap(std::vector<Message>(exchange.count(), message)))
        while (!from.isTaken()) all.push_back(from.take<Point>());
    cut(std::move(all), shares);
}

void Bisection::cut(std::vector<Point> points, std::span<const double> shares) {
    nodes.clear();
    cutPart(points, shares, 0);
}

namespace {

struct BisectionCut {
    double border = infinity;  // m
    double width = -1;         // m, of the slab around it that has so many points as a layer
};

/// Where the share of the weight is on the low side, and how thick a layer of points is there.
/// @param points place (m) and weight, in any order
BisectionCut findCut(std::vector<std::pair<double, double>> points, double share) {
    const auto begin = points.begin();
    const auto at = [&](std::size_t k) { return begin + static_cast<std::ptrdiff_t>(k); };
    const auto weightOf = [&](std::size_t from, std::size_t to) {
        return std::accumulate(at(from), at(to), 0.0,
                               [](double sum, const auto& p) { return sum + p.second; });
    };
    const double until = share * weightOf(0, points.size());
    double passed = 0;
    std::size_t low = 0, high = points.size();
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        std::nth_element(at(low), at(middle), at(high));
        const double before = passed + weightOf(low, middle), here = points[middle].second;
        if (before + 0.5 * here < until) passed = before + here, low = middle + 1;
        else high = middle;
    }
    if (low == points.size()) return {};
    const double border = points[low].first;
    const auto half =
        static_cast<std::size_t>(0.5 * std::pow(static_cast<double>(points.size()), 2.0 / 3)) + 1;
    const std::size_t first = low - std::min(low, half), last = std::min(low + half, points.size() - 1);
    std::nth_element(begin, at(first), at(low));
    std::nth_element(at(low), at(last), points.end());
    return {border, points[last].first - points[first].first};
}

}  // namespace

std::uint32_t Bisection::cutPart(std::span<Point> points, std::span<const double> shares,
                                 std::uint32_t firstRank) {
    const auto number = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    if (shares.size() == 1) {
        nodes[number].low = firstRank;
        return number;
    }
    const std::size_t lowRanks = shares.size() / 2;
    const auto sumOf = [](std::span<const double> some) {
        return std::accumulate(some.begin(), some.end(), 0.0);
    };
    const double share = sumOf(shares.first(lowRanks)) / sumOf(shares);
    BisectionCut best;
    std::uint32_t axis = 0;
    std::vector<std::pair<double, double>> along(points.size());
    for (std::uint32_t a = 0; a < 3; ++a) {
        std::ranges::transform(points, along.begin(), [&](const Point& p) {
            return std::pair(p.position.*vectorAxes[a], p.weight);
        });
        if (const BisectionCut found = findCut(along, share); found.width > best.width)
            best = found, axis = a;
    }
    nodes[number].axis = axis;
    nodes[number].border = best.border;
    const auto isLow = [&](const Point& p) { return p.position.*vectorAxes[axis] < best.border; };
    const auto next =
        static_cast<std::size_t>(std::partition(points.begin(), points.end(), isLow) - points.begin());
    const std::uint32_t low = cutPart(points.first(next), shares.first(lowRanks), firstRank),
                        high = cutPart(points.subspan(next), shares.subspan(lowRanks),
                                       firstRank + static_cast<std::uint32_t>(lowRanks));
    nodes[number].low = low;
    nodes[number].high = high;
    return number;
}

std::size_t Bisection::ownerOf(const Vector<double>& position) const {
    std::uint32_t at = 0;
    while (nodes[at].axis != leaf)
        at = position.*vectorAxes[nodes[at].axis] < nodes[at].border ? nodes[at].low : nodes[at].high;
    return nodes[at].low;
}

}  // namespace pendular
