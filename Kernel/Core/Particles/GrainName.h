#pragma once

#include <fmt/format.h>

#include <string>

#include "Kernel/Core/Particles/ParticleStore.h"

namespace pendular {

/// What sentences call a grain: a rigid body before the one of its grains that is meant, as a driver may know
/// the body only.
/// @param body its rigid body, or RigidBodies::none
inline std::string nameOfGrain(std::uint32_t identity, std::uint32_t body) {
    if (body == RigidBodies::none) return fmt::format("particle {}", identity);
    return fmt::format("rigid body {} (its particle {})", body, identity);
}
inline std::string nameOfGrain(const ParticleStore& grains, std::uint32_t identity) {
    return nameOfGrain(identity, grains.bodies.bodyOf(identity));
}
/// "particles 0 and 1", or each with its rigid body.
inline std::string namesOfGrains(const ParticleStore& grains, std::uint32_t one, std::uint32_t other) {
    const auto isAlone = [&](std::uint32_t identity) {
        return grains.bodies.bodyOf(identity) == RigidBodies::none;
    };
    if (isAlone(one) && isAlone(other)) return fmt::format("particles {} and {}", one, other);
    return fmt::format("{} and {}", nameOfGrain(grains, one), nameOfGrain(grains, other));
}

}  // namespace pendular
