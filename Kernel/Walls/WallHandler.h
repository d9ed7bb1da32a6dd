#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "Kernel/InputError.h"
#include "Kernel/Walls/InfiniteWall.h"

namespace pendular {

/// The walls of a scene, by their numbers in the order of adding. Walls may be added and removed during a
/// run; numbers stay. A restart file does not hold shapes: the scene that goes on is set up with all walls
/// that the run had when it was written (restartTime() of the scene tells when that was), and removes those
/// that the run had removed by itself.
class WallHandler {
public:
    /// Adds a copy; the pointer stays valid until the wall is removed. In a run, a wall with a motion begins
    /// it now, from where it is; and a species that is set by the pointer holds from the next step on.
    template <class Shape>
    requires std::derived_from<Shape, Wall> Shape* copyAndAddObject(const Shape& wall) {
        if (wall.species < 0)
            throw InputError(
                fmt::format("wall {}: species is not set; call setSpecies() with a species of this scene.",
                            walls.size()));
        if (!wall.isSet())
            throw InputError(
                fmt::format("wall {}: its place is not set; call set() before it is added.", walls.size()));
        auto copy = std::make_unique<Shape>(wall);
        Shape* added = copy.get();
        if (isSet(now)) added->join(now);
        walls.push_back(std::move(copy));
        ++changes;
        return added;
    }
    /// Removes a wall; the numbers of all others stay. Throws InputError if there is none.
    void removeObject(std::size_t number) {
        if (number >= walls.size() || isRemoved(number))
            throw InputError(
                fmt::format("There is no wall {}; the scene has {} (counted from 0).", number, walls.size()));
        if (beforeRemoval) beforeRemoval(static_cast<int>(number));
        walls[number] = std::make_unique<RemovedWall>();
        ++changes;
    }
    /// Removes all walls, and begins again with number 0.
    void clear() {
        if (beforeRemoval)
            for (std::size_t w = 0; w < walls.size(); ++w) beforeRemoval(static_cast<int>(w));
        walls.clear();
        knownWalls = 0;
        ++changes;
    }
    /// Walls that there are and have been: numbers are less than this.
    [[nodiscard]] std::size_t getSize() const { return walls.size(); }
    [[nodiscard]] Wall& getObject(std::size_t number) const {
        if (number >= walls.size())
            throw InputError(
                fmt::format("There is no wall {}; the scene has {} (counted from 0).", number, walls.size()));
        return *walls[number];
    }
    [[nodiscard]] bool isRemoved(std::size_t number) const { return getObject(number).isRemoved(); }
    /// Called with the number of a wall before it is removed.
    void callBeforeRemoval(std::function<void(int)> function) { beforeRemoval = std::move(function); }
    /// Walls from this number on were added since changesAreKnown().
    [[nodiscard]] std::size_t firstNewWall() const { return knownWalls; }
    /// Whether walls were added or removed, have got another species, or are moved by other forces, since
    /// changesAreKnown().
    [[nodiscard]] bool hasChanges() const {
        return changes != knownChanges ||
               std::ranges::any_of(
                   walls, [](const auto& wall) { return wall->drive() && !wall->drive()->isChecked; }) ||
               !std::ranges::equal(walls, knownSpecies, {}, [](const auto& wall) { return wall->species; });
    }
    void changesAreKnown() {
        knownChanges = changes;
        knownWalls = walls.size();
        knownSpecies.clear();
        for (const auto& wall : walls) {
            knownSpecies.push_back(wall->species);
            if (PlaneDrive* const drive = wall->drive()) drive->isChecked = true;
        }
    }

    /// Moves all walls to where they are at a time (s); returns how far (m) any of their points can have
    /// moved.
    double moveTo(double time) {
        now = time;
        double farthest = 0;
        for (const auto& wall : walls) farthest = std::max(farthest, wall->moveTo(time));
        return farthest;
    }

    /// Walls that the run of a file had removed are removed, whether the scene was set up with them or not.
    void visitState(StateArchive& archive) {
        std::size_t count = walls.size();
        archive.value("count", count);
        for (std::size_t w = 0; archive.isReading() && w < count; ++w) takeRemoval(archive, w);
        archive.requireSame(count == walls.size(), "count", std::to_string(count),
                            std::to_string(walls.size()), {}, asTheRunHadThem);
        archive.value("time", now);
        archive.require(!std::isinf(now), "time", "is not finite");
        for (std::size_t w = 0; w < walls.size(); ++w)
            archive.group(std::to_string(w), [&] { walls[w]->visitState(archive); });
    }

private:
    static constexpr std::string_view asTheRunHadThem =
        "a scene that goes on is set up with the walls that the run had added by then; restartTime() tells "
        "the time of the file";

    /// Removes a wall, or counts one, that the run of a file had removed.
    void takeRemoval(StateArchive& archive, std::size_t number) {
        int species = -1;
        archive.group(std::to_string(number), [&] { archive.value("species", species); });
        if (species >= 0) return;
        if (number == walls.size()) walls.push_back(nullptr);
        if (number < walls.size()) walls[number] = std::make_unique<RemovedWall>();
    }

    /// In the place of a wall that was removed: nothing touches it.
    class RemovedWall final : public Wall {
    public:
        void listParts(const Vector<double>&, double, std::vector<std::uint32_t>&) const override {}
        void findPoints(const Vector<double>&, double, std::span<const std::uint32_t>,
                        std::span<WallPoint> points) const override {
            for (WallPoint& point : points) point = {{0, 0, 1}, infinity, {0, 0, 0}};
        }
        [[nodiscard]] bool isRemoved() const override { return true; }
    };

    std::vector<std::unique_ptr<Wall>> walls;
    std::function<void(int)> beforeRemoval;
    std::uint64_t changes = 0;  // additions and removals
    std::uint64_t knownChanges = 0;
    std::size_t knownWalls = 0;
    std::vector<int> knownSpecies;  // of each wall
    double now = unset;             // s; not a number before the run
};

}  // namespace pendular
