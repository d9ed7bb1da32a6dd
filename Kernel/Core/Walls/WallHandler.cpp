#include "Kernel/Core/Walls/WallHandler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {
namespace {

constexpr std::string_view asTheRunHadThem =
    "a scene that goes on is set up with the walls that the run had added by then; restartTime() tells "
    "the time of the file";

/// Stands for all walls that were removed: nothing touches it.
class RemovedWall final : public Wall {
public:
    void listParts(const Vector<double>&, double, std::vector<std::uint32_t>&) const override {}
    void findPoints(const Vector<double>&, double, std::span<const std::uint32_t>,
                    std::span<WallPoint> points) const override {
        for (WallPoint& point : points) point = {{0, 0, 1}, infinity, {0, 0, 0}};
    }
    [[nodiscard]] bool isRemoved() const override { return true; }
};

}  // namespace

void WallHandler::requireComplete(const Wall& wall, bool isPlaced) const {
    if (wall.getSpeciesIndex() < 0)
        throw InputError(fmt::format(
            "wall {}: species is not set; call setSpecies() with a species of this scene.", walls.size()));
    if (!isPlaced)
        throw InputError(
            fmt::format("wall {}: its place is not set; call set() before it is added.", walls.size()));
}

void WallHandler::add(std::unique_ptr<Wall> wall) {
    if (keepsForces) wall->keepForcesFromNowOn();
    // It may be a copy of a wall that another scene repeats.
    if (auto* const repeated = dynamic_cast<RepeatedWall*>(wall.get())) repeated->repeat({0, 0, 0});
    existing.push_back({walls.size(), std::move(wall)});
    walls.push_back(existing.back().object.get());
    areOthers = true;
}

void WallHandler::keepForces() {
    keepsForces = true;
    for (const PresentWall& wall : existing) wall.object->keepForcesFromNowOn();
}

void WallHandler::refuseNumber(std::size_t number) const {
    if (number < walls.size()) throw InputError(fmt::format("Wall {} was removed.", number));
    throw InputError(
        fmt::format("There is no wall {}; the scene has {} (counted from 0).", number, walls.size()));
}

void WallHandler::removeObject(std::size_t number) {
    if (number >= walls.size() || isRemoved(number)) refuseNumber(number);
    if (beforeRemoval) beforeRemoval(static_cast<int>(number));
    remove(number);
}

void WallHandler::remove(std::size_t number) {
    walls[number] = standIn();
    existing.erase(std::ranges::lower_bound(existing, number, {}, &PresentWall::number));
    areOthers = true;
}

Wall* WallHandler::standIn() {
    if (!removed) removed = std::make_unique<RemovedWall>();
    return removed.get();
}

void WallHandler::clear() {
    if (beforeRemoval)
        for (const PresentWall& wall : existing) beforeRemoval(static_cast<int>(wall.number));
    walls.clear();
    existing.clear();
    knownWalls = 0;
    areOthers = true;
}

bool WallHandler::hasChanges() const {
    return areOthers ||
           std::ranges::any_of(existing,
                               [](const PresentWall& wall) {
                                   const PlaneDrive* const drive = wall.object->drive();
                                   const WallBody* const body = wall.object->body();
                                   return (drive && !drive->isChecked) || (body && !body->isChecked);
                               }) ||
           !std::ranges::equal(existing, knownSpecies, {},
                               [](const PresentWall& wall) { return wall.object->getSpeciesIndex(); });
}

void WallHandler::changesAreKnown() {
    areOthers = false;
    knownWalls = walls.size();
    knownSpecies.clear();
    for (const auto& [number, wall] : existing) {
        knownSpecies.push_back(wall->getSpeciesIndex());
        if (PlaneDrive* const drive = wall->drive()) drive->isChecked = true;
        if (WallBody* const body = wall->body()) body->isChecked = true;
    }
}

double WallHandler::moveTo(double time) {
    now = time;
    double farthest = 0;
    // By index: a motion function that adds walls, or removes others, must not invalidate the loop.
    for (std::size_t k = 0; k < existing.size(); ++k)
        farthest = std::max(farthest, existing[k].object->moveTo(time));
    return farthest;
}

void WallHandler::visitState(StateArchive& archive) {
    std::size_t count = walls.size();
    archive.value("count", count);
    const std::size_t removals = visitRemovals(archive, count);
    const auto requireSame = [&](std::string_view what, std::size_t kept, std::size_t present) {
        archive.requireSame(kept == present, what, std::to_string(kept), std::to_string(present), {},
                            asTheRunHadThem);
    };
    requireSame("count", count, walls.size());
    requireSame("removed", removals, walls.size() - existing.size());
    archive.value("time", now);
    archive.require(!std::isinf(now), "time", "is not finite");
    for (const PresentWall& wall : existing)
        archive.group(std::to_string(wall.number), [&] { wall.object->visitState(archive); });
}

/// A file of an earlier version has removed walls among the others, with the species -1.
static std::vector<std::uint32_t> withoutSpecies(StateArchive& archive, std::size_t count) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t w = 0; w < count; ++w) {
        int species = -1;
        archive.group(std::to_string(w), [&] { archive.value("species", species); });
        if (species < 0) numbers.push_back(w);
    }
    return numbers;
}

std::size_t WallHandler::visitRemovals(StateArchive& archive, std::size_t count) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t w = 0; w < walls.size(); ++w)
        if (isRemoved(w)) numbers.push_back(w);
    if (archive.isReading() ? archive.holds("removed") : !numbers.empty())
        archive.column<std::uint32_t>("removed", numbers);
    else if (archive.isReading()) numbers = withoutSpecies(archive, count);
    archive.require(std::ranges::adjacent_find(numbers, std::ranges::greater_equal{}) == numbers.end() &&
                        (numbers.empty() || numbers.back() < count),
                    "removed", "has not the numbers of walls in their order");
    if (archive.isReading())
        for (const std::uint32_t number : numbers) takeRemoval(number);
    return numbers.size();
}

void WallHandler::takeRemoval(std::size_t number) {
    if (number == walls.size()) walls.push_back(standIn());
    else if (number < walls.size() && !isRemoved(number)) remove(number);
}

}  // namespace pendular
