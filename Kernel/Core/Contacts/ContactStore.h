#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/ContactSample.h"
#include "Kernel/Core/Contacts/ContactSides.h"
#include "Kernel/Core/Contacts/ForceTotals.h"
#include "Kernel/Core/Contacts/MemoryColumns.h"
#include "Kernel/Core/Contacts/Prefetch.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Walls/Wall.h"
#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

/// The eight contacts of a block: places of the bodies.
struct alignas(64) ContactBlock {
    std::array<std::uint32_t, Pack::lanes> first{};
    std::array<std::uint32_t, Pack::lanes> second{};  // at walls: the part of the wall

    /// Gives lanes that hold no contact the places of the first that does, so that they are computed from
    /// bodies that there are, and come to nothing.
    void pointToListed(std::uint8_t listed) {
        const auto good = static_cast<std::size_t>(std::countr_zero(listed));
        for (std::size_t lane = 0; listed != 0 && lane < Pack::lanes; ++lane) {
            if ((listed >> lane & 1) != 0) continue;
            first[lane] = first[good];
            second[lane] = second[good];
        }
    }
};

/// The points of a wall that are nearest to the eight grains of a block, in this step.
struct WallPointColumns {
    std::array<LaneColumn, 3> normal{};    // unit, into the wall
    std::array<LaneColumn, 3> velocity{};  // m/s, of the wall's surface
    LaneColumn distance{};                 // m, from the centre

    void set(std::size_t lane, const WallPoint& point) {
        normal[0].lane[lane] = point.normal.x;
        normal[1].lane[lane] = point.normal.y;
        normal[2].lane[lane] = point.normal.z;
        velocity[0].lane[lane] = point.velocity.x;
        velocity[1].lane[lane] = point.velocity.y;
        velocity[2].lane[lane] = point.velocity.z;
        distance.lane[lane] = point.distance;
    }
    /// The points of all eight contacts.
    void set(const Vector<Pack>& normals, const Vector<Pack>& velocities, const Pack& distances) {
        const auto store = [](std::array<LaneColumn, 3>& to, const Vector<Pack>& v) {
            v.x.store(to[0].lane.data()), v.y.store(to[1].lane.data()), v.z.store(to[2].lane.data());
        };
        store(normal, normals);
        store(velocity, velocities);
        distances.store(distance.lane.data());
    }
    [[nodiscard]] Vector<double> normalAt(std::size_t lane) const { return vectorAt(normal, lane); }
    /// m/s
    [[nodiscard]] Vector<double> velocityAt(std::size_t lane) const { return vectorAt(velocity, lane); }
    [[nodiscard]] WallPoint pointAt(std::size_t lane) const {
        return {normalAt(lane), distance.lane[lane], velocityAt(lane)};
    }

private:
    static Vector<double> vectorAt(const std::array<LaneColumn, 3>& columns, std::size_t lane) {
        return {columns[0].lane[lane], columns[1].lane[lane], columns[2].lane[lane]};
    }
};

/// The state of the eight contacts of a block, one bit a lane.
struct BlockState {
    std::uint8_t listed = 0;    // lanes that hold a contact
    std::uint8_t touching = 0;  // the bodies overlapped at the last step
    std::uint8_t bridged = 0;   // a bridge joins them
    std::uint8_t closing = 0;   // the last step took itself for the last one of the touch, or of the neck

    friend bool operator==(const BlockState&, const BlockState&) = default;
};

/// What the kernel writes for a contact: the force on body 1, half the overlap (each body's lever arm is its
/// radius minus that), n x force, and the normal force (repulsion positive).
struct alignas(64) ForceTorqueRecord {
    Vector<double> force;      // N
    double halfOverlap;        // m
    Vector<double> leverless;  // N, torque on either body / its lever arm
    double normalForce;        // N
};

/// The force record without friction: no torque, half the memory.
struct alignas(32) ForceRecord {
    Vector<double> force;  // N, on body 1
    double normalForce;    // N, repulsion positive
};

/// The torque on body 1 that a contact gives besides that of its force; body 2 gets the opposite one. Kept
/// only for laws that have one.
struct alignas(32) TorqueRecord {
    Vector<double> torque{0, 0, 0};  // N m
    double unused = 0;
};

/// The records of all contacts, by columns, as the kernel writes them.
struct RecordColumns : MemoryColumns {
    static constexpr std::size_t numbers = sizeof(ForceTorqueRecord) / sizeof(double);
    static constexpr std::size_t leverless = 4, normalForce = 7;  // the columns where these begin

    [[nodiscard]] ForceTorqueRecord operator[](std::size_t slot) const {
        std::array<double, numbers> record;
        get(slot, record.data());
        return std::bit_cast<ForceTorqueRecord>(record);
    }
    [[nodiscard]] Vector<double> force(std::size_t slot) const {
        return {at(slot, 0), at(slot, 1), at(slot, 2)};
    }
    /// Its eight columns of a block.
    [[nodiscard]] double* ofBlock(std::size_t block) { return columns[block * numbers].lane.data(); }
};
/// Writes the records of a block, as its columns.
[[gnu::always_inline]] inline void storeColumns(double* columns, const Vector<Pack>& force,
                                                const Pack& halfOverlap, const Vector<Pack>& leverless,
                                                const Pack& normalForce) {
    force.x.store(columns), force.y.store(columns + 8), force.z.store(columns + 16);
    halfOverlap.store(columns + 24);
    leverless.x.store(columns + 32), leverless.y.store(columns + 40), leverless.z.store(columns + 48);
    normalForce.store(columns + 56);
}

/// Blocks [begin, end) whose contacts all join the same two species, or a species and one wall.
struct Bucket {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    int species1 = 0;
    int species2 = 0;
    int wall = -1;  // -1: grains with grains

    [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// What contacts remember, and the forces that the kernel writes for them, in blocks of eight. Block 0 is
/// that of all contacts that have no memory: it stays zero.
class ContactMemory {
public:
    MemoryColumns history;  // of the friction law
    MemoryColumns normalHistory;
    MemoryColumns interaction;
    MemoryColumns liquid;                // m^3, the volumes of a bridge whose liquid moves
    MemoryColumns named;                 // of the driver's own columns
    RecordColumns records;               // of laws with friction
    std::vector<ForceRecord> forces;     // of laws without
    std::vector<TorqueRecord> torques;   // empty unless the friction law has a torque of its own
    EnergyRecords energies;              // empty unless there is an account of the energy
    std::vector<std::uint32_t> blockOf;  // the block of contacts that has this block of memory

    /// The volume of a bridge whose liquid moves, and the one for which it was prepared, negative (or -0) if
    /// it is to be prepared again for whatever change.
    static constexpr std::size_t liquidNumbers = 2;
    [[nodiscard]] double& volumeOf(std::size_t slot) { return liquid.at(slot, 0); }
    [[nodiscard]] double volumeOf(std::size_t slot) const { return liquid.at(slot, 0); }
    [[nodiscard]] double& preparedVolumeOf(std::size_t slot) { return liquid.at(slot, 1); }
    [[nodiscard]] std::size_t slotCount() const { return blockOf.size() * Pack::lanes; }

    void setLayout(const ContactLayout& of) {
        layout = of;
        history.count = of.history;
        normalHistory.count = of.normalHistory;
        interaction.count = of.interaction;
        liquid.count = of.liquid;
        named.count = of.named;
        records.count = of.hasTorque ? RecordColumns::numbers : 0;
    }
    [[nodiscard]] const ContactLayout& getLayout() const { return layout; }

    /// Forgets everything, and has so many blocks of zeros besides block 0.
    void reset(bool withLedger, std::size_t blocks = 0) {
        resize(0);
        energies.reset(withLedger, Pack::lanes);
        resize(1 + blocks);
    }
    /// Room for so many blocks and a few more, if there is not yet.
    void makeRoom(std::size_t blocks) {
        // A vector's own growth would take up to twice the memory.
        if (blocks > blockOf.capacity()) reserve(blocks + blocks / 16 + 64);
    }
    /// Brings what contacts remember to other places; zeros where nothing comes to.
    /// @param origins of each new place the old one, or Rearrangement::nothing
    /// @param blocks of each new block of memory: the block of contacts that has it
    void rearrange(std::vector<std::uint32_t> origins, std::vector<std::uint32_t> blocks, int threads);
    /// Room for so many blocks in all.
    void reserve(std::size_t blocks) {
        for (MemoryColumns* each : columns()) each->reserve(blocks);
        if (!layout.hasTorque) reserveLarge(forces, blocks * Pack::lanes);
        if (layout.hasContactTorque) reserveLarge(torques, blocks * Pack::lanes);
        blockOf.reserve(blocks);
        if (!energies.empty()) energies.reserve(blocks * Pack::lanes);
    }
    /// Adds a block of zeros for this block of contacts; returns its number.
    std::uint32_t add(std::size_t block) {
        const std::size_t count = blockOf.size();
        makeRoom(count + 1);
        resize(count + 1);
        blockOf.back() = static_cast<std::uint32_t>(block);
        return static_cast<std::uint32_t>(count);
    }
    /// Asks for what the kernel writes of a block for the ledger.
    [[gnu::always_inline]] void prefetchSamples(std::size_t block) const {
        for (std::size_t k = 0; k < Pack::lanes; ++k)
            prefetch<true>(static_cast<const CoreSample*>(&energies[block * Pack::lanes + k].now),
                           sizeof(CoreSample));
    }
    /// Asks for what the kernel reads and writes of a block besides.
    [[gnu::always_inline]] void prefetchBlock(std::size_t block) const {
        history.prefetchBlock(block);
        normalHistory.prefetchBlock(block);
        interaction.prefetchBlock(block);
        const std::size_t first = block * Pack::lanes;
        records.prefetchBlock(block);
        if (!layout.hasTorque) prefetch<true>(forces.data() + first, Pack::lanes * sizeof(ForceRecord));
        if (layout.hasContactTorque)
            prefetch<true>(torques.data() + first, Pack::lanes * sizeof(TorqueRecord));
    }
    /// Forgets one contact; returns the energy (J) that was stored in it, where a ledger is kept.
    double clear(std::size_t slot);
    /// How many numbers a contact has without its energies, and these: what it remembers and its forces.
    [[nodiscard]] std::size_t numberCount() const;
    void getNumbers(std::size_t slot, double* to) const;
    void setNumbers(std::size_t slot, const double* from);
    [[nodiscard]] std::size_t bytes() const {
        return bytesOf(history.columns, normalHistory.columns, interaction.columns, liquid.columns,
                       named.columns, records.columns, forces, torques, blockOf) +
               energies.bytes();
    }

private:
    [[nodiscard]] std::array<MemoryColumns*, 6> columns() {
        return {&history, &normalHistory, &interaction, &liquid, &named, &records};
    }
    [[nodiscard]] std::array<const MemoryColumns*, 6> columns() const {
        return {&history, &normalHistory, &interaction, &liquid, &named, &records};
    }
    void resize(std::size_t blocks) {
        for (MemoryColumns* each : columns()) each->resize(blocks);
        if (!layout.hasTorque) forces.resize(blocks * Pack::lanes);
        if (layout.hasContactTorque) torques.resize(blocks * Pack::lanes);
        blockOf.resize(blocks);
        if (!energies.empty()) energies.resize(blocks * Pack::lanes);
    }

    ContactLayout layout;
};

/// All listed contacts of a scene, in blocks of eight. Only blocks in which something has touched since they
/// were listed have memory.
class ContactStore {
public:
    static constexpr std::uint32_t asleep = 0;                  // no memory: nothing acts in this block
    static constexpr std::uint32_t waking = ~std::uint32_t{0};  // asleep, and needs memory in this step

    std::vector<Bucket> buckets;
    std::vector<ContactBlock> blocks;
    std::vector<BlockState> states;
    std::vector<std::uint32_t> slots;  // of each block: its block of memory
    ContactMemory memory;
    std::vector<WallPointColumns> wallPoints;  // of the wall blocks, which come last

    mutable ContactSides sides;  // see sidesOf()
    bool keepsTotals = false;    // the kernel sums forces
    mutable ForceTotals totals;  // whoever moves the grains takes them
    /// The gap (m) of each block: while no two bodies have approached by this since they were listed, nothing
    /// in it can begin to touch, or to form a bridge at its filmContactGap. A block that is looked at after
    /// that, and in which nothing has begun, gets a new one from where its bodies are then; superquadrics
    /// keep that of the list. It has no meaning for blocks with memory.
    std::vector<double> gaps;

    [[nodiscard]] std::size_t blockCount() const { return blocks.size(); }
    [[nodiscard]] bool touches(std::size_t contact) const {
        return bitOf(states[contact / Pack::lanes].touching, contact);
    }
    [[nodiscard]] bool isListed(std::size_t contact) const {
        return bitOf(states[contact / Pack::lanes].listed, contact);
    }
    [[nodiscard]] bool isBridged(std::size_t contact) const {
        return bitOf(states[contact / Pack::lanes].bridged, contact);
    }
    /// The place of its first grain.
    [[nodiscard]] std::uint32_t firstOf(std::size_t contact) const {
        return blocks[contact / Pack::lanes].first[contact % Pack::lanes];
    }
    /// The place of its second grain; at a wall, the part of it.
    [[nodiscard]] std::uint32_t secondOf(std::size_t contact) const {
        return blocks[contact / Pack::lanes].second[contact % Pack::lanes];
    }
    /// Whether the contact has a force: it touches or is bridged.
    [[nodiscard]] bool acts(std::size_t contact) const {
        const BlockState& state = states[contact / Pack::lanes];
        return bitOf(state.touching | state.bridged, contact);
    }
    /// The place at which the memory holds a contact.
    [[nodiscard]] std::size_t slotOf(std::size_t contact) const {
        return slots[contact / Pack::lanes] * std::size_t{Pack::lanes} + contact % Pack::lanes;
    }
    /// The contact that the memory holds at a place.
    [[nodiscard]] std::uint32_t contactAt(std::uint32_t slot) const {
        return memory.blockOf[slot / Pack::lanes] * Pack::lanes + slot % Pack::lanes;
    }
    /// The force (N) on body 1.
    [[nodiscard]] Vector<double> forceOf(std::size_t contact) const {
        const std::size_t slot = slotOf(contact);
        return memory.getLayout().hasTorque ? memory.records.force(slot) : memory.forces[slot].force;
    }
    /// N, repulsion positive.
    [[nodiscard]] double normalForceOf(std::size_t contact) const {
        const std::size_t slot = slotOf(contact);
        return memory.getLayout().hasTorque ? memory.records.at(slot, RecordColumns::normalForce)
                                            : memory.forces[slot].normalForce;
    }
    /// Whether another contact of the grain stands for this one with a wall.
    [[nodiscard]] bool isLeftOut(std::size_t contact) const {
        return std::isinf(
            wallPoints[contact / Pack::lanes - firstWallBlock()].distance.lane[contact % Pack::lanes]);
    }
    [[nodiscard]] std::size_t firstWallBlock() const { return blocks.size() - wallPoints.size(); }

    /// Calls function(bucket, contact) for each listed contact.
    template <class Function>
    void forEachListed(Function&& function) const {
        for (const Bucket& bucket : buckets)
            for (std::uint32_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c)
                if (bitOf(states[c / Pack::lanes].listed, c)) function(bucket, c);
    }

    [[nodiscard]] const Bucket& bucketOf(std::size_t block) const {
        return *std::upper_bound(buckets.begin(), buckets.end(), block,
                                 [](std::size_t b, const Bucket& bucket) { return b < bucket.end; });
    }
    /// The key by which the contacts of a grain are ordered, which is body 1 (0) or body 2 (1) of this one:
    /// other grains by identity, then walls by number and part.
    [[nodiscard]] std::uint64_t keyOf(std::uint32_t contact, std::uint32_t which,
                                      const std::vector<std::uint32_t>& identity) const {
        const ContactBlock& block = blocks[contact / Pack::lanes];
        const std::size_t lane = contact % Pack::lanes;
        if (contact / Pack::lanes < firstWallBlock())
            return identity[which == 0 ? block.second[lane] : block.first[lane]];
        const auto wall = static_cast<std::uint64_t>(bucketOf(contact / Pack::lanes).wall);
        return (wall + 1) << 32 | block.second[lane];
    }
    /// The list is whole: contacts have the memory that they had.
    /// @param identity of the grain at each place
    void beginSides(const std::vector<std::uint32_t>& identity, int threads);
    /// The sides of a grain (ContactSides::of, asleepOf). The first one that asks after a new list makes
    /// them, also where several threads ask.
    [[nodiscard]] std::span<const std::uint32_t> sidesOf(std::size_t grain) const {
        if (!sides.wereAskedFor()) [[unlikely]]
            askForSides();
        return sides.of(grain);
    }
    [[nodiscard]] std::span<const std::uint32_t> asleepSidesOf(std::size_t grain) const {
        if (!sides.wereAskedFor()) [[unlikely]]
            askForSides();
        return sides.asleepOf(grain);
    }
    /// The sides of one grain that is about to be removed: a list from which few grains are removed needs
    /// no sides for that.
    struct OwnSides {
        std::vector<std::uint32_t> withMemory, asleep;
    };
    [[nodiscard]] OwnSides ownSidesOf(std::uint32_t grain);
    /// Gives back what a new list makes again; what contacts remember stays.
    void releaseList();

    /// Bytes that one contact with memory takes, without the ledger.
    static constexpr std::size_t bytesPerContact(const ContactLayout& layout) {
        return (sizeof(ContactBlock) + sizeof(BlockState) + sizeof(std::uint32_t) + sizeof(double)) /
                   Pack::lanes +
               (layout.hasTorque ? sizeof(ForceTorqueRecord) : sizeof(ForceRecord)) +
               2 * sizeof(std::uint32_t) + (layout.hasContactTorque ? sizeof(TorqueRecord) : 0) +
               sizeof(double) * (layout.history + layout.normalHistory + layout.interaction + layout.liquid +
                                 layout.named);
    }
    /// Bytes of memory that the contacts take.
    [[nodiscard]] std::size_t bytes() const {
        return bytesOf(buckets, blocks, states, slots, wallPoints, gaps) + memory.bytes() + sides.bytes() +
               totals.bytes();
    }
    /// The bit of a contact's lane.
    static bool bitOf(unsigned bits, std::size_t contact) {
        return (bits >> (contact % Pack::lanes) & 1u) != 0;
    }

private:
    void askForSides() const;
    void makeSides(int threads) const;

    bool sidesWereAskedFor = false;  // those of the last list
    int searches = 0;                // of ownSidesOf() since the list was made
};

}  // namespace pendular
