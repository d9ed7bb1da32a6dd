#include "Kernel/Scene/DomainWarnings.h"

#include <fmt/format.h>

#include <utility>

#include "Kernel/Core/Contacts/CapillaryWatch.h"
#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Scene/PendularState.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/SceneDomain.h"

namespace pendular {

namespace {

std::vector<BrokenLimit> broken(const Scene& scene) {
    if (scene.contacts().rebuildCount() == 0) return {};  // not begun: species are not mixed
    return brokenLimits(scene.laws(), {scene.particleHandler.store(), scene.laws().speciesCount()},
                        scene.wallHandler);
}

}  // namespace

std::optional<RunWarning> overlapWarning(const OverlapWatch& overlaps, const OverlapLimit& limit) {
    if (overlaps.countAbove() == 0) return {};
    return RunWarning{
        kindOfOverlapWarning,
        fmt::format(
            "{}: overlaps were above {} of the effective radius in {} evaluations of contacts and the "
            "largest was {:.3g}; take stiffer grains or lower speeds and loads",
            limit.law, limit.largest, overlaps.countAbove(), overlaps.largestOverlap())};
}

RunWarning warningOf(const BrokenLimit& broken) {
    const bool isLow = broken.limit.value < broken.limit.range.highest;
    return {fmt::format("{} {} {}", broken.law, broken.limit.quantity, isLow ? "low" : "high"),
            broken.text()};
}

std::size_t bridgesOutOfDomain(const Scene& scene) {
    return countBridgesOutOfDomain(scene.contacts(), scene.laws(), scene.particleHandler.store());
}
bool hasBrokenLimits(const Scene& scene) { return !broken(scene).empty(); }

std::vector<RunWarning> domainWarnings(const Scene& scene, bool withMeetingBridges) {
    std::vector<RunWarning> found;
    if (auto overlap = overlapWarning(scene.contacts().overlaps(), scene.laws().overlapLimit))
        found.push_back(std::move(*overlap));
    const CapillaryWatch numbers = scene.contacts().capillaryNumbers();
    if (numbers.countAbove() > 0)
        found.push_back({"capillary number",
                         fmt::format("bridges were drawn at capillary numbers above the "
                                     "largestCapillaryNumber of their law in {} evaluations and the largest "
                                     "was {:.3g}; they may have ruptured too early: set "
                                     "largestCapillaryNumber to at least that",
                                     numbers.countAbove(), numbers.largestNumber())});
    for (const BrokenLimit& limit : broken(scene)) {
        RunWarning warning = warningOf(limit);
        warning.sentence += fmt::format(" ({} bridges now out of its domain)", bridgesOutOfDomain(scene));
        found.push_back(std::move(warning));
    }
    if (scene.movesLiquid())
        for (RunWarning& warning : pendularState(scene, withMeetingBridges).kindsOfWarnings())
            found.push_back(std::move(warning));
    return found;
}

void addWarningsTo(SummaryRows& rows, const Scene& scene, bool withMeetingBridges) {
    for (const std::string& warning : scene.logger.warnings()) rows.add("warning", warning);
    for (const RunWarning& warning : domainWarnings(scene, withMeetingBridges))
        rows.add("warning", warning.sentence);
}

}  // namespace pendular
