#pragma once

#include "Kernel/Energy/EnergyAccount.h"
#include "Kernel/Energy/EnergyLedger.h"
#include "Kernel/Step/StepPart.h"

namespace pendular {

/// The account of the energy, where a ledger is kept.
class AccountPart : public StepPart {
public:
    [[nodiscard]] std::string_view name() const override { return "energy"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    void takeOver(StepContext& scene, const SceneChanges& changes) override;
    void beforeMotion(StepContext& step) override;
    void afterMotion(StepContext& step) override;
    void finish(StepContext& step) override;
    void takeBack(StepContext& step) override;
    void visitSetting(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

    void keep(bool keepIt) { kept = keepIt; }
    [[nodiscard]] bool isKept() const { return kept; }
    [[nodiscard]] const EnergyLedger& energies() const { return ledger; }
    /// Lets the context show the ledger and the account to other parts: null where none is kept.
    void show(StepContext& scene) {
        scene.ledger = kept ? &ledger : nullptr;
        scene.account = kept ? &account : nullptr;
    }
    /// The scene begins with what is in the ledger now.
    void beginWithThis() { energyAtStart = ledger.total(); }
    /// J
    [[nodiscard]] double changeSinceStart() const { return ledger.total() - energyAtStart; }

private:
    EnergyLedger ledger;
    EnergyAccount account;
    double energyAtStart = 0;  // J, of the ledger
    bool kept = false;
};

}  // namespace pendular
