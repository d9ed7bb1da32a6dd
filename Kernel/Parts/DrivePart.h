#pragma once

#include "Kernel/Motion/PlaneMotion.h"
#include "Kernel/Step/StepPart.h"

namespace pendular {

/// Planes that are moved by the forces on them: pistons, and walls with a target force.
class DrivePart : public StepPart {
public:
    [[nodiscard]] std::string_view name() const override { return "drives"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void check(const StepContext& scene) override;
    /// More grains may touch a piston than its mass was checked for.
    void prepare(StepContext& step) override;
    void moveSurroundings(StepContext& step) override;
    void afterForces(StepContext& step) override;
    void takeBack(StepContext& step) override;

    /// Sums the forces on walls whose forces were not kept before.
    static void sumForcesOnNewDrives(const StepContext& scene);
    /// The step as the motion of walls needs it.
    [[nodiscard]] static PlaneMotion::Step stepOf(const StepContext& step);

private:
    PlaneMotion motion;
};

}  // namespace pendular
