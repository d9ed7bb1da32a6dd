#include "Kernel/Scene/UnlistedContacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Contacts/NeighbourSearch.h"
#include "Kernel/Core/Particles/GrainName.h"

namespace pendular {
namespace {

/// Two bodies that overlap, by their names in messages.
using Names = std::optional<std::pair<std::string, std::string>>;

bool overlap(const ContactSystem& contacts, const ParticleStore& grains, std::uint32_t a, std::uint32_t b) {
    if (grains.bodies.areJoinedAt(a, b)) return false;
    const TranslationRecord &one = grains.translation[a], &two = grains.translation[b];
    const Vector<double> shift = contacts.periodicBox().nearest(two.position - one.position);
    if (const GrainShapes* const shapes = contacts.laws().shapes())
        return shapes->touch(grains, a, b, shift).depth > 0;
    return norm(shift) < one.radius + two.radius;
}

Names findPair(const ContactSystem& contacts, const ParticleStore& grains,
               const std::vector<std::uint32_t>& held) {
    if (contacts.listedOfHeld().pairs) return {};
    std::vector<TranslationRecord> records;
    for (const std::uint32_t place : held) records.push_back(grains.translation[place]);
    const NeighbourSearch search(records, 0, contacts.periodicBox());
    std::optional<std::pair<std::uint32_t, std::uint32_t>> first;  // identities: the lowest of all pairs
    for (std::uint32_t k = 0; k < held.size(); ++k)
        search.forEachPartner(k, [&](std::uint32_t other) {
            const std::pair<std::uint32_t, std::uint32_t> both =
                std::minmax(grains.identity[held[k]], grains.identity[held[other]]);
            if ((!first || both < *first) && overlap(contacts, grains, held[k], held[other])) first = both;
        });
    if (!first) return {};
    return {{nameOfGrain(grains, first->first), nameOfGrain(grains, first->second)}};
}

bool overlapsWall(const ContactSystem& contacts, const ParticleStore& grains, std::uint32_t place,
                  const Wall& wall) {
    const TranslationRecord& grain = grains.translation[place];
    std::vector<std::uint32_t> parts;
    wall.listParts(grain.position, grain.radius, parts);
    if (parts.empty()) return false;
    std::vector<WallPoint> points(parts.size());
    if (const GrainShapes* const shapes = contacts.laws().shapes())
        return std::ranges::any_of(parts, [&](std::uint32_t part) {
            return shapes->touchAtWall(grains, place, wall, part, 0).depth > 0;
        });
    wall.findPoints(grain.position, grain.radius, parts, points);
    return std::ranges::any_of(points, [&](const WallPoint& point) { return point.distance < grain.radius; });
}

Names findAtWall(const ContactSystem& contacts, const ParticleStore& grains, const WallHandler& walls,
                 const std::vector<std::uint32_t>& held) {
    for (const auto& [number, wall] : walls.present()) {
        if (contacts.listedOfHeld().atWall(number)) continue;
        for (const std::uint32_t place : held)
            if (overlapsWall(contacts, grains, place, *wall))
                return {{nameOfGrain(grains, grains.identity[place]), fmt::format("wall {}", number)}};
    }
    return {};
}

}  // namespace

std::string UnlistedContacts::lookFor(const ContactSystem& contacts, const ParticleStore& grains,
                                      const WallHandler& walls, std::size_t step) {
    if (hasWarned || contacts.rebuildCount() == 0 || contacts.getHeldContacts() == HeldContacts::None)
        return {};
    const bool isNewList = std::exchange(lastList, contacts.rebuildCount()) != contacts.rebuildCount();
    if (std::exchange(lastStep, step) == step && !isNewList) return {};
    std::vector<std::uint32_t> held;
    bool move = false;
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        if (grain.inverseMass > 0) continue;
        held.push_back(place);
        move |= squaredNorm(grain.velocity) > 0;
    }
    if (held.empty() || !(isNewList || move)) return {};
    Names both = findPair(contacts, grains, held);
    if (!both) both = findAtWall(contacts, grains, walls, held);
    if (!both) return {};
    hasWarned = true;
    return fmt::format(
        "{} and {} overlap and are held along all axes: their contact is not listed, so that "
        "interactions(), interactionsOf(), contactForceOn(), getForce() and getTorque() do not have it; take "
        "setHeldContacts(HeldContacts::All) to list such contacts, or HeldContacts::None to leave them out "
        "without this warning",
        both->first, both->second);
}

}  // namespace pendular
