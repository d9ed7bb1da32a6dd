#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "Kernel/Core/Run/RunWarning.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

/// The numbers that tell whether the liquid of a scene is in the pendular state, in which bridges are
/// separate: the model of liquid that moves is made for no other one.
struct PendularState {
    double liquidOverSolid = 0;   // volume of films and bridges over that of grains and rigid bodies
    double shareInFilms = 0;      // of films and bridges together
    double bridgesOfAGrain = 0;   // twice the bridges over the grains; a rigid body is one
    bool bridgesForm = false;     // some pair of species has a V_max above 0
    std::size_t thickFilms = 0;   // grains whose film is thicker than 0.1 of their radius
    double overlappingShare = 0;  // of all bridges: those that meet another one at a grain

    /// Share of the pores that liquid fills, where grains fill this share of the space.
    [[nodiscard]] double saturation(double solidFraction) const {
        return liquidOverSolid * solidFraction / (1 - solidFraction);
    }
    [[nodiscard]] std::vector<RunWarning> kindsOfWarnings() const;
    /// Their sentences, without commas.
    [[nodiscard]] std::vector<std::string> warnings() const;
};

/// @param withOverlaps looks for bridges that meet, too: for each the equation of its shape is solved, 5 us
PendularState pendularState(const Scene& scene, bool withOverlaps);

}  // namespace pendular
