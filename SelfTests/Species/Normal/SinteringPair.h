#pragma once

#include <numbers>

#include "SelfTests/Scenes/FewGrains.h"

namespace pendular::scenes {

/// Equal grains in a row along x, each of which overlaps its neighbours: two, or more.
template <class S>
struct SinteringPair : FewGrains<S> {
    /// @param mass kg, of each; @param apart m/s, at which the second is drawn off; @param adaptive of the
    /// stable step, with which steps are chosen; 0: they are as given
    SinteringPair(S species, double grainRadius, double mass, double overlap, double step, double apart = 0,
                  int count = 2, double adaptive = 0)
        : FewGrains<S>(withMass(species, grainRadius, mass), row(grainRadius, overlap, apart, count), step),
          radius(grainRadius) {
        this->keepEnergyLedger();
        if (adaptive > 0) this->setAdaptiveTimeStep(adaptive);
        this->initialise();
    }
    /// m, of a grain with the next
    double overlap(std::size_t first = 0) {
        return 2 * radius - (this->motion(first + 1).position - this->motion(first).position).norm();
    }
    void runUntil(double time) {
        while (this->getTime() < time - 0.5 * this->getTimeStep()) this->step();
    }
    const double radius;  // m

private:
    static S withMass(S species, double radius, double mass) {
        species.setDensity(mass / (4.0 / 3 * std::numbers::pi * radius * radius * radius));
        return species;
    }
    static std::vector<GrainMotion> row(double radius, double overlap, double apart, int count) {
        std::vector<GrainMotion> grains;
        for (int k = 0; k < count; ++k)
            grains.push_back({.radius = radius,
                              .position = {k * (2 * radius - overlap), 0, 0},
                              .velocity = {k == 1 ? apart : 0, 0, 0}});
        return grains;
    }
};

/// s, when the neck x^2 = 2 R d of a pair is so large (of the radius).
template <class S>
double timeOfNeck(SinteringPair<S>& pair, double neck) {
    const double wanted = 0.5 * neck * neck * pair.radius;
    double last = pair.overlap();
    while (true) {
        pair.step();
        const double now = pair.overlap();
        if (now >= wanted) return pair.getTime() - pair.getTimeStep() * (now - wanted) / (now - last);
        last = now;
    }
}

}  // namespace pendular::scenes
