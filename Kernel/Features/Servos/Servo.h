#pragma once

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// A servo that brings a value (a force, a stress) to its target by a speed (of a wall; of a logarithm of a
/// length), where value' = -stiffness x (speed - drift). The drift is what the value does by itself: a bed
/// that is sheared, that creeps, or whose floor moves. The speed is
///
///     (value - target) / (stiffness x time) + drift,
///
/// with the drift found from how the value has changed under the speed that it had, over a time of its own.
/// That is a PI servo (proportional and integral), whose integral begins so that it does not overshoot: with
/// the right stiffness and drift the value follows exp(-t / time); a wrong drift is forgotten by
/// exp(-t / driftTime), so that there is no steady error. It is looked for from when the value has come to
/// its target (to a tenth of it, or from one side to the other), at the latest after four times driftTime:
/// what is far from it may be loose, and not answer to the speed yet. While the speed is cut to the largest
/// one (loose grains that come together), nothing is learnt, so that nothing winds up. Source: Rivera, Morari
/// and Skogestad (1986), Ind. Eng. Chem. Process Des. Dev. 25, 252: PI by the model of what is controlled.
///
/// Where the value is softer than thought, stiffness a with a share a < 1, the roots of
/// s^2 + a (1/time + 1/driftTime) s + a / (time x driftTime) have negative real parts for any a > 0; they are
/// real, so that nothing rings, if a >= 4 n / (n + 1)^2, n = driftTime / time: the value goes beyond its
/// target once, by exp(-2) = 0.135 of the first difference at most. A stiffness that is taken too large is
/// slow; one that is too small by more than a factor of 2 time / interval diverges.
struct Servo {
    double speed = 0;      // of the value's choice: m/s, 1/s
    double drift = 0;      // in the same unit
    double last = 0;       // the value when it was looked at last
    bool hasLast = false;  // it was, and there was a stiffness
    bool arrived = false;  // the value has come to its target
    double waited = 0;     // s, for that

    /// Forgets what it has learnt: the value is of something else from now on.
    void forget() { drift = 0, beginAnew(false); }
    /// It has another target from now on. What it has learnt of the value stays.
    /// @param sameInterval the next look comes after the interval that there was
    void beginAnew(bool sameInterval) { hasLast &= sameInterval, arrived = false, waited = 0; }

    /// Takes the speed for the time to come.
    /// @param stiffness of the value against what the speed moves, not negative
    /// @param interval s, since the last look; @param time, driftTime s; @param largest speed, positive
    void look(double value, double target, double stiffness, double interval, double time, double driftTime,
              double largest) {
        if (!(stiffness > 0)) {
            forget();  // nothing resists: as fast as is allowed
            speed = value == target ? 0 : std::copysign(largest, value - target);
            return;
        }
        const double off = value - target;
        waited += interval;
        arrived = arrived || std::abs(off) <= 0.1 * std::abs(target) ||
                  (hasLast && off * (last - target) <= 0) || waited > 4 * driftTime;
        if (hasLast && arrived) {
            const double seen = (value - last) / (stiffness * interval) + speed;
            const double share = std::min(1.0, interval / driftTime);
            drift = std::clamp(drift + share * (seen - drift), -largest, largest);
        }
        speed = off / (stiffness * time) + drift;
        if (std::abs(speed) >= largest) {
            forget();
            speed = std::copysign(largest, speed);
            return;
        }
        last = value;
        hasLast = true;
    }

    void visitState(StateArchive& archive) {
        archive.finite("servoSpeed", speed);
        archive.finite("servoDrift", drift);
        archive.finite("servoLast", last);
        archive.value("servoHasLast", hasLast);
        archive.value("servoArrived", arrived);
        archive.finite("servoWaited", waited);
    }
};

/// driftTime / time at which a value may be softer than thought by a factor of 4.4 and still does not ring.
inline constexpr double servoDriftTimes = 16;

}  // namespace pendular
