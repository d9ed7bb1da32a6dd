#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Features/Meshes/PartCover.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

template <Number T>
ProfilePlace<T> operator-(const ProfilePlace<T>& a, const ProfilePlace<T>& b) {
    return {a.radius - b.radius, a.height - b.height};
}
template <Number T>
T product(const ProfilePlace<T>& a, const ProfilePlace<T>& b) {
    return a.radius * b.radius + a.height * b.height;
}
double length(const ProfilePoint& a) { return std::hypot(a.radius, a.height); }
bool same(const ProfilePoint& a, const ProfilePoint& b) {
    return a.radius == b.radius && a.height == b.height;
}

template <Number T>
ProfilePlace<T> nearestOn(const ProfilePlace<T>& begin, const ProfilePlace<T>& end,
                          const ProfilePlace<T>& from) {
    const ProfilePlace<T> along = end - begin;
    const T share = product(from - begin, along) / product(along, along),
            clamped = select(share < T(0), T(0), select(T(1) < share, T(1), share));
    const MaskOf<T> isEnd = clamped == T(1);  // which rounding could miss
    return {select(isEnd, end.radius, begin.radius + clamped * along.radius),
            select(isEnd, end.height, begin.height + clamped * along.height)};
}

/// Whether two segments that leave a common point in directions a and b go on smoothly.
bool smoothly(const ProfilePoint& a, const ProfilePoint& b) {
    return product(a, b) < -smoothCosine * length(a) * length(b);
}

}  // namespace

void AxisymmetricWall::set(const Vec3D& direction, const Vec3D& point, std::vector<ProfilePoint> polyline) {
    axis = checkedDirection("AxisymmetricWall", "length of the axis' direction", direction);
    origin = checkedVector("AxisymmetricWall", "point", point, "m");
    radialOnAxis = anyAcross(axis);
    if (polyline.size() < 2)
        throw InputError(fmt::format("AxisymmetricWall: the profile has {} points; it must have at least 2.",
                                     polyline.size()));
    for (std::size_t k = 0; k < polyline.size(); ++k) {
        checkValue(fmt::format("AxisymmetricWall, profile point {}", k), "radius", polyline[k].radius, "m",
                   notNegative);
        checkValue(fmt::format("AxisymmetricWall, profile point {}", k), "height", polyline[k].height, "m",
                   {-infinity, infinity, false, false});
        if (k == 0) continue;
        if (same(polyline[k], polyline[k - 1]))
            throw InputError(
                fmt::format("AxisymmetricWall: profile points {} and {} are the same.", k - 1, k));
        if (polyline[k].radius == 0 && polyline[k - 1].radius == 0)
            throw InputError(
                fmt::format("AxisymmetricWall: profile points {} and {} both lie on the axis.", k - 1, k));
    }
    profile = std::move(polyline);
    takePlace();
}

template <Number T>
AxisymmetricWall::Meridian<T> AxisymmetricWall::meridianOf(const Vector<T>& centre) const {
    const Vector<T> relative = centre - inAllLanes<T>(origin), along = inAllLanes<T>(axis);
    const T z = dot(relative, along);
    const Vector<T> across = relative - z * along;
    const T r = norm(across);
    return {{r, z}, select(r > T(0), (T(1) / r) * across, inAllLanes<T>(radialOnAxis))};
}

AxisymmetricWall::Segment<double> AxisymmetricWall::segmentOf(std::uint32_t part) const {
    const double side = part % 2 == 0 ? 1 : -1;
    const ProfilePoint &a = profile[part / 2], &b = profile[part / 2 + 1];
    return {{side * a.radius, a.height}, {side * b.radius, b.height}};
}

AxisymmetricWall::Segment<Pack> AxisymmetricWall::segmentsOf(
    const std::array<std::uint32_t, Pack::lanes>& parts) const {
    if (std::ranges::all_of(parts, [&](std::uint32_t part) { return part == parts[0]; })) {
        const auto [begin, end] = segmentOf(parts[0]);
        return {{Pack(begin.radius), Pack(begin.height)}, {Pack(end.radius), Pack(end.height)}};
    }
    std::array<std::array<double, Pack::lanes>, 4> numbers;
    for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
        const auto [begin, end] = segmentOf(parts[lane]);
        numbers[0][lane] = begin.radius, numbers[1][lane] = begin.height;
        numbers[2][lane] = end.radius, numbers[3][lane] = end.height;
    }
    const auto column = [&](std::size_t k) { return Pack::fromLanes(numbers[k]); };
    return {{column(0), column(1)}, {column(2), column(3)}};
}

template <Number T>
AxisymmetricWall::NearestPoint<T> AxisymmetricWall::nearestPoint(const Segment<T>& segment,
                                                                 const Meridian<T>& at) const {
    const ProfilePlace<T> shift = nearestOn(segment.begin, segment.end, at.centre) - at.centre;
    const T distance = sqrt(product(shift, shift));
    return {select(distance > T(0),
                   (shift.radius / distance) * at.radial + (shift.height / distance) * inAllLanes<T>(axis),
                   at.radial),
            distance};
}

/// The far side of a segment counts where the near one lies farther out than the centre: seen from inside.
bool AxisymmetricWall::acts(std::uint32_t part, const Meridian<double>& at) const {
    if (part % 2 == 0) return true;
    const Segment<double> nearSide = segmentOf(part - 1);
    return nearestOn(nearSide.begin, nearSide.end, at.centre).radius > at.centre.radius;
}

void AxisymmetricWall::listInBody(const Vector<double>& centre, double reach,
                                  std::vector<std::uint32_t>& parts) const {
    const Meridian<double> at = meridianOf(centre);
    for (std::uint32_t part = 0; part < 2 * (profile.size() - 1); ++part) {
        const Segment<double> segment = segmentOf(part);
        const ProfilePoint shift = nearestOn(segment.begin, segment.end, at.centre) - at.centre;
        if (product(shift, shift) < reach * reach) parts.push_back(part);
    }
}

void AxisymmetricWall::findInBody(const Vector<double>& centre, double reach,
                                  std::span<const std::uint32_t> parts, std::span<WallPoint> points) const {
    const Meridian<double> at = meridianOf(centre);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const auto [normal, distance] = nearestPoint(segmentOf(parts[k]), at);
        points[k] = {normal, acts(parts[k], at) ? distance : infinity, {0, 0, 0}};
    }
    const double tolerance = 1e-7 * reach;
    leaveOutCovered(points, reach, [&](std::uint32_t near, std::uint32_t far) {
        const Vector<double> shift = points[far].distance * points[far].normal;
        return holds(parts[near],
                     {at.centre.radius + dot(shift, at.radial), at.centre.height + dot(shift, axis)},
                     tolerance) ||
               (isSmooth(points[near].normal, points[far].normal) && meetSmoothly(parts[near], parts[far]));
    });
}

void AxisymmetricWall::findEightInBody(const Vector<Pack>& centres,
                                       const std::array<std::uint32_t, Pack::lanes>& parts,
                                       EightWallPoints& points) const {
    const Meridian<Pack> at = meridianOf(centres);
    const auto [normal, distance] = nearestPoint(segmentsOf(parts), at);
    points.normal = normal;
    points.distance = distance;
    unsigned farSides = 0;
    for (std::size_t lane = 0; lane < Pack::lanes; ++lane) farSides |= (parts[lane] & 1) << lane;
    if (farSides == 0) return;
    std::array<std::uint32_t, Pack::lanes> nearSides = parts;
    for (std::uint32_t& part : nearSides) part &= ~1u;
    const Segment<Pack> nearSide = segmentsOf(nearSides);
    const Mask isOutside = nearestOn(nearSide.begin, nearSide.end, at.centre).radius > at.centre.radius;
    points.distance = select(maskFromBits(static_cast<std::uint8_t>(farSides)) & !isOutside, Pack(infinity),
                             points.distance);
}

bool AxisymmetricWall::holds(std::uint32_t part, const ProfilePoint& point, double tolerance) const {
    const Segment<double> a = segmentOf(part);
    return length(nearestOn(a.begin, a.end, point) - point) < tolerance;
}

bool AxisymmetricWall::meetSmoothly(std::uint32_t part1, std::uint32_t part2) const {
    const Segment<double> a = segmentOf(part1), b = segmentOf(part2);
    for (const auto& [a1, a2] : {std::pair{a.begin, a.end}, std::pair{a.end, a.begin}})
        for (const auto& [b1, b2] : {std::pair{b.begin, b.end}, std::pair{b.end, b.begin}})
            if (same(a1, b1) && smoothly(a2 - a1, b2 - b1)) return true;
    return false;
}

bool AxisymmetricWall::isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const {
    // The way is short against all radii that matter: in the plane of (r, z) it is a straight line.
    const Meridian<double> m1 = meridianOf(from), m2 = meridianOf(to);
    const double side = dot(m1.radial, m2.radial) < 0 ? -1 : 1;  // through the axis
    const ProfilePoint begin = m1.centre, end{side * m2.centre.radius, m2.centre.height};
    const auto sideOf = [](const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& p) {
        return (b.radius - a.radius) * (p.height - a.height) - (b.height - a.height) * (p.radius - a.radius);
    };
    for (std::uint32_t part = 0; part < 2 * (profile.size() - 1); ++part) {
        const Segment<double> s = segmentOf(part);
        if ((sideOf(s.begin, s.end, begin) < 0) != (sideOf(s.begin, s.end, end) < 0) &&
            (sideOf(begin, end, s.begin) < 0) != (sideOf(begin, end, s.end) < 0))
            return true;
    }
    return false;
}

void AxisymmetricWall::visitShape(StateArchive& archive) const {
    archive.same("shape", "AxisymmetricWall");
    archive.sameRecord<double>("axis", axis);
    archive.sameRecord<double>("origin", origin);
    archive.same<double>("profile", std::span(profile));
}

SurfaceExtent AxisymmetricWall::extent() const {
    const auto [low, high] =
        std::minmax_element(profile.begin(), profile.end(),
                            [](const ProfilePoint& a, const ProfilePoint& b) { return a.height < b.height; });
    const double middle = 0.5 * (low->height + high->height);
    double radius = 0;
    for (const ProfilePoint& p : profile) radius = std::max(radius, std::hypot(p.radius, p.height - middle));
    return {SurfaceExtent::Symmetry::Axis, origin + middle * axis, radius, axis};
}

/// Along the axis it is alike where its profile is: this is looked at as a strip of the profile's form.
SurfaceAtFaces AxisymmetricWall::atFaces(const PeriodicFaces& faces) const {
    const Vector<double> direction = getPose().turn(axis), place = getPose().place(origin);
    const double cosine = dot(direction, faces.along), sine = norm(cross(direction, faces.along)),
                 middle = dot(place, faces.along);
    double low = infinity, high = -infinity, widest = 0;  // m
    for (const ProfilePoint& p : profile) {
        low = std::min(low, middle + cosine * p.height - sine * p.radius);
        high = std::max(high, middle + cosine * p.height + sine * p.radius);
        widest = std::max(widest, p.radius);
    }
    // A circle that is inclined by this leaves its plane by less than the tolerance.
    if (sine * (widest + faces.length) > faces.tolerance) return intervalAtFaces(low, high, faces);
    const Vector<double> outward = anyAcross(faces.along), across = cross(faces.along, outward);
    std::vector<Polygon> strip;
    for (std::size_t k = 1; k < profile.size(); ++k) {
        const auto at = [&](const ProfilePoint& p, double along) {
            const double height = cosine < 0 ? -p.height : p.height;
            return (middle + height) * faces.along + p.radius * outward + along * across;
        };
        const ProfilePoint &begin = profile[k - 1], &end = profile[k];
        strip.push_back({at(begin, 0), at(end, 0), at(end, faces.length), at(begin, faces.length)});
    }
    PeriodicFaces own = faces;
    own.others.clear();
    SurfaceAtFaces found = polygonsAtFaces(strip, own);
    if (found.place) *found.place += place - middle * faces.along - dot(*found.place, across) * across;
    return found;
}

void FiniteCylinder::set(const Vec3D& direction, const Vec3D& point, double radius, double length) {
    checkValue("FiniteCylinder", "radius", radius, "m", positive);
    checkValue("FiniteCylinder", "length", length, "m", positive);
    AxisymmetricWall::set(direction, point, {{radius, -0.5 * length}, {radius, 0.5 * length}});
}

WallSurface AxisymmetricWall::surfaceInBody(const SceneSphere&) const {
    WallSurface surface;
    for (std::size_t k = 1; k < profile.size(); ++k) {
        const ProfilePoint &begin = profile[k - 1], &end = profile[k];
        const auto facets = turnedAround(axis, anyAcross(axis), origin + begin.height * axis, begin.radius,
                                         origin + end.height * axis, end.radius);
        surface.polygons.insert(surface.polygons.end(), facets.begin(), facets.end());
    }
    return surface;
}

}  // namespace pendular
