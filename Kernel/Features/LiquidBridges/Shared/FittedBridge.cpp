#include "Kernel/Features/LiquidBridges/Shared/FittedBridge.h"

#include <fmt/format.h>

namespace pendular {

FittedBridgeInteraction<double> fitBridge(const PublishedBridge& bridge, const BridgeScales& scales,
                                          double surfaceTension) {
    if (!(bridge.ruptureDistance > 0)) return {{{}, 0, 1}, 0};
    const double length = std::sqrt(scales.volume * (2 / std::numbers::pi));
    const double reach = bridge.ruptureDistance / length;
    const auto values = fitCurve([&](double y) { return bridge.force(y * length); }, reach, reach);
    return {curveThrough(values, reach, scales.radius * length, scales.radius * surfaceTension),
            scales.radius * bridge.ruptureDistance};
}

std::optional<std::string> objectionToFit(std::string_view law, const PublishedBridge& bridge,
                                          const BridgeScales& scales, double contactAngle) {
    const auto sentence = [&](std::string_view what) {
        return fmt::format(
            "{}: {} for contactAngle = {:.6g} rad and V* = liquidBridgeVolume/R^3 = {:.6g} (R = "
            "{:.6g} m), so take another bridge law.",
            law, what, contactAngle, scales.volume, scales.radius);
    };
    constexpr double rounding = 1e-12;  // of V / R^3, so that the ends of the range are in it
    if (!(scales.volume >= leastFittedVolume * (1 - rounding) &&
          scales.volume <= mostFittedVolume * (1 + rounding)))
        return sentence(
            fmt::format("V* must be from {} to {}, which it is not", leastFittedVolume, mostFittedVolume));
    if (!(bridge.ruptureDistance > 0))
        return sentence("the model has no attractive bridge from contact to rupture");
    for (double share = 0; share <= 1; share += 0.0625)
        if (!(bridge.force(share * bridge.ruptureDistance) > 0))
            return sentence("the model does not attract");
    return std::nullopt;
}

}  // namespace pendular
