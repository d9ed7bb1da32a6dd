#pragma once

#include <cstddef>
#include <string_view>

#include "Kernel/Laws/Species/SpeciesOwner.h"

namespace pendular {

/// What grains need to know of the species of their scene.
class GrainSpecies {
public:
    virtual ~GrainSpecies() = default;

    [[nodiscard]] virtual std::size_t speciesCount() const = 0;
    /// The handler that has them: what getOwner() of one of them returns.
    [[nodiscard]] virtual const SpeciesOwner* owner() const = 0;
    /// kg/m^3
    [[nodiscard]] virtual double density(std::size_t species) const = 0;
    /// kg, of a grain; @param radius m
    [[nodiscard]] double massOf(std::size_t species, double radius) const {
        return grainsAreDiscs() ? discMass(radius, density(species)) : sphereMass(radius, density(species));
    }
    [[nodiscard]] bool grainsAreDiscs() const { return owner()->grainsAreDiscs(); }
    /// The name of the type of a species, for sentences.
    [[nodiscard]] virtual std::string_view typeName(std::size_t species) const = 0;
    /// Whether contacts turn grains, which then have a spin.
    [[nodiscard]] virtual bool turnGrains() const = 0;
};

}  // namespace pendular
