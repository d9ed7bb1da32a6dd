#include "Kernel/Core/Particles/OwnSpecies.h"

#include <fmt/format.h>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

void requireOwnSpecies(const GrainSpecies& ofScene, std::string_view whose, int index,
                       const SpeciesOwner* owner) {
    if (index >= 0 && owner == ofScene.owner()) return;
    throw InputError(
        fmt::format("{}: species is {}; call setSpecies() with a species of this scene, which "
                    "speciesHandler.copyAndAddObject() returns.",
                    whose, index < 0 ? "not set" : "one of another scene"));
}

}  // namespace pendular
