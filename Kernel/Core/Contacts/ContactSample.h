#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// A spring with dashpot and slider at the end of a step.
struct SliderSample {
    Vector<double> spring{0, 0, 0};  // N, force of the spring on body 1
    Vector<double> rest{0, 0, 0};    // N, what the force is besides: the dashpot's, if it does not slide
    double stretch2 = 0;             // m^2, of the spring
    double stiffness = 0;            // N/m
    double slides = 0;               // 1 or 0

    /// J
    [[nodiscard]] double stored() const { return 0.5 * stiffness * stretch2; }
};

/// What a bridge gives body 1 against the motion of its ends, at the end of a step.
struct BridgeSample {
    double normalForce = 0;          // N, repulsion
    Vector<double> drag{0, 0, 0};    // N, tangential
    Vector<double> torque{0, 0, 0};  // N, over the effective radius
};

// What a contact does at the end of a step, by mechanism; all zero where it does not act. The parts that a
// contact does not have stay zero, and are not touched: a scene of many contacts waits for its memory.

/// Of all contacts.
struct CoreSample {
    double touching = 0, bridged = 0;  // 1 or 0
    Vector<double> normal{0, 0, 0};    // unit, from body 1 to body 2
    double halfOverlap = 0;            // m
    double effectiveRadius = 0;        // m
    double elasticForce = 0;           // N, repulsion of the normal law
    double dashpotForce = 0;           // N, repulsion
    double adhesiveForce = 0;          // N, attraction
    double elasticEnergy = 0;          // J, that the overlap gives back
    double creepLoss = 0;              // J of it, that the creep of the law has taken at this sample
    SliderSample sliding;
};
/// Of contacts with walls.
struct WallSample {
    Vector<double> wallVelocity{0, 0, 0};  // m/s, of a wall's surface
    Vector<double> wallSpin{0, 0, 0};      // rad/s, of a wall
    Vector<double> wallPoint{0, 0, 0};     // m, where a wall is touched
};
/// Of bodies that are no spheres.
struct ArmSample {
    Vector<double> arm1{0, 0, 0};  // m, of body 1 to the contact; zero of a sphere
    Vector<double> arm2{0, 0, 0};  // m, of body 2
};
/// Of laws with a torque of their own: torques on body 1 over the effective radius.
struct CoupleSample {
    SliderSample rolling, torsion;
};
struct ContactSample : CoreSample, WallSample, ArmSample, CoupleSample {
    BridgeSample bridge;

    [[nodiscard]] bool isShaped() const { return arm1 != Vector<double>{0, 0, 0}; }
    [[nodiscard]] bool acts() const { return touching + bridged > 0; }
};

/// What the account of the energy reads of a contact; kept only where there is one.
struct EnergyRecord {
    ContactSample now, last;  // at the end of this step and of the one before
    double adhesionWork = 0;  // J, done against the adhesion since it began to act
    double lastWall = -1;     // number of the wall that the last sample is of; -1: none

    /// The energy (J) in the springs and the adhesion, as the ledger counts it.
    [[nodiscard]] double stored() const {
        return last.elasticEnergy + last.sliding.stored() + last.rolling.stored() + last.torsion.stored() +
               adhesionWork;
    }
};

/// The records of contacts by slots of their memory. Where walls alone have samples those of blocks in which
/// none has been written are not there, and are read as records of contacts that do not act.
class EnergyRecords {
public:
    [[nodiscard]] bool empty() const { return !areKept; }
    /// Records of so many slots that do not act, or none.
    void reset(bool keep, std::size_t count) {
        areKept = keep;
        all.clear(), blocks.clear();
        if (keep) resize(count);
    }
    /// From now on only blocks in which something is written take memory.
    void makeSparse();
    [[nodiscard]] bool areSparse() const { return sparse; }
    void resize(std::size_t count) {
        if (sparse) blocks.resize((count + lanes - 1) / lanes);
        else all.resize(count);
    }
    void reserve(std::size_t count) {
        if (sparse) blocks.reserve((count + lanes - 1) / lanes);
        else all.reserve(count);
    }
    /// To write. Different blocks at the same time.
    [[nodiscard]] EnergyRecord& operator[](std::size_t slot) {
        if (!sparse) return all[slot];
        std::vector<EnergyRecord>& block = blocks[slot / lanes];
        if (block.empty()) block.resize(lanes);
        return block[slot % lanes];
    }
    [[nodiscard]] const EnergyRecord& operator[](std::size_t slot) const {
        static constexpr EnergyRecord none{};
        if (!sparse) return all[slot];
        const std::vector<EnergyRecord>& block = blocks[slot / lanes];
        return block.empty() ? none : block[slot % lanes];
    }
    /// The same as (*this)[slot] = record, but a record that does not act takes no memory.
    void put(std::size_t slot, const EnergyRecord& record);
    /// Brings them to other places. @param origins of each new slot the old one, or `nothing`
    void rearrangeSparse(const std::vector<std::uint32_t>& origins, std::uint32_t nothing, int threads);
    [[nodiscard]] std::size_t bytes() const;

private:
    static constexpr std::size_t lanes = 8;

    bool areKept = false, sparse = false;
    std::vector<EnergyRecord> all;                  // unless they are sparse
    std::vector<std::vector<EnergyRecord>> blocks;  // else; empty where nothing was written
};

}  // namespace pendular
