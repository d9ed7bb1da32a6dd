#pragma once

#include <string>
#include <vector>

#include "Kernel/Analysis/Output/Hdf5Series.h"
#include "Kernel/Analysis/Output/ParaViewSeries.h"
#include "Tools/View/OpenFolder.h"

namespace pendular::view {

// Lists of frames, read by the handle of their folder. The files that they tell are names in this folder;
// what lies elsewhere is left out.

/// Of a series NAME.pvd. Throws InputError if it is none.
std::vector<ParaViewEntry> filesOf(const OpenFolder& folder, const std::string& series);
/// Of a list NAME.h5. Throws InputError if it is none.
std::vector<Hdf5Entry> framesIn(const OpenFolder& folder, const std::string& list);

}  // namespace pendular::view
