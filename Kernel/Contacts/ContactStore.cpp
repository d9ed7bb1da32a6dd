#include "Kernel/Contacts/ContactStore.h"

namespace pendular {

double ContactMemory::clear(std::size_t slot) {
    for (MemoryColumns* columns : {&history, &normalHistory, &interaction, &liquid, &named})
        columns->clear(slot);
    if (layout.hasTorque) records[slot] = {};
    else forces[slot] = {};
    if (layout.hasContactTorque) torques[slot] = {};
    if (energies.empty()) return 0;
    const double stored = energies[slot].stored();
    energies[slot] = {};
    return stored;
}

void ContactStore::listSides(const std::vector<std::uint32_t>& identity) {
    const auto forEachSide = [&](auto&& function) {
        forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            function(blocks[c / Pack::lanes].first[c % Pack::lanes], c, 0u);
            if (bucket.wall < 0) function(blocks[c / Pack::lanes].second[c % Pack::lanes], c, 1u);
        });
    };
    sides.list(
        identity.size(), forEachSide, [&](std::uint32_t c) { return slotOf(c); },
        [&](std::uint32_t c, std::uint32_t which) { return keyOf(c, which, identity); });
}

}  // namespace pendular
