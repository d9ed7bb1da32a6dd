#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Features/RigidBodies/RigidBodies.h"

namespace pendular {

/// How far the axes of bodies point along one direction: S, the largest eigenvalue of the mean of
/// (3 u u - 1) / 2 over the unit axes u; 1 where all are parallel. Axes that are even among all directions
/// have a mean square of S below 1 / N, for N of them. Source: de Gennes and Prost, The Physics of Liquid
/// Crystals (1993), 2.1.
struct OrientationOrder {
    double value = 0;                 // S; 0 where there are no axes
    Vec3D direction = Vec3D::Zero();  // unit, its eigenvector
    std::size_t count = 0;            // of axes
};
OrientationOrder orientationOrder(std::span<const Vec3D> axes);

/// The axis of a body with these principal moments (in any order), as the number of a principal axis: of a
/// rod that of the smallest moment, of a plate that of the largest, whichever is farther from the other two.
/// None where all moments are equal to 1e-6.
std::optional<int> axisOf(const Vector<double>& moments);

/// The order of the rigid bodies that have an axis. @param first of those that are looked at
OrientationOrder orientationOrder(const RigidBodies& bodies, std::size_t first = 0);

}  // namespace pendular
