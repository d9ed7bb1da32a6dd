#pragma once

#include <array>
#include <memory>
#include <string>

#include "Kernel/Features/Insertion/Region.h"

namespace pendular {

/// A region of a scene whose images may move: it stays where it is in space, and the flow goes through it.
/// Along an axis along which it reaches from face to face it does so at any time.
class RegionInFlow {
public:
    RegionInFlow() = default;
    /// @param of after Region::in(); @param atSetUp the periodic box in which it is described
    RegionInFlow(std::shared_ptr<const Region> of, const PeriodicBox& atSetUp);

    /// The place (m) that a place in the region has now.
    [[nodiscard]] Vector<double> placeNow(const Vector<double>& place, const PeriodicBox& now) const;
    /// The periodic box from the lowest corner of the region: wrap() of it brings a place to the image that
    /// may be in the region.
    [[nodiscard]] PeriodicBox boxNow(const PeriodicBox& now) const;
    /// Throws RunError where the scene has become shorter than the region. @param owner of it
    void requireRoom(const std::string& owner, const PeriodicBox& now) const;

private:
    std::shared_ptr<const Region> region;
    PeriodicBox then;
    std::array<bool, 3> open{};
};

}  // namespace pendular
