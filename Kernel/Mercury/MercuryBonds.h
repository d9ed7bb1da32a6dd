#pragma once

#include <cstdint>
#include <vector>

#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Core/Step/StepPart.h"

namespace pendular {

/// The bonds that a driver asks for by interaction->bond(), of species with the adhesion law Bonded: given to
/// the contacts at the start of a run, or before the next step, in which they act.
class MercuryBonds : public StepPart {
public:
    /// Two grains that touch, or a grain and a wall, by its number (second: ObservedContact::none).
    struct Pair {
        std::uint32_t first, second;
        std::int32_t wall;
    };
    /// @param force N; negative: that of the species; 0 ends a bond
    void ask(const Pair& pair, double force);

    [[nodiscard]] std::string_view name() const override { return "bonds of contacts"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void prepare(StepContext& step) override { give(step); }
    void afterForces(StepContext& step) override;
    /// It has no settings: bonds are added in the run.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void visitState(StateArchive& archive, StepContext& scene) override;

private:
    struct Asked {
        Pair pair;
        double force;  // N
    };
    void give(StepContext& step);
    static void giveOne(StepContext& step, const Asked& asked);

    std::vector<Asked> waiting;
};

}  // namespace pendular
