#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeTableMaking.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"

namespace pendular {

namespace {

/// Bridges of one shape at growing gaps (/ R), each solved from the one before.
struct NoBridge : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class GrowingGap {
public:
    explicit GrowingGap(const BridgeShape& shape) : conditions(shape.conditions()) {}

    const CapillaryBridge& at(double gap) {
        last = solveBridge(conditions, gap, last ? &*last : nullptr);
        if (!last)
            throw NoBridge(fmt::format("No bridge of V* = {:.6g} and theta = {:.6g} rad at S/R = {:.6g}.",
                                       conditions.volume, conditions.first.contactAngle, gap));
        return *last;
    }

private:
    BridgeConditions conditions;
    std::optional<CapillaryBridge> last;
};

BridgeShape shapeAt(double angle, double volume, double asymmetry) {
    const double root = std::sqrt(0.5 * (1 + asymmetry));
    return {0.5 * (1 + angle) * BridgeTable::mostAngle,
            BridgeTable::leastVolume *
                std::pow(BridgeTable::mostVolume / BridgeTable::leastVolume, 0.5 * (1 + volume)),
            root * root * root};
}

/// Fills a product with the series of function(shape) -> Value.
template <class Product, class Function>
void fill(Product& product, Function&& function) {
    const auto [first, second, third] = Product::shape;
    std::vector<double> values;
    values.reserve(product.coefficients.size());
    const auto node = [](std::size_t i, std::size_t n) {
        return chebyshevNode(static_cast<int>(i), static_cast<int>(n));
    };
    for (std::size_t i = 0; i < first; ++i)
        for (std::size_t j = 0; j < second; ++j)
            for (std::size_t k = 0; k < third; ++k)
                for (const double value : function(shapeAt(node(i, first), node(j, second), node(k, third))))
                    values.push_back(value);
    toChebyshevSeries(values, third, Product::valueCount);
    toChebyshevSeries(values, second, third * Product::valueCount);
    toChebyshevSeries(values, first, second * third * Product::valueCount);
    for (std::size_t c = 0; c < values.size(); ++c)
        product.coefficients[c] = static_cast<std::int32_t>(std::lround(values[c] / Product::unit));
}

double solveRupture(const BridgeShape& shape) {
    const auto rupture = findRupture(shape.conditions());
    if (!rupture)
        throw std::runtime_error(fmt::format("No bridge of V* = {:.6g} and theta = {:.6g} rad.", shape.volume,
                                             shape.contactAngle));
    return rupture->last.gap();
}

}  // namespace

CurveValues fitCurve(const BridgeShape& shape, double rupture, double reach) {
    constexpr double share = 0.97;  // of the rupture distance: the slope is infinite at its end
    GrowingGap bridges(shape);
    const auto force = [&](double y) {
        return bridges.at(y * shape.length()).pinnedForce() / (2 * std::numbers::pi);
    };
    return fitCurve(force, share * rupture / shape.length(), reach);
}

std::optional<SolvedCurve> solveCurve(const BridgeShape& shape, double radius, double forceScale) {
    const auto rupture = findRupture(shape.conditions());
    if (!rupture) return {};
    const double distance = rupture->last.gap(), length = shape.length();
    try {
        const auto values = fitCurve(shape, distance, distance / length);
        return SolvedCurve{curveThrough(values, distance / length, radius * length, forceScale),
                           radius * distance};
    } catch (const NoBridge&) {
        return {};  // the search has lost it on the way
    }
}

BridgeTable makeBridgeTable() {
    BridgeTable table;
    fill(table.rupture,
         [](const BridgeShape& shape) { return std::array{solveRupture(shape) / std::cbrt(shape.volume)}; });
    fill(table.force, [&](const BridgeShape& shape) {
        return fitCurve(shape, solveRupture(shape),
                        table.at(shape.contactAngle).roughRupture(shape) / shape.length());
    });
    fill(table.area, [&](const BridgeShape& shape) {
        GrowingGap bridges(shape);
        std::array<double, areaNodes.size()> values;
        for (std::size_t i = 0; i < areaNodes.size(); ++i) {
            const double gap = areaNodes[i] * table.at(shape.contactAngle).roughRupture(shape);
            values[i] = bridges.at(gap).lateralArea() / areaScale(shape, gap);
        }
        return values;
    });
    return table;
}

}  // namespace pendular
