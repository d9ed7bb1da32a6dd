#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "Kernel/Foundation/Math/Pack.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// The largest overlap that contacts have met, over the effective radius, and how many evaluations of their
/// laws had one that the laws are not made for: exactly, at one multiplication and one comparison for eight
/// contacts, because only a new record, or a number out of the domain, needs more. Watches of parts of the
/// contacts give the same sum in any order.
class OverlapWatch {
public:
    OverlapWatch() = default;
    /// @param largestOverlap that the laws are made for, over the effective radius
    explicit OverlapWatch(double largestOverlap) : limit(largestOverlap) {}

    /// Overlaps (of the effective radius) up to this need not be noted.
    [[nodiscard]] double level() const { return threshold; }
    /// Takes note of the touching contacts whose overlap is above the level.
    /// @param overlap m; @param effectiveRadius m
    [[gnu::noinline, gnu::cold]] void note(std::uint8_t touching, Pack overlap, Pack effectiveRadius) {
        for (int k = 0; k < Pack::lanes; ++k) {
            if ((touching >> k & 1) == 0) continue;
            const double share = overlap[k] / effectiveRadius[k];
            largest = std::max(largest, share);
            above += share > limit ? 1 : 0;
            expectedWasSmaller |= share > expected;
        }
        setThreshold();
    }
    /// A watch that has counted nothing yet, for a part of the contacts.
    [[nodiscard]] OverlapWatch part() const {
        OverlapWatch fresh = *this;
        fresh.above = 0;
        fresh.expectedWasSmaller = false;
        return fresh;
    }
    /// A watch that has counted nothing yet, for laws with a limit of their own (over the effective radius).
    [[nodiscard]] OverlapWatch part(double largestOverlap) const {
        OverlapWatch fresh = part();
        fresh.limit = largestOverlap;
        fresh.setThreshold();
        return fresh;
    }
    void add(const OverlapWatch& part) {
        largest = std::max(largest, part.largest);
        above += part.above;
        expectedWasSmaller |= part.expectedWasSmaller;
        setThreshold();
    }

    /// Larger overlaps (of the effective radius) than this are not expected from now on.
    void expect(double largestOverlap) {
        expected = largestOverlap;
        expectedWasSmaller = false;
        setThreshold();
    }
    /// Whether a larger overlap than the expected one has come since expect().
    [[nodiscard]] bool hasExceededExpected() const { return expectedWasSmaller; }

    /// The largest overlap so far, over the effective radius.
    [[nodiscard]] double largestOverlap() const { return largest; }
    /// Evaluations (contacts x steps) above the limit.
    [[nodiscard]] std::uint64_t countAbove() const { return above; }

    void visitState(StateArchive& archive) {
        archive.finite("largest", largest);
        archive.value("above", above);
        archive.require(largest >= 0, "largest", "is negative");
        setThreshold();
    }

private:
    /// A little below the number that it stands for: the quotient of note() decides, not the rounding of a
    /// product.
    void setThreshold() { threshold = std::min({largest, limit, expected}) * (1 - 0x1p-50); }

    double limit = infinity;
    double expected = infinity;
    bool expectedWasSmaller = false;
    double largest = 0;
    double threshold = 0;
    std::uint64_t above = 0;
};

}  // namespace pendular
