#pragma once

#include <map>

#include "Kernel/Output/FrameOutput.h"

namespace pendular {

/// NAME-fields.h5, and of each frame NAME-fields-STEP.h5, which appears in it as the group frames/STEP. Every
/// file is complete at any moment, so a run that is killed leaves all frames but the one that it was writing.
class Hdf5Frames {
public:
    Hdf5Frames(const std::string& name, double keptUntil);
    static std::filesystem::path indexOf(const std::string& name) { return name + "-fields.h5"; }
    static void prepare();
    static void check(const std::string& name);

    void add(const SceneFrame& frame, int threads);

private:
    using Times = std::map<std::uint64_t, double>;  // s, of each frame, by its step

    static Times readIndex(const std::filesystem::path& path);
    /// Of a series that is there; none of one that cannot be read, if none of them are needed.
    [[nodiscard]] Times formerTimes(bool needed) const;
    [[nodiscard]] std::filesystem::path fileOf(std::uint64_t step) const;
    void writeIndex() const;

    std::string beginning;
    Times times;
};

/// Files for h5py and MATLAB.
using Hdf5Output = FrameOutput<Hdf5Frames>;

}  // namespace pendular
