#include "Kernel/Scene/DomainBox.h"

#include <fmt/format.h>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {
namespace {

constexpr const char* namesOfDomainAxes[] = {"x", "y", "z"};

void requireFinite(const char* which, const Vec3D& point) {
    for (int axis = 0; axis < 3; ++axis)
        checkValue("Domain", fmt::format("{} of the {}", namesOfDomainAxes[axis], which), point[axis], "m",
                   anyFinite);
}

void requireOrder(const Vec3D& low, const Vec3D& high) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(low[axis] <= high[axis]))
            throw InputError(
                fmt::format("Domain: along {} the lowest point is {} m and the highest {} m; "
                            "the highest one must not be less.",
                            namesOfDomainAxes[axis], low[axis], high[axis]));
}

Vec3D given(const std::optional<Vec3D>& point, const char* which) {
    if (!point)
        throw InputError(
            fmt::format("Domain: its {} point is not set; call setDomain(lowest, highest).", which));
    return *point;
}

}  // namespace

void DomainBox::setDomain(const Vec3D& low, const Vec3D& high) {
    requireFinite("lowest point", low);
    requireFinite("highest point", high);
    requireOrder(low, high);
    lowest = low, highest = high;
}

void DomainBox::setMin(const Vec3D& low) {
    requireFinite("lowest point", low);
    if (highest) requireOrder(low, *highest);
    lowest = low;
}

void DomainBox::setMax(const Vec3D& high) {
    requireFinite("highest point", high);
    if (lowest) requireOrder(*lowest, high);
    highest = high;
}

Vec3D DomainBox::getMin() const { return given(lowest, "lowest"); }

Vec3D DomainBox::getMax() const { return given(highest, "highest"); }

}  // namespace pendular
