#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Core/Walls/InfiniteWall.h"

namespace pendular {

/// A wall that is there, with its number.
struct PresentWall {
    std::size_t number;
    std::unique_ptr<Wall> object;
};

/// The walls of a scene, by their numbers in the order of adding. Walls may be added and removed during a
/// run; numbers stay. Of a removed wall only a pointer is left, and loops over present() skip it. A restart
/// file does not hold shapes: the scene that goes on is set up with all walls that the run had when it was
/// written (restartTime() of the scene tells when that was), and removes those that the run had removed by
/// itself.
class WallHandler {
public:
    /// Adds a copy; the pointer stays valid until the wall is removed. In a run, a wall with a motion begins
    /// it now, from where it is; and a species that is set by the pointer holds from the next step on.
    template <class Shape>
    requires std::derived_from<Shape, Wall> Shape* copyAndAddObject(const Shape& wall) {
        requireComplete(wall, wall.isSet());
        auto copy = std::make_unique<Shape>(wall);
        Shape* added = copy.get();
        if (isSet(now)) added->join(now);
        add(std::move(copy));
        return added;
    }
    /// Removes a wall; the numbers of all others stay. Throws InputError if there is none.
    void removeObject(std::size_t number);
    /// Removes all walls, and begins again with number 0.
    void clear();
    /// Walls that there are and have been: numbers are less than this.
    [[nodiscard]] std::size_t getSize() const { return walls.size(); }
    /// A wall that was removed is one that nothing touches, whose isRemoved() is true.
    [[nodiscard]] Wall& getObject(std::size_t number) const {
        if (number >= walls.size()) refuseNumber(number);
        return *walls[number];
    }
    /// The walls that were not removed, in the order of their numbers. Adding or removing one invalidates the
    /// span.
    [[nodiscard]] std::span<const PresentWall> present() const { return existing; }
    [[nodiscard]] bool isRemoved(std::size_t number) const { return getObject(number).isRemoved(); }
    /// Keeps the forces on all walls (Wall::keepForces()), and on those that are added from now on.
    void keepForces();
    /// Called with the number of a wall before it is removed.
    void callBeforeRemoval(std::function<void(int)> function) { beforeRemoval = std::move(function); }
    /// Walls from this number on were added since changesAreKnown().
    [[nodiscard]] std::size_t firstNewWall() const { return knownWalls; }
    /// Whether walls were added or removed, have got another species, or are moved by other forces, since
    /// changesAreKnown().
    [[nodiscard]] bool hasChanges() const;
    void changesAreKnown();

    /// Moves all walls to where they are at a time (s); returns how far (m) any of their points can have
    /// moved.
    double moveTo(double time);

    /// Walls that the run of a file had removed are removed, whether the scene was set up with them or not.
    void visitState(StateArchive& archive);

private:
    /// Throws InputError unless a wall can be added as it is.
    void requireComplete(const Wall& wall, bool isPlaced) const;
    void add(std::unique_ptr<Wall> wall);
    /// Leaves the number to what stands for all removed walls.
    void remove(std::size_t number);
    [[noreturn]] void refuseNumber(std::size_t number) const;
    [[nodiscard]] Wall* standIn();
    /// Returns how many there are, in the file that is read.
    std::size_t visitRemovals(StateArchive& archive, std::size_t count);
    /// Removes a wall, or counts one, that the run of a file had removed.
    void takeRemoval(std::size_t number);

    std::vector<Wall*> walls;  // by number
    std::function<void(int)> beforeRemoval;
    bool keepsForces = false;       // of all walls
    bool areOthers = false;         // walls were added or removed since changesAreKnown()
    std::unique_ptr<Wall> removed;  // stands for all that were removed
    std::size_t knownWalls = 0;
    std::vector<PresentWall> existing;
    std::vector<int> knownSpecies;  // of each of these
    double now = unset;             // s; not a number before the run
};

}  // namespace pendular
