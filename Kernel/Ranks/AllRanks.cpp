#include "Kernel/Ranks/AllRanks.h"

namespace pendular {

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
