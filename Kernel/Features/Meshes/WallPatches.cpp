#include "Kernel/Features/Meshes/WallPatches.h"

#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Features/Meshes/ContactPatch.h"
#include "Kernel/Features/Meshes/PartCover.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

namespace {

constexpr std::size_t patchesWorthAThread = 256;  // grains near several parts
/// Surfaces in one plane are at distances that differ by round-off. The wall with the lower number counts
/// there, instead of one or the other by chance; the second one is taken to lie this share of the radius
/// deeper.
constexpr double orderOfWalls = 1e-12;

/// The cosine of the angle (60 degrees) between the normals at two points from which on facets that continue
/// each other are not one contact: the far side of a narrow cone or tube.
constexpr double endOfChain = 0.5;
/// A share of the range of a bridge: within this distance of a touch, the width of the liquid of another
/// contact counts the less, so that a touch at a step or a groove is none of the liquid's, ...
constexpr double fadingOfLiquid = 0.1;
/// ... but for this share of it: a crack is none at the moment of a touch, too.
constexpr double leastOfLiquid = 0.02;

double distanceOf(const ContactStore& store, std::uint32_t contact) {
    return store.wallPoints[contact / Pack::lanes - store.firstWallBlock()]
        .distance.lane[contact % Pack::lanes];
}
void setDistance(ContactStore& store, std::uint32_t contact, double distance) {
    store.wallPoints[contact / Pack::lanes - store.firstWallBlock()].distance.lane[contact % Pack::lanes] =
        distance;
}
Vector<double> normalOf(const ContactStore& store, std::uint32_t contact) {
    const auto& n = store.wallPoints[contact / Pack::lanes - store.firstWallBlock()].normal;
    const std::size_t lane = contact % Pack::lanes;
    return {n[0].lane[lane], n[1].lane[lane], n[2].lane[lane]};
}
std::uint32_t partOf(const ContactStore& store, std::uint32_t contact) {
    return store.blocks[contact / Pack::lanes].second[contact % Pack::lanes];
}

/// A part of a wall, of which the point nearest to another one can be asked.
struct Facet {
    const Wall& wall;
    std::uint32_t part;

    [[nodiscard]] Vector<double> nearestTo(const Vector<double>& place, double reach) const {
        WallPoint found;
        wall.findPoints(place, reach, {&part, 1}, {&found, 1});
        return place + found.distance * found.normal;
    }
};

/// m, between two facets, near to where a grain touches them at p and q: not less than it is. It is looked
/// for from q, which lies at the edge where the surface is flat, and from where the planes across the normals
/// meet, which is the edge of a groove.
double gapBetween(const Facet& nearFacet, const Facet& farFacet, const Vector<double>& p,
                  const Vector<double>& q, const Vector<double>& normalP, const Vector<double>& normalQ,
                  double radius) {
    const double direct = norm(nearFacet.nearestTo(q, radius) - q);
    const double c = dot(normalP, normalQ), sine2 = 1 - c * c;
    if (!(sine2 > 1e-12)) return direct;
    // x = m + a n_p + b n_q with n_p (x - p) = n_q (x - q) = 0, m in the middle of p and q.
    const Vector<double> half = 0.5 * (q - p);
    const double u = -dot(normalP, half), v = dot(normalQ, half);
    const Vector<double> shift = ((u - c * v) / sine2) * normalP + ((v - c * u) / sine2) * normalQ;
    if (!(squaredNorm(shift) < radius * radius)) return direct;
    const Vector<double> edge = p + half + shift;
    return std::min(direct, norm(nearFacet.nearestTo(edge, radius) - farFacet.nearestTo(edge, radius)));
}

}  // namespace

void WallPatches::listed(const ContactStore& contacts, const ContactLaws& laws, const ParticleStore& grains) {
    several.clear(), members.clear(), ranges.clear();
    if (contacts.wallPoints.empty()) return;
    std::vector<std::uint32_t> next(grains.size() + 1);  // first counts, then where members go
    const auto forEachAtWalls = [&](auto&& function) {
        for (std::size_t k = 0; k < contacts.buckets.size(); ++k) {
            const Bucket& bucket = contacts.buckets[k];
            for (std::uint32_t c = bucket.begin * Pack::lanes;
                 bucket.wall >= 0 && c < bucket.end * Pack::lanes; ++c)
                if (ContactStore::bitOf(contacts.states[c / Pack::lanes].listed, c))
                    function(k, c, contacts.blocks[c / Pack::lanes].first[c % Pack::lanes]);
        }
    };
    forEachAtWalls([&](std::size_t, std::uint32_t, std::uint32_t place) { ++next[place]; });
    std::uint32_t count = 0;
    constexpr std::uint32_t alone = ~std::uint32_t{0};
    for (std::uint32_t place = 0; place < grains.size(); ++place) {
        const std::uint32_t own = std::exchange(next[place], alone);
        if (own < 2) continue;
        several.push_back({place, count});
        next[place] = count;
        count += own;
    }
    if (several.empty()) return;
    several.push_back({0, count});
    members.resize(count);
    if (laws.layout.interaction > 0) ranges.resize(count);
    forEachAtWalls([&](std::size_t bucket, std::uint32_t contact, std::uint32_t place) {
        if (next[place] == alone) return;
        const std::uint32_t at = next[place]++;
        members[at] = {contact, static_cast<std::int32_t>(bucket)};
        if (ranges.empty()) return;
        const Bucket& of = contacts.buckets[bucket];
        ranges[at] = laws.range(of.species1, of.species2, {grains.translation[place].radius});
    });
}

void WallPatches::join(ContactStore& contacts, const ContactLaws& laws, const ParticleStore& grains,
                       const WallHandler& walls, int threads, bool handsOver,
                       const std::function<void(std::size_t)>& wake) {
    if (several.empty()) return;
    handOvers.resize(static_cast<std::size_t>(threads));
    for (std::vector<HandOver>& own : handOvers) own.clear();
    inParts(
        several.size() - 1, threads,
        [&](int part, std::size_t begin, std::size_t end) {
            std::vector<Point> points;
            for (std::size_t k = begin; k < end; ++k)
                joinOf(k, contacts, laws.shapes(), grains, walls, points,
                       handOvers[static_cast<std::size_t>(part)]);
        },
        patchesWorthAThread);
    if (handsOver) handOver(contacts, laws, handOvers, wake);
}

/// Fills in the points of a grain that are near enough to act.
void WallPatches::findNear(std::size_t grain, const ContactStore& contacts, const GrainShapes* shapes,
                           const ParticleStore& grains, std::vector<Point>& points) const {
    const std::uint32_t place = several[grain].place;
    const TranslationRecord& body = grains.translation[place];
    const std::uint32_t begin = several[grain].begin, end = several[grain + 1].begin;
    const bool isShaped = shapes && shapes->isShaped(grains, place);
    const auto rangeOf = [&](std::uint32_t m) { return ranges.empty() ? 0 : ranges[m]; };
    points.clear();
    std::uint32_t near = 0;
    for (std::uint32_t m = begin; m < end; ++m)
        near += distanceOf(contacts, members[m].contact) < body.radius + rangeOf(m) ? 1 : 0;
    if (near < 2 || (isShaped && isAtOneWall(grain, contacts))) return;
    for (std::uint32_t m = begin; m < end; ++m) {
        const std::uint32_t contact = members[m].contact;
        const double distance = distanceOf(contacts, contact);
        if (!(distance < body.radius + rangeOf(m))) continue;
        if (!ContactStore::bitOf(contacts.states[contact / Pack::lanes].listed, contact)) continue;
        const Bucket& bucket = contacts.buckets[static_cast<std::size_t>(members[m].bucket)];
        const Vector<double> normal = normalOf(contacts, contact);
        Point point{contact,
                    &bucket,
                    normal,
                    distance,
                    body.radius + rangeOf(m),
                    distance + orderOfWalls * body.radius * bucket.wall,
                    1,
                    body.radius,
                    distance * normal};
        if (isShaped) {  // the deepest first
            const Vector<double> farthest = shapes->farthest(grains, place, normal);
            point.height = dot(farthest, normal);
            point.touched = farthest - (point.height - distance) * normal;
            point.reach = point.height + rangeOf(m);
            point.order -= point.height;
            if (!(distance < point.reach)) continue;
        }
        points.push_back(point);
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const Point& a, const Point& b) { return a.order < b.order; });
}

void WallPatches::joinOf(std::size_t grain, ContactStore& contacts, const GrainShapes* shapes,
                         const ParticleStore& grains, const WallHandler& walls, std::vector<Point>& points,
                         std::vector<HandOver>& found) const {
    findNear(grain, contacts, shapes, grains, points);
    const std::uint32_t place = several[grain].place;
    const TranslationRecord& body = grains.translation[place];
    const bool isShaped = shapes && shapes->isShaped(grains, place);
    const auto shareOf = [&](const Point& near, const Point& far) {
        return isShaped ? ownShareOfShape(near, far) : ownShare(contacts, walls, near, far, body.position);
    };
    // A point takes from those behind it by how far it counts itself, so that nothing jumps where two of
    // several change places. A facet that is left out goes on for the one that it continues, as the next
    // facets of a finely cut cavity lie beside it and not beside that one.
    std::vector<const Point*> continued(points.size(), nullptr);
    for (std::size_t far = 1; far < points.size(); ++far) {
        Point& point = points[far];
        double most = 0;
        const Point* cover = nullptr;
        for (std::size_t k = 0; k < far && point.share > 0; ++k) {
            const Point& other = points[k];
            const Point* const first = other.share > 0 ? &other : continued[k];
            if (!first || !(dot(first->normal, point.normal) > endOfChain)) continue;
            const double weight = other.share > 0 ? other.share : first->share;
            const double taken = weight * (1 - shareOf(other, point));
            if (taken > most) most = taken, cover = first;
            point.share *= 1 - taken;
        }
        if (!cover) continue;
        continued[far] = cover;
        if (point.share > 0) {
            setDistance(contacts, point.contact,
                        point.share * point.distance + (1 - point.share) * point.reach);
            continue;
        }
        setDistance(contacts, point.contact, infinity);
        // Another material begins a contact of its own.
        if (cover->bucket->species2 == point.bucket->species2)
            found.push_back({point.contact, cover->contact, point.normal, cover->normal});
    }
}

bool WallPatches::isAtOneWall(std::size_t grain, const ContactStore& contacts) const {
    const auto wallOf = [&](std::uint32_t m) {
        return contacts.buckets[static_cast<std::size_t>(members[m].bucket)].wall;
    };
    const std::uint32_t begin = several[grain].begin;
    for (std::uint32_t m = begin + 1; m < several[grain + 1].begin; ++m)
        if (wallOf(m) != wallOf(begin)) return false;
    return true;
}

/// m, how deep the contact at the near point reaches into the surface, beside the far one.
double WallPatches::depthBeside(const Point& near, const Point& far) {
    const double radius = near.height, range = near.reach - radius, gap = far.distance - far.height,
                 pressed = patchDepth(radius, near.distance, 0),
                 wetted = patchDepth(radius, near.distance, range) - pressed;
    return pressed +
           (range > 0 ? std::clamp(gap / (fadingOfLiquid * range), leastOfLiquid, 1.0) * wetted : 0);
}

/// How far the point q rises out of the tangent plane at p does not ask for a centre: n_p . (p - q).
double WallPatches::ownShareOfShape(const Point& near, const Point& far) {
    if (near.bucket->wall == far.bucket->wall) return 1;
    return ownShareByRise(dot(near.normal, near.touched - far.touched), depthBeside(near, far));
}

double WallPatches::ownShare(const ContactStore& contacts, const WallHandler& walls, const Point& near,
                             const Point& far, const Vector<double>& centre) {
    const double cosine = dot(near.normal, far.normal), radius = near.height, depth = depthBeside(near, far);
    const double byRise = ownShareByRise(near.distance - far.distance * cosine, depth);
    if (byRise == 0 || !(cosine > smoothCosine)) return byRise;
    const Facet a{walls.getObject(static_cast<std::size_t>(near.bucket->wall)),
                  partOf(contacts, near.contact)};
    const Facet b{walls.getObject(static_cast<std::size_t>(far.bucket->wall)), partOf(contacts, far.contact)};
    const auto normalA = a.wall.facetNormal(a.part), normalB = b.wall.facetNormal(b.part);
    if (!normalA || !normalB || !(std::abs(dot(*normalA, *normalB)) > smoothCosine)) return byRise;
    const Vector<double> p = centre + near.distance * near.normal, q = centre + far.distance * far.normal;
    const double between = gapBetween(a, b, p, q, near.normal, far.normal, radius);
    return std::min(byRise, ownShareByGap(between, radius, depth));
}

}  // namespace pendular
