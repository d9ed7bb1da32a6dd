#pragma once

#include <cmath>
#include <string_view>

#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Walls/WallHandler.h"

namespace pendular {

/// Checks contacts that came out of a restart file: whatever a step follows by its number must be there, in
/// the contacts themselves and among the species, grains and walls of the scene. Throws InputError with the
/// name of the column.
class StoredContacts {
public:
    /// @param grainCount, wallCount of the scene when the contacts were listed
    StoredContacts(const ContactStore& contacts, std::size_t speciesCount, std::size_t grainCount,
                   const WallHandler& sceneWalls, std::size_t wallCount)
        : store(contacts),
          species(speciesCount),
          grains(grainCount),
          walls(sceneWalls),
          listedWalls(wallCount) {}

    void require(const StateArchive& archive, bool withLedger) const {
        requireRows(archive, withLedger);
        requireBuckets(archive);
        for (const Bucket& bucket : store.buckets)
            for (std::size_t b = bucket.begin; b < bucket.end; ++b) requireBlock(archive, bucket, b);
        for (std::size_t m = 1; m < store.memory.blockOf.size(); ++m)
            archive.require(
                store.memory.blockOf[m] < store.blocks.size() && store.slots[store.memory.blockOf[m]] == m,
                "memory/blockOf", "is not the inverse of contacts/slots");
        ContactSides expected;
        store.listSides(grains, expected);
        archive.require(store.sides == expected, "sides", "is not that of contacts/blocks");
    }

private:
    void requireRows(const StateArchive& archive, bool withLedger) const {
        constexpr std::string_view rows = "has another number of rows than contacts/blocks",
                                   slots = "has another number of rows than contacts/memory/blockOf";
        const std::size_t blocks = store.blocks.size(), held = store.memory.blockOf.size();
        archive.require(store.states.size() == blocks, "states", rows);
        archive.require(store.slots.size() == blocks, "slots", rows);
        archive.require(store.gaps.size() == blocks, "gaps", rows);
        archive.require(store.wallPoints.size() <= blocks, "wallPoints",
                        "has more rows than contacts/blocks");
        archive.require(held > 0, "memory/blockOf", "is empty");
        const ContactMemory& memory = store.memory;
        const ContactLayout& layout = memory.getLayout();
        const auto requireColumns = [&](const MemoryColumns& columns, std::string_view name) {
            archive.require(columns.columns.size() == held * columns.count, name, slots);
        };
        requireColumns(memory.history, "memory/history");
        requireColumns(memory.normalHistory, "memory/normalHistory");
        requireColumns(memory.interaction, "memory/interaction");
        const std::size_t lanes = held * Pack::lanes;
        archive.require((layout.hasTorque ? memory.records.size() : memory.forces.size()) == lanes,
                        "memory/records", slots);
        archive.require(memory.torques.size() == (layout.hasContactTorque ? lanes : 0), "memory/torques",
                        slots);
        archive.require(memory.energies.size() == (withLedger ? lanes : 0), "memory/energies", slots);
    }

    /// They follow each other without gaps, those of walls last.
    void requireBuckets(const StateArchive& archive) const {
        const auto isAmong = [](int number, std::size_t count) {
            return number >= 0 && static_cast<std::size_t>(number) < count;
        };
        std::size_t begin = 0;
        for (const Bucket& bucket : store.buckets) {
            archive.require(bucket.begin == begin && begin < bucket.end && bucket.end <= store.blocks.size(),
                            "buckets", "does not divide contacts/blocks");
            archive.require(isAmong(bucket.species1, species) && isAmong(bucket.species2, species), "buckets",
                            "has a species that the scene has not");
            archive.require(bucket.wall == -1 || isAmong(bucket.wall, listedWalls), "buckets",
                            "has a wall that the scene has not");
            archive.require((bucket.wall >= 0) == (begin >= store.firstWallBlock()), "buckets",
                            "does not agree with contacts/wallPoints");
            begin = bucket.end;
        }
        archive.require(begin == store.blocks.size(), "buckets", "does not divide contacts/blocks");
    }

    void requireBlock(const StateArchive& archive, const Bucket& bucket, std::size_t b) const {
        const std::size_t others =
            bucket.wall < 0 ? grains : walls.getObject(static_cast<std::size_t>(bucket.wall)).partCount();
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane)
            archive.require(store.blocks[b].first[lane] < grains && store.blocks[b].second[lane] < others,
                            "blocks", "has a grain or a part of a wall that the scene has not");
        const BlockState& state = store.states[b];
        const unsigned acting = state.touching | state.bridged, listed = state.listed;
        const bool isLast = b + 1 == bucket.end;
        archive.require(isLast ? listed != 0 && (listed & (listed + 1)) == 0 : listed == 0xff, "states",
                        "has gaps between the contacts");
        archive.require((acting & ~listed) == 0, "states", "has a contact that acts and is not listed");
        const std::uint32_t slot = store.slots[b];
        archive.require(slot == ContactStore::asleep
                            ? acting == 0
                            : slot < store.memory.blockOf.size() && store.memory.blockOf[slot] == b,
                        "slots", "does not agree with contacts/memory/blockOf");
        archive.require(!std::isnan(store.gaps[b]), "gaps", "has one that is not a number");
    }

    const ContactStore& store;
    std::size_t species, grains;
    const WallHandler& walls;
    std::size_t listedWalls;
};

}  // namespace pendular
