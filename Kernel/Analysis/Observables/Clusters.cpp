#include "Kernel/Analysis/Observables/Clusters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/NeighbourSearch.h"
#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Particles/Resolution.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

namespace {

double shortestPeriod(const PeriodicBox& box) {
    double shortest = infinity;
    for (const double length : {box.length.x, box.length.y, box.length.z})
        if (length > 0) shortest = std::min(shortest, length);
    return shortest;
}

/// Disjoint sets whose members know where they are from their set's root, through all faces of the box.
/// Joined by size, so that no member is more than log2(n) steps from its root. Source: Tarjan (1975), J. ACM
/// 22, 215.
class JoinedPoints {
public:
    JoinedPoints(std::size_t count, const PeriodicBox& box)
        : nodes(count), endless(count), halfPeriod(0.5 * shortestPeriod(box)) {
        for (std::size_t k = 0; k < count; ++k) nodes[k].above = k;
    }
    /// @param shift m, from the first to the image of the second to which it is joined
    void join(std::size_t first, std::size_t second, const Vector<double>& shift) {
        const Root a = rootOf(first), b = rootOf(second);
        const Vector<double> between = a.shift + shift - b.shift;  // from root to root
        if (a.node == b.node) {                                    // round-off, or a whole image
            if (norm(between) > halfPeriod) endless[a.node] = true;
            return;
        }
        const bool secondIsLarger = nodes[a.node].size < nodes[b.node].size;
        const std::size_t root = secondIsLarger ? b.node : a.node, other = secondIsLarger ? a.node : b.node;
        nodes[other].above = root;
        nodes[other].shift = secondIsLarger ? -between : between;
        nodes[root].size += nodes[other].size;
        if (endless[other]) endless[root] = true;
    }
    [[nodiscard]] Clusters clusters() const {
        Clusters found;
        std::vector<std::size_t> numberOf(nodes.size(), unnumbered);
        std::vector<Vector<double>> sums;  // m, of the members' shifts
        std::vector<double> squares;       // m^2
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const Root root = rootOf(k);
            std::size_t& number = numberOf[root.node];
            if (number == unnumbered) {
                number = found.list.size();
                found.list.push_back({.size = nodes[root.node].size,
                                      .bodies = nodes[root.node].size,
                                      .isEndless = endless[root.node]});
                sums.push_back({0, 0, 0});
                squares.push_back(0);
            }
            sums[number] += root.shift;
            squares[number] += squaredNorm(root.shift);
            found.of.push_back(number);
        }
        for (std::size_t k = 0; k < found.list.size(); ++k) {
            const auto size = static_cast<double>(found.list[k].size);
            const double spread = squares[k] / size - squaredNorm((1 / size) * sums[k]);
            found.list[k].gyrationRadius = std::sqrt(std::max(spread, 0.0));
        }
        sort(found);
        return found;
    }

private:
    static constexpr std::size_t unnumbered = std::numeric_limits<std::size_t>::max();
    struct Node {
        std::size_t above = 0;          // itself at the root
        std::size_t size = 1;           // of the set, at the root
        Vector<double> shift{0, 0, 0};  // m, from the node above
    };
    struct Root {
        std::size_t node;
        Vector<double> shift;  // m, from it
    };

    [[nodiscard]] Root rootOf(std::size_t node) const {
        Vector<double> shift{0, 0, 0};
        for (; nodes[node].above != node; node = nodes[node].above) shift += nodes[node].shift;
        return {node, shift};
    }
    static void sort(Clusters& found) {
        std::vector<std::size_t> order(found.list.size()), place(order.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, std::ranges::greater{},
                                 [&](std::size_t k) { return found.list[k].size; });
        std::vector<Cluster> sorted;
        for (const std::size_t k : order) {
            place[k] = sorted.size();
            sorted.push_back(found.list[k]);
        }
        found.list = std::move(sorted);
        for (std::size_t& cluster : found.of) cluster = place[cluster];
    }

    std::vector<Node> nodes;
    std::vector<bool> endless;  // at the roots
    double halfPeriod;          // m
};

std::vector<std::size_t> identitiesOf(const ParticleStore& grains) {
    std::vector<std::size_t> identities;
    for (const std::uint32_t place : grains.place) identities.push_back(grains.identity[place]);
    return identities;
}

std::size_t rankOf(const std::vector<std::size_t>& identities, std::size_t identity) {
    return static_cast<std::size_t>(std::ranges::lower_bound(identities, identity) - identities.begin());
}

/// The grains of a rigid body are where its arms have them.
void joinBodies(JoinedPoints& joined, const ParticleStore& grains,
                const std::vector<std::size_t>& identities) {
    const std::vector<Vector<double>> arms = grains.bodies.armsInSpace(grains);
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        const auto members = grains.bodies.membersOf(k);
        const std::uint32_t first = members[0].grain;
        for (const BodyMember& member : members.subspan(1))
            joined.join(rankOf(identities, first), rankOf(identities, member.grain),
                        arms[grains.place[member.grain]] - arms[grains.place[first]]);
    }
}

void addLiquid(Clusters& clusters, const std::vector<ObservedContact>& contacts) {
    for (const ObservedContact& seen : contacts) {
        if (seen.particle2 == ObservedContact::none) continue;
        const std::size_t cluster = clusters.of[rankOf(clusters.ids, seen.particle1)];
        if (cluster == clusters.of[rankOf(clusters.ids, seen.particle2)])
            clusters.list[cluster].bridgeVolume += seen.bridgeVolume;
    }
}

/// Finds what needs more than the points.
Clusters finished(const JoinedPoints& joined, const ParticleStore& grains,
                  std::vector<std::size_t> identities, const std::vector<ObservedContact>& contacts) {
    Clusters found = joined.clusters();
    found.ids = std::move(identities);
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        const auto members = grains.bodies.membersOf(k);
        found.list[found.of[rankOf(found.ids, members[0].grain)]].bodies -= members.size() - 1;
    }
    addLiquid(found, contacts);
    return found;
}

}  // namespace

std::size_t Clusters::countBodies() const {
    std::size_t sum = 0;
    for (const Cluster& cluster : list) sum += cluster.bodies;
    return sum;
}

double Clusters::shareOfAlone(std::size_t all) const {
    const auto alone = std::ranges::count(list, std::size_t{1}, &Cluster::bodies);
    return all == 0 ? 0 : static_cast<double>(alone) / static_cast<double>(all);
}

std::size_t Clusters::count(std::size_t size) const {
    return static_cast<std::size_t>(std::ranges::count(list, size, &Cluster::size));
}

namespace {

JoinedPoints joinNear(const std::vector<Vector<double>>& points, const PeriodicBox& box, double distance) {
    checkValue("Clusters", "distance", distance, "m", positive);
    if (!(distance <= 0.5 * shortestPeriod(box)))
        throw InputError(fmt::format(
            "Clusters: distance = {} m is more than half of the shortest period of the scene, {} m: a grain "
            "would be joined to several images of another one.",
            distance, shortestPeriod(box)));
    std::vector<TranslationRecord> records(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        records[k].position = box.wrap(points[k]), records[k].radius = 0.5 * distance;
        requireResolved(fmt::format("Clusters: point {}", k), "place", records[k].position,
                        records[k].radius);
    }
    const NeighbourSearch search(records, 0, box);  // of spheres that overlap
    JoinedPoints joined(points.size(), box);
    for (std::uint32_t k = 0; k < points.size(); ++k)
        search.forEachPartner(k, [&](std::uint32_t other) {
            joined.join(k, other, box.nearest(records[other].position - records[k].position));
        });
    return joined;
}

}  // namespace

Clusters clustersOfPoints(const std::vector<Vector<double>>& points, const PeriodicBox& box,
                          double distance) {
    return joinNear(points, box, distance).clusters();
}

Clusters clustersOfGrains(const ParticleStore& grains, const PeriodicBox& box,
                          const std::vector<ObservedContact>& contacts, double distance) {
    std::vector<Vector<double>> centres;
    for (const std::uint32_t place : grains.place) centres.push_back(grains.translation[place].position);
    JoinedPoints joined = joinNear(centres, box, distance);
    const std::vector<std::size_t> identities = identitiesOf(grains);
    joinBodies(joined, grains, identities);
    return finished(joined, grains, identities, contacts);
}

Clusters clustersOfGrains(const ParticleStore& grains, const PeriodicBox& box,
                          const std::vector<ObservedContact>& contacts) {
    const std::vector<std::size_t> identities = identitiesOf(grains);
    JoinedPoints joined(identities.size(), box);
    for (const ObservedContact& seen : contacts)
        if (seen.particle2 != ObservedContact::none && (seen.touching || seen.bridged))
            joined.join(rankOf(identities, seen.particle1), rankOf(identities, seen.particle2), seen.shift);
    joinBodies(joined, grains, identities);
    return finished(joined, grains, identities, contacts);
}

Clusters clustersWithin(const Scene& scene, double distance) {
    scene.contacts().ranks().requireAllGrains("clusters");
    return clustersOfGrains(scene.particleHandler.store(), scene.getPeriodicBox(), scene.interactions(),
                            distance);
}

Clusters clustersOfContacts(const Scene& scene) {
    scene.contacts().ranks().requireAllGrains("clusters");
    return clustersOfGrains(scene.particleHandler.store(), scene.getPeriodicBox(), scene.interactions());
}

}  // namespace pendular
