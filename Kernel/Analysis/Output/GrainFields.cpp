#include <array>
#include <cstdint>

#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/GrainMasses.h"
#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Features/RigidBodies/BodyArms.h"

namespace pendular {

namespace {

/// Adds for each grain: the number of its body, or -1; where it is in it
/// (body_arm, from the centre of mass); the velocity and the volume of the body. Zeros for grains in none.
template <std::floating_point Real>
void addBodyFields(const ParticleStore& grains, PolyData& data) {
    const std::vector<Vector<double>> arms = grains.bodies.armsInSpace(grains);
    std::vector<std::int32_t> body;
    std::vector<Real> arm, velocity, volume;
    const auto append = [](std::vector<Real>& column, const Vector<double>& v) {
        for (const double part : {v.x, v.y, v.z}) column.push_back(static_cast<Real>(part));
    };
    for (const std::uint32_t place : grains.place) {
        const std::uint32_t number = grains.bodies.bodyOf(grains.identity[place]);
        body.push_back(static_cast<std::int32_t>(number));
        const bool isMember = number != RigidBodies::none;
        const std::size_t k = isMember ? grains.bodies.find(number) : 0;
        append(arm, isMember ? arms[place] : Vector<double>{0, 0, 0});
        append(velocity, isMember ? grains.bodies[k].velocity : Vector<double>{0, 0, 0});
        volume.push_back(isMember ? static_cast<Real>(grains.bodies.volumeOf(k)) : 0);
    }
    data.pointFields.push_back({"body", 1, std::move(body)});
    data.pointFields.push_back({"body_arm_m", 3, std::move(arm)});
    data.pointFields.push_back({"body_velocity_m_per_s", 3, std::move(velocity)});
    data.pointFields.push_back({"body_volume_m3", 1, std::move(volume)});
}

}  // namespace

template <std::floating_point Real>
PolyData grainPoints(const ParticleStore& grains, const ContactLaws& laws, bool withBodies) {
    PolyData data;
    const GrainMasses masses(grains, laws);
    std::vector<Real> radius, mass, velocity, spin, force;
    std::vector<std::int32_t> species, fixed, identity;
    const auto append = [](std::vector<Real>& column, const Vector<double>& v) {
        for (const double part : {v.x, v.y, v.z}) column.push_back(static_cast<Real>(part));
    };
    const std::size_t count = grains.count();
    data.points.reserve(count), data.corners.reserve(count);
    radius.reserve(count), mass.reserve(count);
    species.reserve(count), fixed.reserve(count), identity.reserve(count);
    velocity.reserve(3 * count), force.reserve(3 * count);
    if (grains.hasSpin) spin.reserve(3 * count);
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
        data.points.push_back(grain.position);
        radius.push_back(static_cast<Real>(grain.radius));
        mass.push_back(static_cast<Real>(masses(place)));
        append(velocity, grain.velocity);
        if (grains.hasSpin) append(spin, grains.rotation[place].spin);
        append(force, forceOn(grains, masses, place));
        species.push_back(grains.species[place]);
        fixed.push_back(grain.inverseMass > 0 ? 0 : 1);
        identity.push_back(static_cast<std::int32_t>(grains.identity[place]));
    }
    if (!data.corners.empty()) data.ends = {static_cast<std::int32_t>(data.corners.size())};
    data.pointFields = {{"radius_m", 1, std::move(radius)},
                        {"mass_kg", 1, std::move(mass)},
                        {"velocity_m_per_s", 3, std::move(velocity)}};
    if (grains.hasSpin) data.pointFields.push_back({"spin_rad_per_s", 3, std::move(spin)});
    data.pointFields.push_back({"force_N", 3, std::move(force)});
    data.pointFields.push_back({"species", 1, std::move(species)});
    if (withBodies || !grains.bodies.empty()) addBodyFields<Real>(grains, data);
    data.pointFields.push_back({"fixed", 1, std::move(fixed)});
    data.pointFields.push_back({"identity", 1, std::move(identity)});
    for (const GrainColumn& column : grains.columns) {
        std::vector<Real> numbers;
        numbers.reserve(count);
        for (const std::uint32_t place : grains.place)
            numbers.push_back(static_cast<Real>(column.values[place]));
        data.pointFields.push_back({column.fieldName(), 1, std::move(numbers)});
    }
    return data;
}

template <std::floating_point Real>
PolyDataField grainStresses(const ContactSystem& contacts, const ParticleStore& grains,
                            const ContactLaws& laws) {
    std::vector<std::array<double, 9>> sums(grains.size());  // of the grain at each place
    const GrainShapes* const shapes = laws.shapes();
    const BodyArms arms(grains);
    const auto add = [&](std::uint32_t identity, double sign, const Vector<double>& branch,
                         const Vector<double>& force) {
        const std::uint32_t place = grains.place[identity];
        const double parts[] = {sign * force.x, sign * force.y, sign * force.z};
        for (std::size_t k = 0; k < 3; ++k) {
            sums[place][k] += branch.x * parts[k];
            sums[place][3 + k] += branch.y * parts[k];
            sums[place][6 + k] += branch.z * parts[k];
        }
    };
    const auto addTo1 = [&](const ObservedContact& seen) {
        const std::uint32_t place = grains.place[seen.particle1];
        if (shapes) {
            Vector<double> branch = seen.point - grains.translation[place].position;
            if (seen.wall >= 0) branch += (0.5 * seen.overlap()) * seen.normal();
            return add(seen.particle1, 1, branch + arms.at(place), seen.force);
        }
        const Vector<double> normal = (1 / norm(seen.shift)) * seen.shift;
        add(seen.particle1, 1,
            (grains.translation[place].radius + 0.5 * seen.separation) * normal + arms.at(place), seen.force);
    };
    const auto addTo2 = [&](const ObservedContact& seen) {
        const std::uint32_t place = grains.place[seen.particle2];
        if (shapes) {
            const Vector<double> position1 =
                grains.translation[grains.placeOf(seen.particle1)].position;  // it may be a ghost
            return add(seen.particle2, -1, seen.point - position1 - seen.shift + arms.at(place), seen.force);
        }
        const Vector<double> normal = (1 / norm(seen.shift)) * seen.shift;
        add(seen.particle2, -1,
            -1.0 * ((grains.translation[place].radius + 0.5 * seen.separation) * normal) + arms.at(place),
            seen.force);
    };
    if (grains.isShared) {
        // All contacts of own grains, also those that count on another rank; in the order in which they are
        // added below.
        for (const std::uint32_t place : grains.place)
            for (const bool isSecond : {true, false})
                contacts.forEachActingOf(place, [&](const Bucket& bucket, std::uint32_t contact) {
                    if ((contacts.firstOf(contact) == place) == isSecond) return;
                    const ObservedContact seen = contacts.observe(grains, bucket, contact);
                    isSecond ? addTo2(seen) : addTo1(seen);
                });
    } else {
        contacts.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
            const ObservedContact seen = contacts.observe(grains, bucket, contact);
            addTo1(seen);
            if (bucket.wall < 0) addTo2(seen);
        });
    }
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        std::array<double, 9> whole{};
        const auto members = grains.bodies.membersOf(k);
        for (const BodyMember& member : members)
            for (std::size_t part = 0; part < 9; ++part)
                whole[part] += sums[grains.place[member.grain]][part];
        for (const BodyMember& member : members) sums[grains.place[member.grain]] = whole;
    }
    std::vector<Real> numbers;
    for (const std::uint32_t place : grains.place) {
        const std::uint32_t body = grains.bodies.bodyOf(grains.identity[place]);
        const double volume = body != RigidBodies::none ? grains.bodies.volumeOf(grains.bodies.find(body))
                                                        : sphereMass(grains.translation[place].radius, 1);
        for (const double sum : sums[place]) numbers.push_back(static_cast<Real>(sum / volume));
    }
    return {"stress_Pa", 9, std::move(numbers)};
}

template PolyData grainPoints<float>(const ParticleStore&, const ContactLaws&, bool);
template PolyData grainPoints<double>(const ParticleStore&, const ContactLaws&, bool);
template PolyDataField grainStresses<float>(const ContactSystem&, const ParticleStore&, const ContactLaws&);
template PolyDataField grainStresses<double>(const ContactSystem&, const ParticleStore&, const ContactLaws&);

}  // namespace pendular
