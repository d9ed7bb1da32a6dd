#pragma once

#include <optional>

#include "Kernel/Features/LiquidBridges/BridgeSurface.h"
#include "Kernel/Laws/Concepts/Bodies.h"
#include "Kernel/Laws/Concepts/LiquidRules.h"

namespace pendular {

/// What a scene asks of the liquid between its species: bridges, films, and what moves between them. All
/// functions take the indices of two species; `interaction` is what a bridge remembers, as numbers. Dry laws
/// answer with nothing or 0, and do nothing.
class LiquidLaws {
public:
    virtual ~LiquidLaws() = default;

    /// m^3; nothing where no laws of the scene have a bridge
    [[nodiscard]] virtual std::optional<double> bridgeVolume(int a, int b) const = 0;
    /// How liquid moves between the two; nothing where it does not.
    [[nodiscard]] virtual std::optional<LiquidRules> liquidRules(int a, int b) const = 0;

    /// m: bodies that have not touched form a bridge below this gap; 0 where they must touch. This is for
    /// bridges of a fixed volume.
    [[nodiscard]] virtual double filmContactGap(int a, int b) const = 0;
    /// The gap (m) as above where liquid moves, for films of this thickness (m, of both bodies together).
    [[nodiscard]] virtual double filmContactGap(int a, int b, const Bodies& bodies, double films) const = 0;
    /// Films have met: the bridge that liquid is about to make there will resist from the gap `start` (m) on,
    /// of which the bodies have gone up to `gap` (m).
    virtual void meetFilms(int a, int b, double* interaction, double gap, double start) const = 0;

    /// Prepares a bridge of this volume (m^3), where liquid moves.
    virtual void prepareBridge(int a, int b, const Bodies& bodies, double volume,
                               double* interaction) const = 0;
    /// A bridge that was prepared again goes on with what it remembered.
    virtual void takeBridgeState(int a, int b, double* interaction, const double* before) const = 0;
    /// Called between two steps: if the separation (m) is not what it was at the end of the last one (by more
    /// than roundOff, m), the bodies have been put there, and a bridge forgets how they moved.
    virtual void checkGap(int a, int b, double* interaction, double separation, double roundOff) const = 0;

    /// Minus the work (J) that a bridge still does from a separation (m) to its rupture, where liquid moves.
    [[nodiscard]] virtual double adhesionEnergy(int a, int b, const double* interaction,
                                                double separation) const = 0;
    /// The free surface of a bridge of this volume (m^3) at a separation (m), where liquid moves.
    /// @param solved with pressure and filling angles
    [[nodiscard]] virtual BridgeSurface bridgeSurface(int a, int b, const Bodies& bodies, double volume,
                                                      double separation, bool solved) const = 0;
};

}  // namespace pendular
