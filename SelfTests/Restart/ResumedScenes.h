#pragma once

#include "Kernel/Scene/Simulation.h"

namespace pendular::resumed {

using S = LinearViscoelasticSlidingFrictionSpecies;

/// A few grains that do not touch.
template <class Species>
struct GrainsOf : Simulation<Species> {
    explicit GrainsOf(const Species& species) : glass(this->speciesHandler.copyAndAddObject(species)) {
        SphericalParticle grain;
        grain.setSpecies(glass), grain.setRadius(1e-3);
        for (int k = 0; k < 4; ++k) {
            grain.setPosition({0.003 + 0.004 * k, 0.005, 0.005 + 0.002 * k});
            grain.setVelocity({0.01, 0.002 * k, 0});
            this->particleHandler.copyAndAddObject(grain);
        }
        this->setTimeStep(2e-6);
        this->setQuiet();
    }
    Species* glass;
};

struct FewGrains : GrainsOf<S> {
    FewGrains() : GrainsOf(linear()) {}
    static S linear() {
        S species;
        species.setDensity(2500), species.setStiffness(100), species.setDissipation(1e-3);
        species.setSlidingStiffness(30), species.setSlidingFrictionCoefficient(0.5);
        return species;
    }
};

}  // namespace pendular::resumed
