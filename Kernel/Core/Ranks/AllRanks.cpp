#include "Kernel/Core/Ranks/AllRanks.h"

#include <fmt/format.h>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

void AllRanks::requireAllGrains(std::string_view what) const {
    if (areSeveral())
        throw InputError(
            fmt::format("Simulation: {} need all grains, and each rank of a scene on several ranks "
                        "(setRanks()) has its own "
                        "ones only; call gather() before, or ask on one rank.",
                        what));
}

void AllRanks::addUp(std::span<ExactSum* const> sums) const {
    if (!areSeveral()) return;
    constexpr std::size_t each = ExactSum::integerCount;
    std::vector<std::int64_t> integers(sums.size() * each);
    const auto of = [&](std::size_t k) { return std::span<std::int64_t, each>(&integers[k * each], each); };
    std::size_t k = 0;
    for (const ExactSum* const sum : sums) sum->writeTo(of(k++));
    exchange->addUp(integers);
    k = 0;
    for (ExactSum* const sum : sums) sum->readFrom(of(k++));
}

std::uint64_t AllRanks::sum(std::uint64_t own) const {
    if (!areSeveral()) return own;
    auto integer = static_cast<std::int64_t>(own);
    exchange->addUp({&integer, 1});
    return static_cast<std::uint64_t>(integer);
}

}  // namespace pendular
