#include "Kernel/Features/EnergyLedger/AccountPart.h"

#include <fmt/format.h>

#include <array>

#include "Kernel/Core/Step/StepTimes.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

Features AccountPart::features(const StepContext& /*scene*/) const {
    if (kept || keepsSpringsAlone()) return {Feature::EnergyLedger};
    return wears ? Features{Feature::WornWalls} : Features{};
}

void AccountPart::begin(StepContext& scene, bool /*isRestarted*/) {
    if (kept || keepsSpringsAlone()) return;
    scene.contacts.sampleWallsAlone();
    wear.begin();
}

void AccountPart::takeOver(StepContext& scene, const SceneChanges& changes) {
    const StepTimes::Within ledgers(scene.times, StepTimes::Part::Ledger);
    if (kept && changes.walls) EnergyAccount::wallsChanged(scene.walls, ledger);
}

void AccountPart::beforeMotion(StepContext& step) {
    if (!acts()) return;
    const StepTimes::Within ledgers(step.times, StepTimes::Part::Ledger);
    step.contacts.renewGhosts(step.grains());  // a hook may have changed velocities
    if (kept) account.begin(step.grains(), step.contacts, step.walls, step.gravity, step.length, ledger);
    else wear.beforeMotion(step.grains(), step.contacts, step.threads);
}

void AccountPart::afterMotion(StepContext& step) {
    if (!acts()) return;
    const StepTimes::Within ledgers(step.times, StepTimes::Part::Ledger);
    if (kept) account.moved(step.grains(), step.contacts.ranks(), step.gravity, ledger);
    else wear.afterMotion(step.grains(), step.contacts, step.shifts.grains, step.shifts.walls);
}

void AccountPart::finish(StepContext& step) {
    if (!acts()) return;
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

/// Whether the ledger is whole, or has the springs alone: whatever the number of ranks. A file without such
/// an entry has a whole one, or none.
static void compareWhole(StateArchive& archive, bool isWhole) {
    constexpr std::string_view
        entry = "ledgerIsWhole",
        advice =
            "what is kept of the energies stays the same from the start of a run to its "
            "end, so call keepEnergyLedger() where the file has 1, and keepSpringEnergy() "
            "alone where it has 0";
    if (archive.isReading() && !archive.holds(entry))
        archive.requireSame(isWhole, entry, "1", isWhole ? "1" : "0", {}, advice);
    else if (archive.isReading() || !isWhole) archive.same(entry, isWhole, {}, advice);
}

void AccountPart::visitSetting(StateArchive& archive, StepContext& /*scene*/) {
    archive.same("ledgerKept", asked != Asked::Nothing, {},
                 "the energy ledger is kept from the start of a run to its end or not at all, so give "
                 "--energy-interval-s (or keepEnergyLedger()) as it was: above 0 where the file has 1, 0 "
                 "where it has 0");
    compareWhole(archive, !asksForSprings());
    archive.finite("ledger", ledger);
    archive.finite("energyAtStart", energyAtStart);
    if (asked == Asked::Ledger) account.visitState(archive);  // on any number of ranks
}

/// As the ledger has it: each kind of spring is rounded once.
double AccountPart::springs(const StepContext& scene) const {
    if (kept) return ledger.springs();
    std::array<ExactSum, 4> sums;
    const ContactStore& store = scene.contacts.store();
    scene.contacts.forEachActing(scene.grains(), [&](const Bucket&, std::uint32_t contact) {
        const ContactSample& now = store.memory.energies[store.slotOf(contact)].now;
        sums[0].add(now.elasticEnergy);
        sums[1].add(now.sliding.stored());
        sums[2].add(now.rolling.stored());
        sums[3].add(now.torsion.stored());
    });
    double all = 0;
    for (const ExactSum& sum : sums) all += sum.value();
    return all;
}

void AccountPart::addTo(SummaryRows& rows) const {
    if (!kept) return;
    for (const auto& entry : EnergyLedger::entries())
        rows.addNumber(fmt::format("energy: {}", entry.name), ledger.*entry.member, "J");
    rows.addNumber("energy lost", ledger.lost(), "J");
    rows.addNumber("energy unaccounted for", changeSinceStart(), "J");
}

}  // namespace pendular
