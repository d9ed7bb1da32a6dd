#pragma once

#include "Kernel/Core/Step/StepPart.h"

namespace pendular {

/// The motion of the grains that move by themselves.
class GrainPart : public StepPart {
public:
    [[nodiscard]] std::string_view name() const override { return "grains"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void moveGrains(StepContext& step) override;
    /// It has no settings: grains are part of the state.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void takeBack(StepContext& step) override;

    /// The end of a step that was left to whoever asks for the grains: of these and of rigid bodies.
    static void finishLeftStep(const StepContext& step);
};

}  // namespace pendular
