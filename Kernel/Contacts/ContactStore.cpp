#include "Kernel/Contacts/ContactStore.h"

namespace pendular {

void ContactMemory::visitState(StateArchive& archive) {
    auto& [h, n, i, r, f, t, e, b, l] = *this;  // a member that is added has to be added here
    archive.column<double>("history", h.columns);
    archive.column<double>("normalHistory", n.columns);
    archive.column<double>("interaction", i.columns);
    if (l.hasTorque) archive.column<double>("records", r);
    else archive.column<double>("records", f);
    archive.column<double>("torques", t);
    archive.column<double>("energies", e);
    archive.column<std::uint32_t>("blockOf", b);
}

void ContactStore::listSides(std::size_t grainCount, ContactSides& all) const {
    const auto forEachSide = [&](auto&& function) {
        forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            function(blocks[c / Pack::lanes].first[c % Pack::lanes], c, 0u);
            if (bucket.wall < 0) function(blocks[c / Pack::lanes].second[c % Pack::lanes], c, 1u);
        });
    };
    all.list(grainCount, forEachSide, [&](std::uint32_t c) { return slotOf(c); });
}

void ContactStore::visitState(StateArchive& archive) {
    auto& [list, pairs, bits, memoryOf, m, points, sidesOf, g] = *this;  // a member that is added as well
    archive.column<std::int32_t>("buckets", list);
    archive.column<std::uint32_t>("blocks", pairs);
    archive.column<std::uint8_t>("states", bits);
    archive.column<std::uint32_t>("slots", memoryOf);
    archive.column<double>("wallPoints", points);
    archive.column<double>("gaps", g);
    archive.group("memory", [&, &part = m] { part.visitState(archive); });
    archive.group("sides", [&, &part = sidesOf] { part.visitState(archive); });
}

}  // namespace pendular
