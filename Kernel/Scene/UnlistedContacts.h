#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace pendular {

class ContactSystem;
class ParticleStore;
class WallHandler;

/// Finds out whether two bodies overlap that are held along all axes and have no contact (HeldContacts.h),
/// for a warning at queries of contacts: at most one in a run. It searches only where the neighbour list was
/// rebuilt, or such bodies move.
class UnlistedContacts {
public:
    /// A sentence on two such bodies, the first time that there are any; else empty.
    /// @param step the number of steps that have been done
    [[nodiscard]] std::string lookFor(const ContactSystem& contacts, const ParticleStore& grains,
                                      const WallHandler& walls, std::size_t step);

private:
    std::optional<std::size_t> lastStep, lastList;
    bool hasWarned = false;
};

}  // namespace pendular
