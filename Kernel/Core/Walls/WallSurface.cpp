#include "Kernel/Core/Walls/WallSurface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "Kernel/Core/Walls/WallHandler.h"

namespace pendular {

namespace {

Polygon clipped(const Polygon& polygon, const HalfSpace& half, double slack) {
    const auto heightOf = [&](const Vector<double>& point) {
        const double height = dot(half.normal, point) - half.offset;
        return std::abs(height) > slack ? height : 0;
    };
    Polygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector<double>&a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double above = heightOf(a), next = heightOf(b);
        if (above <= 0) kept.push_back(a);
        if ((above <= 0) != (next <= 0)) kept.push_back(a + (above / (above - next)) * (b - a));
    }
    return kept;
}

/// Walls farther away than so many of the longest sides of the box do not widen it: a lid that was moved out
/// of the way would make the scene small in its picture. A particle that falls from 30 times its diameter is
/// still shown with the floor.
constexpr double farthestShown = 20;

[[nodiscard]] bool isEmpty(const Box& box) { return !(box.lowest.x <= box.highest.x); }

[[nodiscard]] double longestSide(const Box& box) {
    const Vector<double> sides = box.highest - box.lowest;
    return std::max({sides.x, sides.y, sides.z});
}

[[nodiscard]] bool isWithin(const Vector<double>& point, const Box& box) {
    return std::ranges::all_of(vectorAxes, [&](auto axis) {
        return point.*axis > box.lowest.*axis && point.*axis < box.highest.*axis;
    });
}

/// Sides of half-spaces that are the same but for round-off leave two corners in place of one.
Polygon withoutDoubleCorners(const Polygon& polygon, double nearest) {
    Polygon kept;
    for (const Vector<double>& corner : polygon)
        if (kept.empty() || norm(corner - kept.back()) > nearest) kept.push_back(corner);
    while (kept.size() > 1 && norm(kept.back() - kept.front()) <= nearest) kept.pop_back();
    return kept;
}

/// The half-spaces that cut off a surface at a box.
std::vector<HalfSpace> sidesOf(const Box& box, const WallSurface& surface) {
    if (surface.axis) {
        const Vector<double> half = 0.5 * (box.highest - box.lowest), &along = *surface.axis;
        const double middle = dot(along, box.middle());
        const double reach =
            std::abs(along.x) * half.x + std::abs(along.y) * half.y + std::abs(along.z) * half.z;
        return {{along, middle + reach}, {-along, reach - middle}};
    }
    const Vector<double>&low = box.lowest, &high = box.highest;
    return {{{1, 0, 0}, high.x},  {{-1, 0, 0}, -low.x}, {{0, 1, 0}, high.y},
            {{0, -1, 0}, -low.y}, {{0, 0, 1}, high.z},  {{0, 0, -1}, -low.z}};
}

/// The surfaces of all walls while the box in which they are drawn is found.
class Drawing {
public:
    Drawing(const WallHandler& handler, const Box& around, std::array<bool, 3> isPeriod)
        : walls(handler.present()), given(around), held(isPeriod) {
        for (const PresentWall& wall : walls) surfaces.push_back(wall.object->surface({{0, 0, 0}, 0}));
    }

    /// The box in which endless walls are drawn; without an extent where nothing tells how large they are to
    /// be.
    [[nodiscard]] Box box() {
        const Box known = withEnds();
        return isKnown(known) ? withCorners(withNearest(known)) : known;
    }
    [[nodiscard]] std::vector<WallSurface> drawn() && {
        if (const Box wide = box(); isKnown(wide)) {
            cut(wide);
        } else {
            for (WallSurface& surface : surfaces)
                if (surface.endless) surface.polygons.clear();
        }
        return std::move(surfaces);
    }

private:
    [[nodiscard]] static bool isKnown(const Box& box) { return !isEmpty(box) && longestSide(box) > 0; }
    void include(Box& box, const WallSurface& surface) const {
        for (const Polygon& polygon : surface.polygons)
            for (const Vector<double>& corner : polygon) box.include(corner);
        hold(box);
    }
    void hold(Box& box) const {
        if (isEmpty(given)) return;
        for (std::size_t k = 0; k < 3; ++k)
            if (held[k])
                box.lowest.*vectorAxes[k] = given.lowest.*vectorAxes[k],
                box.highest.*vectorAxes[k] = given.highest.*vectorAxes[k];
    }
    /// The given box and the walls that have ends; where there are neither, what is nearest to the origin.
    [[nodiscard]] Box withEnds() const {
        Box box = given;
        for (const WallSurface& surface : surfaces)
            if (!surface.endless) include(box, surface);
        if (isEmpty(box))
            for (const WallSurface& surface : surfaces) include(box, surface);
        return box;
    }
    [[nodiscard]] static Box limitsOf(const Box& box) {
        const double reach = farthestShown * longestSide(box);
        const Vector<double> by{reach, reach, reach};
        return {box.lowest - by, box.highest + by};
    }
    /// In a sphere without a radius, a plane shrinks to its point that is nearest to the centre, and a
    /// cylinder to its circle there, whose box does not change where the facets turn.
    [[nodiscard]] Box withNearest(const Box& box) {
        place({box.middle(), 0});
        const Box limits = limitsOf(box);
        Box wide = box;
        for (const WallSurface& surface : surfaces) {
            const bool isNear = std::ranges::all_of(surface.polygons, [&](const Polygon& polygon) {
                return std::ranges::all_of(
                    polygon, [&](const Vector<double>& corner) { return isWithin(corner, limits); });
            });
            if (surface.endless && isNear)
                wide.include(boxAround(surface, surface.axis.value_or(Vector<double>{})));
        }
        hold(wide);
        return wide;
    }
    /// With the corners in which endless walls meet: those that are not on the sides of a far wider box.
    [[nodiscard]] Box withCorners(const Box& box) {
        const Box limits = limitsOf(box);
        Box cutAt = limits;
        hold(cutAt);
        cut(cutAt);
        const double slack = 1e-9 * longestSide(limits);
        const Vector<double> by{slack, slack, slack};
        const Box inner{limits.lowest + by, limits.highest - by};
        Box wide = box;
        for (const WallSurface& surface : surfaces) {
            if (!surface.endless) continue;
            for (const Polygon& polygon : surface.polygons)
                for (const Vector<double>& corner : polygon)
                    if (isWithin(corner, inner)) wide.include(corner);
        }
        hold(wide);
        return wide;
    }
    void place(const SceneSphere& around) {
        for (std::size_t w = 0; w < walls.size(); ++w)
            if (surfaces[w].endless) surfaces[w] = walls[w].object->surface(around);
    }
    /// Cuts off endless walls at a box, which is widened by the slanted ends of cylinders before it cuts off
    /// planes.
    void cut(Box box) {
        const Vector<double> middle = box.middle();
        place({middle, norm(box.highest - middle)});
        for (const bool isCylinder : {true, false})
            for (std::size_t w = 0; w < surfaces.size(); ++w) {
                if (!surfaces[w].endless || surfaces[w].axis.has_value() != isCylinder) continue;
                cutOne(w, box);
                if (isCylinder) include(box, surfaces[w]);
            }
    }
    void cutOne(std::size_t w, const Box& box) {
        std::vector<HalfSpace> sides = sidesOf(box, surfaces[w]);
        for (std::size_t other = 0; other < surfaces.size(); ++other)
            if (other != w)
                sides.insert(sides.end(), surfaces[other].inside.begin(), surfaces[other].inside.end());
        // A plane on a side of the box, which ends at its nearest point, is there in spite of round-off.
        const double slack = 1e-9 * longestSide(box);
        for (Polygon& polygon : surfaces[w].polygons)
            polygon = withoutDoubleCorners(clipped(std::move(polygon), sides, slack), slack);
        std::erase_if(surfaces[w].polygons, [](const Polygon& polygon) { return polygon.size() < 3; });
    }

    std::span<const PresentWall> walls;
    Box given;
    std::array<bool, 3> held;
    std::vector<WallSurface> surfaces;
};

}  // namespace

WallSurface WallSurface::placed(const Pose& pose) const {
    WallSurface result = *this;
    for (Polygon& polygon : result.polygons)
        for (Vector<double>& corner : polygon) corner = pose.place(corner);
    for (HalfSpace& half : result.inside) {
        half.normal = pose.turn(half.normal);
        half.offset += dot(half.normal, pose.shift);
    }
    if (result.axis) result.axis = pose.turn(*result.axis);
    return result;
}

std::vector<Polygon> turnedAround(const Vector<double>& axis, const Vector<double>& across,
                                  const Vector<double>& begin, double beginRadius, const Vector<double>& end,
                                  double endRadius) {
    const Vector<double> other = cross(axis, across);
    const auto outward = [&](int k) {
        const double angle = 2 * std::numbers::pi * (k % facetsAround) / facetsAround;
        return std::cos(angle) * across + std::sin(angle) * other;
    };
    std::vector<Polygon> facets;
    for (int k = 0; k < facetsAround; ++k) {
        Polygon facet{begin + beginRadius * outward(k), end + endRadius * outward(k)};
        if (endRadius > 0) facet.push_back(end + endRadius * outward(k + 1));
        if (beginRadius > 0) facet.push_back(begin + beginRadius * outward(k + 1));
        facets.push_back(std::move(facet));
    }
    return facets;
}

Polygon clipped(Polygon polygon, const std::vector<HalfSpace>& halfSpaces, double slack) {
    for (const HalfSpace& half : halfSpaces) polygon = clipped(polygon, half, slack);
    return polygon;
}

Box boxAround(const WallSurface& surface, const Vector<double>& spin) {
    Box box;
    for (const Polygon& polygon : surface.polygons)
        for (const Vector<double>& corner : polygon) box.include(corner);
    const double speed = norm(spin);
    if (isEmpty(box) || !(speed > 0)) return box;
    // A cylinder about the axis on which the surface turns, and the box around that.
    const Vector<double> axis = (1 / speed) * spin, middle = box.middle();
    double length = 0, radius = 0;
    for (const Polygon& polygon : surface.polygons)
        for (const Vector<double>& corner : polygon) {
            const double along = dot(corner - middle, axis);
            length = std::max(length, std::abs(along));
            radius = std::max(radius, norm(corner - middle - along * axis));
        }
    Vector<double> half{0, 0, 0};
    for (const auto k : vectorAxes)
        half.*k = length * std::abs(axis.*k) + radius * std::sqrt(std::max(0.0, 1 - axis.*k * axis.*k));
    return {middle - half, middle + half};
}

std::vector<WallSurface> surfacesOf(const WallHandler& walls, const Vector<double>& lowest,
                                    const Vector<double>& highest, std::array<bool, 3> isPeriod) {
    return Drawing(walls, {lowest, highest}, isPeriod).drawn();
}

Box boxOfDrawing(const WallHandler& walls, const Box& given, std::array<bool, 3> isPeriod) {
    return Drawing(walls, given, isPeriod).box();
}

}  // namespace pendular
