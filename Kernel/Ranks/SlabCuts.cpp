#include "Kernel/Ranks/SlabCuts.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace pendular {

void SlabCuts::cut(Exchange& exchange, std::span<const Point> own, std::span<const double> shares) {
    Message message;
    for (const Point& point : own) message.add(point);
    std::vector<Point> all;
    for (Message& from : exchange.swap(std::vector<Message>(exchange.count(), message)))
        while (!from.isTaken()) all.push_back(from.take<Point>());

    double widest = -1, weight = 0;
    for (const Vector<double>& along : {Vector<double>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        const auto [low, high] =
            std::ranges::minmax_element(all, {}, [&](const Point& p) { return dot(along, p.position); });
        const double width = all.empty() ? 0 : dot(along, high->position - low->position);
        if (width > widest) widest = width, axis = along;
    }
    std::ranges::sort(all, {}, [&](const Point& p) { return dot(axis, p.position); });
    for (const Point& point : all) weight += point.weight;
    const double perShare = weight / std::accumulate(shares.begin(), shares.end(), 0.0);
    borders.clear();
    double passed = 0, until = 0;
    std::size_t next = 0;
    for (std::size_t rank = 0; rank + 1 < exchange.count(); ++rank) {
        until += shares[rank] * perShare;
        while (next < all.size() && passed + 0.5 * all[next].weight < until) passed += all[next++].weight;
        borders.push_back(next < all.size() ? dot(axis, all[next].position)
                                            : std::numeric_limits<double>::infinity());
    }
}

std::size_t SlabCuts::ownerOf(const Vector<double>& position) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(borders, dot(axis, position)) - borders.begin());
}

}  // namespace pendular
