#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeCurve.h"

#include <Eigen/Dense>
#include <numbers>

namespace pendular {

namespace {

using Curve = RationalBridge<double>;
constexpr std::size_t terms = Curve::terms;

double endPole(double reach) { return 1.06 * reach; }

/// A reduced gap from 0 to most, for a share from 0 to 1: dense at contact and at both ends.
double denseAtContact(double share, double most) {
    return std::sinh(std::asinh(most) * 0.5 * (1 - std::cos(std::numbers::pi * share)));
}

}  // namespace

CurveValues curveNodes(double reach) {
    CurveValues nodes;
    for (std::size_t i = 0; i < terms; ++i)
        nodes[i] = denseAtContact(static_cast<double>(i) / (terms - 1), 0.95 * reach);
    return nodes;
}

RationalBridge<double> curveThrough(const CurveValues& forceOverDerjaguin, double reach, double length,
                                    double forceScale) {
    const auto nodes = curveNodes(reach);
    Curve curve{{}, 1 / length, endPole(reach)};
    CurveValues difference;  // Newton's divided differences of N
    for (std::size_t i = 0; i < terms; ++i)
        difference[i] = forceScale * forceOverDerjaguin[i] * derjaguinForce(nodes[i]) *
                        Curve::denominator(nodes[i], curve.end);
    for (std::size_t k = 1; k < terms; ++k)
        for (std::size_t i = terms - 1; i >= k; --i)
            difference[i] = (difference[i] - difference[i - 1]) / (nodes[i] - nodes[i - k]);
    auto& n = curve.numerator;
    n = {difference[terms - 1]};
    for (std::size_t k = terms - 1; k-- > 0;) {  // n(y) <- n(y) (y - node k) + difference k
        for (std::size_t j = terms - 1; j > 0; --j) n[j] = n[j - 1] - nodes[k] * n[j];
        n[0] = difference[k] - nodes[k] * n[0];
    }
    return curve;
}

CurveValues fitCurve(const std::function<double(double)>& force, double most, double reach) {
    constexpr int samples = 36;
    constexpr double leastForce = 0.015;  // of D
    const auto nodes = curveNodes(reach);
    const double end = endPole(reach);
    Eigen::Matrix<double, samples, terms> basis;  // of N = Q D at one node and 0 at the others
    Eigen::Matrix<double, samples, 1> wanted;
    for (int i = 0; i < samples; ++i) {
        const double y = denseAtContact((i + 0.5) / samples, most), f = force(y);
        const double weight = 1 / std::hypot(f, leastForce * derjaguinForce(y));
        for (std::size_t j = 0; j < terms; ++j) {
            double value =
                derjaguinForce(nodes[j]) * Curve::denominator(nodes[j], end) / Curve::denominator(y, end);
            for (std::size_t k = 0; k < terms; ++k)
                if (k != j) value *= (y - nodes[k]) / (nodes[j] - nodes[k]);
            basis(i, static_cast<Eigen::Index>(j)) = weight * value;
        }
        wanted[i] = weight * f;
    }
    const Eigen::Matrix<double, terms, 1> best = basis.householderQr().solve(wanted);
    CurveValues values;
    Eigen::Map<Eigen::Matrix<double, terms, 1>>(values.data()) = best;
    return values;
}

}  // namespace pendular
