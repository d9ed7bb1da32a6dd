#include "Kernel/Features/Insertion/Region.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Features/Insertion/WallGap.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

namespace {

constexpr std::array<char, 3> axisNames{'x', 'y', 'z'};

/// Even in a range that is shorter by the margin on both sides.
double between(double low, double high, double even, double margin) {
    return low + margin + even * std::max(high - low - 2 * margin, 0.0);
}

constexpr std::string_view boxName = "BoxRegion", cylinderName = "CylinderRegion",
                           sphereName = "SphereRegion";

}  // namespace

Vector<double> Region::candidate(const std::array<double, 3>& even, double margin) const {
    const Box box = bounds();
    Vector<double> made{};
    for (std::size_t k = 0; k < 3; ++k)
        made.*vectorAxes[k] = between(box.lowest.*vectorAxes[k], box.highest.*vectorAxes[k], even[k], margin);
    return made;
}

std::array<bool, 3> Region::goesRound(std::string_view owner, const Box& bounds,
                                      const PeriodicBox& periodic) {
    // Lengths are differences of positions, which are rounded.
    constexpr double roundOff = 1e-12;
    std::array<bool, 3> round{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double length = bounds.highest.*vectorAxes[k] - bounds.lowest.*vectorAxes[k],
                     period = periodic.length.*vectorAxes[k];
        if (period == 0) continue;
        if (length > period * (1 + roundOff))
            throw InputError(fmt::format(
                "{}: its length along {} = {:.6g} m is longer than the period of the scene, {:.6g} m.", owner,
                axisNames[k], length, period));
        round[k] = length >= period * (1 - roundOff);
    }
    return round;
}

Vector<double> candidateOf(const Region& region, const CountedRandom& random, std::uint64_t identity,
                           std::uint32_t purpose, std::uint32_t attempt, double margin) {
    return region.candidate(
        {random.uniform(identity, purpose, attempt), random.uniform(identity, purpose + 1, attempt),
         random.uniform(identity, purpose + 2, attempt)},
        margin);
}

Vector<double> Region::point(const CountedRandom& random, std::uint64_t identity, std::uint32_t purpose,
                             double margin) const {
    constexpr std::uint32_t most = 1'000'000;
    for (std::uint32_t attempt = 0; attempt < most; ++attempt) {
        const Vector<double> found = candidateOf(*this, random, identity, purpose, attempt, margin);
        if (contains(found, margin)) return found;
    }
    throw InputError(fmt::format(
        "Region: none of {} random points is the centre of a sphere of radius {:.6g} m that is in it.", most,
        margin));
}

BoxRegion::BoxRegion(const Vec3D& lowest, const Vec3D& highest) {
    box.lowest = checkedVector(boxName, "lowest", lowest, "m");
    box.highest = checkedVector(boxName, "highest", highest, "m");
    for (std::size_t k = 0; k < 3; ++k)
        checkValue(boxName, fmt::format("length along {}", axisNames[k]),
                   box.highest.*vectorAxes[k] - box.lowest.*vectorAxes[k], "m", positive);
}

bool BoxRegion::contains(const Vector<double>& point, double margin) const {
    for (std::size_t k = 0; k < 3; ++k) {
        if (open[k]) continue;
        const double x = point.*vectorAxes[k], needed = withRoundOff(margin);
        if (!(x - box.lowest.*vectorAxes[k] >= needed && box.highest.*vectorAxes[k] - x >= needed))
            return false;
    }
    return true;
}

double BoxRegion::volume() const {
    const Vector<double> side = box.highest - box.lowest;
    return side.x * side.y * side.z;
}

double BoxRegion::areaAcross(const Vector<double>& direction) const {
    const Vector<double> side = box.highest - box.lowest;
    return std::abs(direction.x) * side.y * side.z + std::abs(direction.y) * side.z * side.x +
           std::abs(direction.z) * side.x * side.y;
}

double BoxRegion::largestSphere() const {
    double least = infinity;
    for (std::size_t k = 0; k < 3; ++k)
        if (!open[k]) least = std::min(least, 0.5 * (box.highest.*vectorAxes[k] - box.lowest.*vectorAxes[k]));
    return least;
}

Vector<double> BoxRegion::inwards(const Vector<double>& centre, double radius) const {
    Vector<double> sum{0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        if (open[k]) continue;
        sum.*vectorAxes[k] += std::max(radius - (centre.*vectorAxes[k] - box.lowest.*vectorAxes[k]), 0.0) -
                              std::max(radius - (box.highest.*vectorAxes[k] - centre.*vectorAxes[k]), 0.0);
    }
    return sum;
}

Vector<double> BoxRegion::candidate(const std::array<double, 3>& even, double margin) const {
    Vector<double> made{};
    for (std::size_t k = 0; k < 3; ++k)
        made.*vectorAxes[k] =
            between(box.lowest.*vectorAxes[k], box.highest.*vectorAxes[k], even[k], open[k] ? 0 : margin);
    return made;
}

std::shared_ptr<const Region> BoxRegion::in(const PeriodicBox& periodic) const {
    auto made = std::make_shared<BoxRegion>(*this);
    made->open = goesRound(boxName, box, periodic);
    return made;
}

void BoxRegion::visitState(StateArchive& archive) const {
    archive.same("shape", boxName);
    archive.sameRecord<double>("lowest", box.lowest);
    archive.sameRecord<double>("highest", box.highest);
}

CylinderRegion::CylinderRegion(const Vec3D& from, const Vec3D& to, double given)
    : begin(checkedVector(cylinderName, "from", from, "m")),
      axis(checkedVector(cylinderName, "to", to, "m") - begin),
      radius(given) {
    length = norm(axis);
    checkValue(cylinderName, "length", length, "m", positive);
    checkValue(cylinderName, "radius", radius, "m", positive);
    axis = (1 / length) * axis;
}

bool CylinderRegion::contains(const Vector<double>& point, double margin) const {
    const Vector<double> from = point - begin;
    const double height = dot(from, axis), across = norm(from - height * axis);
    const double needed = withRoundOff(margin);
    return radius - across >= needed && (open || (height >= needed && length - height >= needed));
}

double CylinderRegion::volume() const { return std::numbers::pi * radius * radius * length; }

Box CylinderRegion::bounds() const {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = begin.*vectorAxes[k], high = low + length * axis.*vectorAxes[k];
        // The rim of an end reaches so far along an axis.
        const double rim = radius * std::sqrt(std::max(0.0, 1 - axis.*vectorAxes[k] * axis.*vectorAxes[k]));
        box.lowest.*vectorAxes[k] = std::min(low, high) - rim;
        box.highest.*vectorAxes[k] = std::max(low, high) + rim;
    }
    return box;
}

double CylinderRegion::areaAcross(const Vector<double>& direction) const {
    const double cosine = std::abs(dot(direction, axis));
    return std::numbers::pi * radius * radius * cosine +
           2 * radius * length * std::sqrt(std::max(0.0, 1 - cosine * cosine));
}

double CylinderRegion::largestSphere() const { return open ? radius : std::min(radius, 0.5 * length); }

Vector<double> CylinderRegion::inwards(const Vector<double>& centre, double sphere) const {
    const Vector<double> from = centre - begin;
    const double height = dot(from, axis);
    const Vector<double> radial = from - height * axis;
    const double across = norm(radial), outside = sphere - (radius - across);
    Vector<double> sum{0, 0, 0};
    if (outside > 0 && across > 0) sum -= (outside / across) * radial;
    if (!open) sum += (std::max(sphere - height, 0.0) - std::max(sphere - (length - height), 0.0)) * axis;
    return sum;
}

Vector<double> CylinderRegion::candidate(const std::array<double, 3>& even, double margin) const {
    const Vector<double> a = anyAcross(axis), b = cross(axis, a);
    const double across = std::max(radius - margin, 0.0) * std::sqrt(even[0]);
    const double angle = 2 * std::numbers::pi * even[1];
    return begin + between(0, length, even[2], open ? 0 : margin) * axis +
           across * (std::cos(angle) * a + std::sin(angle) * b);
}

std::shared_ptr<const Region> CylinderRegion::in(const PeriodicBox& periodic) const {
    auto made = std::make_shared<CylinderRegion>(*this);
    const std::array<bool, 3> round = goesRound(cylinderName, bounds(), periodic);
    for (std::size_t k = 0; k < 3; ++k) made->open |= round[k] && std::abs(axis.*vectorAxes[k]) == 1;
    return made;
}

std::array<bool, 3> CylinderRegion::openAxes() const {
    return {open && std::abs(axis.x) == 1, open && std::abs(axis.y) == 1, open && std::abs(axis.z) == 1};
}

void CylinderRegion::visitState(StateArchive& archive) const {
    archive.same("shape", cylinderName);
    archive.sameRecord<double>("from", begin);
    archive.sameRecord<double>("axis", axis);
    archive.same("length", length, "m");
    archive.same("radius", radius, "m");
}

SphereRegion::SphereRegion(const Vec3D& centre, double given)
    : middle(checkedVector(sphereName, "centre", centre, "m")), radius(given) {
    checkValue(sphereName, "radius", radius, "m", positive);
}

bool SphereRegion::contains(const Vector<double>& point, double margin) const {
    return radius - norm(point - middle) >= withRoundOff(margin);
}

double SphereRegion::volume() const { return sphereMass(radius, 1); }

Box SphereRegion::bounds() const {
    const Vector<double> half{radius, radius, radius};
    return {middle - half, middle + half};
}

double SphereRegion::areaAcross(const Vector<double>&) const { return std::numbers::pi * radius * radius; }

Vector<double> SphereRegion::inwards(const Vector<double>& centre, double sphere) const {
    const Vector<double> from = centre - middle;
    const double distance = norm(from), outside = sphere - (radius - distance);
    return outside > 0 && distance > 0 ? -(outside / distance) * from : Vector<double>{0, 0, 0};
}

Vector<double> SphereRegion::candidate(const std::array<double, 3>& even, double margin) const {
    const double distance = std::max(radius - margin, 0.0) * std::cbrt(even[0]);
    const double cosine = 2 * even[1] - 1, sine = std::sqrt((1 - cosine) * (1 + cosine));
    const double azimuth = 2 * std::numbers::pi * even[2];
    return middle + distance * Vector<double>{sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

std::shared_ptr<const Region> SphereRegion::in(const PeriodicBox& periodic) const {
    static_cast<void>(goesRound(sphereName, bounds(), periodic));
    return std::make_shared<SphereRegion>(*this);
}

void SphereRegion::visitState(StateArchive& archive) const {
    archive.same("shape", sphereName);
    archive.sameRecord<double>("centre", middle);
    archive.same("radius", radius, "m");
}

BetweenWalls::BetweenWalls(const WallHandler& of, const Vec3D& lowest, const Vec3D& highest)
    : box(std::make_shared<BoxRegion>(lowest, highest)), walls(&of), size(measured()) {
    if (!(size > 0))
        throw InputError(
            "BetweenWalls: the walls leave nothing of the box; their normals point out of the "
            "space of the grains.");
}

double BetweenWalls::measured() const {
    // Points of the additive recurrence of Roberts (2018), which cover a box more evenly than random ones:
    // steps of 1/g, 1/g^2, 1/g^3 with g^4 = g + 1.
    constexpr double g = 1.2207440846057596;
    constexpr std::size_t points = 1 << 16;
    std::size_t free = 0;
    std::array<double, 3> even{0.5, 0.5, 0.5};
    for (std::size_t k = 0; k < points; ++k) {
        for (std::size_t a = 0; a < 3; ++a) {
            even[a] += std::pow(g, -static_cast<double>(a + 1));
            even[a] -= std::floor(even[a]);
        }
        free += contains(box->candidate(even, 0), 0);
    }
    return box->volume() * static_cast<double>(free) / static_cast<double>(points);
}

bool BetweenWalls::contains(const Vector<double>& point, double margin) const {
    return box->contains(point, margin) && !touchesWall(*walls, periodic, point, withRoundOff(margin));
}

/// No larger than that of the box.
double BetweenWalls::areaAcross(const Vector<double>& direction) const { return box->areaAcross(direction); }
double BetweenWalls::largestSphere() const { return box->largestSphere(); }

Vector<double> BetweenWalls::inwards(const Vector<double>& centre, double radius) const {
    Vector<double> sum = box->inwards(centre, radius);
    forEachWallNear(*walls, periodic, centre, radius, [&](const WallPoint& point, std::size_t) {
        sum -= (radius - point.distance) * point.normal;
    });
    return sum;
}

Vector<double> BetweenWalls::candidate(const std::array<double, 3>& even, double margin) const {
    return box->candidate(even, margin);
}

std::shared_ptr<const Region> BetweenWalls::in(const PeriodicBox& scene) const {
    auto made = std::make_shared<BetweenWalls>(*this);
    made->box = box->in(scene);
    made->periodic = scene;
    const Box bounds = box->bounds();
    for (const auto axis : vectorAxes) {
        const double low = scene.lowest.*axis, length = scene.length.*axis;
        if (length == 0 || (bounds.lowest.*axis >= low && bounds.highest.*axis <= low + length)) continue;
        made->size = made->measured();
        break;
    }
    return made;
}

void BetweenWalls::visitState(StateArchive& archive) const {
    archive.same("shape", "BetweenWalls");
    archive.group("box", [&] { box->visitState(archive); });
}

}  // namespace pendular
