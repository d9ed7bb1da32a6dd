#pragma once

#include <filesystem>
#include <vector>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Features/Meshes/TriangleReader.h"

namespace pendular {

/// The triangles of a mesh that a MercuryDPM driver reads: a file NAME.vtk in VTK's old text form, with
/// POINTS and CELLS, or POLYGONS, of three and more corners; or whatever readTriangles() reads. Throws
/// InputError.
/// @param scale m for one unit of the file; @param shift m, of all of it
std::vector<Triangle> readMercuryMesh(const std::filesystem::path& file, double scale,
                                      const Vec3D& shift = Vec3D::Zero());

}  // namespace pendular
