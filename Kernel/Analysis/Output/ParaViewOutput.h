#pragma once

#include "Kernel/Analysis/Output/FrameOutput.h"
#include "Kernel/Analysis/Output/ParaViewSeries.h"

namespace pendular {

class AllRanks;

/// NAME.pvd, and of each frame NAME-particles-STEP.vtp, NAME-contacts-STEP.vtp and NAME-walls-STEP.vtp; of
/// grains that are no spheres NAME-shapes-STEP.vtp, their surfaces; with sprays NAME-droplets-STEP.vtp. In
/// parts, each but walls and droplets is a file of each rank, NAME-particles-STEP-rankN.vtp, and
/// NAME-particles-STEP.pvtp, which names them.
class ParaViewFrames {
public:
    static constexpr bool hasParts = true;
    ParaViewFrames(const std::string& name, double keptUntil) : series(name, keptUntil) {}
    static std::filesystem::path indexOf(const std::string& name) { return name + ".pvd"; }
    static void prepare() {}
    static void check(const std::string& name) { ParaViewSeries::check(name); }

    void add(SceneFrame frame, int threads);
    /// What this rank has; all call it.
    void addPart(SceneFrame frame, int threads, const AllRanks& ranks);

private:
    ParaViewSeries series;
};

/// Files that ParaView opens.
using ParaViewOutput = FrameOutput<ParaViewFrames>;

}  // namespace pendular
