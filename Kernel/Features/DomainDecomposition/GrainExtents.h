#pragma once

#include <array>
#include <span>
#include <vector>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// The boxes around the grains of a rank, one for each factor of two of the radius: a few large grains ask
/// for far neighbours, and all small ones for near ones only. Positions are those inside a periodic scene.
class GrainExtents {
public:
    /// @param largest m, radius of all ranks: the sizes are counted from there
    void add(const Vector<double>& position, double radius, double largest);
    /// Whether a sphere comes as near as the reach (m) to a sphere that was added and is anywhere in its box.
    [[nodiscard]] bool areNear(const Vector<double>& position, double radius, double reach) const;
    [[nodiscard]] bool areEmpty() const;

private:
    struct Extent {
        Vector<double> lowest{infinity, infinity, infinity}, highest{-infinity, -infinity, -infinity};
        double largest = 0;  // m, radius; 0: there are none
    };
    std::array<Extent, 12> ofSizes;
    std::size_t used = 0;  // so many of these, from the largest on: mostly one or two
};

/// By how much (m) images of a grain that is inside a periodic scene lie beside it; itself first.
[[nodiscard]] std::vector<Vector<double>> imageOffsets(const PeriodicBox& box);

}  // namespace pendular
