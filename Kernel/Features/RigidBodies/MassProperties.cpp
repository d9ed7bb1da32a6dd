#include "Kernel/Features/RigidBodies/MassProperties.h"

namespace pendular {

MassProperties MassProperties::fromMoments(double volume, const Eigen::Vector3d& first,
                                           const Eigen::Matrix3d& second) {
    const Eigen::Vector3d centre = first / volume;
    const Eigen::Matrix3d about = second - volume * centre * centre.transpose();
    return {volume, centre, about.trace() * Eigen::Matrix3d::Identity() - about};
}

}  // namespace pendular
