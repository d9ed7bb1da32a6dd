#include "Kernel/Analysis/CoarseGraining/FieldGrid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

/// Throws InputError for too many points.
void requireFew(const std::string& asked, double points) {
    constexpr double most = 0x1p28;
    if (!(points <= most))
        throw InputError(fmt::format("FieldGrid: {} makes {:.3g} points or more; there must be {:g} at most.",
                                     asked, points, most));
}

}  // namespace

FieldGrid::FieldGrid(std::string_view coordinates, const Vector<double>& lowest,
                     const Vector<double>& highest) {
    constexpr std::array<std::string_view, 10> names{"O", "X", "Y", "Z", "XY", "XZ", "YZ", "XYZ", "R", "RZ"};
    if (std::find(names.begin(), names.end(), coordinates) == names.end())
        throw InputError(fmt::format("There are no coordinates \"{}\"; they may be {}.", coordinates,
                                     fmt::join(names, ", ")));
    from = {lowest.x, lowest.y, lowest.z};
    to = {highest.x, highest.y, highest.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        checkValue("FieldGrid", fmt::format("lowest {}", "xyz"[axis]), from[axis], "m", anyFinite);
        checkValue("FieldGrid", fmt::format("highest {}", "xyz"[axis]), to[axis], "m",
                   {from[axis], infinity, false, false});
    }
    cylindrical = coordinates[0] == 'R';
    if (cylindrical) {
        middle = {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]), 0};
        to[0] = 0.5 * std::min(to[0] - from[0], to[1] - from[1]);
        from[0] = from[1] = 0;
        to[1] = 2 * std::numbers::pi;
        resolved = {true, false, coordinates == "RZ"};
    } else {
        for (std::size_t axis = 0; axis < 3; ++axis)
            resolved[axis] = coordinates.find("XYZ"[axis]) != coordinates.npos;
    }
}

FieldGrid::FieldGrid(std::string_view coordinates, const Vector<double>& lowest,
                     const Vector<double>& highest, double spacing)
    : FieldGrid(coordinates, lowest, highest) {
    checkValue("FieldGrid", "spacing", spacing, "m", positive);
    double all = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!resolved[axis]) continue;
        // A length that is a multiple up to round-off is one.
        const double cells = std::max(1.0, std::ceil((to[axis] - from[axis]) / spacing * (1 - 1e-12)));
        all *= cells;
        requireFew(fmt::format("a spacing of {:g} m", spacing), all);
        number[axis] = static_cast<std::size_t>(cells);
    }
}

FieldGrid::FieldGrid(std::string_view coordinates, const Vector<double>& lowest,
                     const Vector<double>& highest, const std::array<std::size_t, 3>& points)
    : FieldGrid(coordinates, lowest, highest) {
    double all = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!resolved[axis]) continue;
        all *= static_cast<double>(points[axis]);
        if (points[axis] == 0)
            throw InputError(fmt::format("FieldGrid: there are 0 points along {}; there must be 1 at least.",
                                         nameOf(axis)));
        requireFew(fmt::format("{} points along {}", points[axis], nameOf(axis)), all);
        number[axis] = points[axis];
    }
}

double FieldGrid::measure(std::size_t kx) const {
    if (cylindrical) return 2 * std::numbers::pi * at(0, kx) * (resolved[2] ? 1 : to[2] - from[2]);
    double lengths = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!resolved[axis]) lengths *= to[axis] - from[axis];
    return lengths;
}

double FieldGrid::volume() const {
    if (cylindrical) return std::numbers::pi * to[0] * to[0] * (to[2] - from[2]);
    return (to[0] - from[0]) * (to[1] - from[1]) * (to[2] - from[2]);
}

std::string_view FieldGrid::nameOf(std::size_t axis) const {
    constexpr std::array<std::string_view, 3> cartesian{"x", "y", "z"}, round{"r", "theta", "z"};
    return (cylindrical ? round : cartesian)[axis];
}

}  // namespace pendular
