#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Features/RigidBodies/BodyHandler.h"
#include "Kernel/Features/Superquadrics/Blocks.h"
#include "Kernel/Features/Superquadrics/ExtremeContact.h"
#include "Kernel/Features/Superquadrics/ShapeAtWall.h"
#include "Kernel/Features/Superquadrics/SuperquadricGeometry.h"
#include "Kernel/Features/Superquadrics/SuperquadricGrain.h"

namespace pendular {

struct ContactTask;
class StateArchive;

/// The superquadrics of a scene, beside its spheres and clumps. Each is a rigid body (BodyHandler) of one
/// grain, the sphere around it, whose principal axes are those of the shape.
class SuperquadricHandler final : public GrainShapes {
public:
    explicit SuperquadricHandler(ParticleHandler& particleHandler) : particles(particleHandler) {}

    /// Adds a grain; returns its body. Throws InputError as copyAndAddObject() of grains does.
    BodyReference copyAndAddObject(const SuperquadricGrain& grain);
    /// Adds a block, which may not be in one scene with superquadrics; returns its body.
    BodyReference copyAndAddObject(const BlockGrain& grain);
    /// The box of a body, by its number. Throws InputError if it is no block.
    [[nodiscard]] const RoundedBox& boxOf(std::size_t body) const;
    /// The shape of a grain, by its identity. Throws InputError if it is none of these.
    [[nodiscard]] const Superquadric& shapeOf(std::uint32_t grain) const;
    /// The number of evaluations of contacts of two grains that acted in which Newton's method has not ended,
    /// and the search without derivatives went on. That of contacts with walls is not counted.
    [[nodiscard]] std::uint64_t fallbacks() const { return fallbackCount; }

    /// Of a block, its core.
    [[nodiscard]] bool isShaped(const ParticleStore& grains, std::uint32_t place) const override {
        if (!blocks.empty()) return blocks.partOf(grains, place).kind == BlockPart::Kind::Core;
        return ofBody(grains.bodies.bodyOf(grains.identity[place])) != nullptr;
    }
    [[nodiscard]] Vector<double> farthest(const ParticleStore& grains, std::uint32_t place,
                                          const Vector<double>& normal) const override;
    [[nodiscard]] ShapeInSpace shapeAt(const ParticleStore& grains, std::uint32_t place) const override;
    [[nodiscard]] ShapeExtremes extremesAt(const ParticleStore& grains, std::uint32_t place) const override;
    /// The smallest half length is the radius that overlaps are held against, that of its edges of a block.
    [[nodiscard]] double thickness(const ParticleStore& grains, std::uint32_t grain) const override;
    [[nodiscard]] ShapedTouch touch(const ParticleStore& grains, std::uint32_t first, std::uint32_t second,
                                    const Vector<double>& shift) const override;
    [[nodiscard]] double hiddenOverlap(const ParticleStore& grains, std::uint32_t first, std::uint32_t second,
                                       const Vector<double>& shift) const override {
        return blocks.empty() ? 0 : blocks.hiddenOverlap(grains, first, second, shift);
    }
    [[nodiscard]] ShapedTouch touchAtPlane(const ParticleStore& grains, std::uint32_t grain,
                                           const Vector<double>& normal, double distance) const override;
    void findPoints(const ParticleStore& grains, std::uint32_t grain, const Wall& wall, double range,
                    std::span<const std::uint32_t> parts, std::span<WallPoint> points) const override;

    [[nodiscard]] std::string objectionTo(const Wall& wall) const override {
        return blocks.empty() ? std::string() : objectionToWallOfBlocks(wall);
    }

    void add(const SuperquadricGrain& grain) override { static_cast<void>(copyAndAddObject(grain)); }
    void expect(const Superquadric& shape) override {
        refuseBesideBlocks();
        noteExtremes(shape, contactOf(shape));
    }
    [[nodiscard]] double largestRadiusRatio() const override {
        return std::max(largestRadii, blocks.largestRadiusRatio());
    }
    /// The smallest principal radius of curvature of all shapes over that of the sphere around.
    [[nodiscard]] double smallestRadiusRatio() const { return smallestRadius; }
    /// The factor by which a torque at a contact turns a shape faster than the sphere around, at most: of the
    /// effective radius times the spin.
    [[nodiscard]] double largestTurningRatio() const { return largestTurning; }
    /// The scene's species attract: blocks, which do not, are refused.
    void setAdhesive() { isAdhesive = true; }
    /// The geometry of the eight contacts of a block.
    /// @param adhesion laws that attract; null if there are none
    [[nodiscard]] SuperquadricGeometry geometryOf(const ContactTask& task, std::size_t block,
                                                  const ContactLaws* adhesion) const;
    void visitState(StateArchive& archive);

private:
    /// The shape of the body with a number; null of clumps, and of grains in no body.
    [[nodiscard]] const Superquadric* ofBody(std::uint32_t number) const {
        if (number >= shapeOfBody.size() || shapeOfBody[number] == RigidBodies::none) return nullptr;
        return &shapes[shapeOfBody[number]];
    }
    void refuseBesideBlocks() const;
    void noteExtremes(const Superquadric& shape, const ExtremeContact& extreme);
    /// As geometryOf(), in a scene with blocks.
    [[nodiscard]] SuperquadricGeometry geometryOfBlocks(const ContactTask& task, std::size_t block) const;
    [[nodiscard]] ShapeAtWall atWalls(const ParticleStore& grains, std::uint32_t place) const;
    [[nodiscard]] std::uint32_t numberOf(const Superquadric& shape);
    void addShape(const Superquadric& shape);
    [[nodiscard]] const ExtremeContact& contactOf(const Superquadric& shape);
    void visitExtremes(StateArchive& archive);
    /// m: Gauss' radius, or the most that the laws take of two bodies.
    [[nodiscard]] static double radiusOf(double gauss, const Bodies& around) {
        return std::min(gauss, SuperquadricGeometry::mostRadii * around.effectiveRadius());
    }

    ParticleHandler& particles;
    Blocks blocks;
    std::vector<Superquadric> shapes;                        // that differ
    std::vector<ExtremeContact> contacts;                    // of each of them
    std::vector<double> balls;                               // m, of each: see ShapeAtWall
    std::map<std::array<double, 5>, std::uint32_t> numbers;  // of shapes, by lengths and exponents
    std::vector<std::uint32_t> shapeOfBody;                  // by the number of the body
    bool areEllipsoids = true;  // all: one way for a whole scene, so that no bit depends on
                                // which contacts are in a block
    double largestRadii = 1, smallestRadius = 1, largestTurning = 1;
    bool isAdhesive = false;
    /// Of shapes that are not scaled others. Restart files have them: found again for another size of a
    /// shape, they would differ by round-off.
    std::vector<std::pair<Superquadric, ExtremeContact>> extremes;
    mutable std::atomic<std::uint64_t> fallbackCount = 0;
};

}  // namespace pendular
