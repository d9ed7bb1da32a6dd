#pragma once

#include <span>

#include "Drivers/Shared/GrainRows.h"
#include "Drivers/Shared/KineticEnergy.h"
#include "Drivers/Shared/PublishedMaterials.h"
#include "Kernel/Simulation/Simulation.h"
#include "Kernel/Species/Laws.h"

namespace pendular {

/// What the scenes of the benchmark of Dosta et al. (2024), Comput. Phys. Commun. 296, 109066, have in
/// common: its materials, its gravity and its time step.
class PublishedScene : public Simulation<HertzianViscoelasticMindlinSpecies> {
public:
    using Material = HertzianViscoelasticMindlinSpecies;

    /// J, of the motion of all centres.
    [[nodiscard]] double kineticEnergy() const { return translationalEnergy(particleHandler.store()); }

protected:
    /// @param publishedStep s, at the published stiffness; with softer grains the step grows as their contact
    /// times do, with the square root of the softening (at a given overlap, k_n grows with Young's modulus)
    PublishedScene(double publishedStep, double softening) {
        addPublishedMaterials(speciesHandler, softening);
        setGravity({0, 0, -9.8});
        setTimeStep(publishedStep * std::sqrt(softening));
    }
    void addGrain(const GrainRow& row, PublishedMaterial material, const Vec3D& velocity = Vec3D::Zero()) {
        addGrainRow(particleHandler, static_cast<const Material*>(speciesHandler.getObject(material)), row,
                    velocity);
    }
    template <class Shape>
    Shape* addSteelWall(Shape wall) {
        wall.setSpecies(speciesHandler.getObject(Steel));
        return wallHandler.copyAndAddObject(wall);
    }
};

}  // namespace pendular
