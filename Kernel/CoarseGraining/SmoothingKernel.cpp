#include "Kernel/CoarseGraining/SmoothingKernel.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/InputError.h"
#include "Kernel/Species/Field.h"

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

/// Chebyshev coefficients of a function of y in [-1, 1], up to where they are round-off.
template <class Function>
std::vector<double> chebyshevSeries(Function&& function) {
    constexpr int nodes = 128;
    std::array<double, nodes> values{};
    for (int k = 0; k < nodes; ++k)
        values[static_cast<std::size_t>(k)] = function(std::cos(pi * (k + 0.5) / nodes));
    std::vector<double> series;
    std::size_t needed = 1;
    for (int n = 0; n < nodes; ++n) {
        double sum = 0;
        for (int k = 0; k < nodes; ++k)
            sum += values[static_cast<std::size_t>(k)] * std::cos(pi * n * (k + 0.5) / nodes);
        series.push_back(sum * (n == 0 ? 1.0 : 2.0) / nodes);
        if (std::abs(series.back()) > 2e-16 * std::abs(series.front())) needed = series.size();
        if (series.size() > needed + 4) break;
    }
    series.resize(needed);
    return series;
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
            series = chebyshevSeries([&](double y) {
                const double p = c * std::sqrt(0.5 * (1 + y));
                return std::sqrt(0.5 * pi) * w * std::erf(p / (std::numbers::sqrt2 * w)) / p;
            });
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
