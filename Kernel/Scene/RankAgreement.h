#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Features/DomainDecomposition/GrainSharing.h"
#include "Kernel/Foundation/State/StateArchive.h"

// What all ranks of a run must have alike: each makes a hash of it, and the hashes are compared. Only where
// they differ the values themselves are compared, by name.

namespace pendular {

/// Lists what must be alike.
using ToAgreeOn = std::function<void(StateArchive&)>;

/// A hash of it. @param largestTable bytes; tables with more are left out
[[nodiscard]] std::uint64_t hashOf(const ToAgreeOn& visit, std::size_t largestTable = ~std::size_t{0});
/// A hash of all grains and rigid bodies, in the order of identities.
[[nodiscard]] std::uint64_t hashOfGrains(ParticleStore& grains);

/// What differs, with its values: "gravity is (0, 0, -9.81) m/s^2 on rank 0 and (0, 0, -5) m/s^2 on rank 1";
/// empty where nothing does. All ranks must call it, and get the same.
[[nodiscard]] std::string differenceOfRanks(GrainSharing& ranks, const ToAgreeOn& visit);
/// The same of grains, where all ranks have all of them.
[[nodiscard]] std::string differenceOfGrains(GrainSharing& ranks, ParticleStore& grains);

}  // namespace pendular
