#pragma once

#include <cstdint>

#include "Kernel/Math/Vector.h"

namespace pendular {

class ParticleStore;
class WallHandler;
struct Superquadric;

/// How two grains that are no spheres touch, or a grain and a plane.
struct ShapedTouch {
    Vector<double> normal;  // unit, from body 1 to body 2
    double depth;           // m; negative: a gap
    Vector<double> arm1;    // m, from the centre of body 1 to the middle of the overlap
};

/// The grains of a scene that are no spheres: what is asked of them besides the forces of their contacts. The
/// radius of such a grain in the store is that of the sphere around it.
class GrainShapes {
public:
    virtual ~GrainShapes() = default;

    /// How the grains at two places of the store touch.
    /// @param shift m, centre 2 - centre 1
    [[nodiscard]] virtual ShapedTouch touch(const ParticleStore& grains, std::uint32_t first,
                                            std::uint32_t second, const Vector<double>& shift) const = 0;
    /// @param normal unit, into the plane; @param distance m, of the centre
    [[nodiscard]] virtual ShapedTouch touchAtPlane(const ParticleStore& grains, std::uint32_t grain,
                                                   const Vector<double>& normal, double distance) const = 0;
    /// The shape of a grain; its axes in space are those of the grain's body (Axes(orientation)).
    [[nodiscard]] virtual const Superquadric& shapeAt(const ParticleStore& grains,
                                                      std::uint32_t place) const = 0;
    /// m, the smallest half length of a grain.
    [[nodiscard]] virtual double thickness(const ParticleStore& grains, std::uint32_t grain) const = 0;
    /// Throws InputError for what the scene has besides and shapes do not know.
    virtual void check(const WallHandler& walls) const = 0;
};

}  // namespace pendular
