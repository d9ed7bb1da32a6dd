#pragma once

#include "Kernel/Motion/ContactBound.h"
#include "Kernel/Parts/AdaptiveStep.h"
#include "Kernel/Step/StepPart.h"

namespace pendular {

class InletHandler;

/// The time step that follows the contacts.
class AdaptivePart : public StepPart {
public:
    explicit AdaptivePart(const InletHandler& ofScene) : inlets(ofScene) {}

    [[nodiscard]] std::string_view name() const override { return "adaptiveStep"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void takeOver(StepContext& scene, const SceneChanges& changes) override;
    void prepare(StepContext& step) override;
    void afterMotion(StepContext& step) override;
    void afterForces(StepContext& step) override;
    void visitSetting(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;

    void set(double share, double largestStep) { adaptive.set(share, largestStep); }
    void chooseAnew() { adaptive.chooseAnew(); }
    [[nodiscard]] const AdaptiveStep& step() const { return adaptive; }

private:
    /// s, for the stiffest pair
    [[nodiscard]] static double largestStepOf(const StepContext& scene, const GrainSizes& sizes);

    const InletHandler& inlets;
    AdaptiveStep adaptive;
    ContactBounds bounds;
};

}  // namespace pendular
