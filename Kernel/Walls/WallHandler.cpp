#include "Kernel/Walls/WallHandler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "Kernel/Base/InputError.h"
#include "Kernel/State/StateArchive.h"

namespace pendular {
namespace {

constexpr std::string_view asTheRunHadThem =
    "a scene that goes on is set up with the walls that the run had added by then; restartTime() tells "
    "the time of the file";

/// A wall in the place of one that was removed: nothing touches it.
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
    walls.push_back(std::move(wall));
    ++changes;
}

void WallHandler::keepForces() {
    keepsForces = true;
    for (const auto& wall : walls) wall->keepForcesFromNowOn();
}

void WallHandler::refuseNumber(std::size_t number) const {
    if (number < walls.size()) throw InputError(fmt::format("Wall {} was removed.", number));
    throw InputError(
        fmt::format("There is no wall {}; the scene has {} (counted from 0).", number, walls.size()));
}

void WallHandler::removeObject(std::size_t number) {
    if (number >= walls.size() || isRemoved(number)) refuseNumber(number);
    if (beforeRemoval) beforeRemoval(static_cast<int>(number));
    walls[number] = std::make_unique<RemovedWall>();
    ++changes;
}

void WallHandler::clear() {
    if (beforeRemoval)
        for (std::size_t w = 0; w < walls.size(); ++w) beforeRemoval(static_cast<int>(w));
    walls.clear();
    knownWalls = 0;
    ++changes;
}

bool WallHandler::hasChanges() const {
    return changes != knownChanges ||
           std::ranges::any_of(walls,
                               [](const auto& wall) {
                                   return (wall->drive() && !wall->drive()->isChecked) ||
                                          (wall->body() && !wall->body()->isChecked);
                               }) ||
           !std::ranges::equal(walls, knownSpecies, {},
                               [](const auto& wall) { return wall->getSpeciesIndex(); });
}

void WallHandler::changesAreKnown() {
    knownChanges = changes;
    knownWalls = walls.size();
    knownSpecies.clear();
    for (const auto& wall : walls) {
        knownSpecies.push_back(wall->getSpeciesIndex());
        if (PlaneDrive* const drive = wall->drive()) drive->isChecked = true;
        if (WallBody* const body = wall->body()) body->isChecked = true;
    }
}

double WallHandler::moveTo(double time) {
    now = time;
    double farthest = 0;
    for (const auto& wall : walls) farthest = std::max(farthest, wall->moveTo(time));
    return farthest;
}

void WallHandler::visitState(StateArchive& archive) {
    std::size_t count = walls.size();
    archive.value("count", count);
    for (std::size_t w = 0; archive.isReading() && w < count; ++w) takeRemoval(archive, w);
    archive.requireSame(count == walls.size(), "count", std::to_string(count), std::to_string(walls.size()),
                        {}, asTheRunHadThem);
    archive.value("time", now);
    archive.require(!std::isinf(now), "time", "is not finite");
    for (std::size_t w = 0; w < walls.size(); ++w)
        archive.group(std::to_string(w), [&] { walls[w]->visitState(archive); });
}

void WallHandler::takeRemoval(StateArchive& archive, std::size_t number) {
    int species = -1;
    archive.group(std::to_string(number), [&] { archive.value("species", species); });
    if (species >= 0) return;
    if (number == walls.size()) walls.push_back(nullptr);
    if (number < walls.size()) walls[number] = std::make_unique<RemovedWall>();
}

}  // namespace pendular
