#pragma once

#include "Kernel/Features/Meshes/PolygonMesh.h"

namespace pendular {

/// Wavefront OBJ, of a file that takeAsText() has taken: vertices (v) and faces (f, with any numbers of
/// corners; "7", "7/2", "7/2/5", "7//5", counted from 1, or back from the last vertex by negative numbers).
/// Normals, texture, groups, materials, colours of vertices, lines and points are passed over; curved
/// surfaces are refused. Source: Wavefront, Advanced Visualizer, appendix B1 (object files).
/// @param scale m for one unit of the file
PolygonMesh readObj(const InputFile& file, double scale);

/// PLY, ASCII or binary of both byte orders, as it was loaded: the elements `vertex` (x, y, z of any type)
/// and `face` (a list vertex_indices or vertex_index). Other elements and properties are passed over. Source:
/// Turk (1994), The PLY polygon file format, Stanford.
PolygonMesh readPly(InputFile& file, double scale);

}  // namespace pendular
