#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "Kernel/Foundation/State/Random.h"

namespace pendular::support {

/// Random places and directions besides numbers.
class Random : public UniformRandom {
public:
    using UniformRandom::UniformRandom;

    Eigen::Vector3d inCube(double halfEdge) {
        const double x = uniform(-halfEdge, halfEdge), y = uniform(-halfEdge, halfEdge);
        return {x, y, uniform(-halfEdge, halfEdge)};
    }
    Eigen::Vector3d direction() {
        const double z = uniform(-1, 1), angle = uniform(0, 2 * std::numbers::pi),
                     across = std::sqrt(1 - z * z);
        return {across * std::cos(angle), across * std::sin(angle), z};
    }
    Eigen::Matrix3d rotation() {
        return Eigen::AngleAxisd(uniform(0, 2 * std::numbers::pi), direction()).toRotationMatrix();
    }
};

}  // namespace pendular::support
