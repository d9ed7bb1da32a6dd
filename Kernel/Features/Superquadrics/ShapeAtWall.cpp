#include "Kernel/Features/Superquadrics/ShapeAtWall.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pendular {

namespace {

WallPoint nearest(const Wall& wall, std::uint32_t part, const Vector<double>& point) {
    WallPoint found{};
    wall.findPoints(point, infinity, {&part, 1}, {&found, 1});
    return found;
}

/// The vector (x, y) of M (x, y) = (a, b).
struct FlatVector {
    double u, v;
};
FlatVector solve(double uu, double uv, double vu, double vv, const FlatVector& right) {
    const double scale = 1 / (uu * vv - uv * vu);
    return {scale * (vv * right.u - uv * right.v), scale * (uu * right.v - vu * right.u)};
}

}  // namespace

ShapeAtWall::Look ShapeAtWall::lookAlong(const Wall& wall, std::uint32_t part,
                                         const Vector<double>& ownNormal) const {
    const Vector<double> normal = axes.turn(ownNormal);
    Look look{.normal = normal,
              .support = supportPoint(shape, ownNormal),
              .point{},
              .towards{},
              .distance = 0,
              .velocity{}};
    look.point = coreAt(look.support, normal);
    const WallPoint seen = nearest(wall, part, look.point);
    look.towards = seen.normal;
    look.distance = seen.distance;
    look.velocity = seen.velocity;
    // The core is beyond a face: the grain overlaps by more than the ball.
    if (dot(seen.normal, normal) < 0 && wall.isCrossed(centre, look.point)) {
        look.towards = -seen.normal;
        look.distance = -seen.distance;
    }
    return look;
}

/// Gilbert's method: x is a point in the core, and goes towards the core's farthest point along the way to
/// the wall as long as it comes nearer.
Vector<double> ShapeAtWall::nearNormal(const Wall& wall, std::uint32_t part, const WallPoint& first,
                                       double range, double& gap) const {
    constexpr int mostRounds = 30, mostHalvings = 8;
    const bool isConvex = wall.hasConvexParts();
    Vector<double> x = centre, n = first.normal;
    double distance = first.distance;
    gap = 0;
    for (int round = 0; round < mostRounds; ++round) {
        const Vector<double> farthest = coreAt(supportAt(n), n), way = farthest - x;
        const double gain = dot(n, way);
        // The part is beyond a plane across n, at this distance from x at least.
        if (isConvex && distance - gain > ballRadius + range) {
            gap = distance - gain - ballRadius;
            return n;
        }
        if (gain < 1e-3 * ballRadius) return n;
        WallPoint there = nearest(wall, part, farthest);
        if (dot(there.normal, way) >= 0 || wall.isCrossed(x, farthest))
            return dot(there.normal, n) > 0 ? there.normal : n;
        // The distance falls at first along the way, and rises at its end.
        double low = 0, high = 1;
        for (int k = 0; k < mostHalvings; ++k) {
            const double middle = 0.5 * (low + high);
            there = nearest(wall, part, x + middle * way);
            (dot(there.normal, way) > 0 ? low : high) = middle;
        }
        if (low == 0) return n;
        x += low * way;
        there = nearest(wall, part, x);
        n = there.normal, distance = there.distance;
    }
    return n;
}

/// The step (m) along the grain's surface at which Newton's method expects the normal. With the radii of
/// curvature A of the grain, that of the ball r, and the change -H e of the direction to the wall by a shift
/// e of the core, the shift w = (A - r) t of a turn t of the normal is that of t + H w = g, where g is how
/// the direction to the wall differs from the normal.
Vector<double> ShapeAtWall::newtonShift(const Wall& wall, std::uint32_t part, const Look& now) const {
    const TangentPlane<double> plane(now.normal);
    const double flattest = 1e-6 / (shape.a + shape.b + shape.c);
    const Curvature<double> k = curvature(now.support, axes.turnBack(plane.u), axes.turnBack(plane.v)) +
                                Curvature<double>{flattest, flattest, 0};
    // (A - r)^-1 = (1 - r K)^-1 K
    const Curvature<double> a = k.inverse();
    const Curvature<double> s = Curvature<double>{a.uu - ballRadius, a.vv - ballRadius, a.uv}.inverse();
    const FlatVector g{dot(now.towards, plane.u), dot(now.towards, plane.v)};
    const double shift = 1e-5 * ballRadius;
    const auto turnBy = [&](const Vector<double>& axis) -> FlatVector {  // -H axis
        const Vector<double> change =
            (1 / shift) * (nearest(wall, part, now.point + shift * axis).normal - now.towards);
        return {dot(change, plane.u), dot(change, plane.v)};
    };
    const bool isBeyond = now.distance < 0;
    const FlatVector byU = isBeyond ? FlatVector{0, 0} : turnBy(plane.u),
                     byV = isBeyond ? FlatVector{0, 0} : turnBy(plane.v);
    const double uu = s.uu - byU.u, uv = s.uv - byV.u, vu = s.uv - byU.v, vv = s.vv - byV.v;
    FlatVector w = solve(uu, uv, vu, vv, g);
    // A step that does not lead down goes the way of a wall that is flat.
    const double decrease = w.u * g.u + w.v * g.v;
    if (!(uu * vv - uv * vu > 0) || !(decrease > 0)) w = solve(s.uu, s.uv, s.uv, s.vv, g);
    const FlatVector t{s.uu * w.u + s.uv * w.v, s.uv * w.u + s.vv * w.v};
    return (w.u + ballRadius * t.u) * plane.u + (w.v + ballRadius * t.v) * plane.v;
}

ShapeAtWall::Look ShapeAtWall::newton(const Wall& wall, std::uint32_t part,
                                      const Vector<double>& start) const {
    constexpr int mostSteps = 60, mostHalvings = 40;
    const double size = shape.a + shape.b + shape.c, roundOff = 1e-16 * (size + norm(centre));
    Look now = lookAlong(wall, part, axes.turnBack(start));
    for (int step = 0; step < mostSteps; ++step) {
        if (!(now.distance < infinity)) return now;
        Vector<double> shift = newtonShift(wall, part, now);
        const double length = norm(shift);
        if (!(length > 1e-14 * size)) return now;
        if (length > 0.5 * size) shift = (0.5 * size / length) * shift;
        bool isBetter = false;
        for (int k = 0; k < mostHalvings && !isBetter; ++k, shift = 0.5 * shift) {
            const Look there =
                lookAlong(wall, part, outwardNormal(shape, now.support.point + axes.turnBack(shift)));
            if (!(there.distance <= now.distance + roundOff)) continue;
            isBetter = true;
            // On a flat face the normal hardly turns, where the core is a point it does not move.
            const double changed = norm(there.normal - now.normal) + norm(there.point - now.point) / size,
                         gained = now.distance - there.distance;
            now = there;
            if (changed < 1e-15 || (gained <= roundOff && k > 2)) return now;
        }
        if (!isBetter) return now;
    }
    return now;
}

/// Where Newton's method has not ended: the best of eight directions about the normal, at steps that are
/// halved where none is better.
ShapeAtWall::Look ShapeAtWall::searchAround(const Wall& wall, std::uint32_t part, Look best) const {
    constexpr int mostRounds = 100;
    double step = 0.1;  // rad
    for (int round = 0; round < mostRounds && step > 1e-9; ++round) {
        const TangentPlane<double> plane(best.normal);
        const Vector<double> middle = best.normal;
        bool isBetter = false;
        for (const auto& [u, v] : superquadric::eightDirections) {
            const Vector<double> tried = middle + (step * u) * plane.u + (step * v) * plane.v;
            const Look there = lookAlong(wall, part, axes.turnBack((1 / norm(tried)) * tried));
            if (!(there.distance < best.distance)) continue;
            best = there;
            isBetter = true;
        }
        if (!isBetter) step *= 0.5;
    }
    return best;
}

ShapeAtWall::Look ShapeAtWall::settle(const Wall& wall, std::uint32_t part, double range,
                                      const Vector<double>& start) const {
    const Look found = newton(wall, part, start);
    const bool isFound = !(found.distance > 0) || !(found.distance < 2 * ballRadius + range) ||
                         dot(found.normal, found.towards) > 1 - 1e-12;
    return isFound ? found : searchAround(wall, part, found);
}

/// Whether a look is what was sought: not where an edge or a corner is in the core. Beyond a face, which is
/// told by that its direction is the same from beside, it still is.
bool ShapeAtWall::isSettled(const Wall& wall, std::uint32_t part, const Look& found) const {
    if (found.distance > 0) return dot(found.normal, found.towards) > 0.99;
    const TangentPlane<double> plane(found.normal);
    const auto isAlike = [&](const Vector<double>& axis) {
        const Vector<double> there = nearest(wall, part, found.point + 0.1 * ballRadius * axis).normal;
        return dot(there, found.towards) < -1 + 1e-12;
    };
    return dot(found.normal, found.towards) > 1 - 1e-12 && isAlike(plane.u) && isAlike(plane.v);
}

WallPoint ShapeAtWall::pointOf(const Wall& wall, std::uint32_t part, double range) const {
    WallPoint point = nearest(wall, part, centre);
    if (!(point.distance < infinity)) return point;
    double gap = 0;
    const Vector<double> start = nearNormal(wall, part, point, range, gap);
    if (gap > 0) {
        point.normal = start;
        point.distance = supportAt(start).height + gap;
        return point;
    }
    Look found = settle(wall, part, range, start);
    if (!wall.hasConvexParts())  // the wall may be as near elsewhere: from each end of the grain
        for (const Vector<double>& end : {axes.x, -axes.x, axes.y, -axes.y, axes.z, -axes.z}) {
            const Look other = settle(wall, part, range, end);
            if (other.distance < found.distance) found = other;
        }
    if (!isSettled(wall, part, found)) return point;  // it is left by the way to its nearest point
    point.normal = found.normal;
    point.distance = found.support.height - ballRadius + found.distance;
    // Velocities are told of the point below the centre.
    const Vector<double> touched = found.point + found.distance * found.towards;
    point.velocity =
        found.velocity + cross(wall.angularVelocity(), centre + point.distance * point.normal - touched);
    return point;
}

/// A part is left out where the ball that touches it finds that another part, of a contact at least as deep,
/// stands for it, as a sphere does; or sees the same point of both: that of an edge or a corner that they
/// share, or of surfaces that lie on each other. The balls of two facets at the edge between them are the
/// same but for round-off, so that each may see its own facet as the one that stands for the other.
void ShapeAtWall::leaveOutCovered(const Wall& wall, double range, std::span<const std::uint32_t> parts,
                                  std::span<WallPoint> points) const {
    thread_local std::vector<std::uint32_t> order;
    thread_local std::vector<double> depth;
    thread_local std::vector<WallPoint> seen;
    order.clear();
    depth.assign(points.size(), -1);
    for (std::uint32_t k = 0; k < points.size(); ++k) {
        if (!(points[k].distance < infinity)) continue;
        depth[k] = supportAt(points[k].normal).height - points[k].distance;
        if (depth[k] > -range) order.push_back(k);
    }
    if (order.size() < 2) return;
    std::sort(order.begin(), order.end(), [](std::uint32_t a, std::uint32_t b) {
        return depth[a] > depth[b] || (depth[a] == depth[b] && a < b);
    });
    seen.resize(parts.size());
    for (std::size_t rank = 1; rank < order.size(); ++rank) {
        const std::uint32_t own = order[rank];
        WallPoint& point = points[own];
        const Vector<double> ball = coreAt(supportAt(point.normal), point.normal);
        wall.findPoints(ball, ballRadius + range, parts, seen);
        const WallPoint here = nearest(wall, parts[own], ball);
        const auto standsForIt = [&](std::uint32_t ahead) {
            if (static_cast<std::uint32_t>(seen[own].coveredBy) == ahead) return true;
            const WallPoint there = nearest(wall, parts[ahead], ball);
            return norm(here.distance * here.normal - there.distance * there.normal) < 1e-9 * ballRadius;
        };
        const std::span<const std::uint32_t> deeper(order.data(), rank);
        const auto by = std::ranges::find_if(deeper, standsForIt);
        if (by == deeper.end()) continue;
        point.coveredBy = points[*by].coveredBy >= 0 ? points[*by].coveredBy : static_cast<int>(*by);
        point.distance = infinity;
    }
}

void ShapeAtWall::findPoints(const Wall& wall, double range, std::span<const std::uint32_t> parts,
                             std::span<WallPoint> points) const {
    for (std::size_t k = 0; k < parts.size(); ++k) points[k] = pointOf(wall, parts[k], range);
    if (parts.size() > 1) leaveOutCovered(wall, range, parts, points);
}

}  // namespace pendular
