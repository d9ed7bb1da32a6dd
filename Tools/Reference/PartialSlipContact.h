#pragma once

#include <vector>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// What the tangential force of a contact of spheres depends on.
struct PartialSlipConditions {
    double effectiveRadius;  // R*, m
    double elasticModulus;   // E*, Pa
    double shearModulus;     // G* of the contact, 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2, Pa
    double friction;         // Coulomb's coefficient mu

    /// 4 G* / E*: the tangential stiffness of a contact over its normal one, 8 G* a over 2 E* a; for two
    /// bodies of one material 2 (1 - nu) / (2 - nu).
    [[nodiscard]] double stiffnessRatio() const { return 4 * shearModulus / elasticModulus; }
    [[nodiscard]] double contactRadius(double overlap) const;  // a of Hertz, m
    [[nodiscard]] double normalForce(double overlap) const;    // of Hertz, N; 0 without overlap
};

/// The ground truth of friction: the elastic contact of two spheres with partial slip, as Cattaneo (1938),
/// Mindlin (1949) and Mindlin and Deresiewicz (1953) describe it, for any path of overlap and slip.
///
/// By the method of dimensionality reduction (Popov and Hess, Method of Dimensionality Reduction in Contact
/// Mechanics and Friction (2015), chapters 3 and 5) the contact is a row of independent springs at the
/// distances x from its middle, over the profile x^2 / R*. In a length dx a spring has the stiffness E* dx
/// along the normal and 4 G* dx across (their 4 G / (2 - nu) is 4 times our G* of two bodies), it touches
/// where its compression overlap - x^2/R* is positive, and slips where its tangential force would exceed mu
/// times its normal one. The sum over x from -a to a is exact for Hertz's normal force and for the tangential
/// force of the theory named above (which takes the pressure as that of Hertz, and all slip as parallel to
/// the force). Where the slip changes its direction in the plane, each spring follows Coulomb's law for
/// vectors; that is no closed theory, but the natural one.
///
/// A straight move in overlap and slip along one line is exact for each spring, whatever its length: overlap
/// and limit change linearly, so a spring that meets its limit in it stays there. What is left is the error
/// of the sum, by the midpoint rule: of a parabola that is cut at the sticking radius and at a, whose slopes
/// change by 2 a / R* at most, it is (1/8 + 1/8 + 1/24) 2 a dx^2 / R*, so 0.9 (dx/a)^2 of mu times the normal
/// force: 4e-6 with 500 springs.
class PartialSlipContact {
public:
    /// @param largestOverlap m, of the path to come
    /// @param springs in the contact radius at the largest overlap
    /// Throws InputError for values that are not positive and finite (the friction may be 0).
    PartialSlipContact(const PartialSlipConditions& conditions, double largestOverlap, int springs = 500);

    /// Moves along a straight line to an overlap (m; none where it is not positive), with so much slip of
    /// body 1 against body 2 on the way (m, tangential). Throws InputError for an overlap above the largest.
    void move(double newOverlap, const Vector<double>& slip);

    [[nodiscard]] double overlap() const { return depth; }  // m, negative where the bodies are apart
    [[nodiscard]] double normalForce() const { return conditions.normalForce(depth); }  // N
    [[nodiscard]] const Vector<double>& tangentialForce() const { return force; }       // N, on body 1
    /// The part of the contact radius that does not slip after the last move; 0 where all slips.
    [[nodiscard]] double stickingPart() const;

private:
    PartialSlipConditions conditions;
    double spacing;                       // m, dx
    double depth = 0;                     // m
    std::vector<double> profile;          // m, x^2 / R* of the springs at x > 0
    std::vector<Vector<double>> stretch;  // m
    std::size_t touching = 0, sticking = 0;
    Vector<double> force{0, 0, 0};
};

}  // namespace pendular
