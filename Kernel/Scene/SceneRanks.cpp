#include <fmt/format.h>

#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Features/EnergyLedger/GrainSums.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Base/SilentRank.h"
#include "Kernel/Scene/RankAgreement.h"
#include "Kernel/Scene/SceneInside.h"

// A scene that several ranks share.

namespace pendular {

void Scene::Inside::gather() {
    if (!isDistributed()) return;
    scene.particleHandler.finishStep();
    if (scene.hasBegun()) takeOverChanges();
    const bool areAsked = wereUnlistedAskedFor();
    contacts.gather(scene.particleHandler.store());
    if (areAsked) scene.warnOfUnlistedContacts();
}

bool Scene::Inside::wereUnlistedAskedFor() {
    return contacts.hasHeldGrains() && contacts.ranks().any(std::exchange(unlistedAreAskedFor, false));
}

void Scene::Inside::onFirstRank(const std::function<void()>& write) {
    if (!isDistributed()) {
        if (!isSilentRank()) write();
        return;
    }
    scene.particleHandler.finishStep();
    if (scene.hasBegun()) takeOverChanges();
    const bool areAsked = wereUnlistedAskedFor();
    contacts.withAllOnFirst(scene.particleHandler.store(), [&] {
        if (areAsked) scene.warnOfUnlistedContacts();
        write();
    });
}

static std::string_view nameOf(HeldContacts which) {
    constexpr std::array<std::string_view, 3> names{"WhereAsked", "All", "None"};
    return names[static_cast<std::size_t>(which)];
}

/// The numbers of those walls for which a condition holds.
template <class Condition>
static std::string listOfWalls(const WallHandler& walls, Condition&& isListed) {
    std::string list;
    for (const auto& [number, wall] : walls.present())
        if (isListed(*wall))
            fmt::format_to(std::back_inserter(list), "{}{}", list.empty() ? "" : ", ", number);
    return list.empty() ? "empty" : list;
}

/// All ranks sum these forces together.
static constexpr std::string_view listOfKept = "the list of walls whose forces are kept";
static std::string wallsThatKeepForces(const WallHandler& walls) {
    return listOfWalls(walls, [](const Wall& wall) { return wall.keepsForces(); });
}

/// What hooks can change at any time.
void Scene::Inside::visitStep(StateArchive& archive) {
    archive.same("the number of steps done", context.number);
    archive.same("the number of steps that step() is to do", scene.stepsToCome());
    archive.same("the time step", context.length, "s");
    archive.sameRecord<double>("gravity", context.gravity, "m/s^2");
    archive.same("setHeldContacts()", nameOf(contacts.getHeldContacts()));
    archive.same(listOfKept, wallsThatKeepForces(scene.wallHandler));
}

std::uint64_t Scene::Inside::hashOfStep() {
    return hashOf([this](StateArchive& archive) { visitStep(archive); });
}

void Scene::Inside::visitSettings(StateArchive& archive) {
    archive.group("species", [&] { laws().visitState(archive, speciesChanged); });
    // Named before their states, which would be those of other walls where one is missing.
    archive.same("the list of walls", listOfWalls(scene.wallHandler, [](const Wall&) { return true; }));
    archive.group("walls", [&] { scene.wallHandler.visitState(archive); });
    archive.group("parts", [&] { parts.compareSetUps(archive, context); });
    // These two may be set again in a run.
    archive.group("flow", [&] { flow.visitSetting(archive, context); });
    archive.group("adaptiveStep", [&] { adaptive.visitSetting(archive, context); });
}

void Scene::Inside::visitSetUp(StateArchive& archive) {
    scene.visitSteps(archive);
    scene.visitDecisions(archive);
    archive.same("integrator", description(integrator));
    archive.same(listOfKept, wallsThatKeepForces(scene.wallHandler));
    visitSurroundings(archive);
    visitSettings(archive);
    archive.same("energyLedger", account.isKept() ? "kept" : "not kept");
    archive.same("acceptedOverlap", acceptedOverlap);
    archive.same("gapOfFirstBridges", gapOfFirstBridges, "m");
}

void Scene::Inside::refuseDifference(const std::string& difference, bool isSetUp) const {
    const std::string where = isSetUp ? "At set-up"
                                      : fmt::format("At time {:.6g} s, after {} steps,", scene.getTime(),
                                                    scene.getNumberOfTimeSteps());
    const std::string sentence = fmt::format(
        "{} the ranks do not agree: {}; set up the same scene on all ranks, and let the hooks of all make "
        "the "
        "same changes and decisions.",
        where, difference.empty() ? "the difference has no name" : difference);
    if (isSetUp) throw InputError(sentence);
    throw RunError(sentence);
}

double Scene::Inside::agreeOnDecisions(double own) {
    const ToAgreeOn visit = [this](StateArchive& archive) { scene.visitDecisions(archive); };
    const GrainSharing::OfAll all = sharing->agree(Reduction::Decisions, hashOf(visit), own);
    if (!all.areAlike) refuseDifference(differenceOfRanks(*sharing, visit));
    return all.shift;
}

void Scene::Inside::agreeOnSettings() {
    if (!sharing) return;
    if (!isDistributed()) return agreeOnAll();
    // Long tables are shapes, which no hook changes.
    constexpr std::size_t largestTable = 256;  // bytes
    const ToAgreeOn visit = [this](StateArchive& archive) { visitSettings(archive); };
    if (!sharing->agree(Reduction::SetUp, hashOf(visit, largestTable)).areAlike)
        refuseDifference(differenceOfRanks(*sharing, visit));
}

void Scene::Inside::agreeAtList() {
    if (!isDistributed() || contacts.rebuildCount() == listsAgreed) return;
    listsAgreed = contacts.rebuildCount();
    agreeOnSettings();
}

void Scene::Inside::agreeOnAll(bool isSetUp) {
    ParticleStore& grains = scene.particleHandler.store();
    const ToAgreeOn visit = [this](StateArchive& archive) { visitSetUp(archive); };
    if (!sharing->agree(Reduction::SetUp, hashOf(visit)).areAlike)
        refuseDifference(differenceOfRanks(*sharing, visit), isSetUp);
    if (!sharing->agree(Reduction::SetUp, hashOfGrains(grains)).areAlike)
        refuseDifference(differenceOfGrains(*sharing, grains), isSetUp);
}

RunNumbers Scene::Inside::numbersOfAll() {
    const ParticleStore& grains = scene.particleHandler.store();
    RunNumbers own{grains.count(), 0, kineticEnergy(grains)};
    // A contact of two ranks counts where its first body is.
    contacts.forEachActing(grains, [&](const Bucket&, std::uint32_t) { ++own.contacts; });
    RunNumbers all;
    for (const RunNumbers& one : sharing->ofAll(own)) {
        all.grains += one.grains;
        all.contacts += one.contacts;
        all.kineticEnergy += one.kineticEnergy;
    }
    return all;
}

}  // namespace pendular
