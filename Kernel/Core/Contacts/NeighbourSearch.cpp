#include "Kernel/Core/Contacts/NeighbourSearch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "Kernel/Core/Contacts/CellGrid.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

namespace {

struct Extent {
    std::array<double, 3> lowest, highest;
};

double along(const Vector<double>& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

template <class Items, class Position>
Extent extentOf(const Items& items, Position position) {
    const Vector<double> first = position(items[0]);
    Extent e{{first.x, first.y, first.z}, {first.x, first.y, first.z}};
    for (const auto& item : items) {
        const Vector<double> p = position(item);
        for (int axis = 0; axis < 3; ++axis) {
            e.lowest[axis] = std::min(e.lowest[axis], along(p, axis));
            e.highest[axis] = std::max(e.highest[axis], along(p, axis));
        }
    }
    return e;
}

constexpr std::size_t cellsWorthAThread = 2048;  // grains whose cells are found

/// A few cells for each item.
double mostCells(std::size_t items) { return 4.0 * static_cast<double>(items) + 64; }

/// The ranks of boxes of a grid along Morton's curve: boxes that are near in space mostly have near ranks.
/// Two boxes are compared along the axis in whose numbers the highest bit differs, as of Chan (2002), Proc.
/// 13th ACM-SIAM Symp. Discrete Algorithms, 472.
std::vector<std::uint32_t> ranksInZOrder(const std::array<std::uint32_t, 3>& count) {
    std::vector<std::array<std::uint32_t, 3>> boxes;
    for (std::uint32_t z = 0; z < count[2]; ++z)
        for (std::uint32_t y = 0; y < count[1]; ++y)
            for (std::uint32_t x = 0; x < count[0]; ++x) boxes.push_back({x, y, z});
    std::vector<std::uint32_t> order(boxes.size()), rank(boxes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
        std::size_t axis = 0;
        std::uint32_t highest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t differing = boxes[p][k] ^ boxes[q][k];
            if (std::bit_width(differing) <= std::bit_width(highest)) continue;
            highest = differing;
            axis = k;
        }
        return boxes[p][axis] < boxes[q][axis];
    });
    for (std::uint32_t k = 0; k < order.size(); ++k) rank[order[k]] = k;
    return rank;
}

/// Stable counting sort: begins[c] is where the members of cell c start in the order returned.
std::vector<std::uint32_t> sortByCell(const std::vector<std::uint32_t>& cellOf, std::size_t cells,
                                      std::vector<std::uint32_t>& begins) {
    begins.assign(cells + 1, 0);
    for (const std::uint32_t cell : cellOf) ++begins[cell + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
    std::vector<std::uint32_t> order(cellOf.size());
    for (std::size_t k = 0; k < cellOf.size(); ++k) order[next[cellOf[k]]++] = static_cast<std::uint32_t>(k);
    return order;
}

}  // namespace

std::vector<std::uint32_t> spatialOrder(std::span<const TranslationRecord> grains, double cellSize,
                                        int threads) {
    if (grains.empty()) return {};
    const Extent e = extentOf(grains, [](const TranslationRecord& g) { return g.position; });
    std::array<double, 3> lengths{};
    for (int axis = 0; axis < 3; ++axis) lengths[axis] = e.highest[axis] - e.lowest[axis];
    const double size = cellSize * enlargementOfCells(lengths, cellSize, mostCells(grains.size()));
    std::array<std::uint32_t, 3> tiles{};
    for (int axis = 0; axis < 3; ++axis)
        tiles[axis] = static_cast<std::uint32_t>(lengths[axis] / size) / 4 + 1;

    const std::vector<std::uint32_t> rank = ranksInZOrder(tiles);
    const auto cellOf = [&](const Vector<double>& p) {
        std::array<std::uint32_t, 3> c{};
        for (int axis = 0; axis < 3; ++axis)
            c[axis] = static_cast<std::uint32_t>((along(p, axis) - e.lowest[axis]) / size);
        const std::uint32_t tile = (c[2] / 4 * tiles[1] + c[1] / 4) * tiles[0] + c[0] / 4;
        return rank[tile] * 64 + (c[2] % 4 * 4 + c[1] % 4) * 4 + c[0] % 4;
    };
    std::vector<std::uint32_t> cells(grains.size());
    inParts(
        grains.size(), threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) cells[k] = cellOf(grains[k].position);
        },
        cellsWorthAThread);
    std::vector<std::uint32_t> begins;
    return sortByCell(cells, std::size_t{64} * tiles[0] * tiles[1] * tiles[2], begins);
}

NeighbourSearch::NeighbourSearch(std::span<const TranslationRecord> grains, double margin,
                                 const PeriodicBox& box, int threads)
    : periodic(box), halfMargin(0.5 * margin), points(grains.size()), levelOf(grains.size()) {
    if (grains.empty()) return;
    // A place whose grain was removed has the radius 0, and is in no cell.
    double smallest = infinity;
    for (const TranslationRecord& grain : grains)
        if (grain.radius > 0) smallest = std::min(smallest, grain.radius);
    smallest += 0.5 * margin;

    inParts(
        grains.size(), threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                points[k] = {box.wrap(grains[k].position), grains[k].radius + 0.5 * margin};
                if (grains[k].radius > 0)
                    levelOf[k] = static_cast<std::uint8_t>(std::log2(points[k].size / smallest));
            }
        },
        cellsWorthAThread);
    for (std::uint32_t k = 0; k < grains.size(); ++k) {
        if (!(grains[k].radius > 0)) continue;
        if (levelOf[k] >= levels.size()) levels.resize(levelOf[k] + 1u);
        levels[levelOf[k]].members.push_back(k);
    }
    for (Level& level : levels)
        if (!level.members.empty()) level.build(points, box, threads);
}

double NeighbourSearch::crowding() const {
    double largest = 0;
    for (const Level& level : levels) largest = std::max(largest, level.crowding());
    return largest;
}

double NeighbourSearch::Level::crowding() const { return crowdingOfCells(begins); }

void NeighbourSearch::Level::build(const Points& points, const PeriodicBox& box, int threads) {
    for (const std::uint32_t k : members) largest = std::max(largest, points[k].size);
    const Extent e = extentOf(members, [&](std::uint32_t k) { return points[k].position; });
    std::array<double, 3> lengths{};
    std::array<double, 3> low{};
    for (int axis = 0; axis < 3; ++axis) {
        wraps[axis] = along(box.length, axis) > 0;
        slides[axis] = along(box.across, axis) > 0;
        low[axis] = wraps[axis] ? along(box.lowest, axis) : e.lowest[axis];
        lengths[axis] = wraps[axis] ? along(box.length, axis) : e.highest[axis] - e.lowest[axis];
    }
    lowest = {low[0], low[1], low[2]};
    const double factor = enlargementOfCells(lengths, 2 * largest, mostCells(members.size()));
    divide(lengths, 2 * largest * factor);
    sort(points, threads);
    if (factor == 1 || box.isSheared() || crowding() < crowded) return;
    divideRepeatedly(lengths, 2 * largest);
    sort(points, threads);
}

void NeighbourSearch::Level::divide(const std::array<double, 3>& lengths, double size) {
    for (int axis = 0; axis < 3; ++axis) {
        // An axis that wraps is divided evenly, so that its last cell is whole.
        cells[axis] = wraps[axis] ? std::max(1, static_cast<int>(lengths[axis] / size))
                                  : static_cast<int>(lengths[axis] / size) + 1;
        cellSize[axis] = wraps[axis] ? lengths[axis] / cells[axis] : size;
        inverseSize[axis] = 1 / cellSize[axis];
    }
}

void NeighbourSearch::Level::divideRepeatedly(const std::array<double, 3>& lengths, double size) {
    std::array<double, 3> count{}, repetitions{1, 1, 1};
    for (int axis = 0; axis < 3; ++axis) count[axis] = std::max(1.0, std::floor(lengths[axis] / size));
    while (count[0] * count[1] * count[2] > mostCells(members.size())) {
        const auto longest = std::max_element(count.begin(), count.end()) - count.begin();
        count[longest] = std::floor(0.5 * count[longest]);
        repetitions[longest] *= 2;
    }
    for (int axis = 0; axis < 3; ++axis) {
        repeats[axis] = repetitions[axis] > 1;
        cells[axis] = static_cast<int>(count[axis]);
        // A periodic length holds a whole number of grids.
        cellSize[axis] = wraps[axis] ? lengths[axis] / (count[axis] * repetitions[axis]) : size;
        inverseSize[axis] = 1 / cellSize[axis];
    }
}

void NeighbourSearch::Level::sort(const Points& points, int threads) {
    std::vector<std::uint32_t> cell(members.size());
    inParts(
        members.size(), threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                const auto [x, y, z] = cellOf(points[members[k]].position);
                cell[k] = static_cast<std::uint32_t>(index(x, y, z));
            }
        },
        cellsWorthAThread);
    Members sorted = sortByCell(cell, index(0, 0, cells[2]), begins);
    for (std::uint32_t& k : sorted) k = members[k];
    members = std::move(sorted);
}

double NeighbourSearch::Level::endlessCell(int axis, double x) const {
    return std::floor((x - along(lowest, axis)) * inverseSize[axis]);
}

int NeighbourSearch::Level::repeatedCell(int axis, double endless) const {
    const double cell = std::fmod(endless, cells[axis]);  // exact, however large
    return static_cast<int>(cell < 0 ? cell + cells[axis] : cell);
}

int NeighbourSearch::Level::cellAlong(int axis, double x) const {
    const double cell = endlessCell(axis, x);
    if (repeats[axis]) return repeatedCell(axis, cell);
    return static_cast<int>(std::clamp(cell, 0.0, cells[axis] - 1.0));
}

std::array<int, 3> NeighbourSearch::Level::cellOf(const Vector<double>& p) const {
    return {cellAlong(0, p.x), cellAlong(1, p.y), cellAlong(2, p.z)};
}

std::array<int, 2> NeighbourSearch::Level::cellRange(int axis, double x, double reach) const {
    if ((!wraps[axis] || slides[axis]) && !repeats[axis])
        return {cellAlong(axis, x - reach), cellAlong(axis, x + reach)};
    const double first = endlessCell(axis, x - reach), last = endlessCell(axis, x + reach);
    // Never a cell twice; with so few cells all of them are looked at.
    if (last - first + 1 >= cells[axis]) return {0, cells[axis] - 1};
    const int begin = repeats[axis] ? repeatedCell(axis, first) : static_cast<int>(first);
    return {begin, begin + static_cast<int>(last - first)};
}

}  // namespace pendular
