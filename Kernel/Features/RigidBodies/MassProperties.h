#pragma once

#include <Eigen/Core>

namespace pendular {

/// A sphere of a shape.
struct Ball {
    Eigen::Vector3d centre{0, 0, 0};  // m
    double radius = 0;                // m
};

/// The mass and the inertia of a solid of density 1, to be multiplied by the density (kg/m^3).
struct MassProperties {
    double volume = 0;                                  // m^3
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();   // m, of mass
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // m^5, about the centre of mass
    double error = 0;  // of volume and moments of inertia, relative: a bound of what is computed

    /// The properties from the integrals over the solid of 1, of the place p, and of p p^T.
    static MassProperties fromMoments(double volume, const Eigen::Vector3d& first,
                                      const Eigen::Matrix3d& second);
};

}  // namespace pendular
