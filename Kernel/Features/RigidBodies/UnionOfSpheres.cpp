#include "Kernel/Features/RigidBodies/UnionOfSpheres.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Features/RigidBodies/SphereGroups.h"
#include "Kernel/Features/RigidBodies/SphereSlices.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

using std::numbers::pi;

/// The integrals over the height of all parts of a slice, of z times the first three, and of z z.
enum Moment { V, Sx, Sy, Sz, Sxx, Syy, Szz, Sxy, Sxz, Syz, Moments };
using MomentSums = std::array<double, Moments>;
using HeightIntegral = HalvedIntervals<Moments>;

MomentSums momentsOf(const std::array<double, SphereSlices::Parts>& s, double z) {
    using S = SphereSlices;
    return {s[S::Area],         s[S::X],  s[S::Y],     z * s[S::Area], s[S::XX], s[S::YY],
            z * z * s[S::Area], s[S::XY], z * s[S::X], z * s[S::Y]};
}

/// More than shapes take: a slanted chain of 100 takes 85 for each sphere, 100 spheres that overlap each
/// other in one heap 39 (to 1e-10).
std::size_t mostHalvings(std::size_t spheres) { return 500 * (spheres + 4); }

void requireSpheres(std::span<const Ball> spheres) {
    if (spheres.empty()) throw InputError("A shape of spheres needs at least one sphere.");
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        const std::string owner = fmt::format("sphere {} of a shape", k);
        const Eigen::Vector3d& centre = spheres[k].centre;
        if (!centre.allFinite())
            throw InputError(fmt::format("{}: its centre = ({:.6g}, {:.6g}, {:.6g}) m must be finite.", owner,
                                         centre.x(), centre.y(), centre.z()));
        checkValue(owner, "radius", spheres[k].radius, "m", positive);
    }
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

/// Calls use(low, high, share) for the intervals between the heights at which slices change, each with its
/// share of the whole.
template <class Use>
void forIntervals(const std::vector<double>& heights, double low, double high, Use&& use) {
    double before = low;
    const auto to = [&](double height) {
        if (const double width = height - before; width > 1e-15 * (high - low))
            use(before, height, width / (high - low));
        before = height;
    };
    for (const double height : heights)
        if (height > low && height < high) to(height);
    to(high);
}

HeightIntegral integrate(const Frame& frame, double tolerance) {
    MomentSums permitted;
    double volume = 0, second = 0;  // lower bounds of them: of the largest sphere
    for (const Ball& ball : frame.spheres) {
        const double r = ball.radius;
        volume = std::max(volume, 4.0 / 3 * pi * r * r * r);
        second = std::max(second, 4.0 / 15 * pi * r * r * r * r * r);
    }
    permitted.fill(tolerance * std::min(second, volume));
    permitted[V] = tolerance * volume;
    HeightIntegral integral(permitted, mostHalvings(frame.spheres.size()));
    SphereSlices slices(frame.spheres);
    const std::vector<double> heights = heightsOfChange(frame.spheres);
    forIntervals(heights, heights.front(), heights.back(), [&](double low, double high, double share) {
        integral.add(low, high, share, [&](double z) {
            const SphereSlices::Sums slice = slices.at(z);
            return ValuesAtHeight<Moments>{momentsOf(slice.values, z), momentsOf(slice.sizes, std::abs(z))};
        });
    });
    return integral;
}

/// The solid of spheres that hang together. The error is that of the volume (m^3).
struct Part {
    MassProperties solid;
    Eigen::Vector3d inertiaError = Eigen::Vector3d::Zero();  // m^5, of each moment
};
Part partOf(std::span<const Ball> spheres, double tolerance) {
    if (spheres.size() == 1) {
        const double r = spheres[0].radius, volume = 4.0 / 3 * pi * r * r * r;
        return {{volume, spheres[0].centre, 0.4 * volume * r * r * Eigen::Matrix3d::Identity()}};
    }
    const Frame frame(spheres);
    const HeightIntegral integral = integrate(frame, tolerance);
    const MomentSums& m = integral.sums;
    Eigen::Matrix3d second;
    second << m[Sxx], m[Sxy], m[Sxz], m[Sxy], m[Syy], m[Syz], m[Sxz], m[Syz], m[Szz];
    MassProperties found = MassProperties::fromMoments(m[V], {m[Sx], m[Sy], m[Sz]}, second);
    double moved = 0;
    for (int k = Sx; k <= Syz; ++k) moved = std::max(moved, integral.errors[k]);
    const double s = frame.size, fifth = s * s * s * s * s;
    found.error = s * s * s * integral.errors[V];
    found.volume *= s * s * s;
    found.centre = frame.origin + s * (frame.turn.transpose() * found.centre);
    found.inertia = fifth * (frame.turn.transpose() * found.inertia * frame.turn);
    // Each moment of inertia has two second moments and the square of the first ones over the volume.
    return {found, Eigen::Vector3d::Constant(4 * moved * fifth)};
}

/// The sum of bodies that have no point in common.
Part sumOf(std::span<const Part> parts) {
    Part sum{};
    for (const Part& part : parts) {
        sum.solid.volume += part.solid.volume;
        sum.solid.centre += part.solid.volume * part.solid.centre;
    }
    sum.solid.centre /= sum.solid.volume;
    for (const Part& part : parts) {
        const Eigen::Vector3d arm = part.solid.centre - sum.solid.centre;
        const Eigen::Matrix3d ofArm = arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
        sum.solid.inertia += part.solid.inertia + part.solid.volume * ofArm;
        sum.solid.error += part.solid.error;
        sum.inertiaError += part.inertiaError + 2 * part.solid.error * ofArm.diagonal();
    }
    return sum;
}

/// The spheres that hang together, group by group. Those that only touch do, as they may overlap by
/// round-off.
std::vector<std::vector<Ball>> groupsOf(std::span<const Ball> spheres) {
    std::vector<std::vector<Ball>> groups;
    for (const std::vector<std::size_t>& numbers : groupsOfSpheres(spheres, 1e-9)) {
        std::vector<Ball>& group = groups.emplace_back();
        for (const std::size_t k : numbers) group.push_back(spheres[k]);
    }
    return groups;
}

/// The spheres that cut the first one's surface, behind it; none if that is in another one as a whole.
std::vector<Ball> withNeighbours(std::span<const Ball> spheres, std::size_t own) {
    std::vector<Ball> found{spheres[own]};
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        if (k == own) continue;
        const double d = (spheres[k].centre - spheres[own].centre).norm(), r = spheres[own].radius,
                     s = spheres[k].radius;
        // The two lie within each other to round-off: the first one counts.
        const bool isSame = d + r <= s && d + s <= r;
        if (isSame ? k < own : d + r <= s) return {};
        if (!isSame && d < r + s && d + s > r) found.push_back(spheres[k]);
    }
    return found;
}

/// The cap of a sphere that another one covers: the direction of its middle, its half angle (rad).
struct SphereCap {
    Eigen::Vector3d middle;
    double half, height;  // rad; over the radius
};
std::vector<SphereCap> capsOn(const Ball& sphere, std::span<const Ball> others) {
    std::vector<SphereCap> caps;
    for (const Ball& other : others) {
        const Eigen::Vector3d apart = other.centre - sphere.centre;
        const double d = apart.norm(), r = sphere.radius, s = other.radius;
        const double cosine = std::clamp((d * d + r * r - s * s) / (2 * d * r), -1.0, 1.0);
        caps.push_back({apart / d, std::acos(cosine), 1 - cosine});
    }
    return caps;
}

double between(const SphereCap& a, const SphereCap& b) {
    return std::acos(std::clamp(a.middle.dot(b.middle), -1.0, 1.0));
}

/// Removes those that are within another one, as those of next neighbours in a chain.
void removeHidden(std::vector<SphereCap>& caps) {
    std::ranges::sort(caps, std::ranges::greater{}, &SphereCap::half);
    std::vector<SphereCap> left;
    for (const SphereCap& cap : caps)
        if (std::ranges::none_of(left, [&](const SphereCap& larger) {
                return between(cap, larger) + cap.half <= larger.half;
            }))
            left.push_back(cap);
    caps.swap(left);
}

/// The share of a sphere's surface that is free of caps, if no two of them have a point in common.
bool freeOfSeparateCaps(std::vector<SphereCap> caps, double& share) {
    removeHidden(caps);
    share = 1;
    for (std::size_t k = 0; k < caps.size(); ++k) {
        share -= 0.5 * caps[k].height;
        for (std::size_t other = 0; other < k; ++other) {
            if (between(caps[k], caps[other]) < caps[k].half + caps[other].half) return false;
        }
    }
    return true;
}

/// The free share of the first sphere's surface, by heights along an axis of the sphere (Archimedes): that of
/// the rim of each disc.
double freeShareByHeights(const std::vector<Ball>& spheres, double tolerance) {
    const Ball& own = spheres[0];
    std::vector<Ball> inFrame;
    for (const Ball& ball : spheres)
        inFrame.push_back({(ball.centre - own.centre) / own.radius, ball.radius / own.radius});
    SphereSlices slices(inFrame);
    HalvedIntervals<1> integral({tolerance}, mostHalvings(spheres.size()));
    forIntervals(heightsOfChange(inFrame), -1, 1, [&](double low, double high, double share) {
        integral.add(low, high, share, [&](double z) {
            return ValuesAtHeight<1>{{slices.freeAngleOfFirst(z) / (4 * pi)}, {1}};
        });
    });
    return integral.sums[0];
}

}  // namespace

MassProperties unionOfSpheres(std::span<const Ball> spheres, double tolerance) {
    requireSpheres(spheres);
    std::vector<Part> parts;
    for (const std::vector<Ball>& group : groupsOf(spheres)) parts.push_back(partOf(group, tolerance));
    Part whole = parts.size() == 1 ? parts[0] : sumOf(parts);
    MassProperties& result = whole.solid;
    const double ofInertia = whole.inertiaError.cwiseQuotient(result.inertia.diagonal()).maxCoeff();
    result.error = std::max(result.error / result.volume, ofInertia) + 1e-14;
    return result;
}

double surfaceOfUnion(std::span<const Ball> spheres, double tolerance) {
    const std::vector<double> shares = exposedShares(spheres, tolerance);
    double area = 0;
    for (std::size_t k = 0; k < spheres.size(); ++k)
        area += shares[k] * 4 * pi * spheres[k].radius * spheres[k].radius;
    return area;
}

std::vector<double> exposedShares(std::span<const Ball> spheres, double tolerance) {
    requireSpheres(spheres);
    std::vector<double> shares;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        const std::vector<Ball> near = withNeighbours(spheres, k);
        double share = 0;
        if (!near.empty() && !freeOfSeparateCaps(capsOn(near[0], std::span(near).subspan(1)), share))
            share = freeShareByHeights(near, tolerance);
        shares.push_back(std::clamp(share, 0.0, 1.0));
    }
    return shares;
}

}  // namespace pendular
