#include "Kernel/Analysis/CoarseGraining/SmoothingKernel.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

using std::numbers::pi;

/// The weight of a Gauss function within q = c / (sqrt(2) w), in 1, 2, 3 dimensions.
double weightWithin(double q, int dimensions) {
    switch (dimensions) {
        case 1:
            return std::erf(q);
        case 2:
            return -std::expm1(-q * q);
        default:
            return std::erf(q) - 2 * q * std::exp(-q * q) / std::sqrt(pi);
    }
}

/// Coefficients of y^k in the integral over s from 0 to 1 of e^(-b s^2 (1 + y)): (-1)^k J_k / k!, where J_k
/// is that of (b s^2)^k e^(-b s^2). By parts, (2k + 1) J_k = 2 J_(k+1) + b^k e^(-b); downwards all terms are
/// positive. The sum of all |J_k / k!| is 1: for |y| <= 1 little is lost to round-off.
std::vector<double> gaussSeries(double b) {
    std::vector<double> poisson{std::exp(-b)};  // b^k e^(-b) / k!
    while (static_cast<double>(poisson.size()) < 2 * b || poisson.back() > 1e-18 || poisson.size() % 2 != 0)
        poisson.push_back(poisson.back() * b / static_cast<double>(poisson.size()));
    std::vector<double> series(poisson.size());
    double later = 0;
    for (std::size_t k = series.size(); k-- > 0;) {
        const auto n = static_cast<double>(k);
        later = (2 * (n + 1) * later + poisson[k]) / (2 * n + 1);
        series[k] = k % 2 == 0 ? later : -later;
    }
    return series;
}

/// Takes the highest powers out of a polynomial of y, as far as it changes by no more than an error for all
/// |y| <= 1: a y^n by a (y^n - T_n(y) / 2^(n - 1)), which errs by |a| / 2^(n - 1) (Lanczos, Applied Analysis,
/// 1956, ch. VII: economisation). Half of the powers of gaussSeries() go.
void economise(std::vector<double>& polynomial, double error) {
    while (polynomial.size() > 2) {
        const std::size_t n = polynomial.size() - 1;
        error -= std::ldexp(std::abs(polynomial[n]), 1 - static_cast<int>(n));
        if (error < 0) break;
        double ofPower = polynomial[n];  // in a T_n / 2^(n - 1), of y^(n - 2m)
        for (std::size_t m = 0; 2 * m <= n; ++m) {
            polynomial[n - 2 * m] -= ofPower;
            const auto left = static_cast<double>(n - 2 * m);
            ofPower *= -left * (left - 1) / (4 * static_cast<double>((m + 1) * (n - m - 1)));
        }
        polynomial.pop_back();
    }
    if (polynomial.size() % 2 != 0) polynomial.push_back(0);
}

}  // namespace

KernelShape kernelShapeNamed(std::string_view name) {
    if (name == "gauss") return KernelShape::Gauss;
    if (name == "lucy") return KernelShape::Lucy;
    if (name == "heaviside") return KernelShape::Heaviside;
    throw InputError(
        fmt::format("There is no smoothing kernel \"{}\"; it may be gauss, lucy or heaviside.", name));
}

SmoothingKernel::SmoothingKernel(KernelShape shape, int dimensions, double width, double cutOff)
    : form(shape), size(dimensions), w(width), c(cutOff) {
    checkValue("SmoothingKernel", "width", width, "m", positive);
    checkValue("SmoothingKernel", "cut-off", cutOff, "m", notNegative);
    if (c == 0) c = w * (shape == KernelShape::Gauss ? 3 : shape == KernelShape::Lucy ? 2 : 1);
    if (shape == KernelShape::Gauss) checkValue("SmoothingKernel", "cut-off", c, "m", {w, 20 * w});
    gaussFactor = -0.5 * std::numbers::log2e / (w * w);
    if (size == 0) return;
    const auto ofDimension = [&](double one, double two, double three) {
        return size == 1 ? one : size == 2 ? two : three;
    };
    switch (form) {
        case KernelShape::Gauss: {
            const double q = c / (std::numbers::sqrt2 * w);
            norm = 1 / (std::pow(std::sqrt(2 * pi) * w, size) * weightWithin(q, size));
            series = gaussSeries(0.5 * q * q);
            economise(series, 1e-16 * w / c);
            break;
        }
        case KernelShape::Lucy:
            norm = ofDimension(5 / (4 * c), 5 / (pi * c * c), 105 / (16 * pi * c * c * c));
            break;
        case KernelShape::Heaviside:
            norm = ofDimension(1 / (2 * c), 1 / (pi * c * c), 3 / (4 * pi * c * c * c));
            break;
    }
}

}  // namespace pendular
