#include "Kernel/Features/RigidBodies/SphereSlices.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pendular {

namespace {

using std::numbers::pi;

}  // namespace

/// Adds the line integrals over the arc of a disc between two angles (rad), counterclockwise.
void SphereSlices::addArc(const Disc& d, double from, double to, Sums& all) {
    auto& sums = all.values;
    const double r = d.radius, x = d.x, y = d.y;
    const double c1 = std::cos(from), s1 = std::sin(from), c2 = std::cos(to), s2 = std::sin(to);
    // Integrals of powers of cosine (c) and sine (s) over the arc.
    const double angle = to - from;
    const double c = s2 - s1, s = c1 - c2;
    const double cc = 0.5 * (angle + s2 * c2 - s1 * c1), ss = angle - cc, sc = 0.5 * (s2 * s2 - s1 * s1);
    const double ccc = c - (s2 * s2 * s2 - s1 * s1 * s1) / 3, sss = s - (c1 * c1 * c1 - c2 * c2 * c2) / 3;
    const double scc = (c1 * c1 * c1 - c2 * c2 * c2) / 3;
    const double c4 = 0.75 * cc + 0.25 * (c2 * c2 * c2 * s2 - c1 * c1 * c1 * s1);
    const double s4 = 0.75 * ss - 0.25 * (s2 * s2 * s2 * c2 - s1 * s1 * s1 * c1);
    const double sccc = 0.25 * (c1 * c1 * c1 * c1 - c2 * c2 * c2 * c2);
    sums[Area] += r * (x * c + r * cc);                               // x dy
    sums[X] += 0.5 * r * (x * x * c + 2 * x * r * cc + r * r * ccc);  // x^2 dy / 2
    sums[Y] += 0.5 * r * (y * y * s + 2 * y * r * ss + r * r * sss);  // -y^2 dx / 2
    sums[XX] += r / 3 * (x * x * x * c + 3 * x * x * r * cc + 3 * x * r * r * ccc + r * r * r * c4);
    sums[YY] += r / 3 * (y * y * y * s + 3 * y * y * r * ss + 3 * y * r * r * sss + r * r * r * s4);
    sums[XY] += 0.5 * r *
                (y * (x * x * c + 2 * x * r * cc + r * r * ccc) +
                 r * (x * x * sc + 2 * x * r * scc + r * r * sccc));  // x^2 y dy / 2
    // The terms above are this large, though they may cancel.
    const double reach = std::abs(x) + std::abs(y) + r, first = r * reach;
    auto& sizes = all.sizes;
    sizes[Area] += first;
    for (const Part part : {X, Y}) sizes[part] += first * reach;
    for (const Part part : {XX, YY, XY}) sizes[part] += first * reach * reach;
}

void SphereSlices::cut(double z) {
    discs.clear();
    for (const Ball& ball : all) {
        const double height = z - ball.centre.z(), squared = ball.radius * ball.radius - height * height;
        if (squared > 0) discs.push_back({ball.centre.x(), ball.centre.y(), std::sqrt(squared)});
    }
}

SphereSlices::Sums SphereSlices::at(double z) {
    cut(z);
    Sums sums{};
    for (std::size_t k = 0; k < discs.size(); ++k)
        forFreeArcs(k, [&](double from, double to) { addArc(discs[k], from, to, sums); });
    return sums;
}

double SphereSlices::freeAngleOfFirst(double z) {
    const double height = z - all[0].centre.z();
    if (!(all[0].radius * all[0].radius - height * height > 0)) return 0;
    cut(z);
    double free = 0;
    forFreeArcs(0, [&](double from, double to) { free += to - from; });
    return free;
}

template <class Use>
void SphereSlices::forFreeArcs(std::size_t k, Use&& use) {
    if (!findCovers(k)) return;
    std::ranges::sort(covers, {}, &Cover::from);
    double free = 0;  // rad: up to here it is covered or counted
    for (const Cover& cover : covers) {
        if (cover.from > free) use(free, cover.from);
        free = std::max(free, cover.to);
    }
    if (free < 2 * pi) use(free, 2 * pi);
}

/// False if the disc is covered as a whole.
bool SphereSlices::findCovers(std::size_t k) {
    covers.clear();
    const Disc& own = discs[k];
    for (std::size_t other = 0; other < discs.size(); ++other) {
        if (other == k) continue;
        const Disc& d = discs[other];
        const double dx = d.x - own.x, dy = d.y - own.y, distance = std::hypot(dx, dy);
        if (distance >= own.radius + d.radius) continue;
        const bool isSame = distance == 0 && d.radius == own.radius;
        if (isSame ? other < k : distance + own.radius <= d.radius) return false;
        if (isSame || distance + d.radius <= own.radius) continue;
        const double cosine = (distance * distance + own.radius * own.radius - d.radius * d.radius) /
                              (2 * distance * own.radius);
        const double half = std::acos(std::clamp(cosine, -1.0, 1.0)), middle = std::atan2(dy, dx);
        addCover(middle - half, middle + half);
    }
    return true;
}

/// Within 0 to 2 pi.
void SphereSlices::addCover(double from, double to) {
    if (from < 0) from += 2 * pi, to += 2 * pi;
    covers.push_back({from, std::min(to, 2 * pi)});
    if (to > 2 * pi) covers.push_back({0, to - 2 * pi});
}

std::vector<double> heightsOfChange(std::span<const Ball> spheres) {
    std::vector<double> heights;
    constexpr std::size_t mostForCircles = 64;
    for (const Ball& a : spheres)
        for (const double sign : {-1.0, 1.0}) heights.push_back(a.centre.z() + sign * a.radius);
    for (std::size_t i = 0; spheres.size() <= mostForCircles && i < spheres.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const Eigen::Vector3d apart = spheres[k].centre - spheres[i].centre;
            const double d = apart.norm(), r = spheres[i].radius, s = spheres[k].radius;
            if (d >= r + s || d <= std::abs(r - s)) continue;
            const double along = (d * d + r * r - s * s) / (2 * d);
            const double radius = std::sqrt(std::max(r * r - along * along, 0.0));
            const double middle = spheres[i].centre.z() + along * apart.z() / d;
            const double rise = radius * std::hypot(apart.x(), apart.y()) / d;
            heights.push_back(middle - rise);
            heights.push_back(middle + rise);
        }
    std::ranges::sort(heights);
    return heights;
}

}  // namespace pendular
