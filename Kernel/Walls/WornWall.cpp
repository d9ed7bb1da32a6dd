#include "Kernel/Walls/WornWall.h"

#include <fmt/format.h>

namespace pendular {

std::vector<WornWall*> wornWalls(const WallHandler& walls) {
    std::vector<WornWall*> found(walls.getSize());
    for (std::size_t w = 0; w < found.size(); ++w)
        if (auto* const wall = dynamic_cast<WornWall*>(&walls.getObject(w)); wall && wall->keepsWear())
            found[w] = wall;
    return found;
}

void refuseWear(const WallHandler& walls, bool withAccount, bool withFriction) {
    const std::vector<WornWall*> worn = wornWalls(walls);
    for (std::size_t w = 0; w < worn.size(); ++w) {
        if (!worn[w]) continue;
        if (!withAccount)
            throw InputError(fmt::format(
                "wall {}: it keeps its wear, and was added to a run without walls that wear and without an "
                "energy ledger, by which sliding is known; add it at set-up, or call keepEnergyLedger() "
                "there.",
                w));
        if (worn[w]->wearLaw().needsFriction() && !withFriction)
            throw InputError(fmt::format(
                "wall {}: it wears by sliding, and the species of the scene have no friction; take one "
                "with a friction law, or Finnie's wear law.",
                w));
    }
}

}  // namespace pendular
