#pragma once

#include <algorithm>

#include "Kernel/Features/LiquidBridges/Shared/ViscousLiquid.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// The share of the step about this moment in which two surfaces are apart: a force that ends where they
/// touch then acts up to that moment, and not to the end of a step.
template <class T>
T shareApart(const BridgeMotion<T>& motion) {
    const T way = T(0.5) * motion.step * max(motion.approach, -motion.approach);  // m, in half a step
    return min(max((motion.separation + way) / max(T(2) * way, T(1e-300)), T(0)), T(1));
}

/// What a contact in a layer of liquid remembers: 1 if the surfaces have been in the liquid since they were
/// last free. They are free outside of it without a bridge.
/// @param wetted what it was before; @param forms a bridge that is there since this step
template <class T>
[[gnu::always_inline]] inline T wettedAfter(const T& wetted, const MaskOf<T>& isOutside,
                                            const MaskOf<T>& hasRuptured, const MaskOf<T>& forms) {
    return select(isOutside & (hasRuptured | forms | (wetted == T(0))), T(0), T(1));
}

/// The capillary number of a bridge from a layer, where it is above the largest one that the range is made
/// for; else 0.
/// @param layer the interaction, with the `depth` (m) of its liquid
template <class T, class Interaction, class Law>
[[gnu::always_inline]] inline T numberAboveBoundOf(const Interaction& layer, const Law& law,
                                                   const T& separation, const T& opening) {
    const T number = capillaryNumber(opening, layer.viscosity, layer.surfaceTension);
    const MaskOf<T> isBridge = (separation > layer.depth) & (layer.wetted > T(0));
    return select(isBridge & (number > T(law.largestCapillaryNumber)), number, T(0));
}

/// The parameters that laws of a layer of liquid share. Law is the law derived from this.
template <class Law>
struct LayerLaw {
    double viscosity = unset;  // eta, Pa s
    double roughness = unset;  // epsilon, m
    double capillaryInContact = 0;
    double largestCapillaryNumber = 1;

    void setViscosity(double value) { set(&LayerLaw::viscosity, value); }
    void setRoughness(double value) { set(&LayerLaw::roughness, value); }
    void setCapillaryInContact(bool value) { capillaryInContact = value ? 1 : 0; }
    void setLargestCapillaryNumber(double value) { set(&LayerLaw::largestCapillaryNumber, value); }
    [[nodiscard]] double getViscosity() const { return viscosity; }
    [[nodiscard]] double getRoughness() const { return roughness; }

protected:
    /// The resistance where it is largest: as near as the roughness lets the surfaces come.
    /// @param thickness m, of one layer
    [[nodiscard]] BridgeResistance<double> resistanceAtRoughness(const Bodies& bodies, double thickness,
                                                                 double asymmetry) const {
        const auto& law = static_cast<const Law&>(*this);
        auto wet = law.prepare(bodies);
        BridgeMotion<double> motion{};
        motion.separation = std::min(roughness, thickness);
        motion.asymmetry = asymmetry;
        motion.forms = true;
        return wet.resist(law, motion);
    }

private:
    void set(double LayerLaw::*member, double value) { setField(static_cast<Law&>(*this), member, value); }
};

}  // namespace pendular
