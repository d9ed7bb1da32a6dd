#include "Kernel/Features/RigidBodies/RigidBodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/Resolution.h"
#include "Kernel/Features/RigidBodies/TurningResponse.h"
#include "Kernel/Features/RigidBodies/UnionOfSpheres.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/Math/SymmetricMatrix.h"

namespace pendular {

std::uint32_t RigidBodies::find(std::size_t number) const {
    const auto own = numbers.begin() + static_cast<std::ptrdiff_t>(size());
    for (const auto& [first, end] : {std::pair(numbers.begin(), own), std::pair(own, numbers.end())})
        if (const auto found = std::lower_bound(first, end, number); found != end && *found == number)
            return static_cast<std::uint32_t>(found - numbers.begin());
    return none;
}

template <class Value>
static void permute(std::vector<Value>& column, std::span<const std::uint32_t> order) {
    if (column.empty()) return;
    std::vector<Value> sorted;
    for (const std::uint32_t k : order) sorted.push_back(column[k]);
    column.swap(sorted);
}

void RigidBodies::reorder(std::span<const std::uint32_t> order) {
    std::vector<std::uint32_t> orderOfMembers, newBegins{0};
    bodyOfGrain.clear();
    for (const std::uint32_t k : order) {
        for (std::uint32_t m = begins[k]; m < begins[k + 1]; ++m) {
            orderOfMembers.push_back(m);
            bodyOfGrain[members[m].grain] = numbers[k];
        }
        newBegins.push_back(static_cast<std::uint32_t>(orderOfMembers.size()));
    }
    permute(bodies, order), permute(volumes, order), permute(frames, order), permute(numbers, order);
    permute(around, order);
    permute(held, order), permute(earlier, order), permute(dry, order);
    permute(members, orderOfMembers), permute(dryArms, orderOfMembers), permute(films, orderOfMembers);
    begins.swap(newBegins);
    forgetPlaces();
}

void RigidBodies::keepOnly(std::span<const std::uint32_t> places) {
    reorder(places);
    ghosts = 0;
}

void RigidBodies::sort() {
    std::vector<std::uint32_t> order(bodies.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto own = order.begin() + static_cast<std::ptrdiff_t>(size());
    const auto isBefore = [&](std::uint32_t a, std::uint32_t b) { return numbers[a] < numbers[b]; };
    std::sort(order.begin(), own, isBefore);
    std::sort(own, order.end(), isBefore);
    reorder(order);
}

std::vector<Vector<double>> RigidBodies::armsInSpace(const ParticleStore& grains) const {
    if (empty()) return {};
    std::vector<Vector<double>> arms(grains.size(), Vector<double>{0, 0, 0});
    for (std::size_t k = 0; k < sizeWithGhosts(); ++k) {
        const Axes axes(bodies[k].orientation);
        for (const BodyMember& member : membersOf(k))
            arms[grains.placeOf(member.grain)] = axes.turn(member.arm);
    }
    return arms;
}

double RigidBodies::exposedShareOf(std::uint32_t grain) const {
    const std::uint32_t body = bodyOf(grain);
    if (body == none) return 1;
    return std::ranges::find(membersOf(find(body)), grain, &BodyMember::grain)->exposed;
}

Quaternion RigidBodies::orientationOf(std::size_t at) const {
    const Quaternion ofDry =
        dry.empty() ? bodies[at].orientation : bodies[at].orientation * inverse(dry[at].axes);
    return (ofDry * inverse(frames[at])).normalised();
}

std::uint32_t RigidBodies::add(const RigidBody& body, std::span<const BodyMember> grains, double volume,
                               const Quaternion& frame) {
    bodies.push_back(body);
    volumes.push_back(volume);
    frames.push_back(frame);
    around.emplace_back();
    numbers.push_back(next);
    members.insert(members.end(), grains.begin(), grains.end());
    forgetPlaces();
    begins.push_back(static_cast<std::uint32_t>(members.size()));
    for (const BodyMember& member : grains) bodyOfGrain[member.grain] = next;
    if (!held.empty()) held.emplace_back();
    if (!earlier.empty()) earlier.push_back({body.acceleration, body.torque});
    if (!dry.empty()) {
        dry.push_back({body.mass, body.inertia, {0, 0, 0}, {}});
        for (const BodyMember& member : grains) dryArms.push_back(member.arm);
        films.resize(members.size());
    }
    return next++;
}

void RigidBodies::remove(std::size_t at) {
    const auto first = members.begin() + begins[at], end = members.begin() + begins[at + 1];
    const auto count = static_cast<std::uint32_t>(end - first);
    for (auto member = first; member != end; ++member) bodyOfGrain.erase(member->grain);
    if (!dry.empty()) {
        const auto begin = static_cast<std::ptrdiff_t>(begins[at]);
        dryArms.erase(dryArms.begin() + begin, dryArms.begin() + begin + count);
        films.erase(films.begin() + begin, films.begin() + begin + count);
        dry.erase(dry.begin() + static_cast<std::ptrdiff_t>(at));
    }
    members.erase(first, end);
    if (!held.empty()) held.erase(held.begin() + static_cast<std::ptrdiff_t>(at));
    if (!earlier.empty()) earlier.erase(earlier.begin() + static_cast<std::ptrdiff_t>(at));
    forgetPlaces();
    if (at >= size()) --ghosts;
    begins.erase(begins.begin() + static_cast<std::ptrdiff_t>(at));
    for (std::size_t k = at; k < begins.size(); ++k) begins[k] -= count;
    bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(at));
    volumes.erase(volumes.begin() + static_cast<std::ptrdiff_t>(at));
    frames.erase(frames.begin() + static_cast<std::ptrdiff_t>(at));
    around.erase(around.begin() + static_cast<std::ptrdiff_t>(at));
    numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(at));
}

void RigidBodies::placeAll(ParticleStore& grains) {
    for (std::size_t k = 0; k < size(); ++k)
        if (!isSphere(grains, k)) place(grains, k);
}
void RigidBodies::place(ParticleStore& grains, std::size_t at) {
    const RigidBody& body = bodies[at];
    const Vector<double> spin = spinOf(at);
    const Axes axes(body.orientation);
    const double share = isHeld(at) ? 0 : 1;  // of it that can move
    for (const BodyMember& member : membersOf(at)) {
        const std::uint32_t place = grains.place[member.grain];
        const Vector<double> arm = axes.turn(member.arm);
        TranslationRecord& grain = grains.translation[place];
        grain.inverseMass = share / body.mass;
        grain.position = body.position + arm;
        grain.velocity = body.velocity + vectorOf(crossFour(fourOf(spin), fourOf(arm)));
        grains.acceleration[place] = heldAxesOf(at).partAlong(body.acceleration);
        if (!grains.hasSpin) continue;
        RotationRecord& turning = grains.rotation[place];
        turning.spin = spin;
        turning.angularAcceleration = {0, 0, 0};
        turning.inverseInertia = share * (2.5 / (body.mass * grain.radius * grain.radius));
        if (isSphere(grains, at))
            turning.angularAcceleration = heldAxesOf(at).partAbout(turning.inverseInertia * body.torque);
    }
}

void RigidBodies::follow(const ParticleStore& grains, std::size_t at) {
    RigidBody& body = bodies[at];
    const std::uint32_t place = grains.place[members[begins[at]].grain];
    body.position = grains.translation[place].position, body.velocity = grains.translation[place].velocity;
    body.acceleration = grains.acceleration[place];
    if (!earlier.empty() && !grains.earlier.empty())
        earlier[at] = {grains.earlier[place].acceleration,
                       body.inertia.x * grains.earlier[place].angularAcceleration};
    if (!grains.hasSpin) return;
    const RotationRecord& turning = grains.rotation[place];
    body.angularMomentum = body.inertia.x * turning.spin;
    body.torque = body.inertia.x * turning.angularAcceleration;
    if (!held.empty()) held[at].spin = turning.spin - held[at].axes.partAbout(turning.spin);
}

bool RigidBodies::isSphere(const ParticleStore& grains, std::size_t at) const {
    if (begins[at + 1] != begins[at] + 1 || !(members[begins[at]].arm == Vector<double>{0, 0, 0}))
        return false;
    const RigidBody& body = bodies[at];
    const double radius = grains.translation[grains.placeOf(members[begins[at]].grain)].radius;
    const double moment = 0.4 * body.mass * radius * radius;  // as join() has it
    return body.inertia == Vector<double>{moment, moment, moment};
}

std::vector<std::uint32_t> RigidBodies::bodiesAt(const ParticleStore& grains) const {
    std::vector<std::uint32_t> all(grains.size(), none);
    for (std::uint32_t k = 0; k < sizeWithGhosts(); ++k)
        for (const BodyMember& member : membersOf(k)) all[grains.placeOf(member.grain)] = k;
    return all;
}

void RigidBodies::keepTogether(const ParticleStore& grains, std::vector<std::uint32_t>& places) const {
    if (empty()) return;
    const std::vector<std::uint32_t> bodyOfPlace = bodiesAt(grains);
    std::vector<bool> isListed(sizeWithGhosts(), false);
    std::vector<std::uint32_t> together;
    together.reserve(places.size());
    for (const std::uint32_t place : places) {
        const std::uint32_t body = bodyOfPlace[place];
        if (body == none) together.push_back(place);
        if (body == none || isListed[body]) continue;
        for (const BodyMember& member : membersOf(body)) together.push_back(grains.placeOf(member.grain));
        isListed[body] = true;
    }
    places.swap(together);
}

void RigidBodies::refresh(const ParticleStore& grains) {
    if (placesAreKnown || (empty() && bodyAt.empty())) return;
    bodyAt = bodiesAt(grains);
    order.clear(), firsts.clear(), inOrder.clear(), spheresOnly.clear(), heldOnly.clear(), own.clear();
    for (std::uint32_t k = 0; k < size(); ++k)
        (isSphere(grains, k) ? spheresOnly : heldAxesOf(k).any() ? heldOnly : order).push_back(k);
    std::ranges::sort(order, {}, [&](std::uint32_t k) { return grains.place[membersOf(k).front().grain]; });
    for (const std::uint32_t k : order) {
        firsts.push_back(static_cast<std::uint32_t>(inOrder.size()));
        for (const BodyMember& member : membersOf(k))
            inOrder.push_back({member.arm, grains.place[member.grain]});
    }
    firsts.push_back(static_cast<std::uint32_t>(inOrder.size()));
    for (std::uint32_t at = 0; at < grains.ownSize(); ++at)
        if (bodyAt[at] == none || isSphere(grains, bodyAt[at])) own.push_back(at);
    placesAreKnown = true;
}

/// The largest eigenvalue of A^T I^-1 A, with A n = arm x n.
double responseOfTurning(const Vector<double>& arm, const Vector<double>& inertia) {
    Eigen::Matrix3d cross;
    cross << 0, -arm.z, arm.y, arm.z, 0, -arm.x, -arm.y, arm.x, 0;
    const Eigen::Vector3d inverse(1 / inertia.x, 1 / inertia.y, 1 / inertia.z);
    const Eigen::Matrix3d response = cross.transpose() * inverse.asDiagonal() * cross;
    return largestEigenvalueOf(response);
}

double RigidBodies::massAtContacts(const ParticleStore& grains, std::size_t at) const {
    const RigidBody& body = bodies[at];
    const double mass = dryMassOf(at),
                 radius = grains.translation[grains.place[membersOf(at)[0].grain]].radius,
                 sphere = 4.0 / 3 * std::numbers::pi * radius * radius * radius;  // m^3
    const Vector<double>& moments = dry.empty() ? body.inertia : dry[at].inertia;
    // Friction at the rim turns it with r^2 / I, where the limit takes 5/2 of a sphere over the mass.
    const double easiest =
        std::max(1 / mass, radius * radius / (2.5 * std::min({moments.x, moments.y, moments.z})));
    if (!(volumes[at] < sphere * (1 - 1e-6))) return 1 / easiest;
    // A superquadric, whose largestFreeMass says by how much contacts elsewhere turn it (SuperquadricBody.h).
    return mass * (sphere / volumes[at]) / (body.largestFreeMass * easiest);
}

std::vector<SphereOfBody> RigidBodies::spheresOf(const ParticleStore& grains, std::size_t at) const {
    std::vector<SphereOfBody> spheres;
    for (std::uint32_t m = begins[at]; m < begins[at + 1]; ++m)
        spheres.push_back({dry.empty() ? members[m].arm : dryArms[m],
                           grains.translation[grains.place[members[m].grain]].radius});
    return spheres;
}

ContactsAround RigidBodies::findContacts(const ParticleStore& grains, std::size_t at) const {
    if (isSphere(grains, at)) return {};
    const double mass = dryMassOf(at);
    const Vector<double>& moments = dry.empty() ? bodies[at].inertia : dry[at].inertia;
    const std::vector<SphereOfBody> spheres = spheresOf(grains, at);
    constexpr std::size_t firstCorner = 1, corners = 8;  // of Kernel/Features/Superquadrics/Blocks.h
    if (isBlock(at))
        return contactsAroundBlock(std::span(spheres).subspan(firstCorner, corners), mass, moments);
    if (spheres.size() == 1) return contactsAroundAs(massAtContacts(grains, at), mass);
    return contactsAround(spheres, mass, moments, frames[at]);
}

bool RigidBodies::haveOneShape(const ParticleStore& grains, std::size_t a, std::size_t b) const {
    if (begins[a + 1] - begins[a] != begins[b + 1] - begins[b] || isBlock(a) != isBlock(b)) return false;
    if (begins[a + 1] - begins[a] == 1) return false;  // found at once
    const std::vector<SphereOfBody> ofA = spheresOf(grains, a), ofB = spheresOf(grains, b);
    const double scale = ofB[0].radius / ofA[0].radius, near = 1e-9 * ofB[0].radius;  // m
    const auto isNear = [](double one, double other) {
        return std::abs(one - other) <= 1e-9 * std::abs(other);
    };
    const auto momentsOf = [&](std::size_t k) { return dry.empty() ? bodies[k].inertia : dry[k].inertia; };
    const double mass = dryMassOf(b) / dryMassOf(a), inertia = mass * scale * scale;
    const Vector<double> one = momentsOf(a), two = momentsOf(b);
    if (!isNear(inertia * one.x, two.x) || !isNear(inertia * one.y, two.y) || !isNear(inertia * one.z, two.z))
        return false;
    for (std::size_t k = 0; k < ofA.size(); ++k)
        if (std::abs(scale * ofA[k].radius - ofB[k].radius) > near ||
            norm(scale * frames[a].turn(ofA[k].arm) - frames[b].turn(ofB[k].arm)) > near)
            return false;
    return true;
}

const ContactsAround& RigidBodies::contactsAt(const ParticleStore& grains, std::size_t at) const {
    if (around[at]) return *around[at];
    // A body that has moved to one of these places since may be of any shape, or not known yet.
    const auto known = std::ranges::find_if(shapes, [&](std::size_t other) {
        return other < size() && around[other] && haveOneShape(grains, other, at);
    });
    if (known != shapes.end()) return *(around[at] = around[*known]);
    around[at] = findContacts(grains, at);
    if (begins[at + 1] - begins[at] == 1) return *around[at];
    constexpr std::size_t most = 16;  // shapes of a mixture
    if (shapes.size() == most) shapes.erase(shapes.begin());
    shapes.push_back(at);
    return *around[at];
}

/// Finds the volumes of all bodies, and the exposed shares of their grains, from the spheres.
void RigidBodies::measureAll(const ParticleStore& grains) {
    for (std::size_t k = 0; k < size(); ++k) {
        std::vector<Ball> spheres;
        for (const BodyMember& member : membersOf(k))
            spheres.push_back({toEigen(member.arm), grains.translation[grains.place[member.grain]].radius});
        volumes[k] = unionOfSpheres(spheres, toleranceOfVolume).volume;
        const std::vector<double> shares = exposedShares(spheres);
        for (std::size_t m = 0; m < shares.size(); ++m) members[begins[k] + m].exposed = shares[m];
    }
}

void RigidBodies::visitState(StateArchive& archive, const ParticleStore& grains) {
    std::vector<std::uint32_t> grainsOf;
    std::vector<Vector<double>> arms;
    std::vector<double> exposed;
    for (const BodyMember& member : members) {
        grainsOf.push_back(member.grain);
        arms.push_back(member.arm);
        exposed.push_back(member.exposed);
    }
    const bool knowsShapes = archive.isWriting() || archive.holds("volumes");  // older files do not
    archive.column<double>("motion", bodies);
    archive.column<std::uint32_t>("numbers", numbers);
    archive.column<std::uint32_t>("begins", begins);
    archive.column<std::uint32_t>("grains", grainsOf);
    archive.column<double>("arms", arms);
    archive.value("next", next);
    if (knowsShapes) {
        archive.column<double>("volumes", volumes);
        archive.column<double>("exposed", exposed);
    }
    archive.column<double>("frames", frames);
    if (archive.isReading()) earlier.clear();
    if (archive.isWriting() ? !earlier.empty() : archive.holds("earlier")) {
        archive.column<double>("earlier", earlier);
        archive.require(earlier.size() == size(), "earlier", "does not have one row for each body");
        archive.requireFinite("earlier", earlier);
    }
    visitHeld(archive);
    visitDry(archive);
    if (!archive.isReading()) return;
    archive.require(grainsOf.size() == arms.size(), "arms", "has another number of rows than bodies/grains");
    archive.requireFinite("arms", arms);
    if (!knowsShapes) {
        volumes.assign(bodies.size(), 1);
        exposed.assign(arms.size(), 1);
    }
    archive.require(exposed.size() == arms.size(), "exposed",
                    "has another number of rows than bodies/grains");
    members.clear();
    for (std::size_t k = 0; k < arms.size(); ++k) members.push_back({grainsOf[k], arms[k], exposed[k]});
    requireWhole(archive, grains);
    if (!knowsShapes) measureAll(grains);
    around.assign(bodies.size(), std::nullopt);
    bodyOfGrain.clear();
    forgetPlaces();
    for (std::size_t k = 0; k < size(); ++k)
        for (const BodyMember& member : membersOf(k)) {
            archive.require(!bodyOfGrain.contains(member.grain), "grains", "has a grain in two bodies");
            bodyOfGrain[member.grain] = numbers[k];
        }
}

void RigidBodies::requireWhole(const StateArchive& archive, const ParticleStore& grains) const {
    archive.requireFinite("motion", bodies);
    for (const RigidBody& body : bodies) {
        const Vector<double>& inertia = body.inertia;
        const Quaternion& q = body.orientation;
        archive.require(body.mass > 0 && std::isfinite(body.largestFreeMass) && body.largestFreeMass != 0 &&
                            inertia.x > 0 && inertia.y > 0 && inertia.z > 0,
                        "motion", "has a mass or a moment of inertia that is not positive");
        archive.require(std::abs(q.real * q.real + squaredNorm(q.imaginary) - 1) < 1e-6, "motion",
                        "has an orientation that is no rotation");
    }
    archive.require(
        frames.size() == size() &&
            std::ranges::all_of(frames,
                                [](const Quaternion& q) {
                                    return std::abs(q.real * q.real + squaredNorm(q.imaginary) - 1) < 1e-6;
                                }),
        "frames", "does not have a rotation of each body");
    archive.require(numbers.size() == size() &&
                        std::ranges::adjacent_find(numbers, std::greater_equal{}) == numbers.end(),
                    "numbers", "does not have the number of each body");
    archive.require(numbers.empty() || numbers.back() < next, "next", "is the number of a body");
    archive.require(begins.size() == size() + 1 && begins.front() == 0 && begins.back() == members.size() &&
                        std::ranges::adjacent_find(begins, std::ranges::greater_equal{}) == begins.end(),
                    "begins", "does not have the grains of each body");
    archive.require(volumes.size() == size() &&
                        std::ranges::all_of(volumes, [](double v) { return v > 0 && v < infinity; }),
                    "volumes", "does not have a positive volume of each body");
    for (const BodyMember& member : members)
        archive.require(member.exposed >= 0 && member.exposed <= 1, "exposed", "has a share beyond 0 to 1");
    for (const BodyMember& member : members)
        archive.require(grains.place.contains(member.grain), "grains",
                        "has a grain that is not in the scene");
    for (std::size_t k = 0; k < size(); ++k)
        for (const BodyMember& member : membersOf(k)) {
            const auto& [position, radius, velocity, inverseMass] =
                grains.translation[grains.place[member.grain]];
            archive.require((inverseMass == 0) == isHeld(k), "grains",
                            "has a grain that is held while its body is not, or the other way round");
            archive.require(isResolved(bodies[k].position, radius) && isResolved(member.arm, radius),
                            "motion", "or its arms have a place that is too far away for the grains there");
        }
}

}  // namespace pendular
