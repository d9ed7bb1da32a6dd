#include "Kernel/Shapes/UnionOfSpheres.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/InputError.h"
#include "Kernel/Math/GaussLegendre.h"

namespace pendular {

namespace {

constexpr double pi = std::numbers::pi;

/// What is integrated over a slice: area, and the moments of x, y, xx, yy, xy; and the length of its rim,
/// each arc divided by the sine of the slope of its sphere: the surface over the height.
enum Part { Area, X, Y, XX, YY, XY, Surface, Parts };
using SliceSums = std::array<double, Parts>;

struct Disc {
    double x, y, radius;  // m
    double sphereRadius;  // m
};

/// Adds the line integrals over the arc of a disc between two angles (rad), counterclockwise.
void addArc(const Disc& d, double from, double to, SliceSums& sums) {
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
    sums[Surface] += d.sphereRadius * angle;                          // r / sin(slope) = R
}

/// The angles (rad) of a disc's rim that another one covers, if any.
struct Cover {
    double from, to;
};

class Slices {
public:
    explicit Slices(std::span<const Ball> spheres) : all(spheres) {}

    /// Of the plane at a height z (m).
    SliceSums at(double z) {
        discs.clear();
        for (const Ball& ball : all) {
            const double height = z - ball.centre.z(), squared = ball.radius * ball.radius - height * height;
            if (squared > 0)
                discs.push_back({ball.centre.x(), ball.centre.y(), std::sqrt(squared), ball.radius});
        }
        SliceSums sums{};
        for (std::size_t k = 0; k < discs.size(); ++k) addFreeArcs(k, sums);
        return sums;
    }

private:
    void addFreeArcs(std::size_t k, SliceSums& sums) {
        if (!findCovers(k)) return;
        std::ranges::sort(covers, {}, &Cover::from);
        double free = 0;  // rad: up to here it is covered or counted
        for (const Cover& cover : covers) {
            if (cover.from > free) addArc(discs[k], free, cover.from, sums);
            free = std::max(free, cover.to);
        }
        if (free < 2 * pi) addArc(discs[k], free, 2 * pi, sums);
    }

    /// False if it is covered as a whole.
    bool findCovers(std::size_t k) {
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
    void addCover(double from, double to) {
        if (from < 0) from += 2 * pi, to += 2 * pi;
        covers.push_back({from, std::min(to, 2 * pi)});
        if (to > 2 * pi) covers.push_back({0, to - 2 * pi});
    }

    std::span<const Ball> all;
    std::vector<Disc> discs;
    std::vector<Cover> covers;
};

/// The integrals over the height of all parts of a slice, of z times the first three, and of z z.
enum Moment { V, Sx, Sy, Sz, Sxx, Syy, Szz, Sxy, Sxz, Syz, A, Moments };
using MomentSums = std::array<double, Moments>;

MomentSums momentsOf(const SliceSums& s, double z) {
    return {s[Area],         s[X],  s[Y],     z * s[Area], s[XX],     s[YY],
            z * z * s[Area], s[XY], z * s[X], z * s[Y],    s[Surface]};
}

class HeightIntegral {
public:
    HeightIntegral(std::span<const Ball> spheres, const MomentSums& permitted)
        : slices(spheres), tolerances(permitted) {}

    void addInterval(double low, double high, double share, int depth = 0) {
        const MomentSums coarse = rule(low, high, 8), fine = rule(low, high, 16);
        bool agrees = true;
        for (int m = 0; m < Moments; ++m) agrees &= std::abs(fine[m] - coarse[m]) <= share * tolerances[m];
        if (!agrees && depth < deepest) {
            const double middle = 0.5 * (low + high);
            addInterval(low, middle, 0.5 * share, depth + 1);
            return addInterval(middle, high, 0.5 * share, depth + 1);
        }
        for (int m = 0; m < Moments; ++m) sums[m] += fine[m], errors[m] += std::abs(fine[m] - coarse[m]);
    }

    MomentSums sums{}, errors{};

private:
    static constexpr int deepest = 30;

    /// Near a pole areas go as the height, and near the end of a circle angles as its root: with z = low +
    /// (high - low) (3 t^2 - 2 t^3) both are smooth in t.
    MomentSums rule(double low, double high, int nodes) {
        MomentSums result{};
        for (const QuadratureNode& node : gaussLegendre(nodes)) {
            const double t = 0.5 * (1 + node.position);
            const double z = low + (high - low) * t * t * (3 - 2 * t);
            const double weight = 0.5 * node.weight * (high - low) * 6 * t * (1 - t);
            const MomentSums at = momentsOf(slices.at(z), z);
            for (int m = 0; m < Moments; ++m) result[m] += weight * at[m];
        }
        return result;
    }

    Slices slices;
    MomentSums tolerances;
};

/// The heights (m) at which slices are not smooth, ascending: poles, and the ends of the circles in which two
/// spheres cut each other.
std::vector<double> heightsOfChange(std::span<const Ball> spheres) {
    std::vector<double> heights;
    constexpr std::size_t mostForCircles = 64;  // of more spheres, the halving of intervals finds them
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

void requireSpheres(std::span<const Ball> spheres) {
    if (spheres.empty()) throw InputError("A shape of spheres needs at least one sphere.");
    for (std::size_t k = 0; k < spheres.size(); ++k)
        if (!spheres[k].centre.allFinite() || !(spheres[k].radius > 0) || !std::isfinite(spheres[k].radius))
            throw InputError(
                fmt::format("sphere {} of a shape: its centre must be finite (m), and its radius "
                            "positive (m); it is {:.6g} m.",
                            k, spheres[k].radius));
}

/// The spheres in the frame in which they are integrated: about their mean, in units of their size, the
/// longest side along z.
struct Frame {
    Eigen::Vector3d origin;
    double size;
    Eigen::Matrix3d turn;  // of axes: a permutation with determinant 1
    std::vector<Ball> spheres;

    explicit Frame(std::span<const Ball> all) {
        Eigen::Vector3d low = all[0].centre, high = low;
        for (const Ball& ball : all) {
            low = low.cwiseMin(ball.centre - Eigen::Vector3d::Constant(ball.radius));
            high = high.cwiseMax(ball.centre + Eigen::Vector3d::Constant(ball.radius));
        }
        origin = 0.5 * (low + high);
        int longest = 0;
        size = (high - low).maxCoeff(&longest);
        turn = Eigen::Matrix3d::Zero();
        for (int axis = 0; axis < 3; ++axis) turn(axis, (longest + 1 + axis) % 3) = 1;
        for (const Ball& ball : all)
            spheres.push_back({turn * (ball.centre - origin) / size, ball.radius / size});
    }
};

HeightIntegral integrate(const Frame& frame, double tolerance, bool withSurface) {
    MomentSums permitted;
    double volume = 0, second = 0, area = 0;  // lower bounds of them: of the largest sphere
    for (const Ball& ball : frame.spheres) {
        const double r = ball.radius;
        volume = std::max(volume, 4.0 / 3 * pi * r * r * r);
        second = std::max(second, 4.0 / 15 * pi * r * r * r * r * r);
        area = std::max(area, 4 * pi * r * r);
    }
    permitted.fill(tolerance * std::min(second, volume));
    permitted[V] = tolerance * volume;
    permitted[A] = withSurface ? tolerance * area : 1e300;
    HeightIntegral integral(frame.spheres, permitted);
    const std::vector<double> heights = heightsOfChange(frame.spheres);
    const double whole = heights.back() - heights.front();
    for (std::size_t k = 1; k < heights.size(); ++k)
        if (const double width = heights[k] - heights[k - 1]; width > 1e-15 * whole)
            integral.addInterval(heights[k - 1], heights[k], width / whole);
    return integral;
}

}  // namespace

MassProperties unionOfSpheres(std::span<const Ball> spheres, double tolerance) {
    requireSpheres(spheres);
    const Frame frame(spheres);
    const HeightIntegral integral = integrate(frame, tolerance, false);
    const MomentSums& m = integral.sums;
    Eigen::Matrix3d second;
    second << m[Sxx], m[Sxy], m[Sxz], m[Sxy], m[Syy], m[Syz], m[Sxz], m[Syz], m[Szz];
    MassProperties result = MassProperties::fromMoments(m[V], {m[Sx], m[Sy], m[Sz]}, second);
    const double smallest = result.inertia.diagonal().minCoeff();
    double moved = 0;
    for (int k = Sx; k <= Syz; ++k) moved = std::max(moved, integral.errors[k]);
    // Each moment of inertia has two second moments and the square of the first ones over the volume.
    result.error = std::max(integral.errors[V] / m[V], 4 * moved / smallest) + 1e-14;
    const double s = frame.size;
    result.volume *= s * s * s;
    result.centre = frame.origin + s * (frame.turn.transpose() * result.centre);
    result.inertia = s * s * s * s * s * (frame.turn.transpose() * result.inertia * frame.turn);
    return result;
}

double surfaceOfUnion(std::span<const Ball> spheres, double tolerance) {
    requireSpheres(spheres);
    const Frame frame(spheres);
    return frame.size * frame.size * integrate(frame, tolerance, true).sums[A];
}

}  // namespace pendular
