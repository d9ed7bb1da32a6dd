#include "Kernel/Features/Superquadrics/RoundedBoxTouch.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pendular {

BoxTouch touchOfSpheres(double radius1, double radius2, const Vector<double>& shift) {
    const double sum = radius1 + radius2, squared = squaredNorm(shift);
    if (!(squared < sum * sum) || !(squared > 0)) return {};
    const double distance = std::sqrt(squared), depth = sum - distance;
    const Vector<double> normal = (1 / distance) * shift;
    return {normal, depth, (radius1 - 0.5 * depth) * normal, radius1 * radius2 / sum};
}

BoxTouch touchOfBox(const RoundedBox& box, const Axes<double>& axes, double largestRadius, double sphere,
                    const Vector<double>& shift) {
    const Vector<double> at = axes.turnBack(shift), &half = box.half;
    Vector<double> nearest{std::clamp(at.x, -half.x, half.x), std::clamp(at.y, -half.y, half.y),
                           std::clamp(at.z, -half.z, half.z)};
    const double sum = sphere + box.radius, squared = squaredNorm(at - nearest);
    if (!(squared < sum * sum)) return {};
    Vector<double> normal = at - nearest;
    double distance = std::sqrt(squared);
    if (distance > 1e-12 * sum) {
        normal = (1 / distance) * normal;
    } else {
        normal = {0, 0, 0};
        auto through = &Vector<double>::x;
        for (const auto axis : {&Vector<double>::y, &Vector<double>::z})
            if (half.*axis - std::abs(at.*axis) < half.*through - std::abs(at.*through)) through = axis;
        normal.*through = at.*through < 0 ? -1 : 1;
        nearest.*through = normal.*through * (half.*through);
        distance = std::abs(at.*through) - half.*through;
    }
    const double depth = sum - distance;
    return {axes.turn(normal), depth, axes.turn(nearest + (box.radius - 0.5 * depth) * normal),
            std::min(sphere, largestRadius)};
}

BoxEdge::BoxEdge(const RoundedBox& box, const Axes<double>& axes, std::size_t edge)
    : along(RoundedBox::axisOf(edge) == 0   ? axes.x
            : RoundedBox::axisOf(edge) == 1 ? axes.y
                                            : axes.z),
      inward(-axes.turn(RoundedBox::facesAt(edge))),
      half(box.halfLength(edge)),
      radius(box.radius) {}

BoxEdge::Point BoxEdge::at(double way) const {
    constexpr double share = 0.1;  // of the radius, by which an end is behind
    const double length = std::min(2 * radius, 0.5 * half), deep = share * radius;
    const double beyond = (std::abs(way) - (half - length)) / length;
    if (beyond <= 0) return {way * along, along, {0, 0, 0}};
    const double slope = std::copysign(2 * deep * beyond / length, way);
    return {way * along + (deep * beyond * beyond) * inward, along + slope * inward,
            (2 * deep / (length * length)) * inward};
}

namespace {

/// The ways (m) along two edges at which they are nearest to each other.
struct Ways {
    double first, second;
};

/// Of straight edges without ends. @param squaredSine of the angle between them
Ways waysOfLines(const BoxEdge& first, const BoxEdge& second, const Vector<double>& shift,
                 double squaredSine) {
    const double cosine = dot(first.along, second.along);
    const double u = dot(shift, first.along), v = dot(shift, second.along);
    return {(u - cosine * v) / squaredSine, (cosine * u - v) / squaredSine};
}

}  // namespace

BoxTouch touchOfEdges(const BoxEdge& first, const BoxEdge& second, const Vector<double>& shift) {
    constexpr double smallestSine = 0.02;
    const Vector<double> across = cross(first.along, second.along);
    const double squaredSine = squaredNorm(across), sum = first.radius + second.radius;
    if (squaredSine < smallestSine * smallestSine) return {};
    const double apart = dot(across, shift);
    if (!(apart * apart < squaredSine * sum * sum)) return {};
    const Vector<double> facing = apart < 0 ? -across : across;
    if (dot(facing, first.inward) >= 0 || dot(facing, second.inward) <= 0) return {};
    // Newton's method for the least distance, from that of straight edges.
    Ways at = waysOfLines(first, second, shift, squaredSine);
    if (std::abs(at.first) > first.half + sum || std::abs(at.second) > second.half + sum) return {};
    constexpr int mostSteps = 20;
    Vector<double> way{0, 0, 0};
    for (int step = 0; step < mostSteps; ++step) {
        at.first = std::clamp(at.first, -first.half, first.half);
        at.second = std::clamp(at.second, -second.half, second.half);
        const BoxEdge::Point one = first.at(at.first), two = second.at(at.second);
        way = shift + two.place - one.place;
        const double u = -dot(way, one.slope), v = dot(way, two.slope);
        const double uu = squaredNorm(one.slope) - dot(way, one.bend),
                     vv = squaredNorm(two.slope) + dot(way, two.bend), uv = -dot(one.slope, two.slope);
        const double scale = 1 / (uu * vv - uv * uv);
        const double moved = -scale * (vv * u - uv * v), movedToo = -scale * (uu * v - uv * u);
        at = {at.first + moved, at.second + movedToo};
        if (std::abs(moved) + std::abs(movedToo) < 1e-12 * (first.half + second.half)) break;
    }
    if (!(std::abs(at.first) < first.half) || !(std::abs(at.second) < second.half)) return {};
    const Vector<double> from = first.at(at.first).place;
    way = shift + second.at(at.second).place - from;
    const double distance = norm(way), depth = sum - distance;
    if (!(depth > 0) || !(distance > 1e-12 * sum)) return {};
    const Vector<double> normal = (1 / distance) * way;
    return {normal, depth, from + (first.radius - 0.5 * depth) * normal,
            std::sqrt(first.radius * second.radius)};
}

double overlapOfCuboids(const RoundedBox& first, const Axes<double>& firstAxes, const RoundedBox& second,
                        const Axes<double>& secondAxes, const Vector<double>& shift) {
    const std::array ofFirst{firstAxes.x, firstAxes.y, firstAxes.z},
        ofSecond{secondAxes.x, secondAxes.y, secondAxes.z};
    const auto reach = [](const RoundedBox& box, const auto& axes, const Vector<double>& along) {
        return box.half.x * std::abs(dot(axes[0], along)) + box.half.y * std::abs(dot(axes[1], along)) +
               box.half.z * std::abs(dot(axes[2], along));
    };
    double least = infinity;
    const auto look = [&](const Vector<double>& along) {
        const double length = norm(along);
        if (length < 1e-6) return;  // of parallel edges
        least = std::min(least, (reach(first, ofFirst, along) + reach(second, ofSecond, along) -
                                 std::abs(dot(shift, along))) /
                                    length);
    };
    for (const Vector<double>& a : ofFirst) {
        look(a);
        for (const Vector<double>& b : ofSecond) look(cross(a, b));
    }
    for (const Vector<double>& b : ofSecond) look(b);
    return std::max(least, 0.0);
}

}  // namespace pendular
