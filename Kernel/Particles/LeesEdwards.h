#pragma once

#include <cmath>

#include "Kernel/Particles/PeriodicBox.h"

namespace pendular {

/// Shear without walls: the images of a periodic scene along the gradient move along the flow with the speed
/// rate x length, so that a flow whose velocity grows by the rate with each metre goes on for ever. Source:
/// Lees and Edwards (1972), J. Phys. C 5, 1921.
struct LeesEdwards {
    int flow = 0, gradient = 1;  // axes
    double rate = 0;             // 1/s, of the velocity along the flow over the place along the gradient
    bool isSet = false;

    /// Where the images are at a time (s). It depends on the time alone, not on the steps to it.
    void move(PeriodicBox& box, double time) const {
        if (!isSet) return;
        const double width = box.length.*axes[gradient], period = box.length.*axes[flow];
        const double slid = std::fmod(rate * width * time, period);
        box.imagesMove = true;
        box.across.*axes[gradient] = 1 / width;
        box.imageShift.*axes[gradient] = width;
        box.imageShift.*axes[flow] = slid < 0 ? slid + period : slid;
        box.imageVelocity.*axes[flow] = rate * width;
    }

    static constexpr double Vector<double>::*axes[] = {&Vector<double>::x, &Vector<double>::y,
                                                       &Vector<double>::z};
};

}  // namespace pendular
