#pragma once

#include <string>

namespace pendular {

class Scene;

/// The overlaps that a scene is about to have, estimated at set-up, beside the 5 % that its stability limit
/// supposes. The estimate for the pair of bodies whose contact is deepest for its size.
struct OverlapEstimate {
    double byWeight = 0;  // of the smaller radius: a mean contact below all grains in a heap, and a pressure
    double bySpeed = 0;   // a collision with the largest speed, gained in a fall through the grains' height
    double pressure = 0;  // Pa, of the first
    double speed = 0;     // m/s, of the second
    double limit = 0;     // s, stabilityLimit()
    double step = 0;      // s, about what it would be at these overlaps

    [[nodiscard]] double largest() const { return byWeight > bySpeed ? byWeight : bySpeed; }
    [[nodiscard]] std::string text() const;
};

/// The estimate is by the normal laws alone, without dashpots and attraction, which make overlaps smaller and
/// larger.
/// - Weight: all grains rest on the shadow A of the box around them, p = m g / A, and a mean contact of Z = 6
///   at the solid fraction 0.6 has pi d^2 p / (0.6 Z) (Rumpf (1958); the stress of Love and Weber).
/// - Speed: 1/2 m* v^2 is stored at once; v is the largest speed of a grain and that of a fall through the
///   height of the box along gravity. Where there are rigid bodies, m* is that of the heaviest ones.
/// The step is the limit times that of the stiffest pair with these overlaps over that with 5 %: normal and
/// tangential stiffness of Hertz and Mindlin change with the overlap, springs of rolling and torsion do not.
/// It may be called before or after the run begins.
/// @param pressure Pa, that acts besides (pistons, target stresses)
[[nodiscard]] OverlapEstimate estimateOverlaps(Scene& scene, double pressure = 0);

}  // namespace pendular
