#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Scene/Simulation.h"

namespace pendular::scenes {

/// A head-on collision along x: grain 1 comes from the left, grain 2 (or a wall at rest) from the right. The
/// momentum of two grains is zero except for the drift.
struct Approach {
    double radius1 = 1e-3;  // m
    double radius2 = 1e-3;  // m; infinite: a plane wall
    double density = 2000;  // kg/m^3
    double speed = 0.2;     // m/s, relative
    double step = 0;        // s
    double offset = 0.5;    // steps from the start to the first touch
    double drift = 0;       // m/s, of both grains along x
    bool ledger = false;

    [[nodiscard]] bool againstWall() const { return std::isinf(radius2); }
    [[nodiscard]] double mass(double radius) const {
        return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
    }
    [[nodiscard]] double reducedMass() const {
        return againstWall() ? mass(radius1)
                             : mass(radius1) * mass(radius2) / (mass(radius1) + mass(radius2));
    }
    [[nodiscard]] double reducedRadius() const {
        return againstWall() ? radius1 : radius1 * radius2 / (radius1 + radius2);
    }
    [[nodiscard]] double firstTouch() const { return offset * step; }  // s
};

/// What is seen of one touch of two bodies.
struct Touch {
    double restitution = 0;
    double rebound = 0;         // m/s, relative
    double contactTime = 0;     // s
    double largestOverlap = 0;  // m
};

template <class S>
class Collision : public Simulation<S> {
public:
    Collision(S species, const Approach& approach) : scene(approach) {
        species.setDensity(scene.density);
        const S* added = this->speciesHandler.copyAndAddObject(species);
        const double gap = scene.speed * scene.firstTouch();
        const double share = scene.againstWall() ? 1 : scene.reducedMass() / scene.mass(scene.radius1);
        SphericalParticle grain;
        grain.setSpecies(added);
        grain.setRadius(scene.radius1);
        grain.setPosition({-scene.radius1, 0, 0});
        grain.setVelocity({share * scene.speed + scene.drift, 0, 0});
        this->particleHandler.copyAndAddObject(grain);
        if (scene.againstWall()) {
            wallOffset = gap;
            InfiniteWall wall;
            wall.set({1, 0, 0}, {wallOffset, 0, 0});
            wall.setSpecies(added);
            this->wallHandler.copyAndAddObject(wall);
        } else {
            grain.setRadius(scene.radius2);
            grain.setPosition({gap + scene.radius2, 0, 0});
            grain.setVelocity({(share - 1) * scene.speed + scene.drift, 0, 0});
            this->particleHandler.copyAndAddObject(grain);
        }
        this->setTimeStep(scene.step);
        this->keepEnergyLedger(scene.ledger);
        this->initialise();
    }

    /// m, of the surfaces; negative while they overlap.
    [[nodiscard]] double separation() {
        const double x1 = this->particleHandler.getObject(0).getPosition().x();
        if (scene.againstWall()) return wallOffset - x1 - scene.radius1;
        return this->particleHandler.getObject(1).getPosition().x() - x1 - (scene.radius1 + scene.radius2);
    }
    /// m/s, positive where the bodies part.
    [[nodiscard]] double partingSpeed() {
        const double v1 = this->particleHandler.getObject(0).getVelocity().x();
        return (scene.againstWall() ? 0 : this->particleHandler.getObject(1).getVelocity().x()) - v1;
    }
    /// kg m/s
    [[nodiscard]] double momentum() {
        double sum = 0;
        for (std::size_t k = 0; k < this->particleHandler.getSize(); ++k) {
            const auto grain = this->particleHandler.getObject(k);
            sum += grain.getMass() * grain.getVelocity().x();
        }
        return sum;
    }

    /// Steps until the first touch has ended. Before and after it the motion is straight, so that its start
    /// and its end are known between steps; the largest overlap is that of the parabola through three steps.
    Touch finishTouch() {
        std::array<double, 3> last{separation(), separation(), separation()};
        Touch touch;
        bool touched = false;
        while (!touched || separation() < 0) {
            this->step();
            last = {last[1], last[2], separation()};
            touched = touched || last[2] < 0;
            if (last[1] < last[0] && last[1] < last[2]) touch.largestOverlap = -parabolaMinimum(last);
        }
        touch.rebound = partingSpeed();
        touch.restitution = touch.rebound / scene.speed;
        touch.contactTime = this->getTime() - separation() / touch.rebound - scene.firstTouch();
        return touch;
    }

    const Approach scene;

private:
    static double parabolaMinimum(const std::array<double, 3>& y) {
        const double slope = 0.5 * (y[2] - y[0]), curvature = y[2] - 2 * y[1] + y[0];
        return y[1] - 0.5 * slope * slope / curvature;
    }

    double wallOffset = 0;  // m
};

/// Offsets of the first touch against the steps that fill (0, 1) evenly: the k-th multiple of the golden
/// section.
inline double spreadOffset(int k) { return 0.005 + 0.99 * std::fmod(0.6180339887498949 * (k + 1), 1.0); }

}  // namespace pendular::scenes
