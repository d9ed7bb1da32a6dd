#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <span>
#include <string_view>

#include "Drivers/Shared/GrainRows.h"
#include "Drivers/Shared/PublishedMaterials.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Features/EnergyLedger/GrainSums.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Scene/SceneCheck.h"
#include "Kernel/Scene/Simulation.h"

namespace pendular {

/// What the scenes of the benchmark of Dosta et al. (2024), Comput. Phys. Commun. 296, 109066, have in
/// common: its materials and its gravity.
class PublishedScene : public Simulation<HertzianViscoelasticMindlinSpecies> {
public:
    using Material = HertzianViscoelasticMindlinSpecies;

    /// J, of the motion of all centres.
    [[nodiscard]] double kineticEnergy() const { return translationalEnergy(particleHandler.store()); }

    /// Solves as any scene does; where softened grains cannot go on, the error names the softening.
    void solve() {
        try {
            Simulation::solve();
        } catch (const RunError& error) {
            if (softeningOfAll <= 1) throw;
            std::string_view sentence = error.what();
            if (sentence.ends_with('.')) sentence.remove_suffix(1);
            throw RunError(fmt::format("{}; Young's moduli are divided by a softening of {:g}.", sentence,
                                       softeningOfAll));
        }
    }
    /// Warns where the softening lets grains that have settled overlap more than is sound.
    void tellOfSoftening() {
        double deepest = 0;  // of the smaller radius
        for (const ObservedContact& seen : interactions()) {
            double smaller = particleHandler.getObject(seen.particle1).getRadius();
            if (seen.wall < 0)
                smaller = std::min(smaller, particleHandler.getObject(seen.particle2).getRadius());
            deepest = std::max(deepest, -seen.separation / smaller);
        }
        if (softeningOfAll <= 1 || deepest <= largestSoundOverlap) return;
        // Under one load Hertz's overlap goes with E*^(-2/3).
        logger(LogLevel::Warn,
               "with a softening of {:g} the settled grains overlap by up to {:.2g} % of the smaller radius; "
               "with {:.2g} they would overlap by some {:g} %.",
               softeningOfAll, 100 * deepest, softeningOfAll * std::pow(largestSoundOverlap / deepest, 1.5),
               100 * largestSoundOverlap);
    }

protected:
    /// Grains of one material and radius (m).
    struct Kind {
        PublishedMaterial material;
        double radius;
    };
    /// @param step s, at the published stiffness; with softer grains it grows as their contact times do, with
    /// the square root of the softening (at a given overlap, k_n grows with Young's modulus)
    PublishedScene(double step, double softening) {
        addPublishedMaterials(speciesHandler, softening);
        setGravity({0, 0, -9.8});
        setTimeStep(step * std::sqrt(softening));
        softeningOfAll = softening;
        // A bed that they have settled in is taken up as it is.
        if (softening > 1) acceptOverlaps(usualOverlapInRun);
    }
    /// s, at the published stiffness: 0.9 of the stability limit in the densest bed of these grains and steel
    /// walls. No grains of the scene itself are needed: one that goes on has them from its restart file only,
    /// and must have the same step.
    static double stableStep(std::initializer_list<Kind> kinds) {
        PublishedScene bed(1, 1);
        for (const Kind& kind : kinds)
            for (std::size_t k = 0; k <= contactsInDensestBed; ++k)
                bed.addGrain({kind.radius, Vec3D::Zero()}, kind.material);
        InfiniteWall wall;
        wall.set(Vec3D::UnitX(), Vec3D::Zero());
        bed.addSteelWall(wall);
        return 0.9 * bed.stabilityLimit();
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

private:
    double softeningOfAll = 1;
};

}  // namespace pendular
