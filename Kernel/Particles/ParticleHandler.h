#pragma once

#include <fmt/format.h>

#include "Kernel/InputError.h"
#include "Kernel/Particles/SphericalParticle.h"
#include "Kernel/Species/SpeciesHandler.h"

namespace pendular {

/// A grain of a scene, found by its identity: valid for as long as the scene.
template <bool hasSpin>
class GrainReference {
public:
    GrainReference(ParticleStore<hasSpin>& grains, std::uint32_t identity)
        : store(&grains), number(identity) {}

    [[nodiscard]] std::uint32_t getId() const { return number; }
    [[nodiscard]] Vec3D getPosition() const { return toEigen(record().position); }
    [[nodiscard]] Vec3D getVelocity() const { return toEigen(record().velocity); }
    [[nodiscard]] double getRadius() const { return record().radius; }
    [[nodiscard]] double getMass() const { return 1 / record().inverseMass; }
    /// Zero in scenes without friction.
    [[nodiscard]] Vec3D getAngularVelocity() const {
        if constexpr (hasSpin) return toEigen(store->rotation[store->place[number]].spin);
        else return Vec3D::Zero();
    }
    /// The sum of all forces (N) of the last step, weight included; not kept for a grain held in place: zero.
    [[nodiscard]] Vec3D getForce() const {
        if (record().inverseMass == 0) return Vec3D::Zero();
        return getMass() * toEigen(store->acceleration[store->place[number]]);
    }
    void setVelocity(const Vec3D& velocity) {
        if (!velocity.allFinite())
            throw InputError(fmt::format("particle {}: velocity = ({}, {}, {}) m/s is not finite.", number,
                                         velocity.x(), velocity.y(), velocity.z()));
        store->translation[store->place[number]].velocity = toVector(velocity);
    }

private:
    [[nodiscard]] const TranslationRecord& record() const { return store->translation[store->place[number]]; }

    ParticleStore<hasSpin>* store;
    std::uint32_t number;
};

/// Adds grains to a scene and finds them again.
template <class S>
class ParticleHandler {
public:
    using Grains = ParticleStore<S::hasTorque>;

    explicit ParticleHandler(const SpeciesHandler<S>& speciesHandler) : species(speciesHandler) {}

    /// Takes the memory for so many grains at once, instead of bit by bit.
    void reserve(std::size_t count) { grains.reserve(count); }

    /// Adds a copy of the grain. Its mass is that of a solid sphere of its species' density.
    GrainReference<S::hasTorque> copyAndAddObject(const SphericalParticle& grain) {
        const std::string owner = fmt::format("particle {}", grains.size());
        checkValue(owner, "radius", grain.getRadius(), "m", positive);
        if (grain.getSpeciesIndex() < 0)
            throw InputError(fmt::format(
                "{}: species is not set; call setSpecies() with a species of this scene.", owner));
        const double density =
            species.getObject(static_cast<std::size_t>(grain.getSpeciesIndex()))->getDensity();
        checkValue(S::name, "density", density, "kg/m^3", positive);
        const double mass = sphereMass(grain.getRadius(), density);
        const Vector<double> nothing{0, 0, 0};  // the motion of a grain that is held in place
        const TranslationRecord record{toVector(grain.getPosition()), grain.getRadius(),
                                       grain.isFixed() ? nothing : toVector(grain.getVelocity()),
                                       grain.isFixed() ? 0 : 1 / mass};
        const std::uint32_t identity =
            grains.add(record, grain.isFixed() ? nothing : toVector(grain.getAngularVelocity()),
                       static_cast<std::uint16_t>(grain.getSpeciesIndex()));
        return {grains, identity};
    }

    [[nodiscard]] std::size_t getSize() const { return grains.size(); }
    [[nodiscard]] GrainReference<S::hasTorque> getObject(std::size_t identity) {
        if (identity >= grains.size())
            throw InputError(fmt::format("There is no particle {}; the scene has {} (counted from 0).",
                                         identity, getSize()));
        return {grains, static_cast<std::uint32_t>(identity)};
    }
    void visitState(StateArchive& archive) {
        grains.visitState(archive);
        for (const std::uint16_t index : grains.species)
            archive.require(index < species.getSize(), "species", "has one that the scene has not");
    }
    [[nodiscard]] Grains& store() { return grains; }
    [[nodiscard]] const Grains& store() const { return grains; }

private:
    const SpeciesHandler<S>& species;
    Grains grains;
};

}  // namespace pendular
