#include "Kernel/Analysis/CoarseGraining/SceneState.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/GrainMasses.h"
#include "Kernel/Core/Contacts/Prefetch.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Scene/ListedContacts.h"
#include "Kernel/Scene/Scene.h"

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
Vector<double> toPoint(const GrainState& state, std::size_t number) {
    if (!state.shapes.empty()) return state.shapes[number].toPoint;
    const GrainState::Contact& contact = state.contacts[number];
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
    for (std::size_t k = 0; k < state.contacts.size(); ++k) {
        const Contact& c = state.contacts[k];
        const Vector<double> point = toPoint(state, k);
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

/// The contacts of a scene that have a force, for its state.
class SceneContacts {
public:
    /// @param numbersOfGrains in the state, by place; @param atPlaces the places of these grains
    SceneContacts(const ContactSystem& ofScene, const ParticleStore& store,
                  const std::vector<std::uint32_t>& numbersOfGrains,
                  const std::vector<std::uint32_t>& atPlaces, int threadCount)
        : contacts(ofScene),
          memory(ofScene.store()),
          grains(store),
          number(numbersOfGrains),
          places(atPlaces),
          threads(threadCount) {}

    /// Puts them into the order of identities: of body 1, then of its partner. They are read as they lie in
    /// memory, and written to where they belong: so little is waited for.
    void putInto(GrainState& state) const {
        std::size_t count = 0;
        const std::vector<std::uint32_t> orders = ordersOfSlots(count);
        const bool isShaped = contacts.laws().shapes() != nullptr;
        state.contacts.resize(count);
        if (isShaped) state.shapes.resize(count);
        inParts(
            orders.size() / Pack::lanes, threads,
            [&](int, std::size_t begin, std::size_t end) {
                constexpr std::size_t ahead = 16;
                for (std::size_t slot = begin * Pack::lanes; slot < end * Pack::lanes; ++slot) {
                    if (slot + ahead < orders.size() && orders[slot + ahead] != none)
                        prefetch<true>(&state.contacts[orders[slot + ahead]], sizeof(GrainState::Contact));
                    if (orders[slot] != none) put(static_cast<std::uint32_t>(slot), orders[slot], state);
                }
            },
            128);
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// Of each place in the memory: where its contact comes in the order of identities, if it has a force.
    std::vector<std::uint32_t> ordersOfSlots(std::size_t& count) const {
        constexpr std::size_t worthAThread = 1024;
        const std::size_t parts = partsOf(places.size(), threads, worthAThread),
                          slots = memory.memory.slotCount();
        std::vector<std::size_t> firsts(parts + 1);
        if (parts > 1)
            inParts(
                places.size(), threads,
                [&](int part, std::size_t begin, std::size_t end) {
                    firsts[static_cast<std::size_t>(part) + 1] =
                        forEachOf(begin, end, 0, [](const auto&...) {});
                },
                worthAThread);
        std::partial_sum(firsts.begin(), firsts.end(), firsts.begin());
        // What no order is asked of has it behind all.
        std::vector<std::uint32_t> orders(slots + parts, none);
        inParts(
            places.size(), threads,
            [&](int part, std::size_t begin, std::size_t end) {
                const std::size_t behind = slots + static_cast<std::size_t>(part);
                const std::size_t last = forEachOf(
                    begin, end, firsts[static_cast<std::size_t>(part)],
                    [&](bool isFirst, std::uint32_t slot, bool acts, std::size_t order) {
                        orders[isFirst ? slot : behind] = acts ? static_cast<std::uint32_t>(order) : none;
                    });
                if (static_cast<std::size_t>(part) + 1 == parts) count = last;
            },
            worthAThread);
        orders.resize(slots);
        return orders;
    }
    /// Calls give(is that of body 1, slot, has a force, order) for the sides of some grains, with numbers
    /// from `order` on for those that are and have; returns the next one. No branch in it could be foreseen.
    template <class Give>
    std::size_t forEachOf(std::size_t begin, std::size_t end, std::size_t order, Give&& give) const {
        constexpr std::size_t ahead = 16;
        const std::size_t listed = memory.sides.grainCount();  // others came after the list
        for (std::size_t k = begin; k < end; ++k) {
            if (k + ahead < end && places[k + ahead] < listed)
                prefetch(memory.sidesOf(places[k + ahead]).data(), 64);
            if (places[k] >= listed) continue;
            for (const std::uint32_t side : memory.sidesOf(places[k])) {
                const bool isFirst = side % 2 == 0, acts = memory.acts(memory.contactAt(side / 2));
                give(isFirst, side / 2, acts, order);
                order += static_cast<std::size_t>(isFirst & acts);
            }
        }
        return order;
    }

    /// Without a bridge between grains, what fields need is near at hand.
    void put(std::uint32_t slot, std::uint32_t order, GrainState& state) const {
        const std::uint32_t contact = memory.contactAt(slot), place = memory.firstOf(contact);
        const bool atWall = contact / Pack::lanes >= memory.firstWallBlock();
        const std::uint32_t second = atWall ? GrainState::Contact::wall : number[memory.secondOf(contact)];
        const bool isShaped = !state.shapes.empty();
        if (!atWall && !memory.isBridged(contact) && !isShaped) {
            const Vector<double> way =
                grains.translation[memory.secondOf(contact)].position - grains.translation[place].position;
            state.contacts[order] = {number[place],           second, state.periodic.nearest(way),
                                     memory.forceOf(contact), 0,      0,
                                     memory.touches(contact)};
            return;
        }
        const ObservedContact seen =
            contacts.observe(grains, memory.bucketOf(contact / Pack::lanes), contact);
        state.contacts[order] = {number[place],     second,       seen.shift, seen.force, seen.adhesiveForce,
                                 seen.bridgeVolume, seen.touching};
        if (isShaped) state.shapes[order] = {seen.point - grains.translation[place].position, seen.normal()};
    }

    const ContactSystem& contacts;
    const ContactStore& memory;
    const ParticleStore& grains;
    const std::vector<std::uint32_t>&number, &places;
    int threads;
};

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
    if (content != FieldContent::WithoutContacts) requireListedContacts(scene, "fields() with contacts");
    scene.contacts().ranks().requireAllGrains("fields");
    const ParticleStore& grains = scene.particleHandler.store();
    state.shapes.clear(), state.branches.clear();
    if (content == FieldContent::WithoutContacts) state.contacts.clear();
    state.time = scene.getTime();
    state.periodic = boxOfContacts(scene);
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
                constexpr std::size_t ahead = 16;
                if (k + ahead < end)
                    prefetch(&grains.translation[places[k + ahead]], sizeof(TranslationRecord));
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
    SceneContacts(scene.contacts(), grains, number, places, threads).putInto(state);
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
            state.shapes.push_back(
                {periodic.nearest(vectorAt(*point, k) - grains.points[state.contacts.back().first])});
    }
    joinBodies(state, grains);
    return state;
}

}  // namespace pendular
