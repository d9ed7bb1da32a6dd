#include "Kernel/Core/Contacts/ContactSample.h"

#include <cstring>
#include <utility>

#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

static bool isUnwritten(const EnergyRecord& record) {
    static constexpr EnergyRecord none{};
    return std::memcmp(&record, &none, sizeof(EnergyRecord)) == 0;
}

void EnergyRecords::makeSparse() {
    if (sparse) return;
    sparse = true;
    const std::vector<EnergyRecord> before = std::exchange(all, {});
    resize(before.size());
    for (std::size_t slot = 0; slot < before.size(); ++slot) put(slot, before[slot]);
}

void EnergyRecords::put(std::size_t slot, const EnergyRecord& record) {
    if (sparse && blocks[slot / lanes].empty() && isUnwritten(record)) return;
    (*this)[slot] = record;
}

void EnergyRecords::rearrangeSparse(const std::vector<std::uint32_t>& origins, std::uint32_t nothing,
                                    int threads) {
    EnergyRecords next;
    next.areKept = areKept, next.sparse = true;
    next.resize(origins.size());
    constexpr std::size_t worthAThread = 256;  // blocks
    inParts(
        next.blocks.size(), threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t slot = begin * lanes; slot < end * lanes && slot < origins.size(); ++slot)
                if (origins[slot] != nothing) next.put(slot, std::as_const(*this)[origins[slot]]);
        },
        worthAThread);
    blocks.swap(next.blocks);
}

std::size_t EnergyRecords::bytes() const {
    std::size_t sum = all.capacity() * sizeof(EnergyRecord) + blocks.capacity() * sizeof(blocks[0]);
    for (const std::vector<EnergyRecord>& block : blocks) sum += block.capacity() * sizeof(EnergyRecord);
    return sum;
}

}  // namespace pendular
