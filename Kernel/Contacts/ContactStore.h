#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "Kernel/Math/Pack.h"
#include "Kernel/Particles/ParticleStore.h"
#include "Kernel/Species/Species.h"
#include "Kernel/Walls/Wall.h"

namespace pendular {

/// Eight numbers, one for each lane of a block of contacts.
struct alignas(64) LaneColumn {
    std::array<double, Pack::lanes> lane{};
};

/// The eight contacts of a block: places of the bodies.
struct alignas(64) ContactBlock {
    std::array<std::uint32_t, Pack::lanes> first{};
    std::array<std::uint32_t, Pack::lanes> second{};  // at walls: the part of the wall
};

/// Where the eight grains of a block are nearest to their wall, in this step.
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
};

/// The state of the eight contacts of a block, one bit a lane.
struct BlockState {
    std::uint8_t listed = 0;    // lanes that hold a contact
    std::uint8_t touching = 0;  // the bodies overlapped at the last step
    std::uint8_t bridged = 0;   // a bridge joins them
    std::uint8_t closing = 0;   // the last step took itself for the last one of the touch

    friend bool operator==(const BlockState&, const BlockState&) = default;
};

/// What the kernel writes for a contact and the particle sum reads: the force on body 1, half the overlap
/// (each body's lever arm is its radius minus that), n x force, and the normal force (repulsion positive).
struct alignas(64) ForceTorqueRecord {
    Vector<double> force;      // N
    double halfOverlap;        // m
    Vector<double> leverless;  // N, torque on either body / its lever arm
    double normalForce;        // N
};

/// The same without friction: no torque, half the memory.
struct alignas(32) ForceRecord {
    Vector<double> force;  // N, on body 1
    double normalForce;    // N, repulsion positive
};

/// What one contact did in a step, kept only when a ledger is asked for.
struct alignas(32) EnergyRecord {
    double elastic;     // J, stored in the overlap
    double damping;     // W, lost in the normal dashpot
    double adhesion;    // W, done against the adhesion
    double tangential;  // W, given to the tangential spring, dashpot and slider
};

/// How many numbers a Template<T> of nothing but T holds.
template <template <class> class Columns>
inline constexpr std::size_t columnsOf = std::is_empty_v<Columns<double>>
                                             ? 0
                                             : sizeof(Columns<double>) / sizeof(double);

/// The memory where the mask is set, zero elsewhere.
template <template <class> class Memory>
Memory<Pack> selectColumns(Mask mask, const Memory<Pack>& memory) {
    auto packs = std::bit_cast<std::array<Pack, columnsOf<Memory>>>(memory);
    for (Pack& pack : packs) pack = select(mask, pack, Pack(0));
    return std::bit_cast<Memory<Pack>>(packs);
}

/// The column form of a law's memory: block b has columns[b * count] ... and lane k of each is contact k's
/// number.
template <template <class> class Memory>
struct MemoryColumns {
    static constexpr std::size_t count = columnsOf<Memory>;
    std::vector<LaneColumn> columns;

    void resize(std::size_t blocks) { columns.assign(blocks * count, {}); }

    [[nodiscard]] Memory<Pack> load(std::size_t block) const {
        if constexpr (count == 0) {
            return {};
        } else {
            std::array<Pack, count> packs;
            for (std::size_t c = 0; c < count; ++c)
                packs[c] = Pack::load(columns[block * count + c].lane.data());
            return std::bit_cast<Memory<Pack>>(packs);
        }
    }
    void store(std::size_t block, const Memory<Pack>& memory) {
        if constexpr (count > 0) {
            const auto packs = std::bit_cast<std::array<Pack, count>>(memory);
            for (std::size_t c = 0; c < count; ++c) packs[c].store(columns[block * count + c].lane.data());
        }
    }
    [[nodiscard]] Memory<double> get(std::size_t contact) const {
        if constexpr (count == 0) {
            return {};
        } else {
            std::array<double, count> numbers;
            for (std::size_t c = 0; c < count; ++c)
                numbers[c] = columns[contact / Pack::lanes * count + c].lane[contact % Pack::lanes];
            return std::bit_cast<Memory<double>>(numbers);
        }
    }
    void set(std::size_t contact, const Memory<double>& memory) {
        if constexpr (count > 0) {
            const auto numbers = std::bit_cast<std::array<double, count>>(memory);
            for (std::size_t c = 0; c < count; ++c)
                columns[contact / Pack::lanes * count + c].lane[contact % Pack::lanes] = numbers[c];
        }
    }
};

/// Blocks [begin, end) whose contacts all join the same two species, or a species and one wall.
struct Bucket {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    int species1 = 0;
    int species2 = 0;
    int wall = -1;  // -1: grains with grains
};

/// All listed contacts of a scene, as columns in blocks of eight.
template <class S>
class ContactStore {
public:
    template <class T>
    using History = typename S::Friction::template History<T>;
    template <class T>
    using Interaction = typename S::Adhesion::template Interaction<T>;
    using Record = std::conditional_t<S::hasTorque, ForceTorqueRecord, ForceRecord>;

    std::vector<Bucket> buckets;
    std::vector<ContactBlock> blocks;
    std::vector<BlockState> states;
    MemoryColumns<History> history;
    MemoryColumns<Interaction> interaction;
    std::vector<Record> records;
    std::vector<WallPointColumns> wallPoints;  // of the wall blocks, which come last
    std::vector<EnergyRecord> energies;        // empty unless a ledger is asked for

    /// The contacts of each grain: 2 x contact + (0: as body 1, 1: as body 2), of the grain at place i in
    /// sides[sidesBegin[i]] ... sides[sidesBegin[i + 1] - 1].
    std::vector<std::uint32_t> sidesBegin;
    std::vector<std::uint32_t> sides;

    [[nodiscard]] std::size_t blockCount() const { return blocks.size(); }
    [[nodiscard]] bool touches(std::uint32_t contact) const {
        return (states[contact / Pack::lanes].touching >> (contact % Pack::lanes) & 1) != 0;
    }
    /// Whether the contact has a force: it touches or is bridged.
    [[nodiscard]] bool acts(std::uint32_t contact) const {
        const BlockState& state = states[contact / Pack::lanes];
        return ((state.touching | state.bridged) >> (contact % Pack::lanes) & 1) != 0;
    }
    /// Of memory that the contacts take.
    [[nodiscard]] std::size_t bytes() const {
        return bytesOf(buckets, blocks, states, history.columns, interaction.columns, records, wallPoints,
                       energies, sidesBegin, sides);
    }
    /// Calls function(bucket, contact) for each listed contact.
    template <class Function>
    void forEachListed(Function&& function) const {
        for (const Bucket& bucket : buckets)
            for (std::uint32_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c)
                if ((states[c / Pack::lanes].listed >> (c % Pack::lanes) & 1) != 0) function(bucket, c);
    }
    [[nodiscard]] std::size_t firstWallBlock() const { return blocks.size() - wallPoints.size(); }

    /// Bytes that one listed contact takes, without the ledger.
    static constexpr std::size_t bytesPerContact() {
        return (sizeof(ContactBlock) + sizeof(BlockState)) / Pack::lanes + sizeof(Record) +
               2 * sizeof(std::uint32_t) + sizeof(double) * (columnsOf<History> + columnsOf<Interaction>);
    }
};

}  // namespace pendular
