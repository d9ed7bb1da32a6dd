#pragma once

#include <map>
#include <vector>

#include "Kernel/Features/Insertion/BodyMixture.h"
#include "Kernel/Features/Insertion/Insertion.h"

namespace pendular {

/// A body that is to find room: its kind, its size and, when it has found some, its place.
struct PlacedBody {
    const BodyKind* kind;
    double radius;                  // m, of the sphere of its volume
    Vector<double> place{0, 0, 0};  // m, of the centre of mass
    Eigen::Quaterniond turn{1, 0, 0, 0};
};

/// The spheres that stand for bodies where they find room: those of clumps and grains, and balls that hold a
/// superquadric (Kernel/Features/Superquadrics/CoveringBalls.h).
class StandInSpheres {
public:
    explicit StandInSpheres(const std::vector<PlacedBody>& bodies);

    /// The spheres (m) of a body where it is.
    [[nodiscard]] std::vector<Ball> of(const PlacedBody& body) const;

private:
    std::map<const BodyKind*, std::vector<Ball>> covers;  // m, of one of scale 1
};

/// How a dense start of bodies was found.
struct DenseBodies {
    int iterations = 0;
    /// The factor of the wanted lengths at which bodies overlap nothing: 1 where they have found room; less
    /// where they had to be made smaller again, to say what can be reached.
    double scale = 1;
};

/// Finds room for clumps, grains and superquadrics at random in a region, among its walls and grains. They
/// begin at places that cover the region evenly, each displaced and turned at random, so small that few meet,
/// and grow to their sizes, their spheres a little beyond; what overlaps pushes and turns, without friction
/// and inertia, until the wanted bodies do not overlap at all. The result does not depend on the threads.
///
/// Source of the idea: Lubachevsky and Stillinger (1990), J. Stat. Phys. 60, 561,
/// https://doi.org/10.1007/BF01025983, for the growth; Jodrey and Tory as of denseStart() for the rest.
DenseBodies denseBodies(std::vector<PlacedBody>& bodies, const StandInSpheres& standIns,
                        const InsertionScene& scene, const Region& region, const InsertOptions& options);

}  // namespace pendular
