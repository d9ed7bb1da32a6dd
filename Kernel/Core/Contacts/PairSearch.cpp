#include "Kernel/Core/Contacts/PairSearch.h"

#include <limits>
#include <numeric>

#include "Kernel/Core/Contacts/CellGrid.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

namespace {

constexpr std::size_t columnsWorthAThread = 2048;  // grains

double alongAxis(const Vector<double>& v, std::size_t axis) { return v.*vectorAxes[axis]; }

/// What positions span along an axis.
struct AxisSpan {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

    void add(double x) { low = std::min(low, x), high = std::max(high, x); }
};

}  // namespace

PairSearch::PairSearch(std::span<const TranslationRecord> grains, double ofSurfaces, const PeriodicBox& box,
                       int threads)
    : periodic(box), margin(ofSurfaces), columnOf(grains.size(), none) {
    const std::vector<Places> members = sortIntoLevels(grains);
    for (std::vector<double>& column : columns) column.resize(grains.size() + Pack::lanes);
    places.resize(grains.size() + Pack::lanes);
    std::uint32_t begin = 0;
    for (std::size_t level = 0; level < grids.size(); ++level) {
        grids[level].begin = begin;
        grids[level].end = begin += static_cast<std::uint32_t>(members[level].size());
        if (!members[level].empty() && !makeGrid(grids[level], grains, members[level], threads)) return;
    }
    usable = true;
}

/// A place whose grain was removed has the radius 0, and is in no column.
std::vector<PairSearch::Places> PairSearch::sortIntoLevels(std::span<const TranslationRecord> grains) {
    const double half = 0.5 * margin;
    AxisSpan sizes;
    for (const TranslationRecord& grain : grains)
        if (grain.radius > 0) sizes.add(grain.radius + half);
    if (sizes.high < 0) return {};
    const bool areAlike = sizes.high < 2 * sizes.low;
    const auto levelOf = [&](double size) {
        return areAlike ? std::size_t{0} : static_cast<std::size_t>(std::ilogb(size / sizes.low));
    };
    grids.resize(levelOf(sizes.high) + 1);
    std::vector<Places> members(grids.size());
    if (areAlike) members[0].reserve(grains.size());
    for (std::uint32_t k = 0; k < grains.size(); ++k) {
        if (!(grains[k].radius > 0)) continue;
        const double size = grains[k].radius + half;
        const std::size_t level = levelOf(size);
        members[level].push_back(k);
        grids[level].largest = std::max(grids[level].largest, size);
    }
    return members;
}

bool PairSearch::makeGrid(Grid& grid, std::span<const TranslationRecord> grains, const Places& members,
                          int threads) {
    const auto positionOf = [&](std::uint32_t place) {
        return periodic.any() ? periodic.wrap(grains[place].position) : grains[place].position;
    };
    std::array<AxisSpan, 3> spans;
    for (const std::uint32_t place : members) {
        const Vector<double> position = positionOf(place);
        spans[0].add(position.x), spans[1].add(position.y), spans[2].add(position.z);
    }
    std::array<double, 3> lengths{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double length = alongAxis(periodic.length, axis);
        grid.wraps[axis] = length > 0 && alongAxis(periodic.across, axis) == 0;
        grid.lowest[axis] = length > 0 ? alongAxis(periodic.lowest, axis) : spans[axis].low;
        lengths[axis] = length > 0 ? length : spans[axis].high - spans[axis].low;
    }
    const double wider = grid.divide(lengths, members.size());
    std::vector<std::uint32_t> cells(members.size());
    inParts(
        members.size(), threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k)
                cells[k] = static_cast<std::uint32_t>(grid.cellOf(positionOf(members[k])));
        },
        columnsWorthAThread);
    grid.begins.assign(grid.rowAt(0, static_cast<std::size_t>(grid.cells[2])) + 1, 0);
    for (const std::uint32_t cell : cells) ++grid.begins[cell + 1];
    grid.begins[0] = grid.begin;
    std::partial_sum(grid.begins.begin(), grid.begins.end(), grid.begins.begin());
    if (wider > 1 && crowdingOfCells(grid.begins) > crowded) return false;
    std::vector<std::uint32_t> next(grid.begins.begin(), grid.begins.end() - 1);
    for (std::size_t k = 0; k < members.size(); ++k) {
        TranslationRecord grain = grains[members[k]];
        grain.position = positionOf(members[k]);
        fillColumn(next[cells[k]]++, grain, members[k]);
    }
    return true;
}

void PairSearch::fillColumn(std::uint32_t column, const TranslationRecord& grain, std::uint32_t place) {
    const std::array<double, 7> numbers{
        grain.position.x, grain.position.y, grain.position.z, grain.radius + 0.5 * margin,
        grain.velocity.x, grain.velocity.y, grain.velocity.z};
    for (std::size_t k = 0; k < numbers.size(); ++k) columns[k][column] = numbers[k];
    places[column] = place;
    columnOf[place] = column;
}

/// Cells are as wide as the reach of two of the largest grains, and along x down to a quarter of it, as a row
/// is looked at as a whole: some more cells than grains. Where that would be too many they are wider.
double PairSearch::Grid::divide(const std::array<double, 3>& lengths, std::size_t members) {
    const double most = 8.0 * static_cast<double>(members) + 256, reach = 2 * largest;
    const auto cellsWith = [&](double alongX) {
        return (std::floor(alongX * lengths[0] / reach) + 1) * (std::floor(lengths[1] / reach) + 1) *
               (std::floor(lengths[2] / reach) + 1);
    };
    double alongX = 4;
    while (alongX > 1 && cellsWith(alongX) > most) alongX -= 1;
    const double wider = enlargementOfCells({alongX * lengths[0], lengths[1], lengths[2]}, reach, most);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double width = wider * reach / (axis == 0 ? alongX : 1);
        // A periodic axis is divided evenly, so that its last cell is whole.
        const bool isPeriodic = wraps[axis];
        const auto whole = static_cast<int>(lengths[axis] / width);
        cells[axis] = isPeriodic ? std::max(1, whole) : whole + 1;
        inverseSize[axis] = isPeriodic ? cells[axis] / lengths[axis] : 1 / width;
    }
    return wider;
}

}  // namespace pendular
