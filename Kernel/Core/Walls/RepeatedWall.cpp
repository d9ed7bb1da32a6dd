#include "Kernel/Core/Walls/RepeatedWall.h"

#include <cmath>

namespace pendular {

void RepeatedWall::listParts(const Vector<double>& centre, double reach,
                             std::vector<std::uint32_t>& parts) const {
    if (!isRepeated()) return listOwn(centre, reach, parts);
    images.forEachWithin(centre, reach, surroundings(),
                         [&](const Vector<double>& shift, std::uint32_t image) {
                             const std::size_t begin = parts.size();
                             listOwn(centre - shift, reach, parts);
                             for (std::size_t k = begin; k < parts.size(); ++k) parts[k] |= image;
                         });
}

/// Parts of one image follow each other, as listParts() gives them.
void RepeatedWall::findPoints(const Vector<double>& centre, double reach,
                              std::span<const std::uint32_t> parts, std::span<WallPoint> points) const {
    if (!isRepeated()) return findOwn(centre, reach, parts, points);
    for (std::size_t begin = 0; begin < parts.size();) {
        std::size_t end = begin + 1;
        while (end < parts.size() && WallImages::imageOf(parts[end]) == WallImages::imageOf(parts[begin]))
            ++end;
        findAtImage(centre, reach, parts.subspan(begin, end - begin), points.subspan(begin, end - begin));
        for (std::size_t k = begin; k < end; ++k)
            if (points[k].coveredBy >= 0) points[k].coveredBy += static_cast<int>(begin);
        begin = end;
    }
}

void RepeatedWall::findAtImage(const Vector<double>& centre, double reach,
                               std::span<const std::uint32_t> parts, std::span<WallPoint> points) const {
    const Vector<double> shifted = centre - imageShift(parts[0], centre);
    if (WallImages::imageOf(parts[0]) == 0) return findOwn(shifted, reach, parts, points);
    std::vector<std::uint32_t> own;
    for (const std::uint32_t part : parts) own.push_back(WallImages::partOf(part));
    findOwn(shifted, reach, own, points);
}

bool RepeatedWall::isCrossed(const Vector<double>& from, const Vector<double>& to) const {
    if (!isRepeated()) return isOwnCrossed(from, to);
    bool isAny = false;
    images.forEachWithin(0.5 * (from + to), 0.5 * norm(to - from), surroundings(),
                         [&](const Vector<double>& shift, std::uint32_t) {
                             isAny = isAny || isOwnCrossed(from - shift, to - shift);
                         });
    return isAny;
}

}  // namespace pendular
