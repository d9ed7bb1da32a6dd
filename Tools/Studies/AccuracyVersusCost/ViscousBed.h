#pragma once

#include "Kernel/Scene/Simulation.h"
#include "Tools/Studies/AccuracyVersusCost/BridgeNetwork.h"
#include "Tools/Studies/AccuracyVersusCost/ViscousPair.h"

// The largest stable step of viscous bridges in a bed, measured: the one above which small motions grow.

namespace pendular {

struct BedScheme {
    std::string_view name;
    ViscousScheme scheme;
    double neighbours = 1;
    const Integrator* integrator = &integrators::predictedVelocityVerlet;

    /// c dt / m* above which a motion of the rate q c / m* grows, by changing its sign from step to step: the
    /// root -1 of the step.
    [[nodiscard]] double limit(double q) const {
        const bool isPredicted = integrator == &integrators::predictedVelocityVerlet;
        if (neighbours > 1) return infinity;
        // dv = -x q v, v being predicted with the change of the last step.
        if (scheme == ViscousScheme::Explicit) return (isPredicted ? 1 : 2) / q;
        // A pair (q = 1) alone stands any step. What others change is predicted: 1 + x = x q.
        if (scheme == ViscousScheme::Implicit) return q > 1 ? 1 / (q - 1) : infinity;
        // Gap: with the relative drift u and what is paid for, y, over the way of a step, both for the last
        // one: w = ((1 - x) u + x y) / (1 + theta x), y' = theta w, u' = u + q x (y - u - y').
        const auto fastestStable = [](double x) {
            const double theta = (1 + x) / (2 + x), t = theta * x;
            return 2 * (1 + t) * (1 + 2 * t) / (x * ((1 + theta) * (1 + 2 * t) + theta * (1 - x)));
        };
        double low = 1e-6, high = 1e6;
        if (fastestStable(high) > q) return infinity;
        for (int k = 0; k < 200; ++k) {
            const double middle = std::sqrt(low * high);
            (fastestStable(middle) > q ? low : high) = middle;
        }
        return low;
    }
};
inline constexpr std::array bedSchemes{
    BedScheme{"gap", ViscousScheme::Gap}, BedScheme{"gap for twelve neighbours", ViscousScheme::Gap, 12},
    BedScheme{"implicit", ViscousScheme::Implicit}, BedScheme{"explicit", ViscousScheme::Explicit},
    BedScheme{"explicit by velocity Verlet", ViscousScheme::Explicit, 1, &integrators::velocityVerlet}};

/// Grains with small random velocities, all gaps below the roughness, so that all bridges have the same c.
class ViscousBed : public Simulation<ViscousPairSpecies> {
public:
    /// @param x c dt / m*
    ViscousBed(const BridgeNetwork& network, const BedScheme& scheme, double x) {
        const auto* const added = speciesHandler.copyAndAddObject(material(scheme));
        const double mass = 0.5 * sphereMass(radius, ViscousPair::density);
        resistance = added->largestResistance({radius, radius}).normal / mass;
        if (resistance == 0) {  // a scheme that needs no limit does not say what it would be
            auto plain = *added;
            plain.setViscousNeighbours(1);
            resistance = plain.largestResistance({radius, radius}).normal / mass;
        }
        const double step = x / resistance;
        const double speed = 1e-6 * BridgeNetwork::roughness * radius / step;
        UniformRandom random(1);
        for (const Vec3D& position : network.positions) {
            SphericalParticle grain;
            grain.setSpecies(added);
            grain.setRadius(radius);
            grain.setPosition(radius * position);
            const double u = random.uniform(-1, 1), v = random.uniform(-1, 1);
            grain.setVelocity(speed * Vec3D(u, v, random.uniform(-1, 1)));
            particleHandler.copyAndAddObject(grain);
        }
        for (int axis = 0; axis < 3; ++axis)
            if (network.period[axis] > 0) setPeriodic(axis, 0, radius * network.period[axis]);
        setTimeStep(step);
        setIntegrator(*scheme.integrator);
        setQuiet();
        acceptUnstableTimeStep();
        joinAtStart(BridgeNetwork::roughness * radius);
    }

    /// Whether 2000 steps make the largest speed ten times as large.
    bool grows() {
        initialise();
        const double before = largestSpeed();
        for (int k = 0; k < 2000; ++k) {
            step();
            if (const double speed = largestSpeed(); !(speed < 10 * before)) return true;
        }
        return false;
    }
    /// c dt / m* of the stability limit that is given.
    [[nodiscard]] double advised() { return resistance * stabilityLimit(); }

private:
    static constexpr double radius = 1e-3;  // m

    static ViscousPairSpecies material(const BedScheme& scheme) {
        ViscousPairSpecies s;
        s.setDensity(ViscousPair::density);
        s.setStiffness(1e-12);  // no grain feels a contact
        s.setLiquidBridgeVolume(1e-2 * std::pow(radius, 3));
        s.setContactAngle(0);
        s.setSurfaceTension(1e-20);
        s.setViscosity(1);
        s.setRoughness(BridgeNetwork::roughness * radius);
        s.setTangentialLubrication(TangentialLubrication::None);
        s.setViscousInContact(true);
        s.setViscousScheme(scheme.scheme);
        s.setViscousNeighbours(scheme.neighbours);
        return s;
    }
    double largestSpeed() {
        double largest2 = 0;
        for (const TranslationRecord& grain : particleHandler.store().translation)
            largest2 = std::max(largest2, squaredNorm(grain.velocity));
        return std::sqrt(largest2);
    }

    double resistance = 0;  // c / m*, 1/s
};

/// c dt / m* above which motions grow, to half a per cent by bisection; infinite if it is more than 1000.
inline double criticalResistance(const BridgeNetwork& network, const BedScheme& scheme) {
    const auto grows = [&](double x) { return ViscousBed(network, scheme, x).grows(); };
    double low = 0.01, high = low;
    while (!grows(high)) {
        low = high;
        high *= 1.3;
        if (high > 1000) return infinity;
    }
    while (high - low > 5e-3 * high) {
        const double middle = 0.5 * (low + high);
        (grows(middle) ? high : low) = middle;
    }
    return low;
}

}  // namespace pendular
