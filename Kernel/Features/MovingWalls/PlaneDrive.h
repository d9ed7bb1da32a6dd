#pragma once

#include <cstdint>

#include "Kernel/Features/Servos/Servo.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// What a driver asks of a plane that is moved by the forces on it.
struct PlaneDriveSettings {
    enum class Kind : std::uint32_t { None, Piston, Servo };
    Kind kind = Kind::None;
    double load = 0;          // N, of a piston, onto the grains; of a servo, the target of their force
    double mass = 0;          // kg, of a piston
    double time = 0;          // s, of a servo
    double largestSpeed = 0;  // m/s, of a servo
};

/// A plane that moves along its normal by the forces on it: a piston is a body with a mass under a load; a
/// servo has the speed at which the force of the grains becomes its target. Speeds and forces are positive
/// away from the grains.
struct PlaneDrive {
    PlaneDriveSettings asked{};

    double velocity = 0;  // m/s, at the end of the last step
    double earlier = 0;   // m/s^2, of a piston, at the start of the last step
    Servo servo{};

    // The last step, for the energy ledger; nothing of it goes into the next one.
    double startVelocity = 0, seenVelocity = 0, meanVelocity = 0;  // m/s: at the start, of contacts, mean
    double acceleration = 0;                                       // m/s^2, at the end
    bool waits = false;                                            // for the first grains
    bool isChecked = false;                                        // as set-up is, since it was asked for
    bool forcesAreOld = false;  // contacts have ended since they were summed

    std::uint64_t steps = 0;        // since it began
    std::uint64_t touches = 0;      // contacts that act, at the end of the last step
    double travelled = 0;           // m, towards the grains since any touched it
    double farthest = 0;            // m, after which it must have met one; 0: not known yet
    std::uint64_t mostTouches = 0;  // for which the time step was checked

    [[nodiscard]] bool isPiston() const { return asked.kind == PlaneDriveSettings::Kind::Piston; }
    [[nodiscard]] bool isServo() const { return asked.kind == PlaneDriveSettings::Kind::Servo; }
    /// J
    [[nodiscard]] double kineticEnergy() const {
        return isPiston() ? 0.5 * asked.mass * velocity * velocity : 0;
    }

    void visitState(StateArchive& archive);
};

}  // namespace pendular
