#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"
#include "Tools/View/RunFolder.h"

namespace pendular::view {

/// A frame of a run that can be shown.
struct FrameEntry {
    enum class Kind { ParaView, Hdf5, Restart };

    double time;  // s; NaN: it is in the file
    std::shared_ptr<const OpenFolder> folder;
    std::string file;  // its name in the folder
    Kind kind = Kind::ParaView;
};

/// Those of the run's series for ParaView, by time; where it has none, those of its list of HDF5 frames;
/// where it has neither, the state of its restart file.
std::vector<FrameEntry> framesOf(const RunFiles& run);

/// What of a frame is wanted.
struct FrameWish {
    std::string field;      // that colours the grains; "velocity_m_per_s.z" is a part
    std::string wallField;  // that colours the walls; empty: none
    bool contacts = false, bridges = true;
    bool droplets = true, surfaces = true;  // surfaces: of walls and of grains that are no spheres
    bool orRadius = false;                  // by the radius where there is no such field
    std::optional<Vector<double>> origin;   // m; nothing: the middle of this frame's grains
};

/// A frame as the page takes it (Columns.h). The text tells time, origin, limits, and the fields of grains
/// and walls. The columns:
///
/// grains     x, y, z (m, from the origin), radius (m; negative: drawn by its shape) of each grain
/// value      of the field of the wish
/// bridges    x, y, z, radius, x, y, z, 0: cylinders of the bridges' volumes
/// contacts   x, y, z, force (N), x, y, z, 0, in the order of the file
/// walls      x, y, z: triangles
/// wallValue  of the wall field of the wish, where the walls have it, of each triangle
/// droplets   x, y, z, radius
/// shapes     x, y, z, row of the grain: triangles of grains that are no spheres
///
/// Throws InputError if the frame cannot be read or has no such field.
std::string packFrame(const FrameEntry& frame, const FrameWish& wish);

/// All fields of a grain, or of a contact, as JSON: {"fields": [{"name", "quantity", "unit", "value"}]}.
/// @param row of its grains or contacts
std::string describeRow(const FrameEntry& frame, bool ofContacts, std::size_t row);

}  // namespace pendular::view
