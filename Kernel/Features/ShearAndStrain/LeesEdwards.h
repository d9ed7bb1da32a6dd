#pragma once

#include <cmath>

#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Features/Servos/ControlledRate.h"

namespace pendular {

/// Shear without walls: the images of a periodic scene along the gradient move along the flow with the speed
/// rate x length, so that a flow whose velocity grows by the rate with each metre goes on for ever. Source:
/// Lees and Edwards (1972), J. Phys. C 5, 1921. In a step that speed is constant. Where it changes, because
/// the rate or the length does, all grains get the change of the flow, as in HomogeneousStrain.
/// The rate is that of the velocity along the flow over the place along the gradient, and the stress that of
/// the shear, against the flow.
struct LeesEdwards : ControlledRate {
    int flow = 0, gradient = 1;  // axes
    bool isSet = false;
    double atLargest = 0;  // strain, for which the servo has asked for its largest rate

    double speed = 0;   // m/s, of the images in this step
    double began = 0;   // s, since when they have it
    double offset = 0;  // m, how far they had slid then

    /// Fixes the speed of the images at the start of a run.
    LeesEdwards& settle(const PeriodicBox& box) {
        speed = rate * box.length.*vectorAxes[gradient];
        return *this;
    }

    /// Takes the rate for a step to come, which begins at a time (s). Returns by how much the speed of the
    /// images has changed (m/s), which the box then knows.
    double begin(PeriodicBox& box, double now) {
        const double before = speed;
        settle(box);
        if (speed == before) return 0;
        box.imageVelocity.*vectorAxes[flow] = speed;
        offset = box.imageShift.*vectorAxes[flow];
        began = now;
        return speed - before;
    }

    /// Moves the images to where they are at a time (s). While the speed lasts, their place depends on the
    /// time alone, not on the steps to it.
    void move(PeriodicBox& box, double now) const {
        if (!isSet) return;
        const double width = box.length.*vectorAxes[gradient], period = box.length.*vectorAxes[flow];
        const double slid = std::fmod(offset + speed * (now - began), period);
        box.imagesMove = true;
        box.across.*vectorAxes[gradient] = 1 / width;
        box.imageShift.*vectorAxes[gradient] = width;
        box.imageShift.*vectorAxes[flow] = slid < 0 ? slid + period : slid;
        box.imageVelocity.*vectorAxes[flow] = speed;
    }
};

}  // namespace pendular
