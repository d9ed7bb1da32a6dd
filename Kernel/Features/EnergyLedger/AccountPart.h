#pragma once

#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/EnergyLedger/EnergyAccount.h"
#include "Kernel/Features/EnergyLedger/EnergyLedger.h"
#include "Kernel/Features/EnergyLedger/WearAccount.h"

namespace pendular {

/// The account of the energy, where a ledger is kept or walls wear. Where only the energy of the springs is
/// asked for, contacts are sampled in each step, and summed up when somebody reads the sum.
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
    [[nodiscard]] bool needsFinishedStep() const override { return acts(); }
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void visitSetting(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

    void keep(bool keepIt) {
        if (keepIt) asked = Asked::Ledger;
        else if (asked == Asked::Ledger) asked = Asked::Nothing;
        kept = keepIt;
    }
    /// Keeps what the sum of springs needs, unless a ledger is kept, which has it.
    void keepSprings() {
        if (asked == Asked::Nothing) asked = Asked::Springs;
    }
    /// Called at set-up, when all has been asked for. Ranks have some of the contacts each, and walls that
    /// wear have an account of other contacts: there the ledger is kept for the springs.
    void settle(bool isShared) { kept = asked == Asked::Ledger || (asksForSprings() && (wears || isShared)); }
    /// Walls wear: there is an account of their contacts also where no ledger is kept.
    void noteWear(bool wallsWear) { wears = wallsWear; }
    /// The ledger.
    [[nodiscard]] bool isKept() const { return kept; }
    /// There is an account, for the ledger or for wear alone.
    [[nodiscard]] bool acts() const { return kept || wears; }
    /// No ledger is kept, but the energy of the springs.
    [[nodiscard]] bool keepsSpringsAlone() const { return asksForSprings() && !kept; }
    /// Contacts are sampled in each step.
    [[nodiscard]] bool takesSamples() const { return acts() || keepsSpringsAlone(); }
    /// J, in the springs of contacts; those of the ledger where one is kept.
    [[nodiscard]] double springs(const StepContext& scene) const;
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
    enum class Asked { Nothing, Springs, Ledger };  // by the driver and its outputs
    [[nodiscard]] bool asksForSprings() const { return asked == Asked::Springs; }

    EnergyLedger ledger;
    EnergyAccount account;
    WearAccount wear;          // in its place where walls wear and no ledger is kept
    double energyAtStart = 0;  // J, of the ledger
    Asked asked = Asked::Nothing;
    bool kept = false, wears = false;
};

}  // namespace pendular
