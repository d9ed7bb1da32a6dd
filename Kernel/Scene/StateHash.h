#pragma once

#include <bit>
#include <cstdint>

#include "Kernel/Core/Particles/ParticleStore.h"

namespace pendular {

/// A number that tells whether two runs have ended in the same state, bit for bit: FNV-1a (64 bits) over the
/// bytes of position, velocity and spin of the grains, in the order of their identities, so that it does not
/// depend on where the store keeps a grain. Bytes are taken from the lowest to the highest on every machine.
/// Source: Fowler, Noll, Vo, Eastlake, "The FNV Non-Cryptographic Hash Algorithm" (IETF draft).
inline std::uint64_t stateHash(const ParticleStore& grains) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&hash](const Vector<double>& vector) {
        for (const double number : {vector.x, vector.y, vector.z})
            for (int shift = 0; shift < 64; shift += 8)
                hash = (hash ^ (std::bit_cast<std::uint64_t>(number) >> shift & 0xff)) * 0x100000001b3u;
    };
    for (const std::uint32_t place : grains.place) {
        add(grains.translation[place].position);
        add(grains.translation[place].velocity);
        if (grains.hasSpin) add(grains.rotation[place].spin);
    }
    return hash;
}

}  // namespace pendular
