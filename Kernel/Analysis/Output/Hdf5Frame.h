#pragma once

#include <filesystem>

#include "Kernel/Analysis/Output/SceneFields.h"

namespace pendular {

/// Reads a frame of Hdf5Output (NAME-fields-STEP.h5), as ParaViewOutput would have written it. Its step and
/// its time are in the list of frames; surfaces of grains that are no spheres come from their fields by
/// shapeSurfaces(). Throws InputError, with the file and the reason, if it is no such frame.
SceneFrame readHdf5Frame(const std::filesystem::path& path);

}  // namespace pendular
