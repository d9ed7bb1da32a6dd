#include "Kernel/Features/Wear/WornWall.h"

#include <fmt/format.h>

namespace pendular {

std::vector<NumberedWornWall> wornWalls(const WallHandler& walls) {
    std::vector<NumberedWornWall> found;
    for (const auto& [number, wall] : walls.present())
        if (auto* const worn = dynamic_cast<WornWall*>(wall.get()); worn && worn->keepsWear())
            found.push_back({number, worn});
    return found;
}

void refuseWear(const WallHandler& walls, bool withAccount, bool withFriction) {
    for (const auto& [number, wall] : wornWalls(walls)) {
        if (!withAccount)
            throw InputError(fmt::format(
                "wall {}: it keeps its wear, and was added to a run without walls that wear and without an "
                "energy ledger, by which sliding is known; add it at set-up, or call keepEnergyLedger() "
                "there.",
                number));
        if (wall->wearLaw().needsFriction() && !withFriction)
            throw InputError(fmt::format(
                "wall {}: it wears by sliding, and the species of the scene have no friction; take one "
                "with a friction law, or Finnie's wear law.",
                number));
    }
}

}  // namespace pendular
