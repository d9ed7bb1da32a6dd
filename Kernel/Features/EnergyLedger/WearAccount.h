#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "Kernel/Features/EnergyLedger/WearOfStep.h"

namespace pendular {

/// The account of a scene without a ledger whose walls wear: of the contacts with walls alone, and of these
/// of what slides or begins. It has the same bits as the wear that an EnergyAccount finds.
class WearAccount {
public:
    /// Called at the start of a run.
    void begin() { listed = none; }
    /// Called before the grains move: remembers the motion of those that are listed at walls, as no others
    /// can wear one in this step; of all grains, where another list may be made in it.
    void beforeMotion(ParticleStore& grains, const ContactSystem& contacts, int threads);
    /// Called when grains and walls have moved, by such largest shifts (m), and before contacts are listed.
    void afterMotion(ParticleStore& grains, const ContactSystem& contacts, double grainShift,
                     double wallShift);
    /// Called at the end of a step (s).
    void finish(const ParticleStore& grains, ContactSystem& contacts, const WallHandler& walls, double step,
                int threads);

private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    void list(const ParticleStore& grains, const ContactSystem& contacts);

    std::size_t listed = none;           // the number of the list that is meant by:
    std::vector<std::uint32_t> atWalls;  // the contacts with walls, in the order of identities
    std::vector<std::uint32_t> near;     // the places of their grains; some twice
    bool remembersAll = false;
    std::vector<WearOfContact> worn;  // by each of the contacts with walls in the step
    std::vector<std::uint8_t> wears;  // which of them do
};

}  // namespace pendular
