#pragma once

#include "Kernel/Energy/EnergyAccount.h"
#include "Kernel/Energy/EnergyLedger.h"
#include "Kernel/Energy/WearAccount.h"
#include "Kernel/Step/StepPart.h"

namespace pendular {

/// The account of the energy, where a ledger is kept or walls wear.
class AccountPart : public StepPart {
public:
    [[nodiscard]] std::string_view name() const override { return "energy"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    void begin(StepContext& scene, bool isRestarted) override;
    void takeOver(StepContext& scene, const SceneChanges& changes) override;
    void beforeMotion(StepContext& step) override;
    void afterMotion(StepContext& step) override;
    void finish(StepContext& step) override;
    void takeBack(StepContext& step) override;
    /// visitSetting() compares them.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void visitSetting(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

    void keep(bool keepIt) { kept = keepIt; }
    /// Walls wear: there is an account of their contacts also where no ledger is kept.
    void noteWear(bool wallsWear) { wears = wallsWear; }
    /// The ledger.
    [[nodiscard]] bool isKept() const { return kept; }
    /// There is an account, for the ledger or for wear alone.
    [[nodiscard]] bool acts() const { return kept || wears; }
    [[nodiscard]] const EnergyLedger& energies() const { return ledger; }
    /// Lets the context show the ledger and the account to other parts: null where there is none.
    void show(StepContext& scene) {
        scene.ledger = kept ? &ledger : nullptr;
        scene.account = acts() ? &account : nullptr;
    }
    /// The scene begins with what is in the ledger now.
    void beginWithThis() { energyAtStart = ledger.total(); }
    /// J
    [[nodiscard]] double changeSinceStart() const { return ledger.total() - energyAtStart; }

private:
    EnergyLedger ledger;
    EnergyAccount account;
    WearAccount wear;          // in its place where walls wear and no ledger is kept
    double energyAtStart = 0;  // J, of the ledger
    bool kept = false, wears = false;
};

}  // namespace pendular
