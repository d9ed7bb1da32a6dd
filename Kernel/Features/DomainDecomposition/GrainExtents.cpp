#include "Kernel/Features/DomainDecomposition/GrainExtents.h"

#include <algorithm>
#include <cmath>

namespace pendular {

void GrainExtents::add(const Vector<double>& position, double radius, double largest) {
    const std::size_t size =
        std::min(static_cast<std::size_t>(std::log2(largest / radius)), ofSizes.size() - 1);
    used = std::max(used, size + 1);
    Extent& extent = ofSizes[size];
    const auto each = [](const auto& choose, const Vector<double>& a, const Vector<double>& b) {
        return Vector<double>{choose(a.x, b.x), choose(a.y, b.y), choose(a.z, b.z)};
    };
    extent.lowest = each([](double a, double b) { return std::min(a, b); }, extent.lowest, position);
    extent.highest = each([](double a, double b) { return std::max(a, b); }, extent.highest, position);
    extent.largest = std::max(extent.largest, radius);
}

/// Round-off of positions and offsets must not lose a grain: a little farther is asked for.
bool GrainExtents::areNear(const Vector<double>& position, double radius, double reach) const {
    const auto beyond = [](double x, double low, double high) { return std::max({low - x, x - high, 0.0}); };
    return std::any_of(ofSizes.begin(), ofSizes.begin() + used, [&](const Extent& extent) {
        if (extent.largest == 0) return false;
        const double far = (radius + extent.largest + reach) * (1 + 1e-9);
        return squaredNorm(Vector<double>{beyond(position.x, extent.lowest.x, extent.highest.x),
                                          beyond(position.y, extent.lowest.y, extent.highest.y),
                                          beyond(position.z, extent.lowest.z, extent.highest.z)}) < far * far;
    });
}

bool GrainExtents::areEmpty() const { return used == 0; }

/// m, to that image along the gradient of a shear which has slid least: the images beside it are asked for,
/// too.
static Vector<double> leastSlid(const PeriodicBox& box) {
    const Vector<double> nearest = box.nearestAlongAxes(box.imageShift);
    return {box.across.x > 0 ? box.length.x : nearest.x, box.across.y > 0 ? box.length.y : nearest.y,
            box.across.z > 0 ? box.length.z : nearest.z};
}

std::vector<Vector<double>> imageOffsets(const PeriodicBox& box) {
    std::vector<Vector<double>> offsets{{0, 0, 0}};
    const auto addAlong = [&](const Vector<double>& shift) {
        if (squaredNorm(shift) == 0) return;
        const std::size_t before = offsets.size();
        for (const double image : {-1.0, 1.0})
            for (std::size_t k = 0; k < before; ++k) offsets.push_back(offsets[k] + image * shift);
    };
    addAlong(box.across.x > 0 ? leastSlid(box) : Vector<double>{box.length.x, 0, 0});
    addAlong(box.across.y > 0 ? leastSlid(box) : Vector<double>{0, box.length.y, 0});
    addAlong(box.across.z > 0 ? leastSlid(box) : Vector<double>{0, 0, box.length.z});
    return offsets;
}

}  // namespace pendular
