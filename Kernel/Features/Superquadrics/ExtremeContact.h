#pragma once

#include "Kernel/Features/Superquadrics/Superquadric.h"

namespace pendular {

/// The extremes of the contacts of a shape, whatever its size: for the stability limit, and for walls.
struct ExtremeContact {
    double turning;  // (arm x n) I^-1 (arm x n) m: by how much the turning adds to 1/m
    double radii;    // Gauss' radius over that of the sphere around, at most SuperquadricGeometry::mostRadii
    double sliding;  // (arm x t) I^-1 (arm x t) m, the largest of all tangents t
    double smallestRadius;  // of curvature, over that of the sphere around: of a ball that rolls inside
};

/// The extremes are found by many normals in an octant, its axes included; 1 % is added for what lies
/// between, and a fifth is taken off the smallest radius.
ExtremeContact extremeContact(const Superquadric& shape);

}  // namespace pendular
