#pragma once

#include <fmt/format.h>

#include <optional>

#include "Kernel/InputError.h"
#include "Kernel/Particles/SphericalParticle.h"
#include "Kernel/Species/Field.h"

namespace pendular {

/// A box that a driver gives to its scene (m): outputs name it as the domain, and the driver places its walls
/// by it. It holds nothing back by itself, and periods are set by setPeriodic().
class DomainBox {
public:
    /// Throw InputError for what is not finite, and where the lowest point is not below the highest one.
    void setDomain(const Vec3D& low, const Vec3D& high) {
        requireFinite("lowest point", low);
        requireFinite("highest point", high);
        requireOrder(low, high);
        lowest = low, highest = high;
    }
    void setMin(const Vec3D& low) {
        requireFinite("lowest point", low);
        if (highest) requireOrder(low, *highest);
        lowest = low;
    }
    void setMax(const Vec3D& high) {
        requireFinite("highest point", high);
        if (lowest) requireOrder(*lowest, high);
        highest = high;
    }

    [[nodiscard]] bool hasDomain() const { return lowest && highest; }
    /// Throw InputError where it has not been set.
    [[nodiscard]] Vec3D getMin() const { return given(lowest, "lowest"); }
    [[nodiscard]] Vec3D getMax() const { return given(highest, "highest"); }
    [[nodiscard]] double getXMin() const { return getMin().x(); }
    [[nodiscard]] double getYMin() const { return getMin().y(); }
    [[nodiscard]] double getZMin() const { return getMin().z(); }
    [[nodiscard]] double getXMax() const { return getMax().x(); }
    [[nodiscard]] double getYMax() const { return getMax().y(); }
    [[nodiscard]] double getZMax() const { return getMax().z(); }

private:
    static constexpr const char* axes[] = {"x", "y", "z"};

    static void requireFinite(const char* which, const Vec3D& point) {
        for (int axis = 0; axis < 3; ++axis)
            checkValue("Domain", fmt::format("{} of the {}", axes[axis], which), point[axis], "m", anyFinite);
    }
    static void requireOrder(const Vec3D& low, const Vec3D& high) {
        for (int axis = 0; axis < 3; ++axis)
            if (!(low[axis] < high[axis]))
                throw InputError(
                    fmt::format("Domain: along {} the lowest point is {} m and the highest {} m; "
                                "the highest one must be greater.",
                                axes[axis], low[axis], high[axis]));
    }
    static Vec3D given(const std::optional<Vec3D>& point, const char* which) {
        if (!point)
            throw InputError(
                fmt::format("Domain: its {} point is not set; call setDomain(lowest, highest).", which));
        return *point;
    }

    std::optional<Vec3D> lowest, highest;  // m
};

}  // namespace pendular
