#include "Kernel/Core/Contacts/GrainMasses.h"

namespace pendular {

GrainMasses::GrainMasses(const ParticleStore& store, const ContactLaws& contactLaws)
    : grains(store), laws(contactLaws) {
    if (grains.bodies.empty()) return;
    shares.resize(grains.size());
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        std::vector<double> own = grains.bodies.sharesOfMass(
            k, [this](std::uint32_t grain) { return ofSphere(grains.place[grain]); });
        const auto members = grains.bodies.membersOf(k);
        for (std::size_t m = 0; m < own.size(); ++m) shares[grains.place[members[m].grain]] = own[m];
    }
}

double GrainMasses::ofSphere(std::uint32_t place) const {
    return laws.massOf(grains.species[place], grains.translation[place].radius);
}

}  // namespace pendular
