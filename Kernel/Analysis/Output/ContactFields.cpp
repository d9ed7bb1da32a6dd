#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

namespace {

/// The row of each contact that has a force, in the order of identities. They are visited as they lie in
/// memory: in the order of the rows each would be waited for.
class ContactRows {
public:
    ContactRows(const ContactSystem& of, const ParticleStore& all, int threadCount)
        : contacts(of), grains(all), threads(threadCount), begins(all.count() + 1), rank(all.size(), none) {
        std::uint32_t next = 0;
        for (const std::uint32_t place : grains.place) rank[place] = next++;
        forEachOfPart([&](std::size_t, std::uint32_t place) {
            std::size_t count = 0;
            forEachActingAt(place, [&](const Bucket&, std::uint32_t) { ++count; });
            begins[rank[place] + 1] = count;
        });
        std::partial_sum(begins.begin(), begins.end(), begins.begin());
    }
    [[nodiscard]] std::size_t size() const { return begins.back(); }
    /// How many threads call the function of forEach().
    [[nodiscard]] std::size_t parts() const { return partsOf(grains.size(), threads, worthAThread); }
    /// The place of a grain in the order of identities.
    [[nodiscard]] std::int32_t rankAt(std::uint32_t place) const {
        return static_cast<std::int32_t>(rank[place]);
    }
    /// It is no ghost.
    [[nodiscard]] bool isOwn(std::uint32_t place) const { return rank[place] != none; }

    /// Calls function(part, row, bucket, contact), on several threads.
    template <class Function>
    void forEach(Function&& function) const {
        forEachOfPart([&](std::size_t part, std::uint32_t place) {
            std::size_t row = begins[rank[place]];
            forEachActingAt(place, [&](const Bucket& bucket, std::uint32_t contact) {
                function(part, row++, bucket, contact);
            });
        });
    }

private:
    static constexpr std::size_t worthAThread = 500;  // grains
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// Calls function(part, place) for all grains.
    template <class Function>
    void forEachOfPart(Function&& function) const {
        inParts(
            grains.size(), threads,
            [&](int part, std::size_t begin, std::size_t end) {
                for (std::size_t place = begin; place < end; ++place)
                    if (rank[place] != none)
                        function(static_cast<std::size_t>(part), static_cast<std::uint32_t>(place));
            },
            worthAThread);
    }
    /// Those whose first body is the grain.
    template <class Function>
    void forEachActingAt(std::uint32_t place, Function&& function) const {
        contacts.forEachActingOf(place, [&](const Bucket& bucket, std::uint32_t contact) {
            if (contacts.firstOf(contact) == place) function(bucket, contact);
        });
    }

    const ContactSystem& contacts;
    const ParticleStore& grains;
    int threads;
    std::vector<std::size_t> begins;  // the first row of each grain in the order of identities, and one more
    std::vector<std::uint32_t> rank;  // of the grain at each place
};

/// The numbers of all contacts, which several threads fill.
template <std::floating_point Real>
class ContactColumns {
public:
    ContactColumns(const ContactSystem& of, const ParticleStore& all, const ContactLaws& laws,
                   bool withPoints, std::size_t count)
        : contacts(of),
          grains(all),
          hasTorque(laws.layout.hasTorque),
          hasPoints(withPoints),
          hasVolume(laws.bridgeVolume(0, 0).has_value()),
          force(3 * count),
          normal(count),
          adhesive(count),
          overlap(count),
          tangential(hasTorque ? count : 0),
          point(hasPoints ? 3 * count : 0),
          volume(hasVolume ? count : 0),
          bridged(count),
          first(count),
          second(count),
          wall(count),
          named(of.columns().size(), std::vector<Real>(count)) {}

    /// Fills the row of a contact; returns it as it was observed.
    ObservedContact fill(std::size_t row, const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = contacts.observe(grains, bucket, contact);
        set(row, seen);
        for (std::size_t c = 0; c < named.size(); ++c)
            named[c][row] = static_cast<Real>(contacts.columnOf(seen, c));
        return seen;
    }
    /// The columns as fields; they are empty then.
    std::vector<PolyDataField> takeFields() {
        std::vector<PolyDataField> fields = {{"force_N", 3, std::move(force)},
                                             {"normal_force_N", 1, std::move(normal)},
                                             {"adhesive_force_N", 1, std::move(adhesive)},
                                             {"overlap_m", 1, std::move(overlap)},
                                             {"bridged", 1, std::move(bridged)},
                                             {"particle1", 1, std::move(first)},
                                             {"particle2", 1, std::move(second)},
                                             {"wall", 1, std::move(wall)}};
        const auto addIf = [&](bool isThere, const std::string& name, std::size_t components,
                               std::vector<Real>& numbers) {
            if (isThere) fields.push_back({name, components, std::move(numbers)});
        };
        addIf(hasTorque, "tangential_force_N", 1, tangential);
        addIf(hasPoints, "contact_point_m", 3, point);
        addIf(hasVolume, "bridge_volume_m3", 1, volume);
        for (std::size_t c = 0; c < named.size(); ++c)
            addIf(true, contacts.columns()[c].fieldName(), 1, named[c]);
        return fields;
    }

private:
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
    static void put(std::vector<Real>& column, std::size_t k, const Vector<double>& v) {
        column[3 * k] = static_cast<Real>(v.x);
        column[3 * k + 1] = static_cast<Real>(v.y);
        column[3 * k + 2] = static_cast<Real>(v.z);
    }

    const ContactSystem& contacts;
    const ParticleStore& grains;
    bool hasTorque, hasPoints, hasVolume;
    std::vector<Real> force, normal, adhesive, overlap, tangential, point, volume;
    std::vector<std::int32_t> bridged, first, second, wall;
    std::vector<std::vector<Real>> named;
};

/// The end of a line at a wall or at an image, which is no own grain's centre.
struct OwnEnd {
    std::size_t row;
    Vector<double> point;
};

}  // namespace

std::vector<PolyDataField> contactFields(const ContactSystem& contacts, const ParticleStore& grains,
                                         const ContactLaws& laws, bool withPoints, int threads) {
    const ContactRows rows(contacts, grains, threads);
    ContactColumns<double> columns(contacts, grains, laws, withPoints, rows.size());
    rows.forEach([&](std::size_t, std::size_t row, const Bucket& bucket, std::uint32_t contact) {
        columns.fill(row, bucket, contact);
    });
    return columns.takeFields();
}

namespace {

template <std::floating_point Real>
PolyData linesOf(const ContactSystem& contacts, const ParticleStore& grains, const ContactLaws& laws,
                 bool withPoints, int threads) {
    PolyData data;
    data.kind = PolyData::Cells::Lines;
    data.points.reserve(grains.count());
    for (const std::uint32_t place : grains.place) data.points.push_back(grains.translation[place].position);
    const ContactRows rows(contacts, grains, threads);
    ContactColumns<Real> columns(contacts, grains, laws, withPoints, rows.size());
    data.corners.resize(2 * rows.size()), data.ends.resize(rows.size());
    const bool isPeriodic = contacts.periodicBox().any();
    std::vector<std::vector<OwnEnd>> ownEnds(rows.parts());
    rows.forEach([&](std::size_t part, std::size_t row, const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = columns.fill(row, bucket, contact);
        const std::uint32_t place1 = contacts.firstOf(contact), place2 = contacts.secondOf(contact);
        const Vector<double> end = grains.translation[place1].position + seen.shift;
        const bool isImage = bucket.wall < 0 && isPeriodic &&
                             norm(end - grains.translation[place2].position) > 0.5 * norm(seen.shift);
        data.corners[2 * row] = rows.rankAt(place1);
        if (bucket.wall < 0 && !isImage && rows.isOwn(place2))
            data.corners[2 * row + 1] = rows.rankAt(place2);
        else if (bucket.wall < 0 && !isImage)
            ownEnds[part].push_back({row, grains.translation[place2].position});
        else ownEnds[part].push_back({row, end});
        data.ends[row] = static_cast<std::int32_t>(2 * (row + 1));
    });
    std::vector<OwnEnd> ends;
    for (const std::vector<OwnEnd>& ofPart : ownEnds) ends.insert(ends.end(), ofPart.begin(), ofPart.end());
    std::ranges::sort(ends, {}, &OwnEnd::row);
    for (const OwnEnd& end : ends) {
        data.corners[2 * end.row + 1] = static_cast<std::int32_t>(data.points.size());
        data.points.push_back(end.point);
    }
    data.cellFields = columns.takeFields();
    return data;
}

}  // namespace

template <std::floating_point Real>
PolyData contactLines(const ContactSystem& contacts, const ParticleStore& grains, const ContactLaws& laws,
                      bool withPoints, int threads) {
    return linesOf<Real>(contacts, grains, laws, withPoints, threads);
}

template PolyData contactLines<float>(const ContactSystem&, const ParticleStore&, const ContactLaws&, bool,
                                      int);
template PolyData contactLines<double>(const ContactSystem&, const ParticleStore&, const ContactLaws&, bool,
                                       int);

}  // namespace pendular
