#pragma once

#include "Kernel/Analysis/Output/FrameOutput.h"
#include "Kernel/Analysis/Output/Hdf5Series.h"

namespace pendular {

/// NAME-fields.h5, and of each frame NAME-fields-STEP.h5; see Hdf5Series.
class Hdf5Frames {
public:
    static constexpr bool hasParts = false;
    Hdf5Frames(const std::string& name, double keptUntil) : series(beginningOf(name), keptUntil) {}
    static std::filesystem::path indexOf(const std::string& name) {
        return Hdf5Series::indexOf(beginningOf(name));
    }
    static void prepare() { Hdf5Series::prepare(); }
    static void check(const std::string& name) { Hdf5Series::check(beginningOf(name)); }

    void add(const SceneFrame& frame, int threads);

private:
    static std::string beginningOf(const std::string& name) { return name + "-fields"; }

    Hdf5Series series;
};

/// Files for h5py and MATLAB.
using Hdf5Output = FrameOutput<Hdf5Frames>;

}  // namespace pendular
