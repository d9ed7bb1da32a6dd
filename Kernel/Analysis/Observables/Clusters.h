#pragma once

#include <cstddef>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

class ParticleStore;
class Scene;
struct ObservedContact;
struct PeriodicBox;

/// Points, or grains, that are joined to each other in pairs.
struct Cluster {
    std::size_t size = 0;       // of its points, or grains
    std::size_t bodies = 0;     // as size, but a rigid body counts as one
    double gyrationRadius = 0;  // m, root mean square distance from the middle; no sense where it is endless
    bool isEndless = false;     // it is joined to an image of itself, so that it spans a periodic scene
    double bridgeVolume = 0;    // m^3, of the bridges between its grains; 0 for points
};

/// All clusters of a set of points or grains; one that is joined to no other is a cluster of one. The grains
/// of a rigid body are joined.
struct Clusters {
    std::vector<Cluster> list;    // from the largest on; of one size, in the order of their first members
    std::vector<std::size_t> of;  // place in the list, of each point, or of grains in the order of identities
    std::vector<std::size_t> ids;  // of the grains; empty for points

    [[nodiscard]] std::size_t largest() const { return list.empty() ? 0 : list.front().size; }
    /// How many clusters have this size.
    [[nodiscard]] std::size_t count(std::size_t size) const;
    /// The two shares of what is alone that are in use: of all members, and of all clusters. A rigid body
    /// that touches no other is alone.
    [[nodiscard]] double aloneOfMembers() const { return shareOfAlone(countBodies()); }
    [[nodiscard]] double aloneOfClusters() const { return shareOfAlone(list.size()); }

private:
    [[nodiscard]] std::size_t countBodies() const;
    [[nodiscard]] double shareOfAlone(std::size_t all) const;
};

/// Points that are nearer to each other than a distance, of their nearest images, are joined.
/// @param distance m; throws InputError unless it is positive and at most half of each period of the box
[[nodiscard]] Clusters clustersOfPoints(const std::vector<Vector<double>>& points, const PeriodicBox& box,
                                        double distance);
/// Grains whose centres are nearer to each other than a distance (m), of their nearest images, are joined.
/// @param contacts that have a force, whose bridges are counted
[[nodiscard]] Clusters clustersOfGrains(const ParticleStore& grains, const PeriodicBox& box,
                                        const std::vector<ObservedContact>& contacts, double distance);
/// Grains that touch or have a bridge are joined.
[[nodiscard]] Clusters clustersOfGrains(const ParticleStore& grains, const PeriodicBox& box,
                                        const std::vector<ObservedContact>& contacts);

/// Grains of a scene whose centres are nearer to each other than a distance (m) are joined.
[[nodiscard]] Clusters clustersWithin(const Scene& scene, double distance);
/// Grains of a scene that touch or have a bridge are joined, as of the last step.
[[nodiscard]] Clusters clustersOfContacts(const Scene& scene);

}  // namespace pendular
