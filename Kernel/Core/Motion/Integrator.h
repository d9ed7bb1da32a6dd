#pragma once

#include <array>
#include <string>
#include <string_view>

#include "Kernel/Core/Contacts/ContactTiming.h"

namespace pendular {

/// How a step of length h goes from the accelerations a of this and a' of the last step to the next, a+.
/// Forces are found once a step, between two parts:
/// - before: x += h v + h^2 (position0 a + position1 a'), v += h (velocity0 a + velocity1 a')
/// - after:  v += corrector h (a+ - now a + earlier a')
struct Integrator {
    std::string_view name;
    double position0, position1;
    double velocity0, velocity1;
    double corrector, now, earlier;
    ContactTiming contacts;

    [[nodiscard]] constexpr bool remembersEarlier() const {
        return position1 != 0 || velocity1 != 0 || earlier != 0;
    }
    /// Whether v goes by the mean of the accelerations at both ends of a step.
    [[nodiscard]] constexpr bool takesMeanAcceleration() const {
        return !remembersEarlier() && corrector == 0.5 && velocity0 - corrector * now == 0.5;
    }
    struct Coefficient {
        std::string_view name;
        double Integrator::*value;
    };
    static constexpr std::array<Coefficient, 7> coefficients() {
        return {{{"position0", &Integrator::position0},
                 {"position1", &Integrator::position1},
                 {"velocity0", &Integrator::velocity0},
                 {"velocity1", &Integrator::velocity1},
                 {"corrector", &Integrator::corrector},
                 {"now", &Integrator::now},
                 {"earlier", &Integrator::earlier}}};
    }
    /// Integrators are equal if their coefficients are; the name does not count.
    friend constexpr bool operator==(const Integrator& a, const Integrator& b) {
        for (const Coefficient& c : coefficients())
            if (a.*c.value != b.*c.value) return false;
        return a.contacts == b.contacts;
    }
};

namespace integrators {

/// The steps of Velocity Verlet. Between the two parts of a step the velocity is v + ahead h a; the second
/// part makes it the one at the end of the step.
constexpr Integrator verletSteps(std::string_view name, double ahead, const ContactTiming& contacts) {
    return {.name = name,
            .position0 = 0.5,
            .position1 = 0,
            .velocity0 = ahead,
            .velocity1 = 0,
            .corrector = 0.5,
            .now = 2 * ahead - 1,
            .earlier = 0,
            .contacts = contacts};
}

/// Velocity Verlet for forces that depend on the velocity: contacts see v + h a, which is right to second
/// order in a dashpot, and their own force implicitly: two grains follow the trapezoidal rule. The default.
inline constexpr Integrator predictedVelocityVerlet =
    verletSteps("PredictedVelocityVerlet", 1, {.implicitForces = true, .timesTouches = true});

/// The default with tangential springs that move to the force with the velocity in the middle of the step.
/// Without this, it keeps them half a step ahead by the velocities v + h a, which feeds springs without
/// dashpots; a scene takes this one by itself where they lack them (lacksDashpots() in StabilityLimit.h).
/// It stands longer steps, too, as long as its springs allow. It costs the loads of accelerations in each
/// contact.
inline constexpr Integrator springsInStep = verletSteps("SpringsInStep", 1, {.springsInStep = true});

/// Velocity Verlet as in other codes: contacts see the velocity in the middle of the step, which is first
/// order in a dashpot.
inline constexpr Integrator velocityVerlet =
    verletSteps("VelocityVerlet", 0.5, {.implicitForces = false, .timesTouches = false});

/// Third order between touches: the prediction of Beeman (1976), J. Comput. Phys. 20, 130, velocities of
/// Adams and Bashforth before and of Adams and Moulton after the forces. Explicit in dashpots; keeps the last
/// acceleration of each grain, 24 bytes (48 with spin).
inline constexpr Integrator adamsMoulton{.name = "AdamsMoulton",
                                         .position0 = 2.0 / 3.0,
                                         .position1 = -1.0 / 6.0,
                                         .velocity0 = 1.5,
                                         .velocity1 = -0.5,
                                         .corrector = 5.0 / 12.0,
                                         .now = 2,
                                         .earlier = 1,
                                         .contacts = {false, true}};

/// All that a scene can take, also by itself.
inline constexpr std::array all{predictedVelocityVerlet, velocityVerlet, adamsMoulton, springsInStep};

}  // namespace integrators

/// The name for messages: the one that integrators::all has for it, "NAME of your own" where it is none of
/// them.
[[nodiscard]] std::string shownName(const Integrator& integrator);

/// The name for restart files, with all coefficients of an integrator of your own.
[[nodiscard]] std::string description(const Integrator& integrator);

/// Throws InputError unless all coefficients are finite, a constant acceleration a gives h^2/2 a in the
/// position and h a in the velocity, and an oscillation is stable in small steps.
void checkIntegrator(const Integrator& integrator);

}  // namespace pendular
