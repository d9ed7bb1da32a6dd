#pragma once

#include "Kernel/Features/PopularSpecies.h"
#include "Kernel/Features/SpeciesByName/SeveralSpeciesLaws.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/SumsOverRanks.h"

namespace pendular {

/// The class that a driver derives from: a scene of grains, and its run. `Simulation<S>` has grains of
/// species S; `Simulation<S1, S2>` has species of these types, and `Simulation<>` of any, also such as are
/// chosen by name. A driver adds species, grains and walls in setupInitialConditions() or before solve(), and
/// overrides hooks.
template <class... Types>
class Simulation : public Scene {
public:
    Simulation() { setLaws(ownLaws); }
    ~Simulation() override { completeLeftRun(); }

    SpeciesHandlerOf<Types...> speciesHandler;

private:
    SeveralSpeciesLaws ownLaws{speciesHandler};
};

template <class S>
class Simulation<S> : public Scene {
public:
    Simulation() { setLaws(*ownLaws); }
    ~Simulation() override { completeLeftRun(); }

    SpeciesHandler<S> speciesHandler;

private:
    std::unique_ptr<ContactLaws> ownLaws = makeSpeciesLaws(speciesHandler);
};

}  // namespace pendular
