#pragma once

#include <cmath>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "Kernel/Core/Ranks/Exchange.h"
#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Foundation/Math/Scalar.h"

namespace pendular {

/// What all ranks of a scene know together: each gives what it has of its own grains, and all get the same
/// bits, whatever their number. All ranks make the same calls in the same order. A scene that has all grains,
/// also because ranks do not share them yet, gets back what it gives.
class AllRanks {
public:
    AllRanks() = default;
    explicit AllRanks(Exchange& with) : exchange(&with) {}
    /// @param doShare whether each has its own grains only, as it is when something is asked
    AllRanks(Exchange& with, const bool& doShare) : exchange(&with), areDistributed(&doShare) {}

    /// There are others, whether they share the grains already or not.
    [[nodiscard]] bool areThere() const { return exchange != nullptr; }
    [[nodiscard]] bool areSeveral() const { return exchange && (!areDistributed || *areDistributed); }
    /// Whether what all ranks do alike, and is summed over them, counts on this one.
    [[nodiscard]] bool isFirst() const { return !areSeveral() || exchange->rank() == 0; }

    /// The number of this one, from 0, and how many there are.
    [[nodiscard]] std::size_t rank() const { return areSeveral() ? exchange->rank() : 0; }
    [[nodiscard]] std::size_t count() const { return areSeveral() ? exchange->count() : 1; }

    /// Throws InputError where each rank has its own grains only. @param what needs all of them, "clusters"
    void requireAllGrains(std::string_view what) const;

    /// Each of these sums becomes that of all ranks; several of them in one call are faster.
    void addUp(std::span<ExactSum* const> sums) const;
    void addUp(std::initializer_list<ExactSum*> sums) const { addUp(std::span(sums.begin(), sums.size())); }
    void addUp(ExactVectorSum& sum) const { addUp({&sum.x, &sum.y, &sum.z}); }
    [[nodiscard]] double sum(ExactSum own) const {
        if (areSeveral()) addUp({&own});
        return own.value();
    }
    [[nodiscard]] std::uint64_t sum(std::uint64_t own) const;

    /// What is not a number counts as infinite.
    [[nodiscard]] double largest(double own) const {
        if (!areSeveral()) return own;
        return exchange->largest(std::isnan(own) ? std::numeric_limits<double>::infinity() : own);
    }
    [[nodiscard]] double smallest(double own) const { return areSeveral() ? -largest(-own) : own; }
    [[nodiscard]] bool any(bool own) const { return areSeveral() ? largest(own ? 1 : 0) > 0 : own; }

    /// The values of all ranks, in the order of ranks.
    template <class Value>
    [[nodiscard]] std::vector<Value> gather(const std::vector<Value>& own) const {
        if (!areSeveral()) return own;
        Message message;
        for (const Value& value : own) message.add(value);
        std::vector<Value> all;
        for (Message& from : exchange->swap(std::vector<Message>(exchange->count(), message)))
            while (!from.isTaken()) all.push_back(from.take<Value>());
        return all;
    }

private:
    Exchange* exchange = nullptr;          // null: there is one
    const bool* areDistributed = nullptr;  // null: they are
};

}  // namespace pendular
