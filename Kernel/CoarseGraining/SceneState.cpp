#include "Kernel/CoarseGraining/SceneState.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include "Kernel/Base/InputError.h"
#include "Kernel/Base/Parallel.h"
#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Contacts/GrainMasses.h"
#include "Kernel/Output/PolyData.h"
#include "Kernel/Particles/ParticleHandler.h"
#include "Kernel/Particles/ParticleStore.h"
#include "Kernel/Simulation/Scene.h"

namespace pendular {

namespace {

/// Throws InputError unless there is the field, with so many numbers for each of its owners.
const PolyDataField& needed(const PolyDataField* field, std::string_view name, std::size_t components,
                            std::size_t owners) {
    if (!field || field->components != components || field->size() != components * owners)
        throw InputError(fmt::format(
            "A frame without the field {} ({} for each) cannot be made into fields; write it again with this "
            "version.",
            name, components));
    return *field;
}

Vector<double> vectorAt(const PolyDataField& field, std::size_t k) {
    return {field.at(3 * k), field.at(3 * k + 1), field.at(3 * k + 2)};
}

/// The way (m) from the centre of the first grain to the point of a contact: in the middle of the overlap or
/// of the gap, at a wall on its surface.
Vector<double> toPoint(const GrainState& state, const GrainState::Contact& contact) {
    if (contact.toPoint) return *contact.toPoint;
    if (contact.second == GrainState::Contact::wall) return contact.shift;
    const double length = norm(contact.shift), radius = state.grains[contact.first].radius,
                 gap = length - radius - state.grains[contact.second].radius;
    return ((radius + 0.5 * gap) / length) * contact.shift;
}

/// Joins grains to the rigid bodies that a frame has. Without any, or where each is a single grain, nothing
/// changes.
void joinBodies(GrainState& state, const PolyData& grains) {
    const PolyDataField* const body = grains.pointField("body");
    if (!body) return;
    const std::size_t count = state.grains.size();
    std::map<std::int64_t, std::uint32_t> numbers;  // of the body with a number
    std::size_t members = 0;
    for (std::size_t k = 0; k < count; ++k)
        if (body->at(k) >= 0) {
            ++members;
            numbers.emplace(static_cast<std::int64_t>(body->at(k)),
                            static_cast<std::uint32_t>(numbers.size()));
        }
    if (members == numbers.size() && !grains.pointField("body_arm_m")) return;
    const PolyDataField &arm = needed(grains.pointField("body_arm_m"), "body_arm_m", 3, count),
                        &velocity = needed(grains.pointField("body_velocity_m_per_s"),
                                           "body_velocity_m_per_s", 3, count),
                        &volume = needed(grains.pointField("body_volume_m3"), "body_volume_m3", 1, count);
    std::vector<MemberState> memberOf(count);
    std::vector<BodyState> bodies(numbers.size());
    for (std::size_t k = 0; k < count; ++k) {
        if (body->at(k) < 0) continue;
        memberOf[k] = {numbers[static_cast<std::int64_t>(body->at(k))], vectorAt(arm, k)};
        BodyState& own = bodies[memberOf[k].body];
        own.position = state.grains[k].position - memberOf[k].arm;
        own.velocity = vectorAt(velocity, k);
        own.mass += state.grains[k].mass;
        own.volume = volume.at(k);
    }
    joinBodies(state, memberOf, bodies);
}

}  // namespace

void joinBodies(GrainState& state, std::span<const MemberState> members, std::span<const BodyState> bodies) {
    using Contact = GrainState::Contact;
    state.branches.clear();
    for (const Contact& c : state.contacts) {
        const Vector<double> point = toPoint(state, c);
        const Vector<double> toFirst = -members[c.first].arm - point;
        state.branches.push_back(
            {toFirst, c.second == Contact::wall ? -point : c.shift - members[c.second].arm - point});
    }
    std::vector<GrainState::Grain> grains;
    std::vector<std::uint32_t> number(state.grains.size());
    for (std::size_t k = 0; k < state.grains.size(); ++k)
        if (members[k].body == MemberState::none) {
            number[k] = static_cast<std::uint32_t>(grains.size());
            grains.push_back(state.grains[k]);
        }
    const std::size_t single = grains.size();
    for (const BodyState& b : bodies)
        grains.push_back(
            {b.position, b.velocity, std::cbrt(0.75 / std::numbers::pi * b.volume), b.mass, 0, -1});
    for (std::size_t k = 0; k < state.grains.size(); ++k) {
        if (members[k].body == MemberState::none) continue;
        number[k] = static_cast<std::uint32_t>(single + members[k].body);
        GrainState::Grain& body = grains[number[k]];
        body.liquid += state.grains[k].liquid;
        if (body.species < 0) body.species = state.grains[k].species;
    }
    for (Contact& c : state.contacts) {
        c.first = number[c.first];
        if (c.second != Contact::wall) c.second = number[c.second];
    }
    state.grains.swap(grains);
}

void takeFlowAway(GrainState& state) {
    for (GrainState::Grain& grain : state.grains) grain.velocity -= state.periodic.flowAt(grain.position);
    state.periodic.imageVelocity = state.periodic.strainRate = {0, 0, 0};
}

namespace {

/// Appends the contacts that have a force and are those of the grain at a place, as their first body, in the
/// order of its partners. Without a bridge between grains, what fields need is near at hand.
/// @param number of the grain at each place, in GrainState
void appendContacts(const ContactSystem& contacts, const ParticleStore& grains, std::uint32_t place,
                    const std::vector<std::uint32_t>& number, std::vector<GrainState::Contact>& found) {
    contacts.forEachActingOf(place, [&](const Bucket& bucket, std::uint32_t contact) {
        if (contacts.firstOf(contact) != place) return;
        const bool atWall = bucket.wall >= 0;
        const std::uint32_t second = atWall ? GrainState::Contact::wall : number[contacts.secondOf(contact)];
        if (!atWall && !contacts.isBridged(contact) && !contacts.laws().shapes()) {
            const Vector<double> way =
                grains.translation[contacts.secondOf(contact)].position - grains.translation[place].position;
            found.push_back({number[place], second, contacts.periodicBox().nearest(way),
                             contacts.forceOf(contact), 0, 0, contacts.touches(contact)});
            return;
        }
        const ObservedContact seen = contacts.observe(grains, bucket, contact);
        found.push_back({number[place], second, seen.shift, seen.force, seen.adhesiveForce, seen.bridgeVolume,
                         seen.touching});
        if (!contacts.laws().shapes()) return;
        found.back().toPoint = seen.point - grains.translation[place].position;
        found.back().normal = seen.normal();
    });
}

/// Puts the rigid bodies of a scene in the place of their grains.
/// @param places of the grains, in the order of the state
void joinBodies(GrainState& state, const ParticleStore& grains, const std::vector<std::uint32_t>& places) {
    if (grains.bodies.empty()) return;
    const std::vector<Vector<double>> arms = grains.bodies.armsInSpace(grains);
    std::vector<BodyState> bodies;
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        const RigidBody& body = grains.bodies[k];
        bodies.push_back({body.position, body.velocity, body.mass, grains.bodies.volumeOf(k)});
    }
    std::vector<MemberState> members;
    for (const std::uint32_t place : places) {
        const std::uint32_t body = grains.bodies.bodyOf(grains.identity[place]);
        members.push_back(body == RigidBodies::none ? MemberState{}
                                                    : MemberState{grains.bodies.find(body), arms[place]});
    }
    joinBodies(state, members, bodies);
}

}  // namespace

void takeState(const Scene& scene, GrainState& state, FieldContent content) {
    if (scene.contacts().ranks().areSeveral())
        throw InputError(
            "Fields: a scene on several ranks (setRanks()) has the grains of one of them only; take "
            "meanStress(), or run it on one rank.");
    const ParticleStore& grains = scene.particleHandler.store();
    state.grains.clear(), state.contacts.clear(), state.branches.clear();
    state.time = scene.getTime();
    state.periodic = scene.contacts().periodicBox();
    const GrainColumn* film = nullptr;
    for (const GrainColumn& column : grains.columns)
        if (column.name == "liquid_film") film = &column;
    const int threads = scene.getNumberOfThreads();
    const GrainMasses masses(grains, scene.laws());
    std::vector<std::uint32_t> places(grains.place.begin(), grains.place.end());  // by identity
    std::vector<std::uint32_t> number(grains.size());                             // of the grain at a place
    state.grains.resize(places.size());
    inParts(
        places.size(), threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                const std::uint32_t place = places[k];
                const TranslationRecord& grain = grains.translation[place];
                number[place] = static_cast<std::uint32_t>(k);
                state.grains[k] = {grain.position,
                                   grain.velocity,
                                   grain.radius,
                                   masses(place),
                                   film ? film->values[place] : 0,
                                   grains.species[place]};
            }
        },
        1024);
    if (content == FieldContent::WithoutContacts) return joinBodies(state, grains, places);
    // Each thread takes the contacts whose first body is one of its grains; put together they are in the
    // order of identities.
    std::vector<std::vector<GrainState::Contact>> ofOthers(static_cast<std::size_t>(std::max(threads, 1)));
    inParts(
        places.size(), threads,
        [&](int part, std::size_t begin, std::size_t end) {
            auto& own = part == 0 ? state.contacts : ofOthers[static_cast<std::size_t>(part)];
            for (std::size_t k = begin; k < end; ++k)
                appendContacts(scene.contacts(), grains, places[k], number, own);
        },
        1024);
    for (const auto& own : ofOthers) state.contacts.insert(state.contacts.end(), own.begin(), own.end());
    joinBodies(state, grains, places);
}

GrainState stateOf(const Scene& scene, FieldContent content) {
    GrainState state;
    takeState(scene, state, content);
    return state;
}

GrainState stateOf(const PolyData& grains, const PolyData& contacts, const PeriodicBox& periodic) {
    GrainState state;
    state.time = grains.time;
    state.periodic = periodic;
    const std::size_t count = grains.points.size();
    const auto ofGrains = [&](std::string_view name, std::size_t components) -> const PolyDataField& {
        return needed(grains.pointField(name), name, components, count);
    };
    const PolyDataField &radius = ofGrains("radius_m", 1), &mass = ofGrains("mass_kg", 1),
                        &velocity = ofGrains("velocity_m_per_s", 3), &species = ofGrains("species", 1),
                        &identity = ofGrains("identity", 1);
    const PolyDataField* film = grains.pointField("liquid_film_m3");
    std::map<std::int64_t, std::uint32_t> numbers;  // of the grain with an identity
    for (std::size_t k = 0; k < count; ++k) {
        numbers[static_cast<std::int64_t>(identity.at(k))] = static_cast<std::uint32_t>(k);
        state.grains.push_back({grains.points[k], vectorAt(velocity, k), radius.at(k), mass.at(k),
                                film ? film->at(k) : 0, static_cast<int>(species.at(k))});
    }
    const std::size_t pairs = contacts.ends.size();
    if (pairs == 0) {
        joinBodies(state, grains);
        return state;
    }
    const auto ofContacts = [&](std::string_view name, std::size_t components) -> const PolyDataField& {
        return needed(contacts.cellField(name), name, components, pairs);
    };
    const PolyDataField &force = ofContacts("force_N", 3), &adhesive = ofContacts("adhesive_force_N", 1),
                        &overlap = ofContacts("overlap_m", 1), &first = ofContacts("particle1", 1),
                        &second = ofContacts("particle2", 1), &wall = ofContacts("wall", 1);
    const PolyDataField *volume = contacts.cellField("bridge_volume_m3"),
                        *point = grains.pointField("half_lengths_m")
                                     ? &ofContacts("contact_point_m", 3)
                                     : nullptr;  // of spheres it follows from the rest
    const auto numberOf = [&](const PolyDataField& field, std::size_t k) {
        const auto found = numbers.find(static_cast<std::int64_t>(field.at(k)));
        if (found == numbers.end())
            throw InputError(
                fmt::format("A frame has a contact of the grain {}, which is not in it.", field.at(k)));
        return found->second;
    };
    const auto cornerOf = [&](std::size_t k) {
        const auto at = static_cast<std::size_t>(contacts.corners.at(k));
        return contacts.points.at(at);
    };
    for (std::size_t k = 0; k < pairs; ++k) {
        const bool atWall = wall.at(k) >= 0;
        state.contacts.push_back({numberOf(first, k),
                                  atWall ? GrainState::Contact::wall : numberOf(second, k),
                                  periodic.nearest(cornerOf(2 * k + 1) - cornerOf(2 * k)), vectorAt(force, k),
                                  adhesive.at(k), volume ? volume->at(k) : 0, overlap.at(k) >= 0});
        if (point)
            state.contacts.back().toPoint =
                periodic.nearest(vectorAt(*point, k) - grains.points[state.contacts.back().first]);
    }
    joinBodies(state, grains);
    return state;
}

}  // namespace pendular
