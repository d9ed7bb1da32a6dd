#pragma once

#include <string>
#include <vector>

#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Foundation/State/Hdf5File.h"

namespace pendular {

/// A column as FieldFile writes it, under the last part of its name. Throws InputError if it is not there, or
/// has no numbers of a kind that FieldFile writes, one to nine to a row.
PolyDataField readColumn(const Hdf5File& file, const std::string& name);
/// All columns of a group, sorted by name.
std::vector<PolyDataField> readColumns(const Hdf5File& file, const std::string& group);

}  // namespace pendular
