#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace pendular {

class ContactSystem;
class ParticleStore;
class WallHandler;

/// Finds out whether two bodies overlap that are held along all axes and have no contact (HeldContacts.h), so
/// that who asks for contacts can be told: at most once in a run, and at the price of a search only where
/// contacts were listed again, or such bodies move.
class UnlistedContacts {
public:
    /// A sentence on two such bodies, the first time that there are any; else empty.
    /// @param step the number of steps that have been done
    [[nodiscard]] std::string lookFor(const ContactSystem& contacts, const ParticleStore& grains,
                                      const WallHandler& walls, std::size_t step);

private:
    std::optional<std::size_t> lastStep, lastList;
    bool wasTold = false;
};

}  // namespace pendular
