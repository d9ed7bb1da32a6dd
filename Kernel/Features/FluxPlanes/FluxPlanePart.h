#pragma once

#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/FluxPlanes/FluxPlane.h"

namespace pendular {

/// Planes that count the grains that go through them.
class FluxPlanePart : public StepPart {
public:
    explicit FluxPlanePart(FluxPlaneHandler& ofScene) : planes(ofScene) {}

    [[nodiscard]] std::string_view name() const override { return "fluxPlanes"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void begin(StepContext& scene, bool isRestarted) override;
    void beforeMotion(StepContext& step) override;
    void afterMotion(StepContext& step) override;
    void takeBack(StepContext& step) override;
    void compareSetUp(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

private:
    FluxPlaneHandler& planes;
};

}  // namespace pendular
