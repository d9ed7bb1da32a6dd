#pragma once

#include <numbers>

#include "Kernel/Laws/Species/SpeciesInScene.h"

namespace pendular::scenes {

/// The material of the bed of Dosta et al. (2024), M1, in the parameters of whatever laws a species has.
struct BedMaterial {
    double density = 2500;        // kg/m^3
    double elasticModulus = 1e9;  // Pa
    double poissonRatio = 0.2;
    double restitution = 0.5;
    double friction = 0.3;
    double linearCollisionTime =
        5e-5;                     // s, of grains of 1 mm radius; the Hertzian one at 0.1 m/s is 5.2e-5 s
    double liquidVolume = 2e-11;  // m^3 a bridge, 20 nl
    double contactAngle = std::numbers::pi / 9;
    double surfaceTension = 0.072;  // N/m
    double viscosity = 1e-3;        // Pa s
    double roughness = 1e-6;        // m
    double film = 8e-11;            // m^3 a grain, where liquid moves
    double layer = 1e-4;            // m, on wet walls
    double liquidDensity = 998;     // kg/m^3
    double halfFillingAngle = std::numbers::pi / 5;

    // Of rolling and of torsion, with the lever R*; a law that takes another one gets what is the same
    // torque.
    double rollingFriction = 0.05,
           rollingStiffness = 1e4;     // N/m: about that of sliding at an overlap of 1 um
    double rollingDissipation = 1e-3;  // kg/s
    double workOfAdhesion = 0.05;      // J/m^2

    /// Sets the fields that the species has.
    void set(AnySpecies& s) const;
    template <class S>
    [[nodiscard]] S species() const {
        SpeciesInScene<S> s(S{}, 0, nullptr);
        set(s);
        return s.species;
    }
};

}  // namespace pendular::scenes
