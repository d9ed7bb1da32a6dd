#include "Kernel/CoarseGraining/SceneState.h"

#include <map>

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

}  // namespace

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
    if (pairs == 0) return state;
    const auto ofContacts = [&](std::string_view name, std::size_t components) -> const PolyDataField& {
        return needed(contacts.cellField(name), name, components, pairs);
    };
    const PolyDataField &force = ofContacts("force_N", 3), &adhesive = ofContacts("adhesive_force_N", 1),
                        &overlap = ofContacts("overlap_m", 1), &first = ofContacts("particle1", 1),
                        &second = ofContacts("particle2", 1), &wall = ofContacts("wall", 1);
    const PolyDataField* volume = contacts.cellField("bridge_volume_m3");
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
    }
    return state;
}

}  // namespace pendular
