#pragma once

#include "Kernel/Laws/Concepts/Bodies.h"

namespace pendular {

/// A bridge as its surface sees it: the same for every law of its force.
struct BridgeLiquid {
    Bodies bodies;
    double volume;          // m^3
    double contactAngle;    // rad
    double surfaceTension;  // N/m
};

/// The free surface of a bridge.
struct BridgeSurface {
    double area = 0;  // m^2
    // Only where the equation was solved.
    double pressure = 0;                          // Pa, in the liquid minus in the gas
    double fillingAngle1 = 0, fillingAngle2 = 0;  // rad, at the smaller and at the larger body; a plane has 0
};

/// The lateral area of the exact bridge (Young-Laplace), from the table of
/// Kernel/Features/LiquidBridges/YoungLaplace: to 1.3 % up to 0.985 of the rupture distance, where the area
/// begins to fall as a root: to 7 % up to 0.999 of it, to 11 % at it (up to 60 degrees; above to 0.6 %).
/// Below the volumes of the table the bridge is a small one that keeps its shape, with lengths as the square
/// root of the volume; where the bodies are farther apart than the rupture distance, it is that at this
/// distance.
/// @param separation m; negative where the bodies overlap, which counts as 0
double bridgeArea(const BridgeLiquid& bridge, double separation);

/// The surface of the bridge with its pressure and filling angles, for which the equation is solved: some 5
/// us, up to 60 us near the rupture. Beyond the rupture distance all are those of the bridge at it (0.2 ms).
/// 0 if there is none.
BridgeSurface solveBridgeSurface(const BridgeLiquid& bridge, double separation);

/// V / R^3 (2/R = 1/r1 + 1/r2) of the bridge between two equal spheres that touch at which its half-filling
/// angle is 30 degrees: three grains in mutual touch have room for no larger ones. At most 0.5.
/// @param contactAngle rad
double volumeWhereBridgesMeet(double contactAngle);

}  // namespace pendular
