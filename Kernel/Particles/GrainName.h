#pragma once

#include <fmt/format.h>

#include <string>

#include "Kernel/Particles/ParticleStore.h"

namespace pendular {

/// What sentences call a grain: a rigid body before the one of its grains that is meant, as a driver may know
/// the body only.
inline std::string nameOfGrain(const ParticleStore& grains, std::uint32_t identity) {
    const std::uint32_t body = grains.bodies.bodyOf(identity);
    if (body == RigidBodies::none) return fmt::format("particle {}", identity);
    return fmt::format("rigid body {} (its particle {})", body, identity);
}

}  // namespace pendular
