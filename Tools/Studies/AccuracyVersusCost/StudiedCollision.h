#pragma once

#include <numbers>

#include "Kernel/Scene/Simulation.h"

namespace pendular {

/// How two equal grains meet: one comes from the left along x, the other is its mirror image.
struct Encounter {
    double radius = 1e-3;       // m
    double speed = 0.2;         // m/s, of approach
    double slip = 0;            // m/s, relative, across the line of centres
    double spin = 0;            // rad/s, of both
    double gap = 0;             // m, of the surfaces at the start
    double reach = 0;           // m: parted when the surfaces are so far from each other
    double longest = infinity;  // s, after which grains that have not parted stay together
};

/// What is left of an encounter.
struct Aftermath {
    double parting;  // m/s
    double slip;     // m/s, of the centres
    double rim;      // m/s, spin x radius
    double energy;   // of 1 kg of grains: J/kg
};

template <class S>
class StudiedCollision : public Simulation<S> {
public:
    StudiedCollision(const S& species, const Encounter& given, double step, const Integrator& integrator)
        : encounter(given) {
        const S* added = this->speciesHandler.copyAndAddObject(species);
        for (const double side : {-1.0, 1.0}) {
            SphericalParticle grain;
            grain.setSpecies(added);
            grain.setRadius(encounter.radius);
            grain.setPosition({side * (encounter.radius + 0.5 * encounter.gap), 0, 0});
            grain.setVelocity({-0.5 * side * encounter.speed, -0.5 * side * encounter.slip, 0});
            grain.setAngularVelocity({0, 0, encounter.spin});
            this->particleHandler.copyAndAddObject(grain);
        }
        this->setTimeStep(step);
        this->setIntegrator(integrator);
        this->acceptUnstableTimeStep();
        this->setQuiet();  // one of hundreds, whose limits are those that are looked for
    }

    /// Steps until the grains have parted; they must have touched. Nothing is left of the motion of grains
    /// that stay together.
    Aftermath finish() {
        this->initialise();
        bool touched = false;
        while (!touched || separation() < encounter.reach) {
            this->step();
            touched = touched || separation() < 0;
            if (this->getTime() > encounter.longest) return {0, 0, 0, 0};
        }
        const auto grain = this->particleHandler.getObject(1);
        const Vec3D velocity = grain.getVelocity(), spin = grain.getAngularVelocity();
        const double rim = encounter.radius * spin.z();
        return {2 * velocity.x(), -2 * velocity.y(), rim, 0.5 * velocity.squaredNorm() + 0.2 * rim * rim};
    }

    /// m, of the surfaces; negative while they overlap.
    double separation() {
        return this->particleHandler.getObject(1).getPosition().x() -
               this->particleHandler.getObject(0).getPosition().x() - 2 * encounter.radius;
    }

private:
    Encounter encounter;
};

}  // namespace pendular
