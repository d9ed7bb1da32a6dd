#include "Kernel/Features/SizeDistributions/SizeLaws.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

constexpr std::string_view ownerOfLaw = "SizeDistribution";

void checkDiameter(std::string_view field, double value) {
    checkValue(ownerOfLaw, field, value, "m", diameterRange);
}

void checkCuts(double low, double high) {
    checkDiameter("smallest diameter", low);
    checkDiameter("largest diameter", high);
    if (!(low < high))
        throw InputError(
            fmt::format("{}: the smallest diameter {:g} m must be below the largest one, {:g} m.", ownerOfLaw,
                        low, high));
}

/// The law on panels between borders given by a function of 0 ... count.
template <class Border>
SizeDistribution onPanels(int count, Border border, SizeBasis basis, std::function<double(double)> law) {
    std::vector<SizePanel> panels;
    for (int k = 0; k < count; ++k) panels.push_back({border(k), border(k + 1), 1, 1});
    return {std::move(panels), basis, std::move(law)};
}

/// Panels of equal ratios of their ends, none above `ratio`.
SizeDistribution onRatios(double low, double high, double ratio, SizeBasis basis,
                          std::function<double(double)> law) {
    if (!(low < high))
        throw InputError(
            fmt::format("{}: the cuts leave no grains of the law that are worth counting.", ownerOfLaw));
    const double all = std::log(high / low);
    const int count = std::max(1, static_cast<int>(std::ceil(all / std::log(ratio))));
    return onPanels(
        count, [=](int k) { return k == count ? high : low * std::exp(all * k / count); }, basis,
        std::move(law));
}

/// The distance from its mean at which a normal law is below the smallest double, in standard deviations.
constexpr double farAway = 40;
/// Panels that are half a standard deviation long are short enough for 16 nodes: the next term of the series
/// of exp(-x^2 / 2) is below (1/4)^32.
constexpr double panelLength = 0.5;

/// The fraction of a normal distribution above x standard deviations.
double normalAbove(double x) { return 0.5 * std::erfc(x / std::numbers::sqrt2); }

}  // namespace

SizeDistribution evenSizes(double low, double high) {
    checkCuts(low, high);
    return sizesFromClasses(std::array{low, high}, std::array{1.0}, SizeBasis::Number);
}

CutLaw normalSizes(double mean, double deviation, double low, double high) {
    checkDiameter("mean diameter", mean);
    checkDiameter("standard deviation", deviation);
    checkCuts(low, high);
    // Above a diameter, and with x its distance from the mean in deviations: the number, and the integral of
    // the cube, by parts.
    const auto numberAbove = [=](double d) { return normalAbove((d - mean) / deviation); };
    const auto cubeAbove = [=](double d) {
        const double x = (d - mean) / deviation, s = deviation;
        const double density = std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi);
        return (s * s * s * (x * x + 2) + 3 * mean * s * s * x + 3 * mean * mean * s) * density +
               (mean * mean * mean + 3 * mean * s * s) * normalAbove(x);
    };
    const double from = std::max(low, mean - farAway * deviation),
                 to = std::min(high, mean + farAway * deviation);
    const double panels = std::max(1.0, std::ceil((to - from) / (panelLength * deviation)));
    if (!(from < to))
        throw InputError(
            fmt::format("{}: the cuts leave no grains of the law that are worth counting.", ownerOfLaw));
    SizeDistribution sizes = onPanels(
        static_cast<int>(panels), [=](int k) { return k == panels ? to : from + (to - from) * k / panels; },
        SizeBasis::Number, [=](double d) { return std::exp(-0.5 * std::pow((d - mean) / deviation, 2)); });
    return {std::move(sizes),
            {1 - (numberAbove(low) - numberAbove(high)) / numberAbove(0),
             1 - (cubeAbove(low) - cubeAbove(high)) / cubeAbove(0)}};
}

CutLaw lognormalSizes(double median, double geometricDeviation, double low, double high, SizeBasis basis) {
    checkDiameter("median diameter", median);
    checkValue(ownerOfLaw, "geometric standard deviation", geometricDeviation, "", {1, 100, false, true});
    checkCuts(low, high);
    const double sigma = std::log(geometricDeviation);
    const double middle = std::log(median) - static_cast<int>(basis) * sigma * sigma;  // of the numbers
    // The range goes from where the numbers vanish to where d^4 times the numbers does.
    const double from = std::max(low, std::exp(middle - farAway * sigma)),
                 to = std::min(high, std::exp(middle + 4 * sigma * sigma + farAway * sigma));
    const auto above = [=](double d, int k) {
        return normalAbove((std::log(d) - middle) / sigma - k * sigma);
    };
    const auto away = [&](int k) { return 1 - (above(low, k) - above(high, k)); };
    return {onRatios(from, to, std::min(std::exp(panelLength * sigma), 1.5), SizeBasis::Length,
                     [=](double d) { return std::exp(-0.5 * std::pow((std::log(d) - middle) / sigma, 2)); }),
            {away(0), away(3)}};
}

CutLaw lognormalSizesFromMean(double mean, double deviation, double low, double high) {
    checkDiameter("mean diameter", mean);
    checkDiameter("standard deviation", deviation);
    const double variance = std::log1p(std::pow(deviation / mean, 2));
    return lognormalSizes(mean * std::exp(-0.5 * variance), std::exp(std::sqrt(variance)), low, high);
}

CutLaw rosinRammlerSizes(double size, double exponent, double low, double high) {
    checkDiameter("Rosin-Rammler size", size);
    checkValue(ownerOfLaw, "Rosin-Rammler exponent", exponent, "", {0.1, 100});
    checkCuts(low, high);
    const auto above = [=](double d) { return std::exp(-std::pow(d / size, exponent)); };
    const auto density = [=](double d) {
        const double x = std::pow(d / size, exponent);
        return x > 745 ? 0 : exponent * x / d * std::exp(-x);  // where exp(-x) is 0, x may be infinite
    };
    // (d / size)^exponent grows by no more than 1.2 in a panel.
    return {onRatios(low, high, std::min(std::pow(1.2, 1 / exponent), 1.5), SizeBasis::Volume, density),
            {unset, 1 - (above(low) - above(high))}};
}

SizeDistribution bidisperseSizes(double small, double large, double volumeOfLarge) {
    checkValue(ownerOfLaw, "volume fraction of the large grains", volumeOfLarge, "", fromZeroTo(1));
    return singleSizes(std::array{small, large}, std::array{1 - volumeOfLarge, volumeOfLarge},
                       SizeBasis::Volume);
}

}  // namespace pendular
