#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Core/Step/StepPart.h"

namespace pendular {

/// Gives contacts, at the start of a run, the history that they had in a restart file of MercuryDPM's: the
/// springs of friction, rolling and torsion, and the overlap by which a plastic contact is flattened.
class MercuryHistories : public StepPart {
public:
    struct OfContact {
        std::uint32_t first = 0, second = 0;  // identities
        std::int32_t wall = -1;               // its number; then there is no second particle
        Vector<double> sliding{0, 0, 0}, rolling{0, 0, 0}, torsion{0, 0, 0};  // m, as there
        double flattening = 0;                                                // m
    };
    void add(const OfContact& contact);

    [[nodiscard]] std::string_view name() const override { return "histories of a MercuryDPM file"; }
    [[nodiscard]] Features features(const StepContext& /*scene*/) const override {
        return waiting.empty() ? Features{} : Features{Feature::OwnPart};
    }
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void begin(StepContext& step, bool isRestarted) override;
    void afterForces(StepContext& step) override;
    /// It has no settings: contacts have their histories from the start on.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}

private:
    void give(StepContext& step);

    std::map<std::tuple<std::uint32_t, std::uint32_t, std::int32_t>, OfContact> waiting;
};

}  // namespace pendular
