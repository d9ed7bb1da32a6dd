#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Scene/Simulation.h"
#include "Tools/Studies/AccuracyVersusCost/CriticalMaterial.h"

// The largest stable step, measured: the one above which small disturbances of grains at rest grow.

namespace pendular {

/// Grains at rest whose contacts all have the same overlap. The first two grains touch.
struct RestingGrains {
    std::string_view name;
    std::vector<double> radii;     // m
    std::vector<Vec3D> positions;  // m
    double period = 0;             // m, along all axes; 0: none
    bool atWall = false;           // the first one touches the plane z = 0 from above; there is one only

    [[nodiscard]] Bodies bodies() const {
        return atWall ? Bodies{radii[0], infinity} : Bodies{radii[0], radii[1]};
    }
    [[nodiscard]] double effectiveMass() const {
        const auto inverse = [](double r) { return 1 / sphereMass(r, criticalMaterial::density); };
        return 1 / (inverse(radii[0]) + (atWall ? 0 : inverse(radii[1])));
    }
};

namespace resting {

inline constexpr double radius = criticalMaterial::radius, large = 10 * radius;  // m

/// The distance (m) of centres that touch.
inline double distance(double r1, double r2) { return r1 + r2 - criticalMaterial::overlap(std::min(r1, r2)); }
inline RestingGrains onWall() {
    return {"at a wall", {radius}, {{0, 0, radius - criticalMaterial::overlap(radius)}}, 0, true};
}
inline RestingGrains pair() {
    return {"pair", {radius, radius}, {{0, 0, 0}, {distance(radius, radius), 0, 0}}};
}
/// A row of a large grain, a small one and a large one, of the ratio 1:10.
inline RestingGrains between() {
    const double d = distance(radius, large);
    return {"small between large", {radius, large, large}, {{0, 0, 0}, {d, 0, 0}, {-d, 0, 0}}};
}
/// A large grain and 200 small ones on it, on a spiral of Fibonacci: nearly one place for each that fits.
inline RestingGrains covered() {
    RestingGrains scene{"large covered by small", {large}, {{0, 0, 0}}};
    constexpr int count = 200;
    const double d = distance(radius, large), turn = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int k = 0; k < count; ++k) {
        const double z = 1 - (2 * k + 1.0) / count, rho = std::sqrt(1 - z * z);
        scene.radii.push_back(radius);
        scene.positions.push_back(d * Vec3D(rho * std::cos(k * turn), rho * std::sin(k * turn), z));
    }
    return scene;
}
/// The densest packing of equal grains, face-centred cubic, 2 x 2 x 2 cells that repeat themselves. Its
/// fastest motions (all grains turn alike; layers shift against each other) fit into them.
inline RestingGrains crystal() {
    const double d = distance(radius, radius), edge = d * std::sqrt(2.0);
    RestingGrains scene{"densest bed", {}, {}, 2 * edge};
    for (int cell = 0; cell < 8; ++cell)
        for (const Vec3D& site :
             {Vec3D(0, 0, 0), Vec3D(0.5, 0.5, 0), Vec3D(0.5, 0, 0.5), Vec3D(0, 0.5, 0.5)}) {
            scene.radii.push_back(radius);
            scene.positions.push_back(edge * (site + Vec3D(cell & 1, cell >> 1 & 1, cell >> 2)));
        }
    return scene;
}

}  // namespace resting

/// Resting grains with small random velocities and spins.
template <class S>
class DisturbedGrains : public Simulation<S> {
public:
    DisturbedGrains(const S& species, const RestingGrains& given, double step, const Integrator& integrator) {
        const S* added = this->speciesHandler.copyAndAddObject(species);
        const double speed = 1e-7 * criticalMaterial::radius / step;  // m/s
        UniformRandom random(1);
        const auto part = [&] { return random.uniform(-1, 1); };
        for (std::size_t k = 0; k < given.radii.size(); ++k) {
            SphericalParticle grain;
            grain.setSpecies(added);
            grain.setRadius(given.radii[k]);
            grain.setPosition(given.positions[k]);
            grain.setVelocity(speed * Vec3D(part(), part(), part()));
            grain.setAngularVelocity(speed / given.radii[k] * Vec3D(part(), part(), part()));
            this->particleHandler.copyAndAddObject(grain);
        }
        for (int axis = 0; axis < 3 && given.period > 0; ++axis) this->setPeriodic(axis, 0, given.period);
        if (given.atWall) {
            InfiniteWall wall;
            wall.set({0, 0, -1}, {0, 0, 0});
            wall.setSpecies(added);
            this->wallHandler.copyAndAddObject(wall);
        }
        this->setTimeStep(step);
        this->setIntegrator(integrator);
        this->acceptUnstableTimeStep();
    }

    /// Whether 400 steps make the largest speed, of centres and rims, ten times as large.
    bool grows() {
        try {
            this->initialise();
            const double before = largestSpeed();
            for (int n = 0; n < 400; ++n) {
                this->step();
                if (!(largestSpeed() < 1e3 * before)) return true;
            }
            return largestSpeed() > 10 * before;
        } catch (const RunError&) {  // they have run away
            return true;
        }
    }

private:
    double largestSpeed() {
        double largest2 = 0;
        const auto& grains = this->particleHandler.store();
        for (std::size_t k = 0; k < grains.size(); ++k) {
            const double radius = grains.translation[k].radius;
            largest2 = std::max(largest2, squaredNorm(grains.translation[k].velocity));
            if constexpr (S::hasTorque)
                largest2 = std::max(largest2, radius * radius * squaredNorm(grains.rotation[k].spin));
        }
        return std::sqrt(largest2);
    }
};

/// The critical step of a scene, as it was measured.
struct CriticalStep {
    double advice;    // s, the stability limit that is given
    double critical;  // s; infinite if it is more than 30 times the advice
};

/// The critical step to half a per cent, by bisection. An instability of short steps that longer ones do not
/// have is found too, to a factor of 1.3.
template <class S>
CriticalStep criticalStep(const S& species, const RestingGrains& scene, const Integrator& integrator) {
    const auto grows = [&](double step) {
        return DisturbedGrains<S>(species, scene, step, integrator).grows();
    };
    const double advice = DisturbedGrains<S>(species, scene, 1, integrator).stabilityLimit();
    double low = 0.1 * advice, high = low;
    while (!grows(high)) {
        low = high;
        high *= 1.3;
        if (high > 30 * advice) return {advice, infinity};
    }
    while (high - low > 5e-3 * high) {
        const double middle = 0.5 * (low + high);
        (grows(middle) ? high : low) = middle;
    }
    return {advice, low};
}

}  // namespace pendular
