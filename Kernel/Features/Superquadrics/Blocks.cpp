#include "Kernel/Features/Superquadrics/Blocks.h"

#include <algorithm>

#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Core/Walls/InfiniteWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/Superquadrics/SuperquadricBody.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

namespace {

constexpr std::uint32_t firstCorner = 1, firstEdge = firstCorner + RoundedBox::corners;

/// The arms (m) of the grains of a block, and their radii (m).
struct Parts {
    std::vector<Vector<double>> arms{{0, 0, 0}};
    std::vector<double> radii;

    explicit Parts(const RoundedBox& box) : radii{box.boundingRadius()} {
        for (std::size_t k = 0; k < RoundedBox::corners; ++k) {
            arms.push_back(box.corner(k));
            radii.push_back(box.radius);
        }
        for (std::size_t k = 0; k < RoundedBox::edges; ++k) {
            arms.push_back(box.middle(k));
            radii.push_back(box.halfLength(k) + box.radius);
        }
    }
};

RigidBody bodyOfBlock(const BlockGrain& grain, double density) {
    RigidBody body = bodyOf(grain, grain.getBox().mass(), density);
    // Negative: so does each of its grains count in the stability limit (GrainSizes).
    body.largestFreeMass = -sphereMass(grain.getBox().radiusAtContacts(), density);
    return body;
}

}  // namespace

std::uint32_t Blocks::numberOf(const RoundedBox& box) {
    const auto isSame = [&](const RoundedBox& b) { return b.half == box.half && b.radius == box.radius; };
    const auto found = std::ranges::find_if(boxes, isSame);
    if (found != boxes.end()) return static_cast<std::uint32_t>(found - boxes.begin());
    boxes.push_back(box);
    contactRadii.push_back(box.largestContactRadius());
    largestEdge = std::max(largestEdge, box.radius);
    // Hertz's law takes half the radius at contacts for two such grains.
    largestRatio = std::max(largestRatio, 2 * contactRadii.back() / box.radiusAtContacts());
    return static_cast<std::uint32_t>(boxes.size() - 1);
}

BodyReference Blocks::add(ParticleHandler& particles, const BlockGrain& grain) {
    const SphericalParticle& around = grain.around();
    const Parts parts(grain.getBox());
    const Axes<double> axes(
        Quaternion{grain.getOrientation().w(), toVector(Vec3D(grain.getOrientation().vec()))});
    std::vector<std::uint32_t> identities;
    std::vector<BodyMember> members;
    try {
        for (std::size_t k = 0; k < parts.arms.size(); ++k) {
            SphericalParticle part(around);
            part.setRadius(parts.radii[k]);
            part.setPosition(around.getPosition() + toEigen(axes.turn(parts.arms[k])));
            identities.push_back(particles.copyAndAddObject(part).getId());
            members.push_back({identities.back(), parts.arms[k], k == 0 ? 1.0 : 0.0});
        }
    } catch (...) {
        for (const std::uint32_t identity : identities) particles.removeObject(identity);
        throw;
    }
    ParticleStore& grains = particles.store();
    const double density =
        particles.massOf(around.getRadius(), around.getSpeciesIndex()) / sphereMass(around.getRadius(), 1);
    const std::uint32_t number =
        grains.bodies.add(bodyOfBlock(grain, density), members, grain.getBox().mass().volume);
    grains.bodies.place(grains, grains.bodies.size() - 1);
    ParticleHandler::Inside::noteJoined(particles, identities);
    boxOfBody.resize(number, RigidBodies::none);
    boxOfBody.push_back(numberOf(grain.getBox()));
    return {particles, number};
}

BlockPart Blocks::partOf(const ParticleStore& grains, std::uint32_t place, std::uint32_t body) const {
    BlockPart part;
    if (body >= grains.bodies.sizeWithGhosts()) return part;
    const std::uint32_t number = grains.bodies.numberOf(body);
    if (!ofBody(number)) return part;
    const std::span<const BodyMember> members = grains.bodies.membersOf(body);
    const std::uint32_t rank = grains.identity[place] - members.front().grain;  // they were added in a row
    part.box = boxOfBody[number];
    part.body = &grains.bodies[body];
    part.isHeld = grains.bodies.isHeld(body);
    if (rank == 0) {
        part.kind = BlockPart::Kind::Core;
        return part;
    }
    const bool isCorner = rank < firstEdge;
    part.kind = isCorner ? BlockPart::Kind::Corner : BlockPart::Kind::Edge;
    part.number = rank - (isCorner ? firstCorner : firstEdge);
    part.arm = members[rank].arm;
    return part;
}

BlockPart Blocks::partOf(const ParticleStore& grains, std::uint32_t place) const {
    const std::uint32_t number = grains.bodies.bodyOf(grains.identity[place]);
    return number == RigidBodies::none ? BlockPart{} : partOf(grains, place, grains.bodies.find(number));
}

BoxTouch Blocks::touch(const BlockPart& first, double radius1, const BlockPart& second, double radius2,
                       const Vector<double>& shift) const {
    using Kind = BlockPart::Kind;
    const double sum = radius1 + radius2;
    if (!(squaredNorm(shift) < sum * sum)) return {};
    if (first.kind == Kind::Edge && second.kind == Kind::Edge)
        return touchOfEdges({boxOf(first), Axes<double>(first.body->orientation), first.number},
                            {boxOf(second), Axes<double>(second.body->orientation), second.number}, shift);
    if (first.kind == Kind::Sphere && second.kind == Kind::Sphere)
        return touchOfSpheres(radius1, radius2, shift);
    const auto ofCore = [&](const BlockPart& core, double sphere, const Vector<double>& way) {
        return touchOfBox(boxOf(core), Axes<double>(core.body->orientation), contactRadii[core.box], sphere,
                          way);
    };
    if (first.kind == Kind::Core && touchesWalls(second)) return ofCore(first, radius2, shift);
    if (second.kind == Kind::Core && touchesWalls(first))
        return reversed(ofCore(second, radius1, -shift), shift);
    return {};
}

double Blocks::hiddenOverlap(const ParticleStore& grains, std::uint32_t first, std::uint32_t second,
                             const Vector<double>& shift) const {
    const BlockPart one = partOf(grains, first), two = partOf(grains, second);
    if (one.kind != BlockPart::Kind::Core || two.kind != BlockPart::Kind::Core) return 0;
    return overlapOfCuboids(boxOf(one), Axes<double>(one.body->orientation), boxOf(two),
                            Axes<double>(two.body->orientation), shift);
}

bool Blocks::areWhole(const RigidBodies& bodies) const {
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        if (!ofBody(bodies.numberOf(k))) continue;
        const std::span<const BodyMember> members = bodies.membersOf(k);
        if (members.size() != firstEdge + RoundedBox::edges) return false;
        for (std::size_t m = 1; m < members.size(); ++m)
            if (members[m].grain != members[0].grain + m) return false;
    }
    return true;
}

ShapeExtremes Blocks::extremesOf(const BlockPart& part, double radius) const {
    if (!part.body) return {radius, radius, 0, 0, 0};
    const double lever = boxOf(part).boundingRadius();
    const Vector<double>& inertia = part.body->inertia;
    const double turning = part.body->mass * lever * lever / std::min({inertia.x, inertia.y, inertia.z});
    // A core takes the radius of what touches it, and two edges the mean of theirs, which is at most the
    // larger one.
    using Kind = BlockPart::Kind;
    const double around = part.kind == Kind::Corner ? radius
                          : part.kind == Kind::Edge ? 2 * largestEdge
                                                    : infinity;
    return {part.kind == Kind::Corner ? radius : infinity, around, turning, turning, lever};
}

ShapeInSpace Blocks::shapeOf(const BlockPart& part, double radius) const {
    if (part.kind == BlockPart::Kind::Sphere || part.kind == BlockPart::Kind::Corner)
        return {{radius, radius, radius}, Axes<double>(Quaternion{})};
    const Axes<double> axes(part.body->orientation);
    const RoundedBox& box = boxOf(part);
    if (part.kind == BlockPart::Kind::Core) {
        const Vector<double> outer = box.outer();
        return {{outer.x, outer.y, outer.z, Superquadric::largestExponent, Superquadric::largestExponent},
                axes,
                box.radius};
    }
    const std::size_t axis = RoundedBox::axisOf(part.number);
    const auto along = [&](std::size_t k) { return k == axis ? radius : box.radius; };
    return {{along(0), along(1), along(2)}, axes};
}

void Blocks::visitState(StateArchive& archive) {
    if (archive.isReading()) boxes.clear(), contactRadii.clear(), boxOfBody.clear();
    if (archive.isReading() ? !archive.holds("blockHalfLengths") : boxes.empty()) return;
    std::vector<Vector<double>> halfLengths;
    std::vector<double> radii;
    for (const RoundedBox& box : boxes) halfLengths.push_back(box.half), radii.push_back(box.radius);
    archive.column<double>("blockHalfLengths", halfLengths);
    archive.column<double>("blockRadii", radii);
    archive.column<std::uint32_t>("blockOfBody", boxOfBody);
    if (!archive.isReading()) return;
    archive.require(radii.size() == halfLengths.size(), "blockRadii", "does not have one of each block");
    for (std::size_t k = 0; k < radii.size(); ++k) {
        const Vector<double>& half = halfLengths[k];
        archive.require(half.x > 0 && half.y > 0 && half.z > 0 && half.x + half.y + half.z < infinity,
                        "blockHalfLengths", "has one that is not positive");
        archive.require(radii[k] > 0 && radii[k] < infinity, "blockRadii", "has one that is not positive");
        static_cast<void>(numberOf({half, radii[k]}));
        archive.require(boxes.size() == k + 1, "blockHalfLengths", "has a block twice");
    }
    const auto isThere = [&](std::uint32_t box) { return box < boxes.size() || box == RigidBodies::none; };
    archive.require(std::ranges::all_of(boxOfBody, isThere), "blockOfBody", "has one that is not there");
}

std::string objectionToWallOfBlocks(const Wall& wall) {
    if (dynamic_cast<const InfiniteWall*>(&wall)) return {};
    const auto* const tube = dynamic_cast<const InfiniteCylinder*>(&wall);
    if (tube && !tube->hasConvexParts()) return {};
    return "blocks touch walls by their corners, which are enough at planes and inside of tubes only: build "
           "it of InfiniteWall and InfiniteCylinder (inside), or take superquadrics";
}

}  // namespace pendular
