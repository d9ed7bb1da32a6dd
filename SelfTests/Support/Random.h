#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace pendular::support {

/// Random numbers that are the same on every machine and standard library (the engine's integers are fixed by
/// the standard, its distributions are not).
class Random {
public:
    explicit Random(std::uint64_t seed) : engine(seed) {}

    /// Evenly in [low, high).
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    }
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

private:
    std::mt19937_64 engine;
};

}  // namespace pendular::support
