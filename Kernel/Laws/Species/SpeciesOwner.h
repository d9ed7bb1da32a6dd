#pragma once

#include <numbers>

namespace pendular {

/// kg, of a solid sphere; @param radius m; @param density kg/m^3
inline double sphereMass(double radius, double density) {
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
}
/// kg, of a disc; @param radius m; @param density kg/m^2
inline double discMass(double radius, double density) { return std::numbers::pi * radius * radius * density; }

/// What a handler of species is to the grains of its scene.
class SpeciesOwner {
public:
    /// All grains are discs in a plane, of a density by area (kg/m^2 for kg/m^3): their mass is pi r^2 rho
    /// and their moment of inertia m r^2 / 2. At set-up, in a scene that holds all grains in a plane
    /// (ParticleHandler::holdAll()).
    void setGrainsAreDiscs(bool areDiscs = true) { discs = areDiscs; }
    [[nodiscard]] bool grainsAreDiscs() const { return discs; }

private:
    bool discs = false;
};

}  // namespace pendular
