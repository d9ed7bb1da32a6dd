#pragma once

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <functional>
#include <optional>
#include <utility>

#include "Kernel/Contacts/BodyArms.h"
#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/InputError.h"
#include "Kernel/Output/BoxFields.h"
#include "Kernel/Output/PolyData.h"
#include "Kernel/Output/ShapeFields.h"
#include "Kernel/Particles/SphericalParticle.h"
#include "Kernel/Shapes/Superquadric.h"

namespace pendular {

/// The masses of grains; also of those that are held (solid spheres) or part of a rigid body (shares of its
/// mass, parted as masses of free spheres are), which their records do not have.
class GrainMasses {
public:
    GrainMasses(const ParticleStore& store, const ContactLaws& contactLaws)
        : grains(store), laws(contactLaws) {
        if (grains.bodies.empty()) return;
        shares.resize(grains.size());
        for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
            std::vector<double> own = grains.bodies.sharesOfMass(
                k, [this](std::uint32_t grain) { return ofSphere(grains.place[grain]); });
            const auto members = grains.bodies.membersOf(k);
            for (std::size_t m = 0; m < own.size(); ++m) shares[grains.place[members[m].grain]] = own[m];
        }
    }
    /// kg, of the grain at a place.
    [[nodiscard]] double operator()(std::uint32_t place) const {
        if (!shares.empty() && shares[place] > 0) return shares[place];
        const double inverse = grains.translation[place].inverseMass;
        return inverse > 0 ? 1 / inverse : ofSphere(place);
    }

private:
    [[nodiscard]] double ofSphere(std::uint32_t place) const {
        return sphereMass(grains.translation[place].radius, laws.density(grains.species[place]));
    }

    const ParticleStore& grains;
    const ContactLaws& laws;
    std::vector<double> shares;  // kg, by place; 0 of grains in no body
};

/// All forces on the grain at a place, N, with its weight and with what holds it in its rigid body; not kept,
/// and zero, for a grain that is held.
inline Vector<double> forceOn(const ParticleStore& grains, const GrainMasses& masses, std::uint32_t place) {
    if (grains.translation[place].inverseMass == 0) return {0, 0, 0};
    return masses(place) * grains.acceleration[place];
}

/// Throws InputError where two fields of a frame have one name: a file cannot hold them.
inline void requireDistinctNames(const std::vector<PolyDataField>& fields, std::string_view owners) {
    for (std::size_t k = 0; k < fields.size(); ++k)
        for (std::size_t other = 0; other < k; ++other)
            if (fields[k].name == fields[other].name)
                throw InputError(fmt::format(
                    "The outputs have two fields '{}' of the {}; give the column or the field another name.",
                    fields[k].name, owners));
}

/// With rigid bodies, of each grain: the number of its body, or -1; where it is in it (body_arm, from the
/// centre of mass); the velocity and the volume of the body. Zeros for grains in none. Grains that are no
/// spheres are bodies by themselves, about their centres: they have the number only.
template <std::floating_point Real>
void addBodyFields(const ParticleStore& grains, bool areSpheres, PolyData& data) {
    if (grains.bodies.empty()) return;
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
        append(arm, arms[place]);
        append(velocity, isMember ? grains.bodies[k].velocity : Vector<double>{0, 0, 0});
        volume.push_back(isMember ? static_cast<Real>(grains.bodies.volumeOf(k)) : 0);
    }
    data.pointFields.push_back({"body", 1, std::move(body)});
    if (!areSpheres) return;
    data.pointFields.push_back({"body_arm_m", 3, std::move(arm)});
    data.pointFields.push_back({"body_velocity_m_per_s", 3, std::move(velocity)});
    data.pointFields.push_back({"body_volume_m3", 1, std::move(volume)});
}

/// The grains as points: radius, mass, velocity, spin, force (of contacts and weight), species, whether they
/// are held in place (fixed), identity; with rigid bodies what addBodyFields() has.
/// @tparam Real of the fields; positions are doubles
template <std::floating_point Real = float>
PolyData grainPoints(const ParticleStore& grains, const ContactLaws& laws) {
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
    addBodyFields<Real>(grains, laws.shapes() == nullptr, data);
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

/// The mean stress in each grain (Pa, tension positive), in the order of identities:
/// sigma = sum over its contacts of l f / V, with the branch l (m) from the centre to the contact point, the
/// force f (N) on the grain and its volume V (m^3). Source: Love, "A Treatise on the Mathematical Theory of
/// Elasticity" (1927); Weber, Bull. Liaison Ponts Chauss. 20 (1966). The contact point lies in the middle of
/// the overlap or of the gap. The grains of a rigid body have the mean stress of the body: with the branches
/// from its centre of mass, over its volume.
template <std::floating_point Real = float>
PolyDataField grainStresses(const ContactSystem& contacts, const ParticleStore& grains) {
    std::vector<std::array<double, 9>> sums(grains.size());  // of the grain at each place
    const GrainShapes* const shapes = contacts.laws().shapes();
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
    contacts.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = contacts.observe(grains, bucket, contact);
        if (shapes) {
            const Vector<double> arm = seen.point - grains.translation[grains.place[seen.particle1]].position;
            add(seen.particle1, 1, arm, seen.force);
            if (bucket.wall < 0) add(seen.particle2, -1, arm - seen.shift, seen.force);
            return;
        }
        const Vector<double> normal = (1 / norm(seen.shift)) * seen.shift;
        const double half = 0.5 * seen.separation;
        const auto branchOf = [&](std::uint32_t identity, double sign) {
            const std::uint32_t place = grains.place[identity];
            return sign * ((grains.translation[place].radius + half) * normal) + arms.at(place);
        };
        add(seen.particle1, 1, branchOf(seen.particle1, 1), seen.force);
        if (bucket.wall < 0) add(seen.particle2, -1, branchOf(seen.particle2, -1), seen.force);
    });
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
        const double volume = shapes                      ? shapes->shapeAt(grains, place).volume()
                              : body != RigidBodies::none ? grains.bodies.volumeOf(grains.bodies.find(body))
                                                          : sphereMass(grains.translation[place].radius, 1);
        for (const double sum : sums[place]) numbers.push_back(static_cast<Real>(sum / volume));
    }
    return {"stress_Pa", 9, std::move(numbers)};
}

/// The contacts that have a force as lines, from centre to centre (of the nearest image) or to the wall's
/// surface. The first points are the centres of all grains, in the order of identities. The forces are those
/// on particle1; particle2 is -1 at a wall, and wall is -1 between grains.
template <std::floating_point Real = float>
PolyData contactLines(const ContactSystem& contacts, const ParticleStore& grains, const ContactLaws& laws,
                      bool withPoints = false) {
    PolyData data;
    data.kind = PolyData::Cells::Lines;
    std::vector<std::int32_t> pointOf(grains.size());  // of the grain at each place
    for (const std::uint32_t place : grains.place) {
        pointOf[place] = static_cast<std::int32_t>(data.points.size());
        data.points.push_back(grains.translation[place].position);
    }
    std::size_t count = 0;
    contacts.forEachActing(grains, [&](const Bucket&, std::uint32_t) { ++count; });
    std::vector<Real> force, normal, tangential, adhesive, overlap, volume, touched;
    std::vector<std::int32_t> bridged, first, second, wall;
    std::vector<std::vector<Real>> named(contacts.columns().size());
    force.reserve(3 * count), data.corners.reserve(2 * count);
    for (auto* column : {&normal, &adhesive, &overlap}) column->reserve(count);
    for (auto* column : {&bridged, &first, &second, &wall, &data.ends}) column->reserve(count);
    const bool isPeriodic = contacts.periodicBox().any();
    contacts.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = contacts.observe(grains, bucket, contact);
        const TranslationRecord& body1 = grains.translation[grains.place[seen.particle1]];
        const std::uint32_t place2 = bucket.wall < 0 ? grains.place[seen.particle2] : 0;
        const Vector<double> end = body1.position + seen.shift;
        const bool isImage = bucket.wall < 0 && isPeriodic &&
                             norm(end - grains.translation[place2].position) > 0.5 * norm(seen.shift);
        data.corners.push_back(pointOf[grains.place[seen.particle1]]);
        if (bucket.wall < 0 && !isImage) {
            data.corners.push_back(pointOf[place2]);
        } else {
            data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
            data.points.push_back(end);
        }
        data.ends.push_back(static_cast<std::int32_t>(data.corners.size()));
        for (const double part : {seen.force.x, seen.force.y, seen.force.z})
            force.push_back(static_cast<Real>(part));
        normal.push_back(static_cast<Real>(seen.normalForce));
        if (laws.layout.hasTorque) tangential.push_back(static_cast<Real>(norm(seen.tangentialForce())));
        if (withPoints)
            for (const double part : {seen.point.x, seen.point.y, seen.point.z})
                touched.push_back(static_cast<Real>(part));
        adhesive.push_back(static_cast<Real>(seen.adhesiveForce));
        overlap.push_back(static_cast<Real>(-seen.separation));
        volume.push_back(static_cast<Real>(seen.bridgeVolume));
        bridged.push_back(seen.bridged ? 1 : 0);
        first.push_back(static_cast<std::int32_t>(seen.particle1));
        second.push_back(bucket.wall < 0 ? static_cast<std::int32_t>(seen.particle2) : -1);
        wall.push_back(bucket.wall);
        for (std::size_t c = 0; c < named.size(); ++c)
            named[c].push_back(static_cast<Real>(contacts.columnOf(seen, c)));
    });
    data.cellFields = {{"force_N", 3, std::move(force)},
                       {"normal_force_N", 1, std::move(normal)},
                       {"adhesive_force_N", 1, std::move(adhesive)},
                       {"overlap_m", 1, std::move(overlap)},
                       {"bridged", 1, std::move(bridged)},
                       {"particle1", 1, std::move(first)},
                       {"particle2", 1, std::move(second)},
                       {"wall", 1, std::move(wall)}};
    if (laws.layout.hasTorque) data.cellFields.push_back({"tangential_force_N", 1, std::move(tangential)});
    if (withPoints) data.cellFields.push_back({"contact_point_m", 3, std::move(touched)});
    if (laws.bridgeVolume(0, 0)) data.cellFields.push_back({"bridge_volume_m3", 1, std::move(volume)});
    for (std::size_t c = 0; c < named.size(); ++c)
        data.cellFields.push_back({contacts.columns()[c].fieldName(), 1, std::move(named[c])});
    return data;
}

/// The walls as polygons, with their numbers and species; see surfacesOf().
PolyData wallPolygons(const WallHandler& walls, const Vector<double>& lowest, const Vector<double>& highest);

/// What a frame shows of a scene.
struct SceneFrame {
    std::size_t step = 0;
    double time = 0;  // s
    PolyData grains;
    std::optional<PolyData> contacts, walls;
    std::optional<PolyData> shapes;  // of grains that are no spheres
};

/// Throws InputError unless a field of an output can have this name.
void requireFieldName(const std::string& name);

/// Which fields a frame has.
class FrameContent {
public:
    bool stress = false, contacts = true, contactPoints = false;
    bool doubles = false;  // fields of 64 bits, not of 32

    /// A number or a Vec3D of each grain, by its identity; the name ends with the unit.
    template <class Function>
    void addField(const std::string& name, Function valueOf) {
        requireFieldName(name);
        added.push_back([name, valueOf = std::move(valueOf)](const ParticleStore& grains, bool inDoubles) {
            return inDoubles ? fieldOf<double>(name, valueOf, grains) : fieldOf<float>(name, valueOf, grains);
        });
    }

    template <class Scene>
    [[nodiscard]] SceneFrame of(const Scene& scene) const {
        return doubles ? frameOf<double>(scene) : frameOf<float>(scene);
    }

private:
    template <class Real, class Function>
    static PolyDataField fieldOf(const std::string& name, const Function& valueOf,
                                 const ParticleStore& grains) {
        PolyDataField field{name, 1, {}};
        std::vector<Real> numbers;
        for (const std::uint32_t place : grains.place) {
            const auto value = valueOf(std::size_t{grains.identity[place]});
            if constexpr (requires { value.x(); }) {
                field.components = 3;
                for (int axis = 0; axis < 3; ++axis) numbers.push_back(static_cast<Real>(value[axis]));
            } else {
                numbers.push_back(static_cast<Real>(value));
            }
        }
        field.numbers = std::move(numbers);
        return field;
    }

    template <class Real, class Scene>
    [[nodiscard]] SceneFrame frameOf(const Scene& scene) const {
        const auto& store = scene.particleHandler.store();
        SceneFrame frame{scene.getNumberOfTimeSteps(),
                         scene.getTime(),
                         grainPoints<Real>(store, scene.laws()),
                         {},
                         {},
                         {}};
        for (const auto& field : added) frame.grains.pointFields.push_back(field(store, doubles));
        if (stress) frame.grains.pointFields.push_back(grainStresses<Real>(scene.contacts(), store));
        if (contacts)
            frame.contacts = contactLines<Real>(scene.contacts(), store, scene.laws(), contactPoints);
        if (const GrainShapes* const shapes = scene.laws().shapes()) {
            addShapeFields(store, *shapes, frame.grains);
            frame.shapes = shapeSurfaces(store, *shapes);
        }
        frame.grains.wholeFields = boxFields(scene.contacts().periodicBox());
        requireDistinctNames(frame.grains.pointFields, "grains");
        if (frame.contacts) requireDistinctNames(frame.contacts->cellFields, "contacts");
        if (scene.wallHandler.getSize() > 0) {
            const auto [lowest, highest] = boxAround(store, scene.contacts().periodicBox());
            frame.walls = wallPolygons(scene.wallHandler, lowest, highest);
        }
        return frame;
    }

    /// Around all grains and the periods of the scene.
    static std::pair<Vector<double>, Vector<double>> boxAround(const ParticleStore& grains,
                                                               const PeriodicBox& periodic) {
        Vector<double> lowest{infinity, infinity, infinity}, highest = -lowest;
        for (const TranslationRecord& grain : grains.translation) {
            if (grain.radius == 0) continue;  // a gap
            for (const auto axis : axes) {
                // A gap to a plane of a few radii belongs to the scene.
                lowest.*axis = std::min(lowest.*axis, grain.position.*axis - 2 * grain.radius);
                highest.*axis = std::max(highest.*axis, grain.position.*axis + 2 * grain.radius);
            }
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

    std::vector<std::function<PolyDataField(const ParticleStore&, bool)>> added;
};

}  // namespace pendular
