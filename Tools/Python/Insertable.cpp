#include "Tools/Python/Insertable.h"

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular::python {

void Mixture::add(const Insertable& like, const SizeDistribution& sizes, double share) {
    if (owner) like.species.requireOf(*owner, "species");
    owner = like.species.owner;
    const auto add = [&](auto body) {
        body.setSpecies(&like.species);
        body.setVelocity(like.velocity), body.setAngularVelocity(like.spin);
        of.add(body, sizes, share);
    };
    if (!like.shape) {
        SphericalParticle grain;
        grain.setLiquidVolume(like.film);
        return add(grain);
    }
    if (like.film != 0) throw InputError("Grains that are no spheres come without a film; leave film out.");
    if (const auto* const clump = std::get_if<ClumpTemplate>(&like.shape->of)) return add(Clump(*clump));
    if (const auto* const grain = std::get_if<SuperquadricGrain>(&like.shape->of)) return add(*grain);
    throw InputError("Blocks cannot be inserted; add each with add_shape().");
}

const BodyMixture& Mixture::in(const PythonScene& scene) const {
    if (of.empty()) throw InputError("This mixture is empty; add kinds of grains to it by add().");
    if (owner != &scene) throw InputError("This mixture is of the species of another scene.");
    return of;
}

}  // namespace pendular::python
