#pragma once

#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/Membranes/MembraneMotion.h"

namespace pendular {

/// The motion of the vertices of membranes.
class MembranePart : public StepPart {
public:
    [[nodiscard]] std::string_view name() const override { return "membranes"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void prepare(StepContext& step) override;
    void moveSurroundings(StepContext& step) override;
    void afterForces(StepContext& step) override;
    /// Membranes, which are walls, compare theirs.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void takeBack(StepContext& step) override;

private:
    MembraneMotion motion;
};

}  // namespace pendular
