#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/Laws.h"
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

/// m, at which the attraction is the elastic push, so that the normal force is zero.
double overlapOf(const Sintering&) { return overlap; }
double overlapOf(const Wet& law) {
    return 2 * std::numbers::pi * law.getSurfaceTension() * radius / stiffness;
}

/// A grain that does not turn, on one that is held, pulled sideways: its way over that of the spring alone.
template <class S>
double wayAtRest(const S& law, double h) {
    const Vec3D place{0, 0, 2 * radius - overlapOf(law)};
    scenes::FewGrains<S> scene(law,
                               {{.radius = radius, .fixed = true}, {.radius = radius, .position = place}}, h);
    scene.particleHandler.getObject(1).setHeldAxes({.aboutX = true, .aboutY = true, .aboutZ = true});
    scene.setGravity({pull, 0, 0});
    scene.acceptUnstableTimeStep();  // the limits are of explicit dashpots in beds
    scene.run(static_cast<int>(20000 * step / h));
    return scene.motion(1).position.x() * slidingStiffness / (mass * pull);
}

// At rest the drag is zero, and the spring bears the pull: of the first motion exp(-h k_t n / c) is left
// after n steps, below 1e-9 for c = m / h, and the contact has turned by x / (2 R) = 1e-4, whose square is
// left. The kernel takes the response of a grain that may turn, 7/2 of 1/m, for that of this one: an error of
// some h^2 k_t / m = 1e-3, which two steps remove. What is linear in h would stay: it was 7/4 h c / m. The
// drag of a neck that is implicit for six contacts follows late, by an error of h^3 k_t c / m^2.
TEST(FrictionBesideDrag, leavesTheSpringWhatItBears) {
    constexpr double squared = 0.05 * 0.05 * slidingStiffness / stiffness;  // h^2 k_t / m
    const auto extrapolated = [](const auto& law) {
        const double one = wayAtRest(law, step);
        EXPECT_NEAR(one, 1, 10 * squared);
        return (4 * wayAtRest(law, 0.5 * step) - one) / 3;
    };
    for (const double resistance : {0.0, 0.01, 0.1, 0.9})
        EXPECT_NEAR(extrapolated(sintering(resistance)), 1, 1e-6 + 3 * resistance * squared) << resistance;
    for (const double viscosity : {1e-3, 0.1, 1.0})
        EXPECT_NEAR(extrapolated(wet(viscosity)), 1, 2e-6) << viscosity;
}

}  // namespace
}  // namespace pendular::frictionBesideDragTest
