#pragma once

#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/Outlets/Outlet.h"

namespace pendular {

/// Grains that leave.
class OutletPart : public StepPart {
public:
    explicit OutletPart(OutletHandler& ofScene) : outlets(ofScene) {}

    [[nodiscard]] std::string_view name() const override { return "outlets"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void begin(StepContext& scene, bool isRestarted) override;
    void atEnd(StepContext& step) override;
    void compareSetUp(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

private:
    OutletHandler& outlets;
};

}  // namespace pendular
