#pragma once

#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/MovingWalls/PlaneMotion.h"
#include "Kernel/Features/MovingWalls/WallBodyMotion.h"

namespace pendular {

/// Walls that are moved by the forces on them: pistons, planes with a target force, and bodies.
class DrivePart : public StepPart {
public:
    explicit DrivePart(const WallHandler& wallHandler) : walls(wallHandler) {}
    [[nodiscard]] std::string_view name() const override { return "drives"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void check(const StepContext& scene) override;
    /// More grains may touch a piston than its mass was checked for.
    void prepare(StepContext& step) override;
    void moveSurroundings(StepContext& step) override;
    void accelerate(StepContext& step) override;
    /// Walls compare what drives them.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void takeBack(StepContext& step) override;
    void addTo(SummaryRows& rows) const override;

    /// Sums the forces on walls whose forces were not kept before.
    static void sumForcesOnNewDrives(const StepContext& scene);
    /// The step as the motion of walls needs it.
    [[nodiscard]] static PlaneMotion::Step stepOf(const StepContext& step);

private:
    const WallHandler& walls;
    PlaneMotion motion;
    WallBodyMotion bodies;
};

}  // namespace pendular
