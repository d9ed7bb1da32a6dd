#pragma once

#include <algorithm>
#include <cstdint>

#include "Kernel/Foundation/Math/Pack.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// How many evaluations of bridges had a capillary number above the largest one that their law's range is
/// made for, and the largest of these. Watches of parts of the contacts give the same sum in any order.
class CapillaryWatch {
public:
    /// @param bridged the bits of the bridges; @param number those above the largest one of the law, else 0
    [[gnu::noinline, gnu::cold]] void note(std::uint8_t bridged, Pack number) {
        for (int k = 0; k < Pack::lanes; ++k) {
            if ((bridged >> k & 1) == 0 || !(number[k] > 0)) continue;
            largest = std::max(largest, number[k]);
            ++above;
        }
    }
    void add(const CapillaryWatch& part) {
        largest = std::max(largest, part.largest);
        above += part.above;
    }

    [[nodiscard]] double largestNumber() const { return largest; }
    /// Evaluations (bridges x steps).
    [[nodiscard]] std::uint64_t countAbove() const { return above; }

    void visitState(StateArchive& archive) {
        archive.finite("largest", largest);
        archive.value("above", above);
        archive.require(largest >= 0, "largest", "is negative");
    }

private:
    double largest = 0;
    std::uint64_t above = 0;
};

}  // namespace pendular
