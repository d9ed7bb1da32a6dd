#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Species/Laws.h"
#include "SelfTests/Scenes/FewGrains.h"

// Springs of friction in contacts that a bridge or a neck resists, too.

namespace pendular::frictionBesideDragTest {
namespace {

constexpr double radius = 1e-3, mass = 1e-5, stiffness = 100, slidingStiffness = 40;  // SI
constexpr double overlap = 1e-5, pull = 1;                                            // m, m/s^2
const double step = 0.05 * std::sqrt(mass / stiffness);                               // s

using Sintering = Species<LinearViscoelastic, SlidingFriction, ParhamiMcMeekingSinter>;
using Wet = Species<LinearViscoelastic, SlidingFriction, ViscousBridge<LiquidBridgeWillett>>;

template <class S>
S solid() {
    S law;
    law.setDensity(mass / (4.0 / 3 * std::numbers::pi * radius * radius * radius));
    law.setStiffness(stiffness), law.setDissipation(std::sqrt(mass * stiffness));
    law.setSlidingStiffness(slidingStiffness), law.setSlidingDissipation(std::sqrt(mass * slidingStiffness));
    law.setSlidingFrictionCoefficient(1000);
    return law;
}

/// @param resistance c of sliding over m / h
Sintering sintering(double resistance) {
    Sintering law = solid<Sintering>();
    law.setAdhesionCoefficient(stiffness * overlap / radius);  // a D = k d with D = R
    law.setSlidingViscosityCoefficient(resistance * mass / step / (2 * radius * overlap * radius));
    return law;
}
Wet wet(double viscosity) {
    Wet law = solid<Wet>();
    law.setLiquidBridgeVolume(1e-3 * radius * radius * radius), law.setSurfaceTension(0.07);
    law.setContactAngle(0), law.setViscosity(viscosity), law.setRoughness(1e-6);
    law.setViscousInContact(1);
    return law;
}

/// A grain that does not turn, on one that is held, pulled sideways: its way over that of the spring alone.
template <class S>
double wayAtRest(const S& law) {
    scenes::FewGrains<S> scene(
        law,
        {{.radius = radius, .fixed = true}, {.radius = radius, .position = {0, 0, 2 * radius - overlap}}},
        step);
    scene.particleHandler.getObject(1).setHeldAxes({.aboutX = true, .aboutY = true, .aboutZ = true});
    scene.setGravity({pull, 0, 0});
    scene.acceptUnstableTimeStep();  // the limits are of explicit dashpots in beds
    scene.run(20000);
    return scene.motion(1).position.x() * slidingStiffness / (mass * pull);
}

// At rest the drag is zero, and the spring bears the pull: of the first motion exp(-h k_t n / c) is left
// after n steps, below 1e-9 for c = m / h, and the contact has turned by x / (2 R) = 1e-4, whose square is
// the error.
TEST(FrictionBesideDrag, leavesTheSpringWhatItBears) {
    for (const double resistance : {0.0, 0.01, 0.1, 0.9})
        EXPECT_NEAR(wayAtRest(sintering(resistance)), 1, 1e-6) << resistance;
    for (const double viscosity : {1e-3, 0.1, 1.0})
        EXPECT_NEAR(wayAtRest(wet(viscosity)), 1, 1e-6) << viscosity;
}

}  // namespace
}  // namespace pendular::frictionBesideDragTest
