#pragma once

#include <functional>
#include <optional>
#include <string>

#include "Kernel/Capillary/BridgeCurve.h"
#include "Kernel/Species/Adhesion/Shared/LiquidBridge.h"

namespace pendular {

/// What one contact remembers of a bridge whose published force needs trigonometric functions or the solution
/// of an equation at each separation: its curve as a rational function, fitted once.
template <class T>
struct FittedBridgeInteraction {
    RationalBridge<T> curve;  // N
    T ruptureDistance;        // m

    [[nodiscard]] T force(T separation) const { return curve.at(separation); }
    [[nodiscard]] T range() const { return ruptureDistance; }
};

/// The published force of one bridge. Lengths are in R, forces in R gamma.
struct PublishedBridge {
    std::function<double(double)> force;  // F(S); called for growing S
    double ruptureDistance;
};

/// The volumes V* for which eight terms follow a published curve to 1 %.
inline constexpr double leastFittedVolume = 1e-9, mostFittedVolume = 1;

FittedBridgeInteraction<double> fitBridge(const PublishedBridge& bridge, const BridgeScales& scales,
                                          double surfaceTension);

/// Why a published curve cannot be used, if so: a volume outside of the box, no rupture distance, or a force
/// that does not attract all the way. One sentence.
std::optional<std::string> objectionToFit(std::string_view law, const PublishedBridge& bridge,
                                          const BridgeScales& scales, double contactAngle);

/// The rupture distance of Lian, Thornton and Adams, J. Colloid Interface Sci. 161 (1993) 138-147, equation
/// 16: (1 + theta/2) V^(1/3).
inline double lianRupture(double volume, double contactAngle) {
    return (1 + 0.5 * contactAngle) * std::cbrt(volume);
}

/// The parts of a law that is fitted. Model has published(scales): the PublishedBridge.
template <class Model>
struct FittedBridge : LiquidBridge<Model> {
    template <class T>
    using Interaction = FittedBridgeInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        if (this->liquidBridgeVolume == 0) return {{{}, 0, 1}, 0};
        const BridgeScales scales = this->scales(bodies);
        return fitBridge(model().published(scales.volume), scales, this->surfaceTension);
    }
    [[nodiscard]] double range(const Bodies& bodies) const {
        if (this->liquidBridgeVolume == 0) return 0;
        const BridgeScales scales = this->scales(bodies);
        return scales.radius * model().published(scales.volume).ruptureDistance;
    }
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const {
        if (this->liquidBridgeVolume == 0) return std::nullopt;
        const BridgeScales scales = this->scales(bodies);
        return objectionToFit(Model::name, model().published(scales.volume), scales, this->contactAngle);
    }

private:
    const Model& model() const { return static_cast<const Model&>(*this); }
};

}  // namespace pendular
