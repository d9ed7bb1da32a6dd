#include "Kernel/Superquadrics/SuperquadricHandler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Base/InputError.h"
#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Particles/ParticleHandlerInside.h"
#include "Kernel/State/StateArchive.h"
#include "Kernel/Walls/InfiniteWall.h"
#include "Kernel/Walls/WallHandler.h"

namespace pendular {

namespace {

/// kg, of the largest free sphere of a body, as the stability limit takes it (RigidBodies::response): it
/// compares the mass with which the body's contacts move, 1 / max(1/m, R^2 / (5/2 I)) with the smallest
/// moment I, with that of this sphere. A normal force at an arm turns a superquadric as well.
double freeMass(const RigidBody& body, const Superquadric& shape, double turning, double massOfSphere) {
    const double radius = shape.boundingRadius();
    const double moment = std::min({body.inertia.x, body.inertia.y, body.inertia.z});
    const double ofSpheres = std::max(1 / body.mass, radius * radius / (2.5 * moment));
    return massOfSphere * std::max((1 + turning) / body.mass, ofSpheres) / ofSpheres;
}

/// The axes of the shape are the principal ones: no search for them, which might change their order.
RigidBody bodyOf(const SuperquadricGrain& grain, double density, double turning, double massOfSphere) {
    const MassProperties solid = grain.getShape().mass();
    const Eigen::Quaterniond& q = grain.getOrientation();
    const SphericalParticle& around = grain.around();
    RigidBody body{.mass = density * solid.volume,
                   .inertia = toVector(Vec3D(density * solid.inertia.diagonal())),
                   .position = toVector(around.getPosition()),
                   .velocity = toVector(around.getVelocity()),
                   .orientation = {q.w(), toVector(Vec3D(q.vec()))}};
    body.setSpin(toVector(around.getAngularVelocity()));
    body.largestFreeMass = freeMass(body, grain.getShape(), turning, massOfSphere);
    return body;
}

SuperquadricPair<double> pairOf(const Superquadric& one, const RigidBody& first, const Superquadric& two,
                                const RigidBody& second, const Vector<double>& shift) {
    return {SuperquadricLanes<double>::from(one), SuperquadricLanes<double>::from(two),
            Axes<double>(first.orientation), Axes<double>(second.orientation), shift};
}

}  // namespace

std::uint32_t SuperquadricHandler::numberOf(const Superquadric& shape) {
    const auto [found, isNew] =
        numbers.try_emplace({shape.a, shape.b, shape.c, 1.0 * shape.n1, 1.0 * shape.n2},
                            static_cast<std::uint32_t>(shapes.size()));
    if (isNew) addShape(shape);
    return found->second;
}

void SuperquadricHandler::addShape(const Superquadric& shape) {
    shapes.push_back(shape);
    areEllipsoids &= shape.isEllipsoid();
    largestRadii = std::max(largestRadii, contactOf(shape).radii);
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

BodyReference SuperquadricHandler::copyAndAddObject(const SuperquadricGrain& grain) {
    const std::uint32_t identity = particles.copyAndAddObject(grain.around()).getId();
    ParticleStore& grains = particles.store();
    const double massOfSphere =
        particles.massOf(grain.around().getRadius(), grain.around().getSpeciesIndex());
    const double density = massOfSphere / sphereMass(grain.around().getRadius(), 1);
    const BodyMember member{identity, {0, 0, 0}};
    const std::uint32_t number =
        grains.bodies.add(bodyOf(grain, density, contactOf(grain.getShape()).turning, massOfSphere),
                          {&member, 1}, grain.getShape().volume());
    grains.bodies.place(grains, grains.bodies.size() - 1);
    ParticleHandler::Inside::noteJoined(particles, {&identity, 1});
    shapeOfBody.resize(number, RigidBodies::none);
    shapeOfBody.push_back(numberOf(grain.getShape()));
    return {particles, number};
}

const Superquadric& SuperquadricHandler::shapeOf(std::uint32_t grain) const {
    const std::uint32_t body = particles.store().bodies.bodyOf(grain);
    if (body >= shapeOfBody.size() || shapeOfBody[body] == RigidBodies::none)
        throw InputError(fmt::format("particle {} is no superquadric.", grain));
    return shapes[shapeOfBody[body]];
}

bool SuperquadricHandler::isEmpty() const {
    return ParticleHandler::Inside::grainsInStep(particles).bodies.empty();
}

void SuperquadricHandler::requireAll() const {
    const ParticleStore& grains = ParticleHandler::Inside::grainsInStep(particles);
    for (const std::uint32_t place : grains.place) {
        const std::uint32_t body = grains.bodies.bodyOf(grains.identity[place]);
        if (body >= shapeOfBody.size() || shapeOfBody[body] >= shapes.size())
            throw InputError(fmt::format(
                "particle {} is no superquadric; in a SuperquadricSimulation all grains must be added by "
                "superquadricHandler (a sphere is one with three equal half lengths).",
                grains.identity[place]));
    }
}

void SuperquadricHandler::check(const WallHandler& walls) const {
    requireAll();
    for (std::size_t w = 0; w < walls.getSize(); ++w)
        if (!walls.isRemoved(w) && dynamic_cast<const InfiniteWall*>(&walls.getObject(w)) == nullptr)
            throw InputError(fmt::format(
                "wall {} is not plane: superquadrics touch InfiniteWall only; take planes, or clumps of "
                "spheres.",
                w));
}

double SuperquadricHandler::thickness(const ParticleStore& grains, std::uint32_t grain) const {
    const Superquadric& shape = shapeAt(grains, grain);
    return std::min({shape.a, shape.b, shape.c});
}

ShapedTouch SuperquadricHandler::touch(const ParticleStore& grains, std::uint32_t first, std::uint32_t second,
                                       const Vector<double>& shift) const {
    const SuperquadricPair<double> pair = pairOf(shapeAt(grains, first), bodyAt(grains, first),
                                                 shapeAt(grains, second), bodyAt(grains, second), shift);
    const SuperquadricTouch<double> found = findTouch(pair, firstNormal(pair), false);
    return {found.normal, found.depth, found.arm1};
}

ShapedTouch SuperquadricHandler::touchAtPlane(const ParticleStore& grains, std::uint32_t grain,
                                              const Vector<double>& normal, double distance) const {
    const Axes<double> axes(bodyAt(grains, grain).orientation);
    const SupportPoint<double> lowest =
        supportPoint(SuperquadricLanes<double>::from(shapeAt(grains, grain)), axes.turnBack(normal));
    const double depth = lowest.height - distance;
    return {normal, depth, axes.turn(lowest.point) - (0.5 * depth) * normal};
}

void SuperquadricHandler::visitState(StateArchive& archive) {
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
    if (!archive.isReading()) return;
    fallbackCount = count;
    archive.require(exponents.size() == 2 * halfLengths.size(), "exponents",
                    "does not have two of each shape");
    shapes.clear(), numbers.clear();
    areEllipsoids = true;
    largestRadii = 1;
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

SuperquadricGeometry SuperquadricHandler::geometryOf(const ContactTask& task, std::size_t block) const {
    const ParticleStore& grains = ParticleHandler::Inside::grainsInStep(particles);
    const RigidBodies& bodies = grains.bodies;
    const auto eight = [&](const Places& places) {
        Places at{};
        std::array<LaneColumn, 5> numbers;
        for (std::size_t k = 0; k < Pack::lanes; ++k) {
            // Lanes of grains that have gone are of no meaning.
            at[k] = bodies.at(places[k]) < bodies.size() ? bodies.at(places[k]) : 0;
            const Superquadric& s = shapes[shapeOfBody[bodies.numberOf(at[k])]];
            const double ofShape[5] = {s.a, s.b, s.c, static_cast<double>(s.n1), static_cast<double>(s.n2)};
            for (std::size_t c = 0; c < 5; ++c) numbers[c].lane[k] = ofShape[c];
        }
        const auto column = [&](std::size_t c) { return Pack::load(numbers[c].lane.data()); };
        constexpr std::size_t record = sizeof(RigidBody) / sizeof(double);
        const double* const base = &bodies[0].mass;
        const auto own = loadRecords<8>(base, record, at.data()),
                   turning = loadRecords<8>(base + 16, record, at.data());
        const auto grain =
            loadRecords<8>(reinterpret_cast<const double*>(task.translation), 8, places.data());
        const auto [wx, wy, wz] =
            loadRecords<3>(reinterpret_cast<const double*>(task.rotation), 8, places.data());
        Pack inverseMass = Pack(1) / own[0];
        Vector<Pack> inertia = packsOf(own, 1);
        if (bodies.areSomeHeld()) {  // one that is held altogether has an infinite mass
            LaneColumn moves;
            for (std::size_t k = 0; k < Pack::lanes; ++k) moves.lane[k] = bodies.isHeld(at[k]) ? 0 : 1;
            const Pack share = Pack::load(moves.lane.data());
            inverseMass = inverseMass * share;
            inertia = {inertia.x / share, inertia.y / share, inertia.z / share};
        }
        return EightSuperquadrics{{column(0), column(1), column(2), column(3), column(4), areEllipsoids},
                                  Axes<Pack>(QuaternionOf<Pack>{turning[3], packsOf(turning, 4)}),
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
        return {task, block, first, task.store.wallPoints[block - task.store.firstWallBlock()]};
    const EightSuperquadrics second = eight(contacts.second);
    const Vector<Pack> apart = second.position - first.position;
    Vector<Pack> shift = apart, imageVelocity{Pack(0), Pack(0), Pack(0)};
    if (task.box.any()) shift = task.box.nearest(apart);
    if (task.box.imagesMove) imageVelocity = task.box.velocityBetweenImages(apart, shift);
    return {task, block, first, second, shift, imageVelocity, fallbackCount};
}

}  // namespace pendular
