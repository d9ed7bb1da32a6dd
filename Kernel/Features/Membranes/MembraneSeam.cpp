// Where a membrane goes on at its images, in a scene that repeats itself.
#include <map>

#include "Kernel/Features/Membranes/MembraneNet.h"
#include "Kernel/Foundation/Math/BoxTree.h"

namespace pendular {

namespace {

using Index = std::uint32_t;
using Point = Vector<double>;

Point along(std::size_t axis, const Point& periods) {
    return {axis == 0 ? periods.x : 0, axis == 1 ? periods.y : 0, axis == 2 ? periods.z : 0};
}

}  // namespace

void MembraneNet::joinAcross(const Point& periods) {
    repeats.clear();
    rest = unjoined;
    measure();
    if (periods == Point{0, 0, 0}) return;
    const Partners partners = partnersAcross(periods);
    findCopies(partners, periods);
    if (repeats.empty()) return;
    for (const Copy& copy : repeats) rest[copy.vertex] = rest[copy.of] + copy.shift;
    measure();
    joinEdges(partners, periods);
}

MembraneNet::Partners MembraneNet::partnersAcross(const Point& periods) const {
    Partners partners;
    std::vector<Index> rim;
    std::vector<Box> boxes;
    for (Index v = 0; v < rest.size(); ++v) {
        if (!atRim[v]) continue;
        rim.push_back(v);
        boxes.emplace_back().include(rest[v]);
    }
    const BoxTree tree(boxes);
    const double tolerance = 1e-4 * shortest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        partners[axis].resize(rest.size());
        const Point period = along(axis, periods);
        if (period == Point{0, 0, 0}) continue;
        for (const Index v : rim)
            tree.forEachNear(rest[v] + period, tolerance, [&](std::uint32_t near) {
                if (norm(rest[rim[near]] - rest[v] - period) < tolerance) partners[axis][v] = rim[near];
            });
    }
    return partners;
}

/// Of all vertices that are one, the first is the one that the others are copies of.
void MembraneNet::findCopies(const Partners& partners, const Point& periods) {
    std::vector<std::vector<std::pair<Index, Point>>> neighbours(rest.size());
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (Index v = 0; v < rest.size(); ++v)
            if (const auto partner = partners[axis][v]) {
                neighbours[v].emplace_back(*partner, along(axis, periods));
                neighbours[*partner].emplace_back(v, -along(axis, periods));
            }
    std::vector<bool> isKnown(rest.size(), false);
    for (Index v = 0; v < rest.size(); ++v) {
        if (isKnown[v]) continue;
        isKnown[v] = true;
        std::vector<Copy> reached{{v, v, {0, 0, 0}}};
        for (std::size_t k = 0; k < reached.size(); ++k)
            for (const auto& [next, shift] : neighbours[reached[k].vertex]) {
                if (isKnown[next]) continue;
                isKnown[next] = true;
                reached.push_back({next, v, reached[k].shift + shift});
            }
        repeats.insert(repeats.end(), reached.begin() + 1, reached.end());
    }
}

void MembraneNet::joinEdges(const Partners& partners, const Point& periods) {
    std::map<std::array<Index, 2>, std::size_t> sides;
    for (std::size_t k = 0; k < freeSides.size(); ++k)
        sides[{cornerOf(freeSides[k]), cornerOf(freeSides[k], 1)}] = k;
    std::vector<bool> isJoined(freeSides.size(), false);
    for (const auto& [ends, k] : sides)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto begin = partners[axis][ends[0]], end = partners[axis][ends[1]];
            if (!begin || !end) continue;
            if (const auto same = sides.find({*begin, *end}); same != sides.end())
                refuseSenses(freeSides[k].triangle, freeSides[same->second].triangle);
            const auto other = sides.find({*end, *begin});
            if (other == sides.end()) continue;
            addHinge(freeSides[k], freeSides[other->second], -along(axis, periods));
            isJoined[k] = isJoined[other->second] = true;
        }
    atRim.assign(rest.size(), false);
    for (const auto& [ends, k] : sides)
        if (!isJoined[k]) atRim[ends[0]] = atRim[ends[1]] = true;
}

}  // namespace pendular
