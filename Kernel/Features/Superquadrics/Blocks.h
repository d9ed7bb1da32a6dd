#pragma once

#include <vector>

#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Features/RigidBodies/BodyHandler.h"
#include "Kernel/Features/Superquadrics/BlockGrain.h"
#include "Kernel/Features/Superquadrics/RoundedBoxTouch.h"

namespace pendular {

class StateArchive;

/// What a grain of a scene with blocks is. A block is a rigid body of 21 grains, in this order: its core,
/// which is the whole box and touches spheres and the corners of other blocks; its 8 corners, spheres that
/// touch the cores of other blocks, and walls; and its 12 edges, which touch those of other blocks. Nothing
/// else touches.
struct BlockPart {
    enum class Kind : std::uint8_t { Sphere, Core, Corner, Edge };
    Kind kind = Kind::Sphere;         // Sphere: a grain of its own, or of a clump
    std::uint32_t box = 0;            // the place of its block's shape
    std::uint32_t number = 0;         // of a corner or an edge, see RoundedBox
    const RigidBody* body = nullptr;  // of a grain of a block
    Vector<double> arm{0, 0, 0};      // m, from the centre of the block, in its axes
    bool isHeld = false;
};

/// The blocks of a scene.
class Blocks {
public:
    /// Adds the grains of a block and joins them.
    BodyReference add(ParticleHandler& particles, const BlockGrain& grain);

    [[nodiscard]] bool empty() const { return boxes.empty(); }
    /// The box of the body with a number; null of others.
    [[nodiscard]] const RoundedBox* ofBody(std::uint32_t number) const {
        if (number >= boxOfBody.size() || boxOfBody[number] == RigidBodies::none) return nullptr;
        return &boxes[boxOfBody[number]];
    }
    [[nodiscard]] const RoundedBox& boxOf(const BlockPart& part) const { return boxes[part.box]; }
    /// The grain at a place of the store, of which the place of its body is known (RigidBodies::at()).
    [[nodiscard]] BlockPart partOf(const ParticleStore& grains, std::uint32_t place,
                                   std::uint32_t body) const;
    /// The same, of any time.
    [[nodiscard]] BlockPart partOf(const ParticleStore& grains, std::uint32_t place) const;

    /// How two grains touch. @param radius1, radius2 m, in the store; @param shift m, centre 2 - centre 1
    [[nodiscard]] BoxTouch touch(const BlockPart& first, double radius1, const BlockPart& second,
                                 double radius2, const Vector<double>& shift) const;
    /// m, by which the cuboids of two blocks go through each other, of their cores; 0 of other grains. No
    /// contact need tell of it: that of two beams that cross is with their edges.
    [[nodiscard]] double hiddenOverlap(const ParticleStore& grains, std::uint32_t first, std::uint32_t second,
                                       const Vector<double>& shift) const;
    /// Whether all bodies that are to be blocks have the grains of one.
    [[nodiscard]] bool areWhole(const RigidBodies& bodies) const;
    /// Whether a grain touches walls.
    static bool touchesWalls(const BlockPart& part) {
        return part.kind == BlockPart::Kind::Sphere || part.kind == BlockPart::Kind::Corner;
    }
    /// What the contacts of a grain can be at most: of a part of a block, as if it were at the farthest point
    /// of the block, with its smallest moment.
    [[nodiscard]] ShapeExtremes extremesOf(const BlockPart& part, double radius) const;
    /// A box or a solid inside of it, for pictures.
    [[nodiscard]] ShapeInSpace shapeOf(const BlockPart& part, double radius) const;
    /// As of GrainShapes::largestRadiusRatio().
    [[nodiscard]] double largestRadiusRatio() const { return largestRatio; }

    void visitState(StateArchive& archive);

private:
    std::uint32_t numberOf(const RoundedBox& box);

    std::vector<RoundedBox> boxes;             // that differ
    std::vector<double> contactRadii;          // m, of each: RoundedBox::largestContactRadius()
    std::vector<std::uint32_t> boxOfBody;      // by the number of the body
    double largestRatio = 1, largestEdge = 0;  // largestEdge: m, radius
};

/// Why a wall cannot stand beside blocks; empty if it can.
[[nodiscard]] std::string objectionToWallOfBlocks(const Wall& wall);

}  // namespace pendular
