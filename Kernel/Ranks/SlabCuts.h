#pragma once

#include <span>
#include <vector>

#include "Kernel/Math/Vector.h"
#include "Kernel/Ranks/Exchange.h"

namespace pendular {

/// Which part of space belongs to which rank: slabs across the axis along which the points are widest. No bit
/// of the results depends on it.
class SlabCuts {
public:
    struct Point {
        Vector<double> position;  // m
        double weight;
    };
    /// Cuts space anew, for points of which each rank gives some.
    /// @param shares of the weight that each rank is to get
    void cut(Exchange& exchange, std::span<const Point> own, std::span<const double> shares);
    [[nodiscard]] std::size_t ownerOf(const Vector<double>& position) const;

private:
    Vector<double> axis{1, 0, 0};
    std::vector<double> borders;  // m, between each rank and the next
};

}  // namespace pendular
