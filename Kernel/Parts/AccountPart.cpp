#include "Kernel/Parts/AccountPart.h"

#include "Kernel/State/StateArchive.h"
#include "Kernel/Step/StepTimes.h"

namespace pendular {

namespace {

/// Time counts for the ledger as long as this lives.
class LedgerTime {
public:
    explicit LedgerTime(StepTimes& of) : times(of), before(of.enter(StepTimes::Part::Ledger)) {}
    LedgerTime(const LedgerTime&) = delete;
    LedgerTime& operator=(const LedgerTime&) = delete;
    ~LedgerTime() { times.enter(before); }

private:
    StepTimes& times;
    StepTimes::Part before;
};

}  // namespace

Features AccountPart::features(const StepContext& /*scene*/) const {
    return kept ? Features{Feature::EnergyLedger} : Features{};
}

void AccountPart::takeOver(StepContext& scene, const SceneChanges& changes) {
    const LedgerTime time(scene.times);
    if (changes.walls) EnergyAccount::wallsChanged(scene.walls, ledger);
}

void AccountPart::beforeMotion(StepContext& step) {
    const LedgerTime time(step.times);
    account.begin(step.grains(), step.contacts.store(), step.walls, step.gravity, step.length, ledger);
}

void AccountPart::afterMotion(StepContext& step) {
    const LedgerTime time(step.times);
    account.moved(step.grains(), step.gravity, ledger);
}

void AccountPart::finish(StepContext& step) {
    const LedgerTime time(step.times);
    account.finish(step.grains(), step.contacts, step.walls, step.gravity, step.length, *step.scheme, ledger);
    if (step.length > 0) EnergyAccount::finishWear(step.walls, step.time + step.length);
}

void AccountPart::takeBack(StepContext& /*step*/) { account.takeBack(ledger); }

void AccountPart::visitSetting(StateArchive& archive, StepContext& /*scene*/) {
    archive.same("ledgerKept", kept, {},
                 "the energy ledger is kept from the start of a run to its end or not at all, so give "
                 "--energy-interval-s (or keepEnergyLedger()) as it was: above 0 where the file has 1, 0 "
                 "where it has 0");
    archive.finite("ledger", ledger);
    archive.finite("energyAtStart", energyAtStart);
}

}  // namespace pendular
