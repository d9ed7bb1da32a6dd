#include "Kernel/Features/LiquidBridges/YoungLaplace/DelaunayArc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Features/LiquidBridges/YoungLaplace/PanelRule.h"
#include "Kernel/Foundation/Math/GaussLegendre.h"

namespace pendular {

namespace {

using std::numbers::pi;

enum Parameter { Radial, Axial, MeanCurvature, Span };

/// ln |Z|, from |Z|^2 = 1 - 4 H f, exact for small H; bounded for the cylinder (Z = 0).
double logarithmOfModulus(const DelaunayArc& arc) {
    const double excess = -4 * arc.meanCurvature * arc.forceLength();
    return excess > -1 ? std::max(0.5 * std::log1p(excess), -60.0) : -60.0;
}

/// Coordinates at one parameter, with what their derivatives share.
struct Kinematics {
    double sine, cosine;  // sin(H s)/H and cos(H s)
    double rate;          // ds/dt
    double rise;          // u - u(middle)
    double sineByCurvature, cosineByCurvature, rateByCurvature;

    Kinematics(const DelaunayArc& arc, double slope, double t) {
        const double x = 0.5 * arc.meanCurvature * t;
        rate = 1 / (1 + x * x);
        sine = t * rate;
        cosine = 2 * rate - 1;
        rise = sine * (2 * arc.radialPart * cosine + slope * sine);
        rateByCurvature = -rate * x * sine;
        sineByCurvature = -x * sine * sine;
        cosineByCurvature = 2 * rateByCurvature;
    }

    /// Derivatives of rise by radialPart, axialPart, meanCurvature.
    [[nodiscard]] std::array<double, 3> riseGradient(const DelaunayArc& arc, double slope) const {
        const double square = sine * sine;
        return {2 * sine * cosine, -2 * arc.meanCurvature * square,
                2 * arc.radialPart * (sineByCurvature * cosine + sine * cosineByCurvature) -
                    2 * arc.axialPart * square + 2 * slope * sine * sineByCurvature};
    }
};

/// dp/ds at the middle: the real part of Z.
double middleSlope(const DelaunayArc& arc) { return 1 - 2 * arc.meanCurvature * arc.axialPart; }

/// Adds one node's share of axial extent, volume and their first three derivatives.
void addNode(ArcIntegrals& sum, const DelaunayArc& arc, double slope, double t, double weight) {
    const Kinematics k(arc, slope, t);
    const double u = arc.squaredRadius() + k.rise;
    const double y = std::sqrt(u), inverse = 1 / y;
    const double q = arc.axialPart + arc.meanCurvature * k.rise;
    const std::array<double, 3> rise = k.riseGradient(arc, slope);
    const std::array<double, 3> byU = {rise[0] + 2 * arc.radialPart, rise[1] + 2 * arc.axialPart, rise[2]};
    const std::array<double, 3> byQ = {arc.meanCurvature * rise[0], 1 + arc.meanCurvature * rise[1],
                                       k.rise + arc.meanCurvature * rise[2]};
    const double share = weight * k.rate, cosine = q * inverse, halfCosine = 0.5 * cosine;
    sum.axialExtent += share * cosine;
    sum.volumeOverPi += share * q * y;
    for (int j = 0; j < 3; ++j) {
        sum.axialExtentGradient[j] += share * inverse * (byQ[j] - halfCosine * inverse * byU[j]);
        sum.volumeGradient[j] += share * (byQ[j] * y + halfCosine * byU[j]);
    }
    const double stretch = weight * k.rateByCurvature;
    sum.axialExtentGradient[MeanCurvature] += stretch * cosine;
    sum.volumeGradient[MeanCurvature] += stretch * q * y;
}

bool isStraight(const DelaunayArc& arc) { return std::abs(arc.meanCurvature) * arc.halfSpan < 1e-7; }

/// Whether arg Z passes the given angle (modulo 2 pi) within the arc.
bool phasePasses(const DelaunayArc& arc, double angle) {
    const auto [real, imaginary] = arc.kenmotsu();
    const double from = std::atan2(imaginary, real) - angle;
    const double reach = std::abs(arc.meanCurvature) * arc.length();
    const double turns = std::floor((from + reach) / (2 * pi));
    return 2 * pi * turns >= from - reach;
}

}  // namespace

double DelaunayArc::length() const {
    const double x = 0.5 * meanCurvature * halfSpan;
    return 2 * halfSpan * (x == 0 ? 1 : std::atan(x) / x);
}

double DelaunayArc::parameterAt(double arcLengthFromMiddle) const {
    const double x = 0.5 * meanCurvature * arcLengthFromMiddle;
    return arcLengthFromMiddle * (x == 0 ? 1 : std::tan(x) / x);
}

ArcPoint DelaunayArc::at(double parameter) const {
    const double slope = middleSlope(*this);
    const Kinematics k(*this, slope, parameter);
    const double turned = 1 - 2 * meanCurvature * meanCurvature * k.sine * k.sine;
    return {.squaredRadius = squaredRadius() + k.rise,
            .radialPart = radialPart * turned + slope * k.sine * k.cosine,
            .axialPart = axialPart + meanCurvature * k.rise,
            .rate = k.rate};
}

ArcEnd DelaunayArc::end(int side) const {
    const double slope = middleSlope(*this), h = meanCurvature;
    const Kinematics k(*this, slope, side * halfSpan);
    const std::array<double, 3> rise = k.riseGradient(*this, slope);
    const ArcPoint point = at(side * halfSpan);
    const double square = k.sine * k.sine, along = side * k.rate;
    const double byCurvature = -4 * radialPart * h * (square + h * k.sine * k.sineByCurvature) -
                               2 * axialPart * k.sine * k.cosine +
                               slope * (k.sineByCurvature * k.cosine + k.sine * k.cosineByCurvature);
    return {
        .point = point,
        .squaredRadius = {rise[0] + 2 * radialPart, rise[1] + 2 * axialPart, rise[2],
                          2 * along * point.radialPart},
        .radialPart = {1 - 2 * h * h * square, -2 * h * k.sine * k.cosine, byCurvature,
                       along * (1 - 2 * h * point.axialPart)},
        .axialPart = {h * rise[0], 1 + h * rise[1], k.rise + h * rise[2], 2 * along * h * point.radialPart}};
}

double DelaunayArc::smallestRadius() const {
    const ArcPoint start = at(-halfSpan), finish = at(halfSpan);
    const double ends = std::sqrt(std::min(start.squaredRadius, finish.squaredRadius));
    const bool neck =
        isStraight(*this) ? start.radialPart < 0 && finish.radialPart > 0 : phasePasses(*this, 0);
    return neck ? std::min(ends, 2 * std::abs(forceLength()) / (1 + std::exp(logarithmOfModulus(*this))))
                : ends;
}

double DelaunayArc::largestRadius() const {
    const ArcPoint start = at(-halfSpan), finish = at(halfSpan);
    const double ends = std::sqrt(std::max(start.squaredRadius, finish.squaredRadius));
    const bool bulge = !isStraight(*this) && phasePasses(*this, pi);
    return bulge ? std::max(ends, (1 + std::exp(logarithmOfModulus(*this))) / (2 * std::abs(meanCurvature)))
                 : ends;
}

int DelaunayArc::extremes() const {
    if (isStraight(*this)) return at(-halfSpan).radialPart < 0 && at(halfSpan).radialPart > 0 ? 1 : 0;
    const auto [real, imaginary] = kenmotsu();
    const double middle = std::atan2(imaginary, real), reach = std::abs(meanCurvature) * length();
    return static_cast<int>(std::floor((middle + reach) / pi) - std::floor((middle - reach) / pi));
}

ArcIntegrals integrate(const DelaunayArc& arc, int mostNodes) {
    ArcIntegrals sum;
    const double slope = middleSlope(arc);
    const PanelRule panels = mostNodes > coarseQuadratureNodes ? PanelRule(arc, -1, 1) : PanelRule(mostNodes);
    for (const Panel& panel : panels) {
        const double middle = 0.5 * (panel.from + panel.to) * arc.halfSpan;
        const double half = 0.5 * (panel.to - panel.from) * arc.halfSpan;
        for (const auto [position, weight] : gaussLegendre(std::min(panel.nodes, mostNodes)))
            addNode(sum, arc, slope, middle + half * position, half * weight);
    }
    for (const int side : {-1, 1}) {
        const ArcPoint end = arc.at(side * arc.halfSpan);
        const double y = std::sqrt(end.squaredRadius);
        sum.axialExtentGradient[Span] += end.rate * end.axialPart / y;
        sum.volumeGradient[Span] += end.rate * end.axialPart * y;
    }
    return sum;
}

ArcMeasures measure(const DelaunayArc& arc, double fromParameter, double toParameter) {
    ArcMeasures sum;
    for (const Panel& panel : PanelRule(arc, fromParameter / arc.halfSpan, toParameter / arc.halfSpan)) {
        const double middle = 0.5 * (panel.from + panel.to) * arc.halfSpan;
        const double half = 0.5 * (panel.to - panel.from) * arc.halfSpan;
        for (const auto [position, weight] : gaussLegendre(panel.nodes)) {
            const ArcPoint point = arc.at(middle + half * position);
            const double y = std::sqrt(point.squaredRadius), share = half * weight * point.rate;
            sum.axialExtent += share * point.axialPart / y;
            sum.volumeOverPi += share * point.axialPart * y;
            sum.areaOverTwoPi += share * y;
        }
    }
    return sum;
}

}  // namespace pendular
