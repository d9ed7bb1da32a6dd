#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pendular {

/// Which contacts between two bodies that are held along all axes, or of such a grain with a wall, a scene
/// has. Their forces move nothing.
enum class HeldContacts {
    /// Where something needs them: heat, walls that forces move, walls whose forces are kept or that wear.
    WhereAsked,
    All,
    None
};

/// Of them, those that are listed.
struct ListedOfHeld {
    bool pairs = false;
    std::vector<std::size_t> walls;  // their numbers, in order

    [[nodiscard]] bool atWall(std::size_t wall) const { return std::ranges::binary_search(walls, wall); }
    [[nodiscard]] bool any() const { return pairs || !walls.empty(); }
    friend bool operator==(const ListedOfHeld&, const ListedOfHeld&) = default;
};

}  // namespace pendular
