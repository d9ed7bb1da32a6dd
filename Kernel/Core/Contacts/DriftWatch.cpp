#include "Kernel/Core/Contacts/DriftWatch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Kernel/Core/Contacts/CellGrid.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

namespace {

constexpr double diametersOfACell = 4;  // of the largest grain
constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr std::size_t worthAThread = 1024;  // grains

Four leastOf(Four a, Four b) { return a < b ? a : b; }
Four mostOf(Four a, Four b) { return a > b ? a : b; }
double squaredShift(Four v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

}  // namespace

const DriftWatch::Extent DriftWatch::nowhere{Four{unlimited, unlimited, unlimited, unlimited},
                                             Four{-unlimited, -unlimited, -unlimited, -unlimited}};

void DriftWatch::Extent::add(const Extent& other) {
    low = leastOf(low, other.low);
    high = mostOf(high, other.high);
}

void DriftWatch::begin(const ParticleStore& grains, const PeriodicBox& box, double range, int threads) {
    periodic = box;
    known = false;
    if (box.imagesMove || box.isSheared() || grains.size() == 0) return;
    start.resize(grains.size());
    cellOf.resize(grains.size());
    struct alignas(64) Found {
        Extent places = nowhere;
        double largest = 0;
    };
    std::vector<Found> found(partsOf(grains.size(), threads, worthAThread));
    inParts(
        grains.size(), threads,
        [&](int part, std::size_t first, std::size_t end) {
            Found own;
            for (std::size_t k = first; k < end; ++k) {
                const Four position = fourOf(grains.translation[k].position);
                start[k] = {position};
                own.largest = std::max(own.largest, grains.translation[k].radius);
                own.places.add({position, position});
            }
            found[static_cast<std::size_t>(part)] = own;
        },
        worthAThread);
    for (const Found& one : found) {
        found[0].places.add(one.places);
        found[0].largest = std::max(found[0].largest, one.largest);
    }
    const auto& [places, largest] = found[0];
    const auto lengths = [](Four v) { return Lengths{v[0], v[1], v[2]}; };
    if (!divide(lengths(places.low), lengths(places.high), grains.size(), largest)) return;
    inParts(
        grains.size(), threads,
        [&](int, std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k)
                cellOf[k] = cellAt(box.wrap(grains.translation[k].position));
        },
        worthAThread);
    // Farther than that it is not known which image has come.
    halfReach = std::min(0.5 * (narrowest - 2 * largest - range), 0.4 * box.shortestLength());
    known = halfReach > 0;
}

bool DriftWatch::divide(const Lengths& low, const Lengths& high, std::size_t grains, double largestRadius) {
    const double most = 0.25 * static_cast<double>(grains) + 64;
    const Lengths boxLengths{periodic.length.x, periodic.length.y, periodic.length.z},
        boxLowest{periodic.lowest.x, periodic.lowest.y, periodic.lowest.z};
    Lengths lengths{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        wraps[axis] = boxLengths[axis] > 0;
        lowest[axis] = wraps[axis] ? boxLowest[axis] : low[axis];
        lengths[axis] = wraps[axis] ? boxLengths[axis] : high[axis] - low[axis];
        if (!(lengths[axis] < unlimited)) return false;
    }
    double size = diametersOfACell * 2 * largestRadius;
    if (!(size > 0)) return false;
    size *= enlargementOfCells(lengths, size, most);
    narrowest = size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto whole = static_cast<std::uint32_t>(lengths[axis] / size);
        // A periodic axis is divided evenly; of three cells all are neighbours.
        cells[axis] = wraps[axis] ? std::max(1u, whole) : whole + 1;
        inverseSize[axis] = wraps[axis] ? cells[axis] / lengths[axis] : 1 / size;
        if (cells[axis] > 3) narrowest = std::min(narrowest, 1 / inverseSize[axis]);
    }
    narrowest *= 1 - 1e-6;  // rounded
    return true;
}

std::uint32_t DriftWatch::cellAt(const Vector<double>& place) const {
    std::array<std::uint32_t, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = (place.*vectorAxes[axis] - lowest[axis]) * inverseSize[axis];
        cell[axis] = static_cast<std::uint32_t>(std::clamp(at, 0.0, cells[axis] - 1.0));
    }
    return indexOf(cell);
}

DriftWatch::Drift DriftWatch::drift(const ParticleStore& grains, std::span<const std::uint8_t> nearWalls,
                                    int threads) {
    const std::size_t count = std::min(grains.size(), start.size());
    extents.resize(partsOf(count, threads, worthAThread));
    std::vector<Largest> found(extents.size());
    inParts(
        count, threads,
        [&](int part, std::size_t first, std::size_t end) {
            const auto own = static_cast<std::size_t>(part);
            extents[own].assign(cellCount(), nowhere);
            found[own] = look(grains, nearWalls, first, end, extents[own]);
        },
        worthAThread);
    Largest largest;
    for (std::size_t part = 0; part < found.size(); ++part) {
        largest.farthest = std::max(largest.farthest, found[part].farthest);
        largest.atWalls = std::max(largest.atWalls, found[part].atWalls);
        for (std::size_t cell = 0; part > 0 && cell < cellCount(); ++cell)
            extents[0][cell].add(extents[part][cell]);
    }
    // A box may be larger than what is in it.
    return {std::sqrt(std::min(squaredApproach(), 4 * largest.farthest)), std::sqrt(largest.farthest),
            std::sqrt(largest.atWalls)};
}

DriftWatch::Largest DriftWatch::look(const ParticleStore& grains, std::span<const std::uint8_t> nearWalls,
                                     std::size_t first, std::size_t end, Extents& boxes) const {
    const Four whole{periodic.length.x, periodic.length.y, periodic.length.z, 0};
    const Four half = 0.5 * Four{wraps[0] ? whole[0] : unlimited, wraps[1] ? whole[1] : unlimited,
                                 wraps[2] ? whole[2] : unlimited, unlimited};
    Largest largest;
    for (std::size_t k = first; k < end; ++k) {
        const TranslationRecord& grain = grains.translation[k];
        if (grain.radius == 0 || cellOf[k] == none) continue;  // a gap, or another grain
        Four shift = loadFour(grain.position) - start[k].position;
        // Grains may have been brought back through a face.
        shift = shift > half ? shift - whole : shift;
        shift = shift < -half ? shift + whole : shift;
        boxes[cellOf[k]].add({shift, shift});
        const double squared = squaredShift(shift);
        largest.farthest = std::max(largest.farthest, squared);
        if (k < nearWalls.size() && nearWalls[k] != 0) largest.atWalls = std::max(largest.atWalls, squared);
    }
    return largest;
}

double DriftWatch::squaredApproach() const {
    double largest = 0;
    for (std::uint32_t z = 0; z < cells[2]; ++z)
        for (std::uint32_t y = 0; y < cells[1]; ++y)
            for (std::uint32_t x = 0; x < cells[0]; ++x)
                largest = std::max(largest, squaredApproach({x, y, z}));
    return largest;
}

double DriftWatch::squaredApproach(const std::array<std::uint32_t, 3>& cell) const {
    const Extent own = extents[0][indexOf(cell)];
    if (own.isEmpty()) return 0;
    double largest = squaredShift(own.high - own.low);
    for (int near = 14; near < 27; ++near) {  // half of the neighbours: the others find this one
        std::array<std::uint32_t, 3> to{};
        if (!neighbour(0, cell[0], near % 3 - 1, to[0]) || !neighbour(1, cell[1], near / 3 % 3 - 1, to[1]) ||
            !neighbour(2, cell[2], near / 9 - 1, to[2]))
            continue;
        const Extent& other = extents[0][indexOf(to)];
        if (other.isEmpty()) continue;
        const Four most = mostOf(own.high - other.low, other.high - own.low);
        largest = std::max(largest, squaredShift(most));
    }
    return largest;
}

bool DriftWatch::neighbour(std::size_t axis, std::uint32_t cell, int by, std::uint32_t& to) const {
    const std::int64_t count = cells[axis], next = std::int64_t{cell} + by;
    if ((next < 0 || next >= count) && !wraps[axis]) return false;
    to = static_cast<std::uint32_t>((next + count) % count);
    return true;
}

}  // namespace pendular
