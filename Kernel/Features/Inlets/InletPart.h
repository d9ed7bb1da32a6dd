#pragma once

#include "Kernel/Core/Contacts/HeldContacts.h"
#include "Kernel/Core/Motion/GrainSizes.h"
#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/Inlets/Inlet.h"

namespace pendular {

/// Grains that come at a rate.
class InletPart : public StepPart {
public:
    explicit InletPart(InletHandler& ofScene) : inlets(ofScene) {}

    [[nodiscard]] std::string_view name() const override { return "inlets"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void begin(StepContext& scene, bool isRestarted) override;
    void prepare(StepContext& step) override;
    void atEnd(StepContext& step) override;
    void compareSetUp(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

    /// The scene into which grains come.
    [[nodiscard]] static InsertionScene placesOf(const StepContext& scene);

private:
    InletHandler& inlets;
};

/// The sizes of all these grains, and of those that inlets will bring.
/// @param ranks that share the grains; none: all are here
[[nodiscard]] GrainSizes sizesOfScene(const ContactLaws& laws, const ParticleStore& grains,
                                      const InletHandler& inlets, HeldContacts heldContacts,
                                      const AllRanks& ranks = {});

}  // namespace pendular
