#pragma once

#include <array>

#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/Simulation.h"

namespace pendular::periodic {

/// A lattice of touching spheres (radius 0.5 mm): 1 in a cube is simple cubic, 4 face-centred cubic.
template <class S>
class Lattice : public Simulation<S> {
public:
    static constexpr double radius = 0.5e-3;  // m
    static constexpr int cubes = 4;           // along each axis

    Lattice(S material, int inCube, double distance = 2 * radius) : count(inCube) {
        material.setDensity(2500);
        const S* species = this->speciesHandler.copyAndAddObject(material);
        const double edge = distance * (inCube == 4 ? std::sqrt(2.0) : 1);
        for (int axis = 0; axis < 3; ++axis) this->setPeriodic(axis, 0, cubes * edge);
        SphericalParticle grain;
        grain.setSpecies(species);
        grain.setRadius(radius);
        const std::array<Vec3D, 4> within{Vec3D(0, 0, 0), {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
        for (int k = 0; k < cubes * cubes * cubes; ++k)
            for (int m = 0; m < inCube; ++m) {
                const Vec3D cube(k % cubes, k / cubes % cubes, k / cubes / cubes);
                grain.setPosition(edge *
                                  (cube + Vec3D::Constant(0.25) + within[static_cast<std::size_t>(m)]));
                this->particleHandler.copyAndAddObject(grain);
            }
        this->setTimeStep(timeStep);
        // Others change the force in the last step of a touch, and steps here are large.
        this->setIntegrator(integrators::velocityVerlet);
        this->setQuiet();
    }
    /// m, of the centres of neighbours
    [[nodiscard]] double distance() const {
        return this->getPeriodicBox().length.x / cubes / (count == 4 ? std::sqrt(2.0) : 1);
    }
    static constexpr double timeStep = 1e-5;  // s

private:
    int count;
};

inline Species<LinearViscoelastic> linear() {
    Species<LinearViscoelastic> material;
    material.setStiffness(100), material.setDissipation(0);
    return material;
}
}  // namespace pendular::periodic
