#include "Kernel/Laws/Species/SpeciesHandler.h"

namespace pendular {

void refuseSpeciesWithoutLaws(int number) {
    throw InputError(
        fmt::format("Species {} has no laws yet: it was added after the last mixAll().", number));
}

void refuseSpeciesNumber(std::ptrdiff_t number, std::size_t count) {
    throw InputError(
        fmt::format("There is no species {}; the scene has {} (counted from 0).", number, count));
}

void visitForm(StateArchive& archive, const SpeciesOwner& species) {
    if (species.grainsAreDiscs() || (archive.isReading() && archive.holds("discs")))
        archive.same("discs", species.grainsAreDiscs() ? 1.0 : 0.0);
}

}  // namespace pendular
