#pragma once

#include "Tools/Studies/AccuracyVersusCost/FrictionLaws.h"
#include "Tools/Studies/AccuracyVersusCost/FrictionPaths.h"

// How far friction laws are from the exact contact, on one path or in one impact.

namespace pendular::friction {

inline constexpr int springsOfTruth = 300;

/// What a contact does along a path.
struct Course {
    std::vector<Vector<double>> forces;  // N, after each move
    double limit2 = 0;                   // N^2, sum of the squares of mu times the normal force
    double loss = 0;                     // J, work against the force along the path
};

template <TangentialContact Contact>
Course courseOf(const Path& path, Contact&& moved) {
    Course course;
    Vector<double> before{0, 0, 0};
    follow(path, [&](double overlap, const Vector<double>& slip) {
        moved.move(overlap, slip);
        const Vector<double> force = moved.tangentialForce();
        course.forces.push_back(force);
        course.limit2 += std::pow(contact.friction * contact.normalForce(overlap), 2);
        course.loss -= 0.5 * dot(force + before, slip);
        before = force;
    });
    return course;
}
inline Course exactCourse(const Path& path) {
    return courseOf(path, PartialSlipContact(contact, 1.001 * deepest, springsOfTruth));
}
template <class Named>
Course courseOfLaw(const Path& path, const Named& law) {
    return courseOf(path, LawContact<Named>(law, contact, deepest));
}

/// The rms error of the force over the rms of mu times the normal force.
inline double forceError(const Course& course, const Course& exact) {
    double squares = 0;
    for (std::size_t k = 0; k < exact.forces.size(); ++k)
        squares += squaredNorm(course.forces[k] - exact.forces[k]);
    return std::sqrt(squares / exact.limit2);
}

/// What becomes of the slip of an impact, m/s, and the forces along it.
struct ImpactCourse {
    double slipAfter = 0;
    double change = 0;  // m/s, of the speed of the centre along the plane
};
template <TangentialContact Contact>
ImpactCourse impactOf(const ImpactOfSlip& impact, Contact&& moved) {
    const auto after = impact.impact().solve({{impact.slip(), 0, 0}, {0, 0, 0}, 0}, moved, stepsOfImpact);
    return {after.slip().x, after.velocity.x - impact.slip()};
}
inline ImpactCourse exactImpact(const ImpactOfSlip& impact) {
    return impactOf(impact, PartialSlipContact(impact.impact().conditions,
                                               1.001 * impact.impact().largestOverlap(), springsOfTruth));
}
template <class Named>
ImpactCourse impactOfLaw(const ImpactOfSlip& impact, const Named& law) {
    return impactOf(impact,
                    LawContact<Named>(law, impact.impact().conditions, impact.impact().largestOverlap()));
}

}  // namespace pendular::friction
