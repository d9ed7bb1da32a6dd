#pragma once

#include <array>

namespace pendular {

// A meridian of constant mean curvature H (a Delaunay curve), with axial position x, radius y, arc length s
// and tangent angle psi: x' = cos psi, y' = sin psi, cos psi / y - psi' = 2 H. With u = y^2, p = y sin psi, q
// = y cos psi the equations are linear,
//     u' = 2 p,   p' = 1 - 2 H q,   q' = 2 H p,
// and q - H u is the same at every point: it is f = F / (2 pi gamma), F the force that pulls the bodies
// together. So Z = 1 - 2 H (q - i p) turns at a constant rate, Z(s) = Z(0) exp(2 i H s) (Kenmotsu, Tohoku
// Math. J. 32 (1980) 147-153), and one formula holds for nodoid, catenoid (H = 0), unduloid, cylinder (Z = 0)
// and sphere (f = 0). Lengths are in any one unit; with surface tension gamma the pressure in the liquid is 2
// gamma H above the gas's.

/// The meridian at one parameter t; see DelaunayArc.
struct ArcPoint {
    double squaredRadius;  // u = y^2
    double radialPart;     // p = y sin psi
    double axialPart;      // q = y cos psi
    double rate;           // ds/dt
};

/// Derivatives by the four parameters of an arc, in the order of its members.
using ArcGradient = std::array<double, 4>;

/// One end of an arc, and its derivatives; the end itself moves with the parameter halfSpan.
struct ArcEnd {
    ArcPoint point;
    ArcGradient squaredRadius, radialPart, axialPart;
};

/// A piece of a meridian, given by its middle in arc length.
/// The parameter along it is t = 2 tan(H s / 2) / H, from -halfSpan to +halfSpan: every coordinate is then a
/// rational function of t and of the four members, regular at H = 0, so that nothing cancels near the
/// catenoid, the cylinder or the sphere, and no trigonometric function is needed. Half arc lengths up to pi /
/// |H| (two periods) are covered.
struct DelaunayArc {
    double radialPart;     // p at the middle; 0 for an arc that is its own mirror image
    double axialPart;      // q at the middle
    double meanCurvature;  // H, positive where the liquid is at the higher pressure
    double halfSpan;       // T > 0

    [[nodiscard]] double squaredRadius() const { return radialPart * radialPart + axialPart * axialPart; }
    /// f = F / (2 pi gamma), a length; positive attracts.
    [[nodiscard]] double forceLength() const { return axialPart - meanCurvature * squaredRadius(); }
    /// Z at the middle, as (real, imaginary).
    [[nodiscard]] std::array<double, 2> kenmotsu() const {
        return {1 - 2 * meanCurvature * axialPart, 2 * meanCurvature * radialPart};
    }
    [[nodiscard]] double length() const;
    [[nodiscard]] double parameterAt(double arcLengthFromMiddle) const;
    [[nodiscard]] ArcPoint at(double parameter) const;
    /// side = -1: the end at t = -halfSpan, +1: the other.
    [[nodiscard]] ArcEnd end(int side) const;
    /// The smallest radius y of the arc, at an end if it has no neck.
    [[nodiscard]] double smallestRadius() const;
    [[nodiscard]] double largestRadius() const;
    /// Number of necks and bulges within the arc.
    [[nodiscard]] int extremes() const;
};

/// Integrals along a whole arc with their derivatives, by the four parameters.
struct ArcIntegrals {
    double axialExtent = 0;   // x(end) - x(start)
    double volumeOverPi = 0;  // integral of y^2 dx
    ArcGradient axialExtentGradient{}, volumeGradient{};
};

constexpr int coarseQuadratureNodes = 12, mostQuadratureNodes = 64;

/// Integrates with Gauss-Legendre rules of at most mostNodes nodes for each panel, and one panel with the
/// coarse rule.
ArcIntegrals integrate(const DelaunayArc& arc, int mostNodes);

/// The part of the arc between two parameters.
struct ArcMeasures {
    double axialExtent = 0, volumeOverPi = 0, areaOverTwoPi = 0;  // integrals of dx, y^2 dx, y ds
};
ArcMeasures measure(const DelaunayArc& arc, double fromParameter, double toParameter);

}  // namespace pendular
