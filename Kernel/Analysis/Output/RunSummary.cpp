#include "Kernel/Analysis/Output/RunSummary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/CapillaryWatch.h"
#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/OverlapWatch.h"
#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Run/RunStatus.h"
#include "Kernel/Core/Run/SummaryFile.h"
#include "Kernel/Core/Step/StepTimes.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Features/DomainDecomposition/GrainSharing.h"
#include "Kernel/Features/EnergyLedger/GrainSums.h"
#include "Kernel/Features/LiquidTransport/ContactLiquid.h"
#include "Kernel/Features/LiquidTransport/Evaporation.h"
#include "Kernel/Features/LiquidTransport/LiquidLedger.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Friction/MindlinSecant.h"
#include "Kernel/Scene/DomainWarnings.h"
#include "Kernel/Scene/PendularState.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/SceneCheck.h"
#include "Kernel/Scene/TimeStep/SoftestModulus.h"

namespace pendular {
namespace {

void addStepForFigure(SummaryRows& rows, const StepForFigure& chosen) {
    rows.add("step for the bulk quantity", nameOf(chosen.figure));
    rows.addNumber("error of the quantity, wanted", chosen.asked, "1");
    if (chosen.isKnown())
        rows.addNumber("error of the quantity, measured in other scenes", chosen.measured, "1");
    else rows.add("error of the quantity", "not known: " + chosen.unknown);
}

void addStepForError(SummaryRows& rows, const StepForError& chosen) {
    rows.addNumber("step for an error of", chosen.asked, "1");
    rows.addNumber("speed of collisions", chosen.speed, "m/s");
    if (chosen.known) {
        rows.addNumber("error of collisions, largest", chosen.largest, "1");
        rows.addNumber("error of collisions, mean", chosen.mean, "1");
    } else {
        rows.add("error of collisions",
                 chosen.together ? "not known: all bodies stay together" : "not known");
    }
    if (chosen.step > chosen.limit)
        rows.add("not promised by this step",
                 "that a bed whose friction sticks stays at rest, and that overlaps near 5 % are borne");
}

void addRun(SummaryRows& rows, const Scene& scene, bool isComplete) {
    rows.add("name", scene.getName());
    scene.status(isComplete).addTo(rows);
    if (scene.getFirstStep() > 0) rows.add("restarted after steps", scene.getFirstStep());
    rows.addNumber("stability limit",
                   sceneStabilityLimit(scene.laws(), scene.grainSizes(scene.particleHandler.store()),
                                       scene.wallHandler, scene.scheme()),
                   "s");
    if (scene.acceptsUnstableTimeStep()) rows.add("step above the stability limit", "accepted");
    if (scene.getStepForError()) addStepForError(rows, *scene.getStepForError());
    if (scene.getStepForFigure()) addStepForFigure(rows, *scene.getStepForFigure());
    rows.add("threads", scene.getNumberOfThreads());
    rows.add("grains", scene.particleHandler.getSize());
    if (const std::size_t bodies = scene.particleHandler.store().bodies.size(); bodies > 0)
        rows.add("rigid bodies", bodies);
    rows.add("walls", scene.wallHandler.present().size());
    const Vec3D g = scene.getGravity();
    rows.add("gravity", fmt::format("{} {} {}", g.x(), g.y(), g.z()), "m/s^2");
}

/// Whether one of these laws has springs that keep their stretch while their stiffness follows the
/// overlap.
/// @param friction names, joined by " + "
bool gainsByPressing(std::string_view friction) {
    const std::string names = fmt::format(" {} ", friction);
    for (const std::string_view law : {Mindlin::name, MindlinRollingTorsion::name, MindlinSecant::name})
        if (names.find(fmt::format(" {} ", law)) != names.npos) return true;
    return false;
}

void addLiquid(SummaryRows& rows, const Scene& scene) {
    const LiquidLedger ledger = scene.liquidLedger();
    rows.addNumber("liquid: films", ledger.films, "m^3");
    rows.addNumber("liquid: bridges", ledger.bridges, "m^3");
    rows.addNumber("liquid: wet walls", ledger.walls, "m^3");
    rows.addNumber("liquid: removed with grains", ledger.removed, "m^3");
    rows.addNumber("liquid: at the start", ledger.initial, "m^3");
    rows.addNumber("liquid: absorbed since", ledger.absorbed, "m^3");
    if (!scene.sprayHandler.isEmpty()) {
        rows.addNumber("liquid: emitted by sprays", ledger.emitted, "m^3");
        rows.addNumber("liquid: in flight", ledger.airborne, "m^3");
        rows.addNumber("liquid: lost by sprays", ledger.lost, "m^3");
    }
    if (scene.getEvaporation().dropletsEvaporate()) {
        rows.addNumber("liquid: evaporated", ledger.evaporated, "m^3");
        rows.add("bridges that have dried", scene.contacts().movingLiquid().driedBridges());
    }
    rows.addNumber("liquid unaccounted for", ledger.unaccounted(), "m^3");
    const PendularState state = pendularState(scene, false);
    rows.addNumber("share of the liquid in films", state.shareInFilms, "");
    rows.addNumber("bridges of a grain", state.bridgesOfAGrain, "");
    rows.addNumber("liquid over solid", state.liquidOverSolid, "");
    rows.addNumber("saturation at a density of 0.6", state.saturation(0.6), "");
}

void addHealth(SummaryRows& rows, const Scene& scene) {
    const auto& grains = scene.particleHandler.store();
    const ContactCounts contacts = scene.contacts().counts();
    double speed2 = 0;
    for (const TranslationRecord& grain : grains.translation)
        speed2 = std::max(speed2, squaredNorm(grain.velocity));
    rows.add("touching contacts", contacts.touching);
    rows.add("bridges", contacts.bridged);
    rows.add("lists of contacts made", scene.contacts().rebuildCount());
    if (scene.contacts().events().isListening()) {
        const ContactEventCounts counts = scene.contactEventCounts();
        rows.add("touches begun", counts.touchesBegun);
        rows.add("touches ended", counts.touchesEnded);
        rows.add("bridges formed", counts.bridgesFormed);
        rows.add("bridges ruptured", counts.bridgesRuptured);
    }
    if (scene.movesLiquid()) addLiquid(rows, scene);
    rows.addNumber("largest speed", std::sqrt(speed2), "m/s");
    rows.addNumber("kinetic energy", kineticEnergy(grains), "J");
    if (scene.keepsEnergyLedger() && gainsByPressing(scene.laws().friction))
        rows.add("note on friction",
                 "springs of Mindlin gain energy where contacts are pressed deeper (see energy: "
                 "lost_in_stiffening); those of MindlinIncremental do not");
}

void addDomain(SummaryRows& rows, const Scene& scene) {
    const OverlapWatch overlaps = scene.contacts().overlaps();
    rows.addNumber("largest overlap met", overlaps.largestOverlap(), "of the effective radius");
    rows.add("evaluations out of domain", overlaps.countAbove());
    if (scene.laws().hasLargestCapillaryNumber)
        rows.add("evaluations above the largest capillary number",
                 scene.contacts().capillaryNumbers().countAbove());
    if (hasBrokenLimits(scene)) rows.add("bridges out of domain now", bridgesOutOfDomain(scene));
}

void addTimes(SummaryRows& rows, const Scene& scene) {
    const StepTimes& times = scene.stepTimes();
    const double total = times.total();
    const auto seconds = times.seconds();
    rows.addNumber("wall time", total, "s");
    for (std::size_t part = 0; part < StepTimes::names.size(); ++part) {
        if (part == static_cast<std::size_t>(StepTimes::Part::Ledger) && !scene.keepsEnergyLedger()) continue;
        if (part == static_cast<std::size_t>(StepTimes::Part::Liquid) && !scene.movesLiquid()) continue;
        rows.addNumber(fmt::format("wall time: {}", StepTimes::names[part]), seconds[part], "s",
                       fmt::format(" ({:.1f} %)", 100 * seconds[part] / total));
    }
    // Of the first rank: the others need not be here.
    if (const RankCounts ranks = scene.rankCounts(); ranks.working > 0)
        rows.addNumber(
            "waiting for other ranks", ranks.waiting, "s",
            fmt::format(" ({:.1f} % of its steps)", 100 * ranks.waiting / (ranks.waiting + ranks.working)));
}

void addSpecies(SummaryRows& rows, const ContactLaws& laws) {
    rows.add("species", laws.name);
    for (std::size_t k = 0; k < laws.speciesCount(); ++k) {
        const auto owner = fmt::format("species {}", k);
        const auto index = static_cast<int>(k);
        const std::string_view type = laws.ofPair(index, index).name;
        if (type != laws.name) rows.add(owner, type);
        rows.add(owner + ": density", laws.density(k), "kg/m^3");
        for (const FieldValue& field : laws.fields(index, index))
            rows.add(fmt::format("{}: {}", owner, field.name), field.value, field.unit);
    }
}

SummaryRows rowsOf(const Scene& scene, bool isComplete) {
    SummaryRows rows;
    addRun(rows, scene, isComplete);
    addHealth(rows, scene);
    scene.addPartsTo(rows);
    addDomain(rows, scene);
    addTimes(rows, scene);
    return rows;
}

void writeFile(const Scene& scene, SummaryRows rows) {
    addSpecies(rows, scene.laws());
    addWarningsTo(rows, scene, false);
    CsvFile file(SummaryFile::pathOf(scene.getName()), "quantity,value,unit");
    rows.write(file);
    file.close();
}

}  // namespace

void RunSummary::prepare(Scene& scene) {
    scene.measureStepTimes();
    scene.leaveSummary(prints);
}

void RunSummary::write(const Scene& scene) {
    const Clock::time_point now = Clock::now();
    if (now < next) return;
    next = now + std::chrono::seconds(1);
    SummaryRows rows = rowsOf(scene, false);
    if (written)
        rows.addNumber("wall time since the summary before",
                       std::chrono::duration<double>(now - *written).count(), "s");
    written = now;
    writeFile(scene, std::move(rows));
}

/// What was warned of before is repeated with the summary; the rest is warned of now, for who reads warnings
/// alone (setLogSink()).
void RunSummary::complete(const Scene& scene) {
    const SummaryRows rows = rowsOf(scene, true);
    writeFile(scene, rows);
    if (!prints || scene.isQuiet()) return;
    std::string text = "Summary of the run\n" + rows.shown();
    const std::vector<RunWarning> warnings = domainWarnings(scene, true);
    for (const RunWarning& warning : warnings)
        if (scene.hasWarnedOf(warning.kind)) text += "Warning: " + warning.sentence + ".\n";
    writeToLog(text);
    scene.warnOnce(warnings);
}

}  // namespace pendular
