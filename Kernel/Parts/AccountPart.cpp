#include "Kernel/Parts/AccountPart.h"

#include <fmt/format.h>

#include "Kernel/State/StateArchive.h"
#include "Kernel/Step/StepTimes.h"
#include "Kernel/Step/SummaryRows.h"

namespace pendular {

Features AccountPart::features(const StepContext& /*scene*/) const {
    if (kept) return {Feature::EnergyLedger};
    return wears ? Features{Feature::WornWalls} : Features{};
}

void AccountPart::begin(StepContext& scene, bool /*isRestarted*/) {
    if (kept) return;
    scene.contacts.sampleWallsAlone();
    wear.begin();
}

void AccountPart::takeOver(StepContext& scene, const SceneChanges& changes) {
    const StepTimes::Within ledgers(scene.times, StepTimes::Part::Ledger);
    if (kept && changes.walls) EnergyAccount::wallsChanged(scene.walls, ledger);
}

void AccountPart::beforeMotion(StepContext& step) {
    const StepTimes::Within ledgers(step.times, StepTimes::Part::Ledger);
    step.contacts.renewGhosts(step.grains());  // a hook may have changed velocities
    if (kept) account.begin(step.grains(), step.contacts, step.walls, step.gravity, step.length, ledger);
    else wear.beforeMotion(step.grains(), step.contacts, step.threads);
}

void AccountPart::afterMotion(StepContext& step) {
    const StepTimes::Within ledgers(step.times, StepTimes::Part::Ledger);
    if (kept) account.moved(step.grains(), step.contacts.ranks(), step.gravity, ledger);
    else wear.afterMotion(step.grains(), step.contacts, step.shifts.grains, step.shifts.walls);
}

void AccountPart::finish(StepContext& step) {
    const StepTimes::Within ledgers(step.times, StepTimes::Part::Ledger);
    if (kept)
        account.finish(step.grains(), step.contacts, step.walls, step.gravity, step.length, *step.scheme,
                       step.threads, ledger);
    else wear.finish(step.grains(), step.contacts, step.walls, step.length, step.threads);
    if (step.length > 0) EnergyAccount::finishWear(step.walls, step.time + step.length);
}

void AccountPart::takeBack(StepContext& /*step*/) {
    if (kept) account.takeBack(ledger);
}

void AccountPart::visitSetting(StateArchive& archive, StepContext& /*scene*/) {
    archive.same("ledgerKept", kept, {},
                 "the energy ledger is kept from the start of a run to its end or not at all, so give "
                 "--energy-interval-s (or keepEnergyLedger()) as it was: above 0 where the file has 1, 0 "
                 "where it has 0");
    archive.finite("ledger", ledger);
    archive.finite("energyAtStart", energyAtStart);
    if (kept) account.visitState(archive);
}

void AccountPart::addTo(SummaryRows& rows) const {
    if (!kept) return;
    for (const auto& entry : EnergyLedger::entries())
        rows.addNumber(fmt::format("energy: {}", entry.name), ledger.*entry.member, "J");
    rows.addNumber("energy lost", ledger.lost(), "J");
    rows.addNumber("energy unaccounted for", changeSinceStart(), "J");
}

}  // namespace pendular
