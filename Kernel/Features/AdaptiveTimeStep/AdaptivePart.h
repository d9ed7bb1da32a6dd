#pragma once

#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/AdaptiveTimeStep/AdaptiveStep.h"
#include "Kernel/Features/AdaptiveTimeStep/ContactBound.h"

namespace pendular {

class FlowPart;
class InletHandler;

/// The time step that follows the contacts.
class AdaptivePart : public StepPart {
public:
    AdaptivePart(const InletHandler& inletsOfScene, const FlowPart& flowOfScene)
        : inlets(inletsOfScene), flow(flowOfScene) {}

    [[nodiscard]] std::string_view name() const override { return "adaptiveStep"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void takeOver(StepContext& scene, const SceneChanges& changes) override;
    void prepare(StepContext& step) override;
    void afterMotion(StepContext& step) override;
    void afterForces(StepContext& step) override;
    /// visitSetting() compares them.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void visitSetting(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

    void set(double share, double largestStep) { adaptive.set(share, largestStep); }
    void chooseAnew() { adaptive.chooseAnew(); }
    [[nodiscard]] const AdaptiveStep& step() const { return adaptive; }

private:
    /// The longest step, over the time in which a servo of stress reaches its aim.
    static constexpr double shareOfServo = 0.1;

    [[nodiscard]] GrainSizes sizesOf(const StepContext& scene) const;
    /// s, for the stiffest pair, and for the servos.
    [[nodiscard]] double largestStepOf(const StepContext& scene, const GrainSizes& sizes) const;

    const InletHandler& inlets;
    const FlowPart& flow;
    AdaptiveStep adaptive;
    ContactBounds bounds;
};

}  // namespace pendular
