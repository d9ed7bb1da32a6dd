#pragma once

#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/LiquidTransport/SprayHandler.h"

namespace pendular {

/// Droplets that come out of sprays, fly, and are caught.
class SprayPart : public StepPart {
public:
    explicit SprayPart(SprayHandler& ofScene) : sprays(ofScene) {}

    [[nodiscard]] std::string_view name() const override { return "sprays"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    void begin(StepContext& scene, bool isRestarted) override;
    void prepare(StepContext& step) override;
    /// Called when the flow of the step is known.
    void beforeMotion(StepContext& step) override;
    void finish(StepContext& step) override;
    void compareSetUp(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

private:
    SprayHandler& sprays;
    PeriodicBox imagesBefore, imagesNow;  // as images moved in the last step, and move in this one
};

}  // namespace pendular
