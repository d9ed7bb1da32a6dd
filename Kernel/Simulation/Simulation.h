#pragma once

#include "Kernel/Contacts/PopularSpecies.h"
#include "Kernel/Simulation/Scene.h"

namespace pendular {

/// What a driver derives from: a scene of grains of species S, and its run.
/// A driver adds species, grains and walls in setupInitialConditions() or before solve(), and overrides
/// hooks.
template <class S>
class Simulation : public Scene {
public:
    Simulation() { setLaws(ownLaws); }

    SpeciesHandler<S> speciesHandler;

private:
    SpeciesLaws<S> ownLaws{speciesHandler};
};

}  // namespace pendular
