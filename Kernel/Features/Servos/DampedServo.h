#pragma once

#include "Kernel/Features/Servos/Servo.h"

namespace pendular {

/// A servo (Servo.h) whose value holds what dashpots C answer to the servo's own speed of the last step: the
/// force of grains with dashpots on a wall, or their stress, value = (elastic part) - C speed_last.
///
/// By the law of Servo.h, speed = (value - target) / (K time) + drift, that speed is fed back from step to
/// step with the factor -C / (K time). The roots of the massless loop with the step h,
///
///     z^2 - (1 - h/time - C/(K time)) z - C/(K time) = 0,
///
/// leave the unit circle at C/(K time) = 1 - h/(2 time): the value rings ever more below time = C/K + h/2. So
/// the dashpots' answer is taken at the new speed, which is that law solved for it:
///
///     speed = (value - target + C speed_last + K time drift) / (K time + C).
///
/// The loop then has the root 1 - h / (time + C/K): it is stable for h < 2 (time + C/K), whatever C is, and
/// still where the true dashpots are up to 2 C + K time (the other root is their excess over K time + C). A
/// column of L grains, with their masses, is stable as well: SelfTests/Particles/ServoLoopTest.cpp has the
/// spectral radius. At rest speed_last = speed = 0: the target is the same.
///
/// The value comes by exp(-t / (time + C/K)), a column of L layers, L + 1 springs one after the other, by
/// exp(-t / ((L + 1) time + C/K)). The share of C/K is not made by the remedy, but by the dashpots being part
/// of the value: a column that is pressed at a constant rate shows its dashpots at once and its springs
/// later.
///
/// It is the servo of the value without what its speed gives it, value + C speed, with the time time + C/K,
/// and the target that this value has while the servo follows a drift: target + C drift.
/// @param dashpot C, not negative; the others as of Servo::look()
inline void lookBesideDashpots(Servo& servo, double value, double target, double stiffness, double dashpot,
                               double interval, double time, double driftTime, double largest) {
    const double relaxation = stiffness > 0 ? dashpot / stiffness : 0;  // s
    if (!(relaxation > 0)) return servo.look(value, target, stiffness, interval, time, driftTime, largest);
    servo.look(value + dashpot * servo.speed, target + dashpot * servo.drift, stiffness, interval,
               time + relaxation, driftTime * (1 + relaxation / time), largest);
}

}  // namespace pendular
