#pragma once

#include <optional>

#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Core/Contacts/GrainShapes.h"

namespace pendular {

/// Adds fields of grains that are no spheres, in the order of identities: half_lengths_m, the exponents n1
/// and n2, and orientation, the matrix (row by row) that turns the axes of the shape into space.
void addShapeFields(const ParticleStore& grains, const GrainShapes& shapes, PolyData& points);

/// The surfaces of grains that are no spheres as polygons, in the order of identities, with the identity and
/// the body of each polygon's grain. Corners are where the surface has normals on circles of latitude and
/// longitude: most of them where it is most curved.
PolyData shapeSurfaces(const ParticleStore& grains, const GrainShapes& shapes);
/// Those of grains that have the fields of addShapeFields() and identity, without the body; nothing where
/// they have not. Balls are left out. What the fields do not tell, the rounding of a block's edges, is that
/// of its exponents.
std::optional<PolyData> shapeSurfaces(const PolyData& points);

}  // namespace pendular
