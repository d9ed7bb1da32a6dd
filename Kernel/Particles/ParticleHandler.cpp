#include "Kernel/Particles/ParticleHandler.h"

#include <fmt/format.h>

#include "Kernel/Contacts/ContactLaws.h"
#include "Kernel/InputError.h"

namespace pendular {

void ParticleHandler::setLaws(const ContactLaws& of) {
    laws = &of;
    grains.hasSpin = of.layout.hasTorque;
}

void GrainReference::setVelocity(const Vec3D& velocity) {
    if (!velocity.allFinite())
        throw InputError(fmt::format("particle {}: velocity = ({}, {}, {}) m/s is not finite.", number,
                                     velocity.x(), velocity.y(), velocity.z()));
    store->translation[store->place[number]].velocity = toVector(velocity);
}

GrainReference ParticleHandler::copyAndAddObject(const SphericalParticle& grain) {
    const std::string owner = fmt::format("particle {}", grains.size());
    checkValue(owner, "radius", grain.getRadius(), "m", positive);
    if (grain.getSpeciesIndex() < 0)
        throw InputError(
            fmt::format("{}: species is not set; call setSpecies() with a species of this scene.", owner));
    const double density = laws->density(static_cast<std::size_t>(grain.getSpeciesIndex()));
    checkValue(laws->name, "density", density, "kg/m^3", positive);
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

GrainReference ParticleHandler::getObject(std::size_t identity) {
    if (identity >= grains.size())
        throw InputError(
            fmt::format("There is no particle {}; the scene has {} (counted from 0).", identity, getSize()));
    return {grains, static_cast<std::uint32_t>(identity)};
}
void ParticleHandler::visitState(StateArchive& archive) {
    grains.visitState(archive);
    for (const std::uint16_t index : grains.species)
        archive.require(index < laws->speciesCount(), "species", "has one that the scene has not");
}

}  // namespace pendular
