#pragma once

#include <optional>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeTable.h"

namespace pendular {

/// The bridge table, from the Young-Laplace solver alone; about a second.
BridgeTable makeBridgeTable();

/// The values of F / (D 2 pi R gamma) of the curve that fits the exact force best, up to 97 % of the rupture
/// distance.
/// @param rupture the rupture distance / R; @param reach what nodes and pole are laid out by, / L
CurveValues fitCurve(const BridgeShape& shape, double rupture, double reach);

/// The curve of one bridge by the solver itself, for shapes that the table does not hold; nothing if no
/// stable bridge is found all the way from contact to rupture. A fifth of a millisecond.
struct SolvedCurve {
    RationalBridge<double> curve;
    double ruptureDistance;  // m
};
std::optional<SolvedCurve> solveCurve(const BridgeShape& shape, double radius, double forceScale);

}  // namespace pendular
