#pragma once

#include <cmath>
#include <cstddef>

#include "Kernel/Features/LiquidBridges/BridgeSurface.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

/// How the liquid of a scene dries: dV/dt = -k A, for each film, bridge and droplet by its own free surface
/// A. The law says what k is. Without one, nothing dries. Everything stays at its temperature, and nothing
/// condenses.
class Evaporation {
public:
    /// k (m/s) itself: the volume that a surface loses for its area and time.
    void setFlux(double value);
    /// k = h_m (1 - RH) rho_vs / rho_l.
    /// @param coefficient h_m, of mass transfer, m/s; @param saturatedVapour rho_vs, kg/m^3; @param
    /// liquidDensity rho_l, kg/m^3; @param relativeHumidity RH, 0 to 1
    void setMassTransfer(double coefficient, double saturatedVapour, double liquidDensity,
                         double relativeHumidity = 0);
    /// Lets droplets in flight dry by diffusion: vapour diffuses away through gas at rest, and the radius a
    /// of a droplet obeys a^2 = a0^2 - 2 D (rho_vs - rho_v) t / rho_l (the d^2 law). Without it, they dry as
    /// films do.
    /// @param diffusivity D, m^2/s; @param vapourDifference rho_vs - rho_v, kg/m^3; @param liquidDensity
    /// rho_l, kg/m^3
    void setDiffusion(double diffusivity, double vapourDifference, double liquidDensity);
    /// Kelvin: above the hollow surface of a bridge the saturated vapour is thinner, by the factor
    /// exp(p V_m / (R_g T)), with the capillary pressure p < 0. For each bridge the equation of its shape is
    /// then solved (two times an update, 5 us each). With setFlux() the gas counts as dry (RH = 0).
    /// @param molarVolume V_m, of the liquid, m^3/mol; @param temperature T, K
    void setKelvin(double molarVolume, double temperature);
    /// Steps between two updates of the volumes, 100 by default. An update moves each bridge by the midpoint
    /// rule in V^(1/4), which falls about linearly in time.
    void setInterval(std::size_t steps);
    /// s; before it nothing dries.
    void setStartTime(double time);

    [[nodiscard]] bool acts() const { return fastest > 0; }
    [[nodiscard]] bool dropletsEvaporate() const { return fastest > 0 || drop > 0; }
    [[nodiscard]] bool seesCurvature() const { return kelvin > 0; }
    [[nodiscard]] std::size_t interval() const { return steps; }
    [[nodiscard]] double startTime() const { return start; }

    /// k (m/s) of a surface over which the liquid's pressure is so much (Pa) above that of the gas.
    [[nodiscard]] double flux(double pressure = 0) const {
        const double vapour = kelvin > 0 ? std::exp(kelvin * pressure) : 1;
        return std::fmax(fastest * (vapour - humidity), 0);
    }
    /// The volume (m^3) that is left of one after a time (s).
    /// @param lossRate m^3/s, of a volume
    template <class LossRate>
    static double leftAfter(double volume, double time, LossRate&& lossRate) {
        const auto falls = [&](double at) { return lossRate(at) / (4 * std::pow(at, 0.75)); };
        const double root = std::sqrt(std::sqrt(volume));
        const double middle = root - 0.5 * time * falls(volume);
        if (!(middle > 0)) return 0;
        const double end = root - time * falls(middle * middle * middle * middle);
        return end > 0 ? end * end * end * end : 0;
    }
    /// The radius (m) that is left to a droplet in flight after a time (s).
    [[nodiscard]] double radiusLeftAfter(double radius, double time) const {
        if (drop > 0) return std::sqrt(std::fmax(radius * radius - drop * time, 0));
        return std::fmax(radius - flux() * time, 0);
    }

    void visitState(StateArchive& archive) const;

private:
    double fastest = 0;   // m/s, k into dry gas from a flat surface
    double humidity = 0;  // RH
    double drop = 0;      // m^2/s, -d(a^2)/dt
    double kelvin = 0;    // 1/Pa, V_m / (R_g T)
    double start = 0;     // s
    std::size_t steps = 100;
};

}  // namespace pendular
