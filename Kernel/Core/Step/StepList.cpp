#include "Kernel/Core/Step/StepList.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

void StepList::add(std::unique_ptr<StepPart> part) {
    const auto hasItsName = [&](const StepPart* other) { return other->name() == part->name(); };
    if (part->name().empty())
        throw InputError("Simulation: a part of the step has no name; give it one of its own.");
    if (std::ranges::any_of(parts, hasItsName))
        throw InputError(fmt::format(
            "Simulation: two parts of the step have the name '{}'; give each one of its own.", part->name()));
    parts.push_back(part.get());
    own.push_back(std::move(part));
}

bool StepList::hasOwn(std::string_view name) const {
    return std::ranges::any_of(own, [&](const auto& part) { return part->name() == name; });
}

Features StepList::wake(const StepContext& context) {
    Features all;
    awake.clear();
    finishEachStep = false;
    for (StepPart* const part : parts) {
        const Features found = part->features(context);
        if (found.isEmpty()) continue;
        all.add(found);
        awake.push_back(part);
        finishEachStep |= part->needsFinishedStep();
    }
    return all;
}

Features StepList::features(const StepContext& context) const {
    Features all;
    for (const StepPart* const part : parts) all.add(part->features(context));
    return all;
}

/// Parts of drivers that do not go together, by their names.
struct PartsConflict {
    std::string_view one, other, why;
};
static constexpr std::array conflictsOfParts{
    PartsConflict{"copies of grains", "bonds", "copies of bonded grains have no bonds"},
    PartsConflict{"copies of grains", "prescribed paths",
                  "a grain that goes through a face is another one from then on, without the path"}};

static void refuseParts(const std::set<std::string_view>& names) {
    for (const PartsConflict& conflict : conflictsOfParts)
        if (names.contains(conflict.one) && names.contains(conflict.other))
            throw InputError(fmt::format(
                "Simulation: {} and {} cannot be combined: {}; leave one of them out, or take setPeriodic().",
                conflict.one, conflict.other, conflict.why));
}

void StepList::refuseOwnConflicts(const Features& scene) const {
    std::set<std::string_view> names;
    for (const auto& part : own) {
        if (std::ranges::find(awake, part.get()) == awake.end()) continue;
        names.insert(part->name());
        Features named = scene;
        named.add(Feature::OwnPart, std::string(part->name()));
        refuseConflicts(named, part->ownConflicts());
        if (!part->actsOnRanks()) refuseConflicts(named, conflictsOfRanks());
    }
    refuseParts(names);
}

void StepList::check(const StepContext& context) const {
    for (StepPart* const part : awake) part->check(context);
}

void StepList::begin(StepContext& context, bool isRestarted) const {
    for (StepPart* const part : parts) part->begin(context, isRestarted);  // also of those that sleep
}

void StepList::takeOver(StepContext& context, const SceneChanges& changes) const {
    for (StepPart* const part : awake) part->takeOver(context, changes);
}

void StepList::takeBack(StepContext& context) const {
    for (auto part = awake.rbegin(); part != awake.rend(); ++part) (*part)->takeBack(context);
}

void StepList::visitSettings(StateArchive& archive, StepContext& context) const {
    for (StepPart* const part : parts)
        archive.group(part->name(), [&] { part->visitSetting(archive, context); });
}

void StepList::visitStates(StateArchive& archive, StepContext& context) const {
    std::vector<std::string_view> names;
    for (const auto& part : own) names.push_back(part->name());
    archive.same("partsOfTheDriver", fmt::format("{}", fmt::join(names, ", ")));
    for (StepPart* const part : parts)
        archive.group(part->name(), [&] {
            part->compareSetUp(archive, context);
            part->visitState(archive, context);
        });
}

void StepList::compareSetUps(StateArchive& archive, StepContext& context) const {
    for (StepPart* const part : parts)
        archive.group(part->name(), [&] { part->compareSetUp(archive, context); });
}

std::vector<std::string_view> StepList::names() const {
    std::vector<std::string_view> all;
    for (const StepPart* const part : parts) all.push_back(part->name());
    return all;
}

void StepList::addTo(SummaryRows& rows) const {
    for (const StepPart* const part : awake) part->addTo(rows);
}

}  // namespace pendular
