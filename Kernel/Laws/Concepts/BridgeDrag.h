#pragma once

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// The force and torque on body 1 of a bridge that resists sliding and rolling.
template <class T>
struct BridgeDrag {
    Vector<T> force;   // N, at the contact point
    Vector<T> torque;  // N, the torque over the effective radius
};

/// Two tangential motions of a contact at the moment of the force: without it, slip and roll are the
/// velocities (m/s) of BridgeResistance, and they change by the responses (m/s per N) times force and torque
/// over R*.
template <class T>
struct BridgeSlip {
    Vector<T> slip, roll;
    T slipResponse, rollResponse;
};

/// These motions with the drag of the bridge: with C the symmetric matrix of the resistance and P the
/// diagonal one of the responses, (1 + P C) v = v0. (The response of the roll to the force, zero between
/// equal grains, is left to the next step.)
template <class T>
struct MotionWithDrag {
    MotionWithDrag(const BridgeResistance<T>& c, const BridgeSlip<T>& motion) {
        const T slipBySlip = fma(motion.slipResponse, c.sliding, T(1));
        const T rollByRoll = fma(motion.rollResponse, c.rolling, T(1));
        const T slipByRoll = motion.slipResponse * c.coupling, rollBySlip = motion.rollResponse * c.coupling;
        const T inverse = T(1) / (slipBySlip * rollByRoll - slipByRoll * rollBySlip);
        slip = fma(-slipByRoll * inverse, motion.roll, (rollByRoll * inverse) * motion.slip);
        roll = fma(-rollBySlip * inverse, motion.slip, (slipBySlip * inverse) * motion.roll);
        slipResponse = (rollByRoll * inverse) * motion.slipResponse;
    }

    Vector<T> slip, roll;  // m/s
    T slipResponse;        // of the slip to a force beside the drag, m/s per N
};

/// The drag at the velocities that it leaves itself: -C v.
template <class T>
BridgeDrag<T> bridgeDrag(const BridgeResistance<T>& c, const BridgeSlip<T>& motion, const Vector<T>& normal) {
    const MotionWithDrag<T> with(c, motion);
    const Vector<T> along = fma(c.coupling, with.slip, c.rolling * with.roll);
    return {-fma(c.sliding, with.slip, c.coupling * with.roll), -cross(along, normal)};
}

}  // namespace pendular
