#pragma once

#include "Kernel/Contacts/GrainShapes.h"
#include "Kernel/Output/PolyData.h"

namespace pendular {

/// Adds fields of grains that are no spheres, in the order of identities: half_lengths_m, the exponents n1
/// and n2, and orientation, the matrix (row by row) that turns the axes of the shape into space.
void addShapeFields(const ParticleStore& grains, const GrainShapes& shapes, PolyData& points);

/// The surfaces of grains that are no spheres as polygons, in the order of identities, with the identity and
/// the body of each polygon's grain. Corners are where the surface has normals on circles of latitude and
/// longitude: most of them where it is most curved.
PolyData shapeSurfaces(const ParticleStore& grains, const GrainShapes& shapes);

}  // namespace pendular
