#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Kernel/Features/SpeciesByName/SeveralSpeciesHandler.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Mercury/MercuryBonds.h"
#include "Kernel/Mercury/MercuryBoundaries.h"
#include "Kernel/Mercury/MercuryHistories.h"
#include "Kernel/Mercury/MercuryRestart.h"
#include "Kernel/Mercury/MercuryWalls.h"

// A scene of a restart file of MercuryDPM's: each of these functions adds the objects of one kind. They throw
// InputError with the file, the line and the reason, where the kernel does not take one.

namespace pendular {

/// Throws InputError for a scene that has species: those of the file have numbers from 0 on.
void requireNoSpecies(const MercuryRestart& state, const SeveralSpeciesHandler& species);
/// The name of the run. One that leads out of the folder in which the program runs is cut to its last part,
/// with a warning: whoever wrote the file does not choose where this program writes.
std::string nameInFolder(const MercuryRestart& state, const Logger& logger);
void addSpeciesOf(const MercuryRestart& state, SeveralSpeciesHandler& species);
/// Returns the numbers of the walls. After the box is set.
std::vector<std::size_t> addWallsOf(const MercuryRestart& state, const SeveralSpeciesHandler& species,
                                    MercuryWallHandler& walls);
void addBoundariesOf(const MercuryRestart& state, MercuryBoundaryHandler& boundaries);
/// Returns the identities of the grains.
std::vector<std::uint32_t> addGrainsOf(const MercuryRestart& state, const SeveralSpeciesHandler& species,
                                       ParticleHandler& particles);
/// Throws InputError for a contact that is bridged and does not touch.
void requireTouchingBridges(const MercuryRestart& state);
/// The history of a contact, by the identities and the numbers that its bodies have here.
MercuryHistories::OfContact historyOf(const MercuryRestart::History& one,
                                      const std::vector<std::uint32_t>& grains,
                                      const std::vector<std::size_t>& walls);

}  // namespace pendular
