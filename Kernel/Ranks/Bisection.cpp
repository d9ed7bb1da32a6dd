#include "Kernel/Ranks/Bisection.h"

#include <algorithm>
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

std::uint32_t Bisection::cutPart(std::span<Point> points, std::span<const double> shares,
                                 std::uint32_t firstRank) {
    const auto number = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    if (shares.size() == 1) {
        nodes[number].low = firstRank;
        return number;
    }
    double widest = -1;
    std::uint32_t axis = 0;
    for (std::uint32_t a = 0; a < 3 && !points.empty(); ++a) {
        const auto [low, high] =
            std::ranges::minmax(points, {}, [&](const Point& p) { return p.position.*axes[a]; });
        const double width = high.position.*axes[a] - low.position.*axes[a];
        if (width > widest) widest = width, axis = a;
    }
    std::ranges::sort(points, {}, [&](const Point& p) { return p.position.*axes[axis]; });
    const std::size_t lowRanks = shares.size() / 2;
    const auto sumOf = [](std::span<const double> some) {
        return std::accumulate(some.begin(), some.end(), 0.0);
    };
    double weight = 0, passed = 0;
    for (const Point& point : points) weight += point.weight;
    const double until = weight * sumOf(shares.first(lowRanks)) / sumOf(shares);
    std::size_t next = 0;
    while (next < points.size() && passed + 0.5 * points[next].weight < until)
        passed += points[next++].weight;
    nodes[number].axis = axis;
    nodes[number].border = next < points.size() ? points[next].position.*axes[axis] : infinity;
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
        at = position.*axes[nodes[at].axis] < nodes[at].border ? nodes[at].low : nodes[at].high;
    return nodes[at].low;
}

}  // namespace pendular
