#include "Kernel/Features/Superquadrics/SuperquadricHandler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Features/Superquadrics/SuperquadricBody.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

std::uint32_t SuperquadricHandler::numberOf(const Superquadric& shape) {
    const auto [found, isNew] =
        numbers.try_emplace({shape.a, shape.b, shape.c, 1.0 * shape.n1, 1.0 * shape.n2},
                            static_cast<std::uint32_t>(shapes.size()));
    if (isNew) addShape(shape);
    return found->second;
}

void SuperquadricHandler::addShape(const Superquadric& shape) {
    const ExtremeContact& extreme = contactOf(shape);
    shapes.push_back(shape);
    balls.push_back(extreme.smallestRadius * shape.boundingRadius());
    areEllipsoids &= shape.isEllipsoid();
    contacts.push_back(extreme);
    noteExtremes(shape, extreme);
}

/// A sphere of this mass around the shape has the moment 2/5 m r^2.
void SuperquadricHandler::noteExtremes(const Superquadric& shape, const ExtremeContact& extreme) {
    largestRadii = std::max(largestRadii, extreme.radii);
    smallestRadius = std::min(smallestRadius, extreme.smallestRadius);
    const MassProperties solid = shape.mass();
    const double around = shape.boundingRadius(),
                 least = solid.inertia.diagonal().minCoeff() / solid.volume;  // m^2
    largestTurning = std::max(largestTurning, 0.4 * around * around / least * extreme.radii * extreme.radii);
}

const ExtremeContact& SuperquadricHandler::contactOf(const Superquadric& shape) {
    const auto isScaled = [&](const auto& known) {
        const double scale = shape.a / known.first.a;
        const auto isNear = [&](double own, double other) {
            return std::abs(own - scale * other) < 1e-9 * own;
        };
        return isNear(shape.b, known.first.b) && isNear(shape.c, known.first.c) &&
               shape.n1 == known.first.n1 && shape.n2 == known.first.n2;
    };
    const auto found = std::ranges::find_if(extremes, isScaled);
    if (found != extremes.end()) return found->second;
    return extremes.emplace_back(shape, extremeContact(shape)).second;
}

void SuperquadricHandler::refuseBesideBlocks() const {
    if (!blocks.empty())
        throw InputError(
            "SuperquadricHandler: superquadrics cannot be in a scene with blocks, because it is not known "
            "how "
            "these touch each other: take spheres or clumps beside blocks, or give superquadrics exponents "
            "of "
            "8 in place of blocks.");
}

BodyReference SuperquadricHandler::copyAndAddObject(const BlockGrain& grain) {
    if (isAdhesive)
        throw InputError(
            "SuperquadricHandler: blocks do not adhere, because flat faces attract each other by their area, "
            "of which corners and edges know nothing: take a species without adhesion, or superquadrics.");
    if (!shapes.empty())
        throw InputError(
            "SuperquadricHandler: blocks cannot be in a scene with superquadrics, because it is not known "
            "how "
            "these touch each other: take spheres or clumps beside blocks, or superquadrics with exponents "
            "of "
            "8 in place of blocks.");
    return blocks.add(particles, grain);
}

const RoundedBox& SuperquadricHandler::boxOf(std::size_t body) const {
    if (const RoundedBox* const box = blocks.ofBody(static_cast<std::uint32_t>(body))) return *box;
    throw InputError(fmt::format("rigid body {} is no block.", body));
}

BodyReference SuperquadricHandler::copyAndAddObject(const SuperquadricGrain& grain) {
    refuseBesideBlocks();
    const std::uint32_t identity = particles.copyAndAddObject(grain.around()).getId();
    ParticleStore& grains = particles.store();
    const double density = particles.massOf(grain.around().getRadius(), grain.around().getSpeciesIndex()) /
                           sphereMass(grain.around().getRadius(), 1);
    const BodyMember member{identity, {0, 0, 0}};
    const std::uint32_t number = grains.bodies.add(
        bodyOf(grain, density, contactOf(grain.getShape()).turning), {&member, 1}, grain.getShape().volume());
    grains.bodies.place(grains, grains.bodies.size() - 1);
    ParticleHandler::Inside::noteJoined(particles, {&identity, 1});
    shapeOfBody.resize(number, RigidBodies::none);
    shapeOfBody.push_back(numberOf(grain.getShape()));
    return {particles, number};
}

const Superquadric& SuperquadricHandler::shapeOf(std::uint32_t grain) const {
    const std::uint32_t body = particles.store().bodies.bodyOf(grain);
    if (const Superquadric* const shape = ofBody(body)) return *shape;
    throw InputError(fmt::format("particle {} is no superquadric.", grain));
}

ShapeInSpace SuperquadricHandler::shapeAt(const ParticleStore& grains, std::uint32_t place) const {
    if (!blocks.empty())
        return blocks.shapeOf(blocks.partOf(grains, place), grains.translation[place].radius);
    const std::uint32_t number = grains.bodies.bodyOf(grains.identity[place]);
    if (const Superquadric* const shape = ofBody(number))
        return {*shape, Axes<double>(grains.bodies[grains.bodies.find(number)].orientation)};
    const double radius = grains.translation[place].radius;
    return {{radius, radius, radius}, Axes<double>(Quaternion{})};
}

Vector<double> SuperquadricHandler::farthest(const ParticleStore& grains, std::uint32_t place,
                                             const Vector<double>& normal) const {
    const ShapeInSpace own = shapeAt(grains, place);
    if (own.edgeRadius > 0)
        return own.axes.turn(blocks.boxOf(blocks.partOf(grains, place)).support(own.axes.turnBack(normal)));
    return own.axes.turn(
        supportPoint(SuperquadricLanes<double>::from(own.shape), own.axes.turnBack(normal)).point);
}

double SuperquadricHandler::thickness(const ParticleStore& grains, std::uint32_t grain) const {
    if (!blocks.empty()) {
        const BlockPart part = blocks.partOf(grains, grain);
        return part.body ? blocks.boxOf(part).radius : grains.translation[grain].radius;
    }
    const Superquadric shape = shapeAt(grains, grain).shape;
    return std::min({shape.a, shape.b, shape.c});
}

/// An ellipsoid is flattest where its smallest half axis ends; a superquadric is flat where any one does. A
/// sphere is alike everywhere, and its contacts turn it by sliding only.
ShapeExtremes SuperquadricHandler::extremesAt(const ParticleStore& grains, std::uint32_t place) const {
    const double around = grains.translation[place].radius;
    if (!blocks.empty()) return blocks.extremesOf(blocks.partOf(grains, place), around);
    if (!isShaped(grains, place)) return {around, around, 0, 0, 0};
    const std::uint32_t body = grains.bodies.bodyOf(grains.identity[place]), number = shapeOfBody[body];
    const Superquadric& s = shapes[number];
    const ExtremeContact& contact = contacts[number];
    const RigidBody& own = grains.bodies[grains.bodies.find(body)];
    const double thin = std::min({s.a, s.b, s.c}),
                 moment = std::max({own.inertia.x, own.inertia.y, own.inertia.z});
    return {.radius = s.isEllipsoid() ? s.a * s.b * s.c / (thin * thin) : infinity,
            .around = SuperquadricGeometry::mostRadii * around,
            .turning = contact.turning,
            .sliding = contact.sliding,
            .lever = std::sqrt(contact.turning * moment / own.mass)};
}

ShapedTouch SuperquadricHandler::touch(const ParticleStore& grains, std::uint32_t first, std::uint32_t second,
                                       const Vector<double>& shift) const {
    if (!blocks.empty()) {
        const BoxTouch found =
            blocks.touch(blocks.partOf(grains, first), grains.translation[first].radius,
                         blocks.partOf(grains, second), grains.translation[second].radius, shift);
        return {found.normal, found.depth, found.arm1, found.radius};
    }
    const ShapeInSpace one = shapeAt(grains, first), two = shapeAt(grains, second);
    const SuperquadricPair<double> pair{SuperquadricLanes<double>::from(one.shape),
                                        SuperquadricLanes<double>::from(two.shape), one.axes, two.axes,
                                        shift};
    const SuperquadricTouch<double> found = findTouch(pair, firstNormal(pair), infinity);
    const Bodies around{grains.translation[first].radius, grains.translation[second].radius};
    return {found.normal, found.depth, found.arm1, radiusOf(found.radius, around), {found.own1, found.own2}};
}

ShapeAtWall SuperquadricHandler::atWalls(const ParticleStore& grains, std::uint32_t place) const {
    const ShapeInSpace own = shapeAt(grains, place);
    const std::uint32_t kind = shapeOfBody[grains.bodies.bodyOf(grains.identity[place])];
    return {SuperquadricLanes<double>::from(own.shape), own.axes, grains.translation[place].position,
            balls[kind]};
}

void SuperquadricHandler::findPoints(const ParticleStore& grains, std::uint32_t grain, const Wall& wall,
                                     double range, std::span<const std::uint32_t> parts,
                                     std::span<WallPoint> points) const {
    if (!blocks.empty() && !Blocks::touchesWalls(blocks.partOf(grains, grain))) {
        for (WallPoint& point : points) point = {{0, 0, 1}, infinity, {0, 0, 0}};
        return;
    }
    if (blocks.empty() && isShaped(grains, grain))
        return atWalls(grains, grain).findPoints(wall, range, parts, points);
    const TranslationRecord& sphere = grains.translation[grain];
    wall.findPoints(sphere.position, sphere.radius + range, parts, points);
}

ShapedTouch SuperquadricHandler::touchAtPlane(const ParticleStore& grains, std::uint32_t grain,
                                              const Vector<double>& normal, double distance) const {
    const ShapeInSpace own = shapeAt(grains, grain);
    const Axes<double>& axes = own.axes;
    const SupportPoint<double> lowest =
        supportPoint(SuperquadricLanes<double>::from(own.shape), axes.turnBack(normal));
    const double depth = lowest.height - distance;
    const TangentPlane<double> plane(normal);
    const double gauss = gaussRadius(curvature(lowest, axes.turnBack(plane.u), axes.turnBack(plane.v)));
    return {normal,
            depth,
            axes.turn(lowest.point) - (0.5 * depth) * normal,
            radiusOf(gauss, {grains.translation[grain].radius}),
            {gauss}};
}

void SuperquadricHandler::visitExtremes(StateArchive& archive) {
    constexpr std::size_t count = 9;
    std::vector<double> numbersOfAll;
    for (const auto& [shape, extreme] : extremes)
        for (const double number : {shape.a, shape.b, shape.c, 1.0 * shape.n1, 1.0 * shape.n2,
                                    extreme.turning, extreme.radii, extreme.sliding, extreme.smallestRadius})
            numbersOfAll.push_back(number);
    archive.column<double>("extremes", numbersOfAll);
    if (!archive.isReading()) return;
    archive.require(numbersOfAll.size() % count == 0, "extremes", "does not have nine numbers of each shape");
    archive.require(std::ranges::all_of(numbersOfAll, [](double x) { return x >= 0 && x < infinity; }),
                    "extremes", "has a number that is not positive");
    extremes.clear();
    for (std::size_t k = 0; k < numbersOfAll.size(); k += count) {
        const double* const own = numbersOfAll.data() + k;
        for (const double n : {own[3], own[4]})
            archive.require(n >= Superquadric::smallestExponent && n <= Superquadric::largestExponent,
                            "extremes", "has an exponent that is not from 2 to 8");
        extremes.emplace_back(
            Superquadric{own[0], own[1], own[2], static_cast<int>(own[3]), static_cast<int>(own[4])},
            ExtremeContact{own[5], own[6], own[7], own[8]});
    }
}

void SuperquadricHandler::visitState(StateArchive& archive) {
    visitExtremes(archive);
    std::vector<Vector<double>> halfLengths;
    std::vector<std::uint32_t> exponents;
    for (const Superquadric& s : shapes) {
        halfLengths.push_back({s.a, s.b, s.c});
        for (const int n : {s.n1, s.n2}) exponents.push_back(static_cast<std::uint32_t>(n));
    }
    archive.column<double>("halfLengths", halfLengths);
    archive.column<std::uint32_t>("exponents", exponents);
    archive.column<std::uint32_t>("shapeOfBody", shapeOfBody);
    std::uint64_t count = fallbackCount;
    archive.value("fallbacks", count);
    blocks.visitState(archive);
    if (!archive.isReading()) return;
    archive.require(blocks.areWhole(particles.store().bodies), "blockOfBody",
                    "has a body without the 21 grains of a block");
    fallbackCount = count;
    archive.require(exponents.size() == 2 * halfLengths.size(), "exponents",
                    "does not have two of each shape");
    shapes.clear(), balls.clear(), numbers.clear(), contacts.clear();
    areEllipsoids = true;
    for (std::size_t k = 0; k < halfLengths.size(); ++k) {
        const Vector<double>& lengths = halfLengths[k];
        for (const std::uint32_t n : {exponents[2 * k], exponents[2 * k + 1]})
            archive.require(n >= Superquadric::smallestExponent && n <= Superquadric::largestExponent,
                            "exponents", "has one that is not from 2 to 8");
        archive.require(
            lengths.x > 0 && lengths.y > 0 && lengths.z > 0 && lengths.x + lengths.y + lengths.z < infinity,
            "halfLengths", "has one that is not positive");
        static_cast<void>(numberOf({lengths.x, lengths.y, lengths.z, static_cast<int>(exponents[2 * k]),
                                    static_cast<int>(exponents[2 * k + 1])}));
        archive.require(shapes.size() == k + 1, "halfLengths", "has a shape twice");
    }
    archive.require(std::ranges::all_of(shapeOfBody,
                                        [&](std::uint32_t shape) {
                                            return shape < shapes.size() || shape == RigidBodies::none;
                                        }),
                    "shapeOfBody", "has one that is not there");
}

// Eight at a time
// --------------------------------------------------------------------------------------------

namespace {

using Places = std::array<std::uint32_t, Pack::lanes>;

Vector<Pack> packsOf(const std::array<Pack, 8>& p, std::size_t first) {
    return {p[first], p[first + 1], p[first + 2]};
}

}  // namespace

SuperquadricGeometry SuperquadricHandler::geometryOf(const ContactTask& task, std::size_t block,
                                                     const ContactLaws* adhesion) const {
    if (!blocks.empty()) [[unlikely]]
        return geometryOfBlocks(task, block);
    const ParticleStore& grains = ParticleHandler::Inside::grainsInStep(particles);
    const RigidBodies& bodies = grains.bodies;
    const auto eight = [&](const Places& places) {
        Places at{};
        std::array<LaneColumn, 5> numbers;
        LaneColumn moves;
        std::uint8_t shaped = 0;
        for (std::size_t k = 0; k < Pack::lanes; ++k) {
            // Lanes of grains that have gone are of no meaning.
            const std::uint32_t body = bodies.at(places[k]);
            const Superquadric* const own =
                body < bodies.sizeWithGhosts() ? ofBody(bodies.numberOf(body)) : nullptr;
            const double radius = task.translation[places[k]].radius;
            const Superquadric s = own ? *own : Superquadric{radius, radius, radius};
            at[k] = own ? body : 0;
            shaped = static_cast<std::uint8_t>(shaped | (own ? 1u : 0u) << k);
            moves.lane[k] = own && bodies.isHeld(body) ? 0 : 1;  // one that is held has an infinite mass
            const double ofShape[5] = {s.a, s.b, s.c, static_cast<double>(s.n1), static_cast<double>(s.n2)};
            for (std::size_t c = 0; c < 5; ++c) numbers[c].lane[k] = ofShape[c];
        }
        const Mask isShaped = maskFromBits(shaped);
        const auto column = [&](std::size_t c) { return Pack::load(numbers[c].lane.data()); };
        const auto grain =
            loadRecords<8>(reinterpret_cast<const double*>(task.translation), 8, places.data());
        const auto [wx, wy, wz] =
            loadRecords<3>(reinterpret_cast<const double*>(task.rotation), 8, places.data());
        // Of spheres, which may be parts of clumps, as the kernel of spheres takes them.
        Pack inverseMass = grain[7];
        const Pack ofSphere = (Pack(0.4) * grain[3] * grain[3]) / max(grain[7], Pack(1e-200));
        Vector<Pack> inertia{ofSphere, ofSphere, ofSphere};
        QuaternionOf<Pack> orientation{Pack(1), {Pack(0), Pack(0), Pack(0)}};
        if (any(isShaped)) {
            constexpr std::size_t record = sizeof(RigidBody) / sizeof(double);
            const double* const base = &bodies[0].mass;
            const auto body = loadRecords<8>(base, record, at.data()),
                       turning = loadRecords<8>(base + 16, record, at.data());
            const Pack share = Pack::load(moves.lane.data());
            const Vector<Pack> moments = packsOf(body, 1);
            inverseMass = select(isShaped, share / body[0], inverseMass);
            inertia = select(isShaped, {moments.x / share, moments.y / share, moments.z / share}, inertia);
            orientation.real = select(isShaped, turning[3], orientation.real);
            orientation.imaginary = select(isShaped, packsOf(turning, 4), orientation.imaginary);
        }
        return EightSuperquadrics{{column(0), column(1), column(2), column(3), column(4), areEllipsoids},
                                  Axes<Pack>(orientation),
                                  inverseMass,
                                  inertia,
                                  packsOf(grain, 0),
                                  packsOf(grain, 4),
                                  {wx, wy, wz},
                                  grain[3]};
    };
    const ContactBlock& contacts = task.store.blocks[block];
    const EightSuperquadrics first = eight(contacts.first);
    if (task.store.buckets[task.bucket].wall >= 0)
        return {task, block, first, task.store.wallPoints[block - task.store.firstWallBlock()], adhesion};
    const EightSuperquadrics second = eight(contacts.second);
    const Vector<Pack> apart = second.position - first.position;
    Vector<Pack> shift = apart, imageVelocity{Pack(0), Pack(0), Pack(0)};
    if (task.box.any()) shift = task.box.nearest(apart);
    if (task.box.imagesMove) imageVelocity = task.box.velocityBetweenImages(apart, shift);
    return {task, block, first, second, shift, imageVelocity, adhesion, fallbackCount};
}

}  // namespace pendular
