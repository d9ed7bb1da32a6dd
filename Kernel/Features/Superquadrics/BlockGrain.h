#pragma once

#include "Kernel/Features/RigidBodies/RoundedBox.h"
#include "Kernel/Features/Superquadrics/ShapedGrain.h"

namespace pendular {

/// A block as a driver describes it, before it is added to a scene: a box with rounded edges and corners.
class BlockGrain : public ShapedGrain {
public:
    /// @param halfLengths m, from the centre to the faces; @param radius m, of the edges, below all of them.
    /// Throws InputError for others.
    BlockGrain(const Vec3D& halfLengths, double radius)
        : ShapedGrain("BlockGrain"),
          boxValue(RoundedBox::fromOuter("BlockGrain", toVector(halfLengths), radius)) {
        setRadiusAround(boxValue.boundingRadius());
    }

    [[nodiscard]] const RoundedBox& getBox() const { return boxValue; }

private:
    RoundedBox boxValue;
};

}  // namespace pendular
