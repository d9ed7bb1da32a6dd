#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Tools/View/RunFolder.h"

namespace pendular::view {

/// Fields of coarse graining in the folder of a run, by time: what FieldOutput or coarse-grain has written
/// for two or three directions, or as HDF5. (What it writes for one direction is a table.)
struct FieldSeries {
    struct Entry {
        double time;  // s
        std::shared_ptr<const OpenFolder> folder;
        std::string file;  // its name in the folder
    };
    std::string name;  // of the file that lists them: "run-coarse.pvd"
    std::vector<Entry> entries;
};

/// All of them, sorted by name. What cannot be read is left out.
std::vector<FieldSeries> fieldSeriesOf(const RunFiles& run);

struct MapWish {
    std::string
        field;  // "velocity_m_per_s.x", "contact_stress_Pa.xz"; without a part: of a vector its length, of a
                // tensor the mean of its diagonal, which is the pressure of a stress; empty: the first one
    std::optional<std::size_t>
        normal;  // the axis that is looked along; nothing: one that is averaged over, or y
    std::optional<std::size_t> slice;  // place along it, by its number; nothing: the middle
};

/// A map of a field as the page takes it (Columns.h). The text tells time, fields, field, the axes across, up
/// and normal, each with its name and the places of its points (m; null: averaged over), and the slice. The
/// column `value` has the numbers, those of a row of points across after one another, the lowest row first;
/// NaN where there is no grain. Throws InputError if there is no such field or slice.
std::string packMap(const FieldSeries::Entry& entry, const MapWish& wish);

}  // namespace pendular::view
