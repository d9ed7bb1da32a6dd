#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "Kernel/Core/Contacts/ForceQuantum.h"
#include "Kernel/Foundation/Base/ZeroedLines.h"
#include "Kernel/Foundation/Math/Four.h"

namespace pendular {

/// The force and the torque that contacts give a grain, in quanta: one line of the cache.
struct alignas(64) ForceTotal {
    typedef long long Whole __attribute__((vector_size(32)));

    Whole force{};   // x, y, z; how many contacts have a force that does not fit
    Whole torque{};  // x, y, z; -

    [[nodiscard]] bool fits() const { return force[3] == 0; }
};

/// The force and torque of all contacts of a grain; lane 3 has no meaning.
template <bool hasTorque>
struct ForceAndTorque {
    Four force{};   // N
    Four torque{};  // N m
};
template <>
struct ForceAndTorque<false> {
    Four force{};  // N
};

/// The totals to which a thread adds.
struct OwnTotals {
    /// So many grains, one after the other, have one mark.
    static constexpr std::size_t grainsOfAMark = 64;

    ForceTotal* totals = nullptr;   // of each grain; null where the kernel makes no sums
    std::uint8_t* marks = nullptr;  // which grains it has added to; null: all may be
};

/// The totals of all grains, of each thread that adds to them.
class ForceTotals {
public:
    ForceQuantum quantum;

    /// All totals are zero from now on, for so many grains and threads.
    void begin(std::size_t grains, int threads);
    /// Those of all grains have been taken: they are zero.
    void allAreTaken() { areZero = true; }

    [[nodiscard]] OwnTotals of(int thread);

    class Taker;
    /// Takes totals until begin() is called next.
    [[nodiscard]] Taker taker();
    [[nodiscard]] std::size_t bytes() const;

private:
    struct Copy {
        ZeroedLines<ForceTotal> totals;
        std::vector<std::uint8_t> marks;

        void clearMarked();
    };

    ZeroedLines<ForceTotal> first;  // of the first thread
    std::vector<Copy> others;
    bool areZero = false;
};

/// Takes the totals of grains, one after the other. What it needs of all totals lies in itself, which a loop
/// over all grains keeps in registers.
class ForceTotals::Taker {
public:
    explicit Taker(ForceTotals& totals)
        : first(totals.first.data()),
          others(totals.others.data()),
          othersEnd(others + totals.others.size()),
          quantum(totals.quantum) {}

    /// Takes the total of a grain, and leaves zero.
    [[gnu::always_inline]] ForceTotal take(std::size_t grain) const {
        // Two vectors, not a ForceTotal: g++ would keep this in memory.
        ForceTotal::Whole force = first[grain].force, torque = first[grain].torque;
        first[grain] = {};
        for (Copy* copy = others; copy != othersEnd; ++copy) {
            if (copy->marks[grain / OwnTotals::grainsOfAMark] == 0) continue;
            force += copy->totals[grain].force;
            torque += copy->totals[grain].torque;
            copy->totals[grain] = {};
        }
        return {force, torque};
    }
    /// In N (and N m), of a grain of a radius (m).
    template <bool hasTorque>
    [[nodiscard, gnu::always_inline]] ForceAndTorque<hasTorque> inNewtons(const ForceTotal& total,
                                                                          double radius) const {
        const double newtons = quantum.newtons(radius);
        ForceAndTorque<hasTorque> sum;
        sum.force = __builtin_convertvector(total.force, Four) * newtons;
        if constexpr (hasTorque)
            sum.torque =
                __builtin_convertvector(total.torque, Four) * (newtons * ForceQuantum::lengthOf(radius));
        return sum;
    }

private:
    ForceTotal* first;
    Copy *others, *othersEnd;
    ForceQuantum quantum;
};

inline ForceTotals::Taker ForceTotals::taker() { return Taker(*this); }

}  // namespace pendular
