#pragma once

#include <Eigen/Core>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeEquations.h"

namespace pendular {

/// The second variation of the energy at constant gap and volume, against axisymmetric disturbances.
/// It is split at the contact lines (as Myshkis et al., Low-Gravity Fluid Mechanics, 1987, treat
/// pinned and free contact lines): the arc that answers to contact lines held at given places, and the energy
/// left as a function of these two places.
struct BridgeStability {
    /// Zero where the bridge with pinned contact lines loses its stability; positive before. Dimensionless.
    double pinnedDeterminant;
    /// -y_i d(apparent contact angle i)/d(place j), so that 2 pi gamma sin(theta_i) times it is the Hessian
    /// of the energy; without that factor it keeps its meaning at theta = 0.
    Eigen::Matrix2d contactStiffness;
    /// Number of independent ways in which the axisymmetric bridge falls.
    int unstableModes;

    /// Changes its sign with each mode that becomes unstable; regular where either factor is not.
    [[nodiscard]] double product() const;
};

BridgeStability stabilityOf(const BridgeEquations& equations, const DelaunayArc& arc,
                            const BridgeGeometry& geometry);

}  // namespace pendular
