#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

/// A straight line y = slope x + intercept.
struct Line {
    double slope;
    double intercept;
};

/// A point of a measured curve.
struct CurvePoint {
    double x;
    double y;
};

/// The line of least squares. Throws InputError with fewer than two different x.
inline Line fitLine(std::span<const CurvePoint> points) {
    double meanX = 0, meanY = 0;
    for (const CurvePoint& p : points) {
        meanX += p.x / static_cast<double>(points.size());
        meanY += p.y / static_cast<double>(points.size());
    }
    double xx = 0, xy = 0;
    for (const CurvePoint& p : points) {
        xx += (p.x - meanX) * (p.x - meanX);
        xy += (p.x - meanX) * (p.y - meanY);
    }
    if (!(xx > 0)) throw InputError("A line needs two points at least, at different places.");
    return {xy / xx, meanY - xy / xx * meanX};
}

/// The median of the slopes of all pairs of points with different x, which grains that stick out do not turn
/// as they turn a line of least squares. Sources: Theil (1950), Proc. Kon. Ned. Akad. Wet. A 53, 386; Sen
/// (1968), J. Am. Stat. Assoc. 63, 1379. Throws InputError with fewer than two different x.
inline double medianSlope(std::span<const CurvePoint> points) {
    std::vector<double> slopes;
    for (std::size_t a = 0; a < points.size(); ++a)
        for (std::size_t b = a + 1; b < points.size(); ++b)
            if (points[b].x != points[a].x)
                slopes.push_back((points[b].y - points[a].y) / (points[b].x - points[a].x));
    if (slopes.empty()) throw InputError("A slope needs two points at least, at different places.");
    const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
    std::ranges::nth_element(slopes, middle);
    if (slopes.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(slopes.begin(), middle));
}

/// Beverloo's law of the discharge through a circular orifice of diameter D in a flat bottom:
/// W = C rho_b sqrt(g) (D - k d)^(5/2). Source: Beverloo, Leniger and van de Velde (1961), Chem. Eng. Sci.
/// 15, 260; their C is 0.58 and k 1.4.
struct BeverlooLaw {
    double coefficient;    // C
    double emptyAnnulus;   // k
    double bulkDensity;    // kg/m^3
    double gravity;        // m/s^2
    double grainDiameter;  // d, m

    /// kg/s; zero where the orifice (m) is narrower than k d.
    [[nodiscard]] double flow(double orifice) const {
        const double open = orifice - emptyAnnulus * grainDiameter;
        return open > 0 ? coefficient * bulkDensity * std::sqrt(gravity) * std::pow(open, 2.5) : 0;
    }
};

/// The law through measured flows (x: orifice diameter in m, y: flow in kg/s): W^(2/5) is linear in D.
inline BeverlooLaw fitBeverloo(std::span<const CurvePoint> flows, double bulkDensity, double gravity,
                               double grainDiameter) {
    std::vector<CurvePoint> straight;
    for (const CurvePoint& p : flows) straight.push_back({p.x, std::pow(p.y, 0.4)});
    const Line line = fitLine(straight);
    if (!(line.slope > 0))
        throw InputError("Beverloo's law cannot be fitted: the flows do not grow with the orifice.");
    return {std::pow(line.slope, 2.5) / (bulkDensity * std::sqrt(gravity)),
            -line.intercept / (line.slope * grainDiameter), bulkDensity, gravity, grainDiameter};
}

/// The beginning of the names of all files of the run through one orifice.
inline std::string dischargeName(double orifice) { return fmt::format("orifice-{:g}", orifice); }

}  // namespace pendular
