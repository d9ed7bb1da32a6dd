#include <cstdint>

#include "Kernel/Contacts/ContactLaws.h"
#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Output/SceneFields.h"
#include "Kernel/Particles/ParticleStore.h"
#include "Kernel/Particles/PeriodicBox.h"

namespace pendular {

template <std::floating_point Real>
PolyData contactLines(const ContactSystem& contacts, const ParticleStore& grains, const ContactLaws& laws,
                      bool withPoints) {
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

template PolyData contactLines<float>(const ContactSystem&, const ParticleStore&, const ContactLaws&, bool);
template PolyData contactLines<double>(const ContactSystem&, const ParticleStore&, const ContactLaws&, bool);

}  // namespace pendular
