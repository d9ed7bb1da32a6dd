#pragma once

#include <span>
#include <vector>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Features/Meshes/TriangleReader.h"

namespace pendular {

/// A plane that bounds a solid.
struct SolidFace {
    Vec3D normal;  // into the solid, away from the grains, as that of an InfiniteWall; of any length
    Vec3D point;   // m, on the plane
};

/// The surface of the solid that lies behind all of these planes, as the triangles of a mesh: plane faces,
/// straight edges and corners. Grains may be outside of the solid (a wedge, a block, a blade) or inside of it
/// (a box, a trough). Faces without end are cut off beyond a sphere around the grains, at squares, so that
/// the surface may be open there.
/// @param centre m, and @param radius m, of a sphere around all places where grains come
/// Throws InputError where a plane is none, or where no part of the surface is in the sphere.
std::vector<Triangle> intersectionOfHalfSpaces(std::span<const SolidFace> faces, const Vec3D& centre,
                                               double radius);

}  // namespace pendular
