#include <cstdint>

#include "Kernel/Base/Parallel.h"
#include "Kernel/Contacts/ContactLaws.h"
#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Output/SceneFields.h"
#include "Kernel/Particles/ParticleStore.h"
#include "Kernel/Particles/PeriodicBox.h"

namespace pendular {

namespace {

struct Acting {
    const Bucket* bucket;
    std::uint32_t contact;
};

/// The numbers of all contacts, which several threads fill.
template <std::floating_point Real>
struct ContactColumns {
    ContactColumns(std::size_t count, bool withTorque, bool withPoints, bool withVolume, std::size_t ofDriver)
        : hasTorque(withTorque),
          hasPoints(withPoints),
          hasVolume(withVolume),
          force(3 * count),
          normal(count),
          adhesive(count),
          overlap(count),
          tangential(withTorque ? count : 0),
          point(withPoints ? 3 * count : 0),
          volume(withVolume ? count : 0),
          bridged(count),
          first(count),
          second(count),
          wall(count),
          named(ofDriver, std::vector<Real>(count)) {}

    void set(std::size_t k, const ObservedContact& seen) {
        put(force, k, seen.force);
        normal[k] = static_cast<Real>(seen.normalForce);
        adhesive[k] = static_cast<Real>(seen.adhesiveForce);
        overlap[k] = static_cast<Real>(-seen.separation);
        if (!tangential.empty()) tangential[k] = static_cast<Real>(norm(seen.tangentialForce()));
        if (!point.empty()) put(point, k, seen.point);
        if (!volume.empty()) volume[k] = static_cast<Real>(seen.bridgeVolume);
        bridged[k] = seen.bridged ? 1 : 0;
        first[k] = static_cast<std::int32_t>(seen.particle1);
        second[k] = seen.wall < 0 ? static_cast<std::int32_t>(seen.particle2) : -1;
        wall[k] = seen.wall;
    }
    /// The columns as fields; they are empty then.
    std::vector<PolyDataField> takeFields(const std::vector<NamedColumn>& ofDriver) {
        std::vector<PolyDataField> fields = {{"force_N", 3, std::move(force)},
                                             {"normal_force_N", 1, std::move(normal)},
                                             {"adhesive_force_N", 1, std::move(adhesive)},
                                             {"overlap_m", 1, std::move(overlap)},
                                             {"bridged", 1, std::move(bridged)},
                                             {"particle1", 1, std::move(first)},
                                             {"particle2", 1, std::move(second)},
                                             {"wall", 1, std::move(wall)}};
        const auto addIf = [&](bool isThere, const char* name, std::size_t components,
                               std::vector<Real>& numbers) {
            if (isThere) fields.push_back({name, components, std::move(numbers)});
        };
        addIf(hasTorque, "tangential_force_N", 1, tangential);
        addIf(hasPoints, "contact_point_m", 3, point);
        addIf(hasVolume, "bridge_volume_m3", 1, volume);
        for (std::size_t c = 0; c < named.size(); ++c)
            addIf(true, ofDriver[c].fieldName().c_str(), 1, named[c]);
        return fields;
    }

    bool hasTorque, hasPoints, hasVolume;
    std::vector<Real> force, normal, adhesive, overlap, tangential, point, volume;
    std::vector<std::int32_t> bridged, first, second, wall;
    std::vector<std::vector<Real>> named;

private:
    static void put(std::vector<Real>& column, std::size_t k, const Vector<double>& v) {
        column[3 * k] = static_cast<Real>(v.x);
        column[3 * k + 1] = static_cast<Real>(v.y);
        column[3 * k + 2] = static_cast<Real>(v.z);
    }
};

/// The ends of lines at walls and images, by the number of the contact: in parts, each in its order.
using OwnEnds = std::vector<std::vector<std::pair<std::size_t, Vector<double>>>>;

}  // namespace

template <std::floating_point Real>
PolyData contactLines(const ContactSystem& contacts, const ParticleStore& grains, const ContactLaws& laws,
                      bool withPoints, int threads) {
    PolyData data;
    data.kind = PolyData::Cells::Lines;
    std::vector<std::int32_t> pointOf(grains.size());  // of the grain at each place
    data.points.reserve(grains.count());
    for (const std::uint32_t place : grains.place) {
        pointOf[place] = static_cast<std::int32_t>(data.points.size());
        data.points.push_back(grains.translation[place].position);
    }
    std::vector<Acting> acting;
    contacts.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        acting.push_back({&bucket, contact});
    });
    const std::size_t count = acting.size();
    const bool isPeriodic = contacts.periodicBox().any(), hasVolume = laws.bridgeVolume(0, 0).has_value();
    ContactColumns<Real> columns(count, laws.layout.hasTorque, withPoints, hasVolume,
                                 contacts.columns().size());
    data.corners.resize(2 * count), data.ends.resize(count);
    constexpr std::size_t worthAThread = 1000;
    OwnEnds ownEnds(partsOf(count, threads, worthAThread));
    const auto observe = [&](std::size_t part, std::size_t k) {
        const auto [bucket, contact] = acting[k];
        const ObservedContact seen = contacts.observe(grains, *bucket, contact);
        columns.set(k, seen);
        for (std::size_t c = 0; c < columns.named.size(); ++c)
            columns.named[c][k] = static_cast<Real>(contacts.columnOf(seen, c));
        const std::uint32_t place1 = grains.place[seen.particle1];
        const std::uint32_t place2 = bucket->wall < 0 ? grains.place[seen.particle2] : 0;
        const Vector<double> end = grains.translation[place1].position + seen.shift;
        const bool isImage = bucket->wall < 0 && isPeriodic &&
                             norm(end - grains.translation[place2].position) > 0.5 * norm(seen.shift);
        data.corners[2 * k] = pointOf[place1];
        if (bucket->wall < 0 && !isImage) data.corners[2 * k + 1] = pointOf[place2];
        else ownEnds[part].emplace_back(k, end);
        data.ends[k] = static_cast<std::int32_t>(2 * (k + 1));
    };
    inParts(
        count, threads,
        [&](int part, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) observe(static_cast<std::size_t>(part), k);
        },
        worthAThread);
    for (const auto& ofPart : ownEnds)
        for (const auto& [k, end] : ofPart) {
            data.corners[2 * k + 1] = static_cast<std::int32_t>(data.points.size());
            data.points.push_back(end);
        }
    data.cellFields = columns.takeFields(contacts.columns());
    return data;
}

template PolyData contactLines<float>(const ContactSystem&, const ParticleStore&, const ContactLaws&, bool,
                                      int);
template PolyData contactLines<double>(const ContactSystem&, const ParticleStore&, const ContactLaws&, bool,
                                       int);

}  // namespace pendular
