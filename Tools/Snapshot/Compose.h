#pragma once

#include <cmath>
#include <map>
#include <numbers>

#include "Tools/Snapshot/Frame.h"
#include "Tools/Snapshot/PovScene.h"
#include "Tools/Snapshot/WallEdges.h"

namespace pendular::snapshot {

/// What the user wants to see.
struct View {
    std::string field = "radius_m";  // "none": all grains in one colour
    std::vector<double> range;       // lowest and highest; empty: those of the frames
    std::string map = "viridis";
    std::vector<double> box;                  // m, x0 x1 y0 y1 z0 z1 of the centres shown; empty: all
    std::vector<double> from{0.4, -1, 0.35};  // direction to the eye
    std::string contacts = "bridges";         // none, bridges or forces
    double wallTransparency = 0.85;
    std::string caption;  // "time": that of the frame
    bool legend = true;
    int width = 800, height = 600;  // pixels
};

/// And finite: the last state of a run may have grains that are nowhere.
inline bool isInside(const Vector<double>& p, const std::vector<double>& box) {
    if (!std::isfinite(p.x + p.y + p.z)) return false;
    return box.empty() || (p.x >= box[0] && p.x <= box[1] && p.y >= box[2] && p.y <= box[3] &&
                           p.z >= box[4] && p.z <= box[5]);
}

/// Lowest and highest of the numbers that are shown.
struct Span {
    double lowest = INFINITY, highest = -INFINITY;

    void take(double value) {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
    }
    [[nodiscard]] double share(double value) const {
        if (std::isnan(value)) return 0;
        return highest > lowest ? (value - lowest) / (highest - lowest) : 0.5;
    }
};

/// The number that gives the colours: of each grain, or of each contact in a picture of forces.
inline Scalar shownScalar(const Frame& frame, const View& view) {
    if (view.contacts == "forces") return scalarOf(frame.contacts.cellFields, "normal_force_N");
    if (view.field == "none") return {"none", std::vector<double>(frame.grains.points.size(), 0.0), false};
    return scalarOf(frame.grains.pointFields, view.field);
}

inline const ColourMap& mapOf(const View& view) {
    for (const ColourMap& map : colourMaps)
        if (map.name == view.map) return map;
    throw InputError(
        fmt::format("snapshot: colour map = '{}'; it may be viridis, coolwarm or grey.", view.map));
}

/// The colour of a name, by its place among the whole numbers.
inline Colour namedColour(double value) {
    const auto count = static_cast<double>(namedColours.size());
    return fromBytes(namedColours[static_cast<std::size_t>(value - count * std::floor(value / count))]);
}

/// The cylinder that a bridge is drawn as, with the bridge's true volume V between spheres whose surfaces,
/// S apart, are taken as paraboloids: V = pi b^2 (S + b^2 / (4 R)), R = r1 r2 / (r1 + r2), b its radius.
inline double bridgeRadius(double volume, double separation, double effectiveRadius) {
    const double s = std::max(separation, 0.0), r = effectiveRadius;
    return std::sqrt(2 * r * (std::sqrt(s * s + volume / (std::numbers::pi * r)) - s));
}

inline void addBridges(Picture& picture, const Frame& frame, const View& view) {
    const PolyData& lines = frame.contacts;
    const PolyDataField *bridged = lines.cellField("bridged"), *volume = lines.cellField("bridge_volume_m3"),
                        *overlap = lines.cellField("overlap_m"), *first = lines.cellField("particle1"),
                        *second = lines.cellField("particle2");
    const PolyDataField *radii = frame.grains.pointField("radius_m"),
                        *identity = frame.grains.pointField("identity");
    if (!bridged || !volume || !overlap || !first || !second || !radii || !identity) return;
    std::map<double, double> radiusOf;  // by identity
    for (std::size_t k = 0; k < identity->size(); ++k) radiusOf[identity->at(k)] = radii->at(k);
    for (std::size_t k = 0; k < lines.ends.size(); ++k) {
        const auto [begin, end] = endsOf(lines, k);
        if (bridged->at(k) == 0 || !isInside(begin, view.box) || !isInside(end, view.box)) continue;
        const double r1 = radiusOf.at(first->at(k));
        const double r2 = second->at(k) < 0 ? INFINITY : radiusOf.at(second->at(k));
        const double radius = bridgeRadius(volume->at(k), -overlap->at(k), 1 / (1 / r1 + 1 / r2));
        picture.rods.push_back({begin, end, radius, {0.15, 0.45, 0.85}, 0.1});
    }
}

/// Rods whose cross-section grows with the size of the normal force.
inline void addForces(Picture& picture, const Frame& frame, const View& view, const Scalar& force,
                      const Span& span) {
    double thickest = INFINITY;
    if (const PolyDataField* radii = frame.grains.pointField("radius_m"))
        for (std::size_t k = 0; k < radii->size(); ++k) thickest = std::min(thickest, 0.6 * radii->at(k));
    const double largest = std::max(std::abs(span.lowest), std::abs(span.highest));
    for (std::size_t k = 0; k < frame.contacts.ends.size(); ++k) {
        const auto [begin, end] = endsOf(frame.contacts, k);
        if (!isInside(begin, view.box) || !(largest > 0)) continue;
        const double share = std::min(std::abs(force.values[k]) / largest, 1.0);
        picture.rods.push_back({begin, end, thickest * std::sqrt(share) + 1e-9 * thickest,
                                mapOf(view).at(span.share(force.values[k])), 0});
    }
}

inline Legend legendOf(const Scalar& scalar, const Span& span, const View& view) {
    Legend legend{label(scalar.name), scalar.areNames ? nullptr : &mapOf(view), {}};
    if (scalar.areNames) {
        const std::set<double> names(scalar.values.begin(), scalar.values.end());
        double place = 0.5 + 0.08 * (static_cast<double>(names.size()) - 1);
        for (const double name : names) {
            legend.marks.push_back({place, fmt::format("{:.0f}", name), namedColour(name)});
            place -= 0.16;
        }
    } else {
        const std::vector<double> numbers = ticks(span.lowest, span.highest);
        const int digits = digitsOf(numbers);
        for (const double number : numbers)
            legend.marks.push_back({span.share(number), fmt::format("{:.{}g}", number, digits), {}});
    }
    return legend;
}

/// The parts of the walls in the box; the box is `border` wider (m), as the grains are wider than their
/// centres.
inline std::vector<Polygon> wallsOf(const PolyData& walls, const View& view, double border) {
    std::vector<HalfSpace> sides;
    for (std::size_t k = 0; k < view.box.size(); ++k) {
        const double sign = k % 2 == 0 ? -1 : 1;
        Vector<double> normal{0, 0, 0};
        (k / 2 == 0 ? normal.x : k / 2 == 1 ? normal.y : normal.z) = sign;
        sides.push_back({normal, sign * view.box[k] + border});
    }
    std::vector<Polygon> found;
    std::size_t begin = 0;
    for (const std::int32_t end : walls.ends) {
        Polygon polygon;
        for (; begin < static_cast<std::size_t>(end); ++begin)
            polygon.push_back(walls.points[static_cast<std::size_t>(walls.corners[begin])]);
        polygon = clipped(std::move(polygon), sides);
        if (polygon.size() >= 3) found.push_back(std::move(polygon));
    }
    return found;
}

/// The shapes of the grains of a frame, if they are no balls.
class Solids {
public:
    explicit Solids(const PolyData& grains)
        : lengths(grains.pointField("half_lengths_m")),
          first(grains.pointField("n1")),
          second(grains.pointField("n2")),
          turns(grains.pointField("orientation")) {}

    [[nodiscard]] std::optional<Solid> operator[](std::size_t grain) const {
        if (!lengths || !first || !second || !turns || lengths->components != 3 || turns->components != 9)
            return {};
        Solid solid{{}, first->at(grain), second->at(grain)};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto part = [&](std::size_t row) { return turns->at(9 * grain + 3 * row + axis); };
            solid.axes[axis] = lengths->at(3 * grain + axis) * Vector<double>{part(0), part(1), part(2)};
        }
        return solid;
    }

private:
    const PolyDataField *lengths, *first, *second, *turns;
};

/// The picture of a frame, with colours between the ends of `span`.
inline Picture compose(const Frame& frame, const View& view, const Span& span) {
    Picture picture;
    picture.wallTransparency = view.wallTransparency;
    const Scalar scalar = shownScalar(frame, view);
    const PolyDataField* radii = frame.grains.pointField("radius_m");
    const Solids solids(frame.grains);
    double largest = 0;
    for (std::size_t k = 0; radii && k < radii->size(); ++k) largest = std::max(largest, radii->at(k));
    if (view.contacts == "forces") {
        addForces(picture, frame, view, scalar, span);
    } else {
        for (std::size_t k = 0; radii && k < frame.grains.points.size(); ++k) {
            if (!isInside(frame.grains.points[k], view.box)) continue;
            const Colour colour = view.field == "none" ? Colour{0.82, 0.72, 0.53}
                                  : scalar.areNames    ? namedColour(scalar.values[k])
                                                       : mapOf(view).at(span.share(scalar.values[k]));
            picture.balls.push_back({frame.grains.points[k], radii->at(k), colour, solids[k]});
        }
        if (view.contacts == "bridges") addBridges(picture, frame, view);
    }
    if (view.wallTransparency < 1) picture.walls = wallsOf(frame.walls, view, largest);
    const bool hasValues = span.lowest <= span.highest;  // a scene without grains has none
    if (view.legend && hasValues && scalar.name != "none") picture.legend = legendOf(scalar, span, view);
    picture.caption = view.caption == "time" ? fmt::format("t = {:.4g} s", frame.grains.time) : view.caption;
    return picture;
}

/// Points that a picture must show whole. Those of a grain are the corners of a cube around it, a little
/// smaller.
inline std::vector<Vector<double>> outline(const Picture& picture) {
    std::vector<Vector<double>> points;
    for (const Ball& ball : picture.balls) {
        const double half = 0.9 * ball.radius;
        for (const double x : {-half, half})
            for (const double y : {-half, half})
                for (const double z : {-half, half}) points.push_back(ball.centre + Vector<double>{x, y, z});
    }
    for (const Rod& rod : picture.rods) points.push_back(rod.begin), points.push_back(rod.end);
    for (const Polygon& polygon : picture.walls) points.insert(points.end(), polygon.begin(), polygon.end());
    return points;
}

}  // namespace pendular::snapshot
