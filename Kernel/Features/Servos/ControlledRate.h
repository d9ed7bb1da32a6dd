#pragma once

#include "Kernel/Features/Servos/Servo.h"

namespace pendular {

/// A rate (1/s) at which a periodic scene is sheared or strained: given, or found by a servo so that a stress
/// becomes its target.
struct ControlledRate {
    double rate = 0;            // 1/s
    bool isControlled = false;  // by the servo
    double stress = 0;          // Pa, the target
    double time = 0;            // s, of the servo
    double largestRate = 0;     // 1/s, of the servo
    Servo servo{};

    /// The servo has this target from now on; what it has learnt stays, if there was one.
    void aimAt(double target, double within, double most) {
        if (isControlled) servo.beginAnew(within == time);
        else servo = {.speed = rate};
        isControlled = true;
        stress = target;
        time = within;
        largestRate = most;
    }

    /// The settings of set-up, which must be the same in a scene that goes on.
    void visitFirst(StateArchive& archive) const {
        archive.same("firstRate", rate, "1/s");
        archive.same("firstStress", stress, "Pa");
        archive.same("firstTime", time, "s");
        archive.same("firstLargestRate", largestRate, "1/s");
    }
    /// The rate as the run has made it.
    void visitNow(StateArchive& archive) {
        archive.value("isControlled", isControlled);
        archive.finite("rate", rate);
        archive.finite("stress", stress);
        archive.finite("time", time);
        archive.finite("largestRate", largestRate);
        servo.visitState(archive);
    }
};

}  // namespace pendular
