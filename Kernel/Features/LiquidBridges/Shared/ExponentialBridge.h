#pragma once

#include <numbers>
#include <optional>
#include <string>

#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"
#include "Kernel/Foundation/Math/ElementaryFunctions.h"

namespace pendular {

/// What one contact remembers of a bridge with the force f (exp(A S + B) + C).
template <class T>
struct ExponentialBridgeInteraction {
    T falling;          // f exp(B), N
    T rate;             // A / ln 2, 1/m
    T constant;         // f C, N
    T ruptureDistance;  // m

    [[nodiscard]] T force(T separation) const { return falling * exponential2(rate * separation) + constant; }
    [[nodiscard]] T range() const { return ruptureDistance; }
};

/// Why such a bridge cannot be used, if so: it does not attract up to its rupture, or its force at contact is
/// beyond all reason (physically it cannot exceed 2 pi R gamma).
std::optional<std::string> objectionToExponential(std::string_view law,
                                                  const ExponentialBridgeInteraction<double>& bridge,
                                                  const BridgeScales& scales, double contactAngle);

}  // namespace pendular
