#pragma once

#include <optional>

#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/CubicLattice.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Random.h"

namespace pendular::scenes {

/// 8^3 grains of almost one size in shear, so dense that each has neighbours across the faces.
template <class S>
class ShearedCloud : public Simulation<S> {
public:
    static constexpr int edge = 8;             // grains
    static constexpr double spacing = 2.1e-3;  // m

    /// @param shearRate 1/s; none: a periodic scene without shear
    explicit ShearedCloud(std::optional<double> shearRate, int gradient = 1,
                          const S& material = boxMaterial<S>(0)) {
        const S* species = this->speciesHandler.copyAndAddObject(material);
        for (int axis = 0; axis < 3; ++axis) this->setPeriodic(axis, 0, edge * spacing);
        if (shearRate) this->setLeesEdwards(gradient == 0 ? 1 : 0, gradient, *shearRate);
        support::Random random(5);
        for (int k = 0; k < edge * edge * edge; ++k) {
            SphericalParticle grain;
            grain.setSpecies(species);
            grain.setRadius(random.uniform(0.9e-3, 1.03e-3));
            grain.setPosition(cellOfCube(k, edge, spacing));
            grain.setVelocity(this->shearFlowAt(grain.getPosition()) + random.inCube(0.1));
            this->particleHandler.copyAndAddObject(grain);
        }
        this->setTimeStep(0x1p-20);
    }
    std::uint64_t hashAfter(std::size_t steps) {
        this->initialise();
        this->step(steps);
        return stateHash(this->particleHandler.store());
    }
};

}  // namespace pendular::scenes
