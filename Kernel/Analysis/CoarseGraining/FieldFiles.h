#pragma once

#include <filesystem>
#include <string>

#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Analysis/Output/PolyData.h"

namespace pendular {

/// The fields that follow from sums, at the points of their grid (x the slowest), of all grains and of each
/// group, whose name is then in front. Velocity, granular temperature, kinetic stress and coordination are
/// NaN where there is no grain. With u = j / rho: kinetic stress = flux - rho u u, and the granular
/// temperature is its trace over 3 rho.
std::vector<PolyDataField> fieldsOf(const FieldSums& sums);

/// The columns of a table of fields: time_s, the resolved coordinates, and all parts of all fields.
std::string headerOf(const FieldSums& sums);
/// Calls use(row) with each row of that table; what is NaN is empty.
/// @param time s
template <class Use>
void forEachRow(const FieldSums& sums, double time, Use&& use);

/// Writes an image file of VTK (.vti) whose points are those of the grid; along an axis that is averaged over
/// there is one. Throws InputError if the file cannot be written.
/// @param time s
void writeImage(const std::filesystem::path& path, const FieldSums& sums, double time, int threads = 1);

/// Writes a file of the HDF5 library: the fields in the group "fields", a row for each point, x the slowest;
/// in "points" the places of the points along each resolved axis. Throws InputError if it cannot be written.
/// @param time s; @param step after which the file is named
void writeHdf5(const std::filesystem::path& path, const FieldSums& sums, double time, std::uint64_t step,
               int threads = 1);

// Implementation -------------------------------------------------------------------------------------------

/// A row of the table, with the fields already made.
std::string rowOf(const FieldSums& sums, const std::vector<PolyDataField>& fields, double time,
                  std::size_t point);

template <class Use>
void forEachRow(const FieldSums& sums, double time, Use&& use) {
    const std::vector<PolyDataField> fields = fieldsOf(sums);
    for (std::size_t k = 0; k < sums.grid().size(); ++k) use(rowOf(sums, fields, time, k));
}

}  // namespace pendular
