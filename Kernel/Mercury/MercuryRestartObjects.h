#pragma once

#include <cstdint>
#include <unordered_map>

#include "Kernel/Mercury/MercuryRestart.h"
#include "Kernel/Mercury/MercuryRestartLines.h"

namespace pendular {

/// Reads the objects of a restart file of MercuryDPM's, one of a line, into a MercuryRestart. All functions
/// throw InputError, with the line, for what is not taken over.
class MercuryRestartObjects {
public:
    explicit MercuryRestartObjects(MercuryRestart& of) : state(&of) {}

    /// Adds a species, or a pair of two; returns whether it was a species.
    bool addSpecies(const MercuryRestartLines& lines);
    /// All species have been added; a line of a species without the mark of a pair is one, too.
    void onlyPairsFollow() { allSpeciesAreThere = true; }
    [[nodiscard]] bool isOfSpecies(const MercuryRestartLines& lines) const;
    void addWall(const MercuryRestartLines& lines);
    void addBoundary(const MercuryRestartLines& lines);
    void addGrain(const MercuryRestartLines& lines);
    void addInteraction(const MercuryRestartLines& lines);
    /// Called behind the last line.
    void finish();

private:
    /// The species and grains of the versions 2 and 3, which have few names.
    void addOldSpecies(const MercuryRestartLines& lines);
    void addOldGrain(const MercuryRestartLines& lines);
    [[nodiscard]] bool isOld() const { return state->version == "2" || state->version == "3"; }

    using Places = std::unordered_map<std::uint64_t, std::size_t>;

    MercuryRestart* state;
    Places placesOfGrains, placesOfWalls;  // by their ids there
    bool allSpeciesAreThere = false;
};

}  // namespace pendular
