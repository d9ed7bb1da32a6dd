#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/DriftWatch.h"

namespace pendular {

/// How long a list of contacts holds all bodies that can act on each other. It is over when bodies can have
/// approached by its skin. Two bounds say so: the sum of what the fastest bodies can have approached in each
/// step, which costs nothing, and, when that is spent, how grains have really come (DriftWatch). The second
/// bound is for scenes on one rank whose images do not move; elsewhere the first one stands alone.
class ListLife {
public:
    /// Which grains are near a wall when contacts are listed.
    struct NearWalls {
        double farther = 0;  // m, beyond the skin: other grains are farther than that from all walls
        double times = 1;    // 2 where a bridge may form on a part near those that are listed: half the skin
        std::vector<std::uint8_t> flags;  // of each place; none where there are no walls
    };

    /// There is no list yet.
    void reset() { *this = {}; }

    /// Contacts were listed.
    /// @param range m, at which bodies are listed beside the skin (m)
    /// @param watches how grains come
    void begin(const ParticleStore& grains, const PeriodicBox& box, double range, double listSkin,
               bool watches, NearWalls grainsNearWalls, int threads = 1) {
        skin = left = listSkin;
        unseen = wallsMoved = approached = 0;
        nearWalls = std::move(grainsNearWalls);
        if (watches) drift.begin(grains, box, range + skin, threads);
        else drift.end();
    }

    /// In a step, two bodies can have approached by so much (m), and walls have moved.
    void move(double approach, double wallShift) {
        unseen += approach;
        lastMove = approach;
        wallsMoved += wallShift;
    }

    /// m, by which bodies may certainly approach until one that is not listed can act.
    [[nodiscard]] double rest() const { return left - unseen; }

    /// Whether the list may lack bodies that act, or soon. It looks at all grains where rest() is spent.
    [[nodiscard]] bool isOver(const ParticleStore& grains, int threads = 1) {
        if (rest() > 0) return false;
        if (!look(grains, threads)) {
            approached = unseen + approached;
            return true;
        }
        return !(left > worthALook * skin);
    }
    /// Whether the list has all bodies that are not farther apart than this (m). It looks at all grains where
    /// rest() is less.
    [[nodiscard]] bool reaches(double gap, const ParticleStore& grains, int threads = 1) {
        return gap <= rest() || (gap <= skin && look(grains, threads) && gap <= rest());
    }
    /// m, with which contacts were listed.
    [[nodiscard]] double width() const { return skin; }
    /// m, by which bodies that are not listed can have approached when isOver() was asked last.
    [[nodiscard]] double approach() const { return approached; }

    /// Another grain has come to a place.
    void forget(std::uint32_t place) { drift.forget(place); }
    /// The grain at a place has gone through a face, behind which walls may be near.
    void noteNearWall(std::uint32_t place) {
        if (place < nearWalls.flags.size()) nearWalls.flags[place] = 1;
    }

private:
    /// Finds rest() by how grains have really come; false where that is not known.
    bool look(const ParticleStore& grains, int threads) {
        if (!drift.knows() || lastMove > skin) return false;
        const DriftWatch::Drift found = drift.drift(grains, nearWalls.flags, threads);
        approached = found.approach;
        if (!nearWalls.flags.empty())
            approached = std::max({approached, nearWalls.times * found.atWalls + wallsMoved,
                                   nearWalls.times * found.farthest + wallsMoved - nearWalls.farther});
        left = std::min(skin - approached, 2 * (drift.reach() - found.farthest));
        unseen = 0;
        return true;
    }

    static constexpr double worthALook = 0.1;  // of the skin

    double skin = 0, left = 0;  // m
    double unseen = 0;          // m, that bodies can have approached since grains were looked at
    double lastMove = 0;        // m, of it in the last step
    double wallsMoved = 0;      // m, since contacts were listed
    double approached = 0;      // m
    NearWalls nearWalls;
    DriftWatch drift;
};

}  // namespace pendular
