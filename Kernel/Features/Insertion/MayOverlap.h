#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "Kernel/Core/Contacts/NeighbourSearch.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Base/SharedQuestion.h"
#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

/// Who of many spheres may overlap whom while none of them moves by more than half a skin: what spheres and
/// bodies that push each other apart have in common (DenseStart.cpp, DenseBodies.cpp).
class MayOverlap {
public:
    /// Lists them in an order that depends on the spheres only.
    /// @param skin m; @param worthAThread spheres; @param counts function of two spheres: whether they push
    /// each other; @param visit function of a sphere, called once for each
    template <class Counts, class Visit>
    void list(std::span<const TranslationRecord> spheres, double skin, const PeriodicBox& periodic,
              int threads, std::size_t worthAThread, Counts&& counts, Visit&& visit) {
        const NeighbourSearch search(spheres, skin, periodic, threads);
        std::vector<std::vector<Pair>> found(static_cast<std::size_t>(threads));
        SharedQuestion question(&askForInterruption);
        question.during([&] {
            inParts(
                spheres.size(), threads,
                [&](int part, std::size_t from, std::size_t to) {
                    std::vector<Pair>& own = found[static_cast<std::size_t>(part)];
                    own.reserve(8 * (to - from));
                    for (std::size_t k = from; k < to; ++k) {
                        question.ask();
                        const auto self = static_cast<std::uint32_t>(k);
                        search.forEachPartner(self, [&](std::uint32_t other) {
                            if (counts(self, other)) own.push_back({self, other});
                        });
                        visit(k);
                    }
                },
                worthAThread);
        });
        sort(found, spheres.size());
    }

    /// The partners of a sphere. Behind the last ones there is room for a Pack to be loaded.
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t sphere) const {
        return {partners.data() + begins[sphere], partners.data() + begins[sphere + 1]};
    }

private:
    struct Pair {
        std::uint32_t first, second;
    };

    void sort(const std::vector<std::vector<Pair>>& found, std::size_t count) {
        const auto forEachPair = [&](auto&& function) {
            for (const std::vector<Pair>& part : found)
                for (const Pair& pair : part) function(pair);
        };
        begins.assign(count + 1, 0);
        forEachPair([&](const Pair& pair) { ++begins[pair.first + 1], ++begins[pair.second + 1]; });
        std::partial_sum(begins.begin(), begins.end(), begins.begin());
        partners.assign(begins.back() + Pack::lanes, 0);
        std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
        forEachPair([&](const Pair& pair) {
            partners[next[pair.first]++] = pair.second;
            partners[next[pair.second]++] = pair.first;
        });
    }

    std::vector<std::uint32_t> begins, partners;
};

}  // namespace pendular
