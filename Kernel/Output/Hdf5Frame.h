#pragma once

#include <filesystem>

#include "Kernel/Output/SceneFields.h"

namespace pendular {

/// Reads a frame of Hdf5Output (NAME-fields-STEP.h5), as ParaViewOutput would have written it; its step and
/// its time are in the list of frames. Grains that are no spheres get surfaces of the superquadrics that the
/// fields tell of. Throws InputError, with the file and the reason, if it is no such frame.
SceneFrame readHdf5Frame(const std::filesystem::path& path);

}  // namespace pendular
