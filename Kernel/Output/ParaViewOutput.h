#pragma once

#include <array>
#include <functional>
#include <optional>
#include <utility>

#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Output/ParaViewSeries.h"
#include "Kernel/Output/PolyData.h"

namespace pendular {

/// The grains as points: radius, velocity, spin, force (of contacts and weight), species, identity.
template <bool hasSpin>
PolyData grainPoints(const ParticleStore<hasSpin>& grains) {
    PolyData data;
    std::vector<float> radius, velocity, spin, force;
    std::vector<std::int32_t> species, identity;
    const auto append = [](std::vector<float>& column, const Vector<double>& v) {
        for (const double part : {v.x, v.y, v.z}) column.push_back(static_cast<float>(part));
    };
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
        data.points.push_back(grain.position);
        radius.push_back(static_cast<float>(grain.radius));
        append(velocity, grain.velocity);
        if constexpr (hasSpin) append(spin, grains.rotation[place].spin);
        // Not kept for a grain held in place.
        append(force, grain.inverseMass > 0 ? (1 / grain.inverseMass) * grains.acceleration[place]
                                            : Vector<double>{0, 0, 0});
        species.push_back(grains.species[place]);
        identity.push_back(static_cast<std::int32_t>(grains.identity[place]));
    }
    if (!data.corners.empty()) data.ends = {static_cast<std::int32_t>(data.corners.size())};
    data.pointFields = {{"radius_m", 1, std::move(radius)}, {"velocity_m_per_s", 3, std::move(velocity)}};
    if constexpr (hasSpin) data.pointFields.push_back({"spin_rad_per_s", 3, std::move(spin)});
    data.pointFields.push_back({"force_N", 3, std::move(force)});
    data.pointFields.push_back({"species", 1, std::move(species)});
    data.pointFields.push_back({"identity", 1, std::move(identity)});
    return data;
}

/// The mean stress in each grain (Pa, tension positive), in the order of identities:
/// sigma = sum over its contacts of l f / V, with the branch l (m) from the centre to the contact point, the
/// force f (N) on the grain and its volume V (m^3). Source: Love, "A Treatise on the Mathematical Theory of
/// Elasticity" (1927); Weber, Bull. Liaison Ponts Chauss. 20 (1966). The contact point lies in the middle of
/// the overlap or of the gap.
template <class S>
PolyDataField grainStresses(const ContactSystem<S>& contacts, const ParticleStore<S::hasTorque>& grains) {
    std::vector<std::array<double, 9>> sums(grains.size());
    const auto radius = [&](std::uint32_t identity) {
        return grains.translation[grains.place[identity]].radius;
    };
    const auto add = [&](std::uint32_t identity, const Vector<double>& branch, const Vector<double>& force) {
        const double parts[] = {force.x, force.y, force.z};
        for (std::size_t k = 0; k < 3; ++k) {
            sums[identity][k] += branch.x * parts[k];
            sums[identity][3 + k] += branch.y * parts[k];
            sums[identity][6 + k] += branch.z * parts[k];
        }
    };
    contacts.store().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        if (!contacts.store().acts(contact)) return;
        const ObservedContact seen = contacts.observe(grains, bucket, contact);
        const Vector<double> normal = (1 / norm(seen.shift)) * seen.shift;
        const double half = 0.5 * seen.separation;
        add(seen.particle1, (radius(seen.particle1) + half) * normal, seen.force);
        if (bucket.wall < 0) add(seen.particle2, -(radius(seen.particle2) + half) * normal, -seen.force);
    });
    std::vector<float> numbers;
    for (std::uint32_t k = 0; k < sums.size(); ++k)
        for (const double sum : sums[k])
            numbers.push_back(static_cast<float>(sum / sphereMass(radius(k), 1)));
    return {"stress_Pa", 9, std::move(numbers)};
}

/// The contacts that have a force as lines, from centre to centre (of the nearest image) or to the wall's
/// surface. The first points are the centres of all grains, in the order of identities. The forces are those
/// on particle1; particle2 is -1 at a wall, and wall is -1 between grains.
template <class S>
PolyData contactLines(const ContactSystem<S>& contacts, const ParticleStore<S::hasTorque>& grains,
                      const SpeciesHandler<S>& species) {
    PolyData data;
    data.kind = PolyData::Cells::Lines;
    for (const std::uint32_t place : grains.place) data.points.push_back(grains.translation[place].position);
    std::vector<float> force, normal, adhesive, overlap, volume;
    std::vector<std::int32_t> bridged, first, second, wall;
    contacts.store().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        if (!contacts.store().acts(contact)) return;
        const ObservedContact seen = contacts.observe(grains, bucket, contact);
        const Vector<double> end = data.points[seen.particle1] + seen.shift;
        const bool isImage = bucket.wall < 0 && contacts.periodicBox().any() &&
                             norm(end - data.points[seen.particle2]) > 0.5 * norm(seen.shift);
        data.corners.push_back(static_cast<std::int32_t>(seen.particle1));
        if (bucket.wall < 0 && !isImage) {
            data.corners.push_back(static_cast<std::int32_t>(seen.particle2));
        } else {
            data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
            data.points.push_back(end);
        }
        data.ends.push_back(static_cast<std::int32_t>(data.corners.size()));
        for (const double part : {seen.force.x, seen.force.y, seen.force.z})
            force.push_back(static_cast<float>(part));
        normal.push_back(static_cast<float>(seen.normalForce));
        adhesive.push_back(static_cast<float>(seen.adhesiveForce));
        overlap.push_back(static_cast<float>(-seen.separation));
        if constexpr (requires(typename S::Mixed laws) { laws.liquidBridgeVolume; })
            volume.push_back(
                seen.bridged
                    ? static_cast<float>(species.mixture(bucket.species1, bucket.species2).liquidBridgeVolume)
                    : 0.0f);
        bridged.push_back(seen.bridged ? 1 : 0);
        first.push_back(static_cast<std::int32_t>(seen.particle1));
        second.push_back(bucket.wall < 0 ? static_cast<std::int32_t>(seen.particle2) : -1);
        wall.push_back(bucket.wall);
    });
    data.cellFields = {{"force_N", 3, std::move(force)},
                       {"normal_force_N", 1, std::move(normal)},
                       {"adhesive_force_N", 1, std::move(adhesive)},
                       {"overlap_m", 1, std::move(overlap)},
                       {"bridged", 1, std::move(bridged)},
                       {"particle1", 1, std::move(first)},
                       {"particle2", 1, std::move(second)},
                       {"wall", 1, std::move(wall)}};
    if constexpr (requires(typename S::Mixed laws) { laws.liquidBridgeVolume; })
        data.cellFields.push_back({"bridge_volume_m3", 1, std::move(volume)});
    return data;
}

/// The walls as polygons, with their numbers and species; see surfacesOf().
PolyData wallPolygons(const WallHandler& walls, const Vector<double>& lowest, const Vector<double>& highest);

/// Files that ParaView opens: NAME.pvd, and at each output NAME-particles-STEP.vtp, NAME-contacts-STEP.vtp
/// and NAME-walls-STEP.vtp. Given to Simulation::addOutput().
class ParaViewOutput {
public:
    /// @param beginning NAME; that of the simulation if empty
    explicit ParaViewOutput(std::string beginning = {}) : name(std::move(beginning)) {}

    /// One frame in so much time (s) at most, where outputs are due more often.
    ParaViewOutput& withInterval(double seconds) {
        checkValue("ParaViewOutput", "interval", seconds, "s", notNegative);
        return interval = seconds, *this;
    }
    /// A number or a Vec3D of each grain, by its identity; the name ends with the unit.
    template <class Function>
    ParaViewOutput& addField(std::string name, Function valueOf) {
        added.push_back([name = std::move(name), valueOf = std::move(valueOf)](std::size_t count) {
            PolyDataField field{name, 1, {}};
            std::vector<float> numbers;
            for (std::size_t identity = 0; identity < count; ++identity) {
                const auto value = valueOf(identity);
                if constexpr (requires { value.x(); }) {
                    field.components = 3;
                    for (int axis = 0; axis < 3; ++axis) numbers.push_back(static_cast<float>(value[axis]));
                } else {
                    numbers.push_back(static_cast<float>(value));
                }
            }
            field.numbers = std::move(numbers);
            return field;
        });
        return *this;
    }
    /// The field stress_Pa of each grain as well; see grainStresses().
    ParaViewOutput& withStress(bool yes = true) { return stress = yes, *this; }
    /// The files of contacts, which are the larger part of a large scene's; on by default.
    ParaViewOutput& withContacts(bool yes = true) { return contactsToo = yes, *this; }

    template <class Scene>
    void write(const Scene& scene) {
        if (!series) series.emplace(name.empty() ? scene.getName() : name, scene.getTime());
        // Times are products of rounded numbers.
        if (scene.getTime() < series->lastTime() + interval * (1 - 1e-9)) return;
        const auto& grains = scene.particleHandler.store();
        PolyData points = grainPoints(grains);
        for (const auto& field : added) points.pointFields.push_back(field(grains.size()));
        if (stress) points.pointFields.push_back(grainStresses(scene.contacts(), grains));
        const auto file = [&](std::string_view kind, PolyData data) {
            data.time = scene.getTime();
            writePolyData(series->add(kind, data.time, scene.getNumberOfTimeSteps()), data,
                          scene.getNumberOfThreads());
        };
        const auto [lowest, highest] = boxAround(grains, scene.contacts().periodicBox());
        file("particles", std::move(points));
        if (contactsToo) file("contacts", contactLines(scene.contacts(), grains, scene.speciesHandler));
        if (scene.wallHandler.getSize() > 0) file("walls", wallPolygons(scene.wallHandler, lowest, highest));
        series->write();
    }

private:
    /// Around all grains and the periods of the scene.
    template <bool hasSpin>
    static std::pair<Vector<double>, Vector<double>> boxAround(const ParticleStore<hasSpin>& grains,
                                                               const PeriodicBox& periodic) {
        Vector<double> lowest{infinity, infinity, infinity}, highest = -lowest;
        for (const TranslationRecord& grain : grains.translation)
            for (const auto axis : axes) {
                // A gap to a plane of a few radii belongs to the scene.
                lowest.*axis = std::min(lowest.*axis, grain.position.*axis - 2 * grain.radius);
                highest.*axis = std::max(highest.*axis, grain.position.*axis + 2 * grain.radius);
            }
        for (const auto axis : axes) {
            if (!(lowest.*axis <= highest.*axis)) lowest.*axis = highest.*axis = 0;  // no grains
            if (!(periodic.length.*axis > 0)) continue;
            lowest.*axis = periodic.lowest.*axis;
            highest.*axis = periodic.lowest.*axis + periodic.length.*axis;
        }
        return {lowest, highest};
    }
    static constexpr std::array axes{&Vector<double>::x, &Vector<double>::y, &Vector<double>::z};

    std::vector<std::function<PolyDataField(std::size_t)>> added;
    std::optional<ParaViewSeries> series;
    std::string name;
    double interval = 0;  // s
    bool stress = false, contactsToo = true;
};

}  // namespace pendular
