#pragma once

#include "Kernel/Output/FrameOutput.h"
#include "Kernel/Output/ParaViewSeries.h"

namespace pendular {

/// NAME.pvd, and of each frame NAME-particles-STEP.vtp, NAME-contacts-STEP.vtp and NAME-walls-STEP.vtp; of
/// grains that are no spheres NAME-shapes-STEP.vtp, their surfaces; with sprays NAME-droplets-STEP.vtp.
class ParaViewFrames {
public:
    ParaViewFrames(const std::string& name, double keptUntil) : series(name, keptUntil) {}
    static std::filesystem::path indexOf(const std::string& name) { return name + ".pvd"; }
    static void prepare() {}
    static void check(const std::string& name) { ParaViewSeries::check(name); }

    void add(SceneFrame frame, int threads);

private:
    ParaViewSeries series;
};

/// Files that ParaView opens.
using ParaViewOutput = FrameOutput<ParaViewFrames>;

}  // namespace pendular
