#pragma once

/// Eigen's vectors belong to set-up code and user code, Vector<double> to the kernel.

#include "Kernel/Foundation/Math/Vector.h"

#include <Eigen/Core>

namespace pendular {

inline Vector<double> toVector(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

inline Eigen::Vector3d toEigen(const Vector<double>& vector) { return {vector.x, vector.y, vector.z}; }

}  // namespace pendular
