#pragma once

#include <algorithm>
#include <array>
#include <memory>

#include "Drivers/Shared/BedMaterial.h"
#include "Drivers/Shared/GrainLattice.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Scene/Simulation.h"
#include "Tools/Studies/AccuracyVersusCost/Statistics.h"

namespace pendular {

/// The cost of a step with each of integrators::all, in steps of the default.
using IntegratorCosts = std::array<double, integrators::all.size()>;

/// A periodic cubic lattice of grains that overlap slightly: six contacts each, and nothing to list again.
class TouchingLattice : public Simulation<HertzianViscoelasticMindlinSpecies> {
public:
    explicit TouchingLattice(const Integrator& integrator, int side = 16) {
        const auto* material = speciesHandler.copyAndAddObject(
            scenes::BedMaterial{}.species<HertzianViscoelasticMindlinSpecies>());
        const double radius = 1e-3, spacing = 1.9999 * radius;
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, side * spacing);
        for (int k = 0; k < side * side * side; ++k) {
            SphericalParticle grain;
            grain.setSpecies(material);
            grain.setRadius(radius);
            grain.setPosition(spacing * Vec3D(k % side, k / side % side, k / (side * side)));
            particleHandler.copyAndAddObject(grain);
        }
        setTimeStep(1e-7);
        setIntegrator(integrator);
        initialise();
    }
    /// Seconds of the processor for some steps.
    double time(int steps = 20) {
        const double start = processorTime();
        for (int k = 0; k < steps; ++k) step();
        return processorTime() - start;
    }
};

/// The fastest of many runs in turns: what else the machine does only adds time.
inline IntegratorCosts measureIntegratorCosts(int runs = 40) {
    std::array<std::unique_ptr<TouchingLattice>, integrators::all.size()> lattices;
    IntegratorCosts fastest;
    fastest.fill(infinity);
    for (std::size_t k = 0; k < lattices.size(); ++k)
        lattices[k] = std::make_unique<TouchingLattice>(integrators::all[k]);
    for (int run = 0; run < runs; ++run)
        for (std::size_t k = 0; k < lattices.size(); ++k)
            fastest[k] = std::min(fastest[k], lattices[k]->time());
    IntegratorCosts costs;
    std::transform(fastest.begin(), fastest.end(), costs.begin(),
                   [&](double time) { return time / fastest[0]; });
    return costs;
}

}  // namespace pendular
