#pragma once

#include <cstddef>
#include <vector>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Ranks/AllRanks.h"

namespace pendular {

/// Free rigid bodies of one species that are alike but for their size, as the stability limit takes them. A
/// body whose grains are of several species is one of each.
struct BodiesAlike {
    struct Size {
        double mass;               // kg
        double smallest, largest;  // m, of its grains; of a block the radius of its edges, and the largest
                                   // that Hertz's law takes for a sphere on one of its faces
        double face = 0;           // m^2, the largest face of a block
    };
    std::size_t species = 0;
    bool isBlock = false;
    ContactsAround around{};
    Size least{infinity, infinity, 0}, most{0, infinity, 0};  // the lightest and the heaviest
    std::size_t count = 1;                                    // that there are

    void add(const Size& size) { add(size, size); }
    void add(const Size& lightest, const Size& heaviest);
    void add(const BodiesAlike& others);
    /// The same shape and species.
    [[nodiscard]] bool isLike(const BodiesAlike& other) const {
        return species == other.species && isBlock == other.isBlock && around == other.around;
    }
    /// Whether others are known with these: between them in mass, and moved no more easily.
    [[nodiscard]] bool hold(const BodiesAlike& others) const;
};

/// Adds bodies to those of their shape.
void addTo(std::vector<BodiesAlike>& all, const BodiesAlike& bodies);

/// The body at a place, one for each species of its grains; none of a single sphere, which counts as a grain,
/// and of one that is held.
[[nodiscard]] std::vector<BodiesAlike> bodiesAt(const ParticleStore& grains, std::size_t at);

/// All bodies of a scene, in an order of their numbers, not of the bodies.
/// @param ranks that share them; none: all are here
[[nodiscard]] std::vector<BodiesAlike> bodiesOf(const ParticleStore& grains, const AllRanks& ranks = {});

}  // namespace pendular
