#include "Kernel/Features/Insertion/SphereGrid.h"

#include <algorithm>
#include <cmath>

namespace pendular {

namespace {

struct Images {
    double first, last;  // numbers of periods
};
/// The cell of a coordinate; what is too far for a number of a cell shares the last one.
std::int64_t cellOf(double x, double inverseSize) {
    return static_cast<std::int64_t>(std::clamp(std::floor(x * inverseSize), -9e18, 9e18));
}

/// The images of a coordinate that spheres within a reach (m) of the box can meet.
Images imagesOf(double x, double lowest, double length, double reach) {
    if (length == 0) return {0, 0};
    return {x + reach > lowest + length ? -1.0 : 0.0, x - reach < lowest ? 1.0 : 0.0};
}

}  // namespace

SphereGrid::SphereGrid(const ParticleStore& grains, const PeriodicBox& box, const Box& within, double radius)
    : SphereGrid(box) {
    const Vector<double> middle = within.middle(), half = 0.5 * (within.highest - within.lowest);
    for (const TranslationRecord& grain : grains.translation) {
        if (grain.radius == 0) continue;  // a gap
        const Vector<double> from = periodic.nearest(grain.position - middle);
        const double reach = grain.radius + radius;
        // Of images that have slid or moved apart, another one may be near a corner of the box.
        if (box.imagesMove || (std::abs(from.x) < half.x + reach && std::abs(from.y) < half.y + reach &&
                               std::abs(from.z) < half.z + reach))
            add(grain.position, grain.radius);
    }
}

int SphereGrid::levelOf(double radius) { return std::ilogb(radius); }
double SphereGrid::cellSize(int level) { return std::ldexp(1.0, level + 2); }

std::size_t SphereGrid::entry(int level, std::int64_t x, std::int64_t y, std::int64_t z) const {
    auto mixed = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u ^
                 static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu ^
                 static_cast<std::uint64_t>(z) * 0x165667B19E3779F9u ^ static_cast<std::uint64_t>(level);
    mixed ^= mixed >> 29;
    mixed *= 0xBF58476D1CE4E5B9u;
    return (mixed ^ mixed >> 32) & (heads.size() - 1);
}

void SphereGrid::link(std::uint32_t number) {
    Sphere& sphere = spheres[number];
    const double inverse = 1 / cellSize(sphere.level);
    const auto cell = [&](double x) { return cellOf(x, inverse); };
    std::uint32_t& head =
        heads[entry(sphere.level, cell(sphere.centre.x), cell(sphere.centre.y), cell(sphere.centre.z))];
    sphere.next = head;
    head = number;
}

void SphereGrid::add(const Vector<double>& centre, double radius) {
    const int level = levelOf(radius);
    if (std::ranges::find(levels, level) == levels.end()) levels.push_back(level);
    spheres.push_back({periodic.wrap(centre), radius, level, none});
    if (spheres.size() <= heads.size()) return link(static_cast<std::uint32_t>(spheres.size() - 1));
    heads.assign(2 * heads.size(), none);
    for (std::uint32_t k = 0; k < spheres.size(); ++k) link(k);
}

bool SphereGrid::overlaps(const Sphere& sphere, const Vector<double>& centre, double radius) const {
    const double touch = sphere.radius + radius;
    return squaredNorm(periodic.nearest(sphere.centre - centre)) < touch * touch;
}

bool SphereGrid::isFreeOfLevel(int level, const Vector<double>& image, double radius) const {
    const double size = cellSize(level), inverse = 1 / size, reach = radius + 0.5 * size;
    const auto cell = [&](double x) { return cellOf(x, inverse); };
    const std::int64_t x1 = cell(image.x + reach), y1 = cell(image.y + reach), z1 = cell(image.z + reach);
    for (std::int64_t z = cell(image.z - reach); z <= z1; ++z)
        for (std::int64_t y = cell(image.y - reach); y <= y1; ++y)
            for (std::int64_t x = cell(image.x - reach); x <= x1; ++x)
                for (std::uint32_t k = heads[entry(level, x, y, z)]; k != none; k = spheres[k].next)
                    if (overlaps(spheres[k], image, radius)) return false;
    return true;
}

bool SphereGrid::isFreeAtImages(int level, const Vector<double>& at, double radius) const {
    const double reach = radius + 0.5 * cellSize(level);
    // Along the gradient of a shear, images have their places from isFree().
    const auto along = [&](double place, double lowest, double length, double across) {
        return imagesOf(place, lowest, across > 0 ? 0 : length, reach);
    };
    const PeriodicBox& box = periodic;
    const Images x = along(at.x, box.lowest.x, box.length.x, box.across.x),
                 y = along(at.y, box.lowest.y, box.length.y, box.across.y),
                 z = along(at.z, box.lowest.z, box.length.z, box.across.z);
    for (double c = z.first; c <= z.last; ++c)
        for (double b = y.first; b <= y.last; ++b)
            for (double a = x.first; a <= x.last; ++a)
                if (!isFreeOfLevel(level,
                                   at + Vector<double>{a * box.length.x, b * box.length.y, c * box.length.z},
                                   radius))
                    return false;
    return true;
}

bool SphereGrid::isFree(const Vector<double>& centre, double radius) const {
    const Vector<double> at = periodic.wrap(centre);
    for (const int level : levels) {
        const double reach = radius + 0.5 * cellSize(level);
        if (std::pow(2 * reach / cellSize(level) + 1, 3) > static_cast<double>(spheres.size())) {
            // A large sphere among small ones: more cells than spheres.
            if (std::ranges::any_of(spheres, [&](const Sphere& s) { return overlaps(s, at, radius); }))
                return false;
            continue;
        }
        if (!isFreeAtImages(level, at, radius)) return false;
        if (!periodic.isSheared()) continue;
        const double place = dot(periodic.across, at - periodic.lowest),
                     share = reach * norm(periodic.across);
        for (const double image : {-1.0, 1.0})
            if (place - image + share >= 0 && place - image - share <= 1 &&
                !isFreeAtImages(level, periodic.wrapAlongAxes(at - image * periodic.imageShift), radius))
                return false;
    }
    return true;
}

}  // namespace pendular
