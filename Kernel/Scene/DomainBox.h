#pragma once

#include <optional>

#include "Kernel/Core/Particles/SphericalParticle.h"

namespace pendular {

/// A box that a driver gives to its scene (m): outputs name it as the domain, and the driver places its walls
/// by it. It holds nothing back by itself, and periods are set by setPeriodic().
class DomainBox {
public:
    /// Throw InputError for what is not finite, and where the lowest point is above the highest one; a box
    /// may be flat.
    void setDomain(const Vec3D& low, const Vec3D& high);
    void setMin(const Vec3D& low);
    void setMax(const Vec3D& high);

    [[nodiscard]] bool hasDomain() const { return lowest && highest; }
    /// Throw InputError where it has not been set.
    [[nodiscard]] Vec3D getMin() const;
    [[nodiscard]] Vec3D getMax() const;
    [[nodiscard]] double getXMin() const { return getMin().x(); }
    [[nodiscard]] double getYMin() const { return getMin().y(); }
    [[nodiscard]] double getZMin() const { return getMin().z(); }
    [[nodiscard]] double getXMax() const { return getMax().x(); }
    [[nodiscard]] double getYMax() const { return getMax().y(); }
    [[nodiscard]] double getZMax() const { return getMax().z(); }

private:
    std::optional<Vec3D> lowest, highest;  // m
};

}  // namespace pendular
