#pragma once

#include "Kernel/Particles/SphericalParticle.h"

namespace pendular {

class ContactLaws;

/// A grain of a scene, found by its identity: valid for as long as the scene.
class GrainReference {
public:
    GrainReference(ParticleStore& grains, std::uint32_t identity) : store(&grains), number(identity) {}

    [[nodiscard]] std::uint32_t getId() const { return number; }
    [[nodiscard]] Vec3D getPosition() const { return toEigen(record().position); }
    [[nodiscard]] Vec3D getVelocity() const { return toEigen(record().velocity); }
    [[nodiscard]] double getRadius() const { return record().radius; }
    [[nodiscard]] double getMass() const { return 1 / record().inverseMass; }
    /// Zero in scenes without friction.
    [[nodiscard]] Vec3D getAngularVelocity() const {
        if (store->hasSpin) return toEigen(store->rotation[store->place[number]].spin);
        else return Vec3D::Zero();
    }
    /// The sum of all forces (N) of the last step, weight included; not kept for a grain held in place: zero.
    [[nodiscard]] Vec3D getForce() const {
        if (record().inverseMass == 0) return Vec3D::Zero();
        return getMass() * toEigen(store->acceleration[store->place[number]]);
    }
    void setVelocity(const Vec3D& velocity);

private:
    [[nodiscard]] const TranslationRecord& record() const { return store->translation[store->place[number]]; }

    ParticleStore* store;
    std::uint32_t number;
};

/// Adds grains to a scene and finds them again.
class ParticleHandler {
public:
    using Grains = ParticleStore;

    ParticleHandler() = default;
    ParticleHandler(const ParticleHandler&) = delete;
    void setLaws(const ContactLaws& of);

    /// Takes the memory for so many grains at once, instead of bit by bit.
    void reserve(std::size_t count) { grains.reserve(count); }

    /// Adds a copy of the grain. Its mass is that of a solid sphere of its species' density.
    GrainReference copyAndAddObject(const SphericalParticle& grain);

    [[nodiscard]] std::size_t getSize() const { return grains.size(); }
    [[nodiscard]] GrainReference getObject(std::size_t identity);
    void visitState(StateArchive& archive);
    [[nodiscard]] Grains& store() { return grains; }
    [[nodiscard]] const Grains& store() const { return grains; }

private:
    const ContactLaws* laws = nullptr;
    Grains grains;
};

}  // namespace pendular
