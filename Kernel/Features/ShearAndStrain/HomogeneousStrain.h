#pragma once

#include <array>
#include <cmath>

#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Features/Servos/ControlledRate.h"

namespace pendular {

/// How the length of a periodic scene along an axis changes: the rate is that of its logarithm, and the
/// stress (compression positive) that along the axis.
struct AxisStrain : ControlledRate {
    double oneWay = 0;  // strain by the servo since the sign of its rate changed
};

/// Homogeneous strain of a periodic scene: images that follow each other along an axis move apart, or
/// together, with the speed rate x length. In a step that speed u is constant. Where it changes, from one
/// step to the next, all grains get the change of the flow, change of u/L x (place - middle), so that each of
/// them and each of its images have the same motion against the flow, whichever of them the scene keeps: to
/// round-off. (With a constant rate that is the acceleration rate^2 x (place - middle).) A grain that flies
/// freely then loses its speed C against the flow as C x L = const.
struct HomogeneousStrain {
    std::array<AxisStrain, 3> axes{};
    bool isSet = false;

    /// Takes the rates for a step (s) to come. Returns by how much the speed of the images over the length
    /// has changed (1/s).
    Vector<double> begin(PeriodicBox& box, double step) const {
        const Vector<double> before = box.strainRate;
        // The speed is such that the length grows by exp(rate x step).
        const auto speed = [step](const AxisStrain& axis) { return std::expm1(axis.rate * step) / step; };
        box.strainRate = {speed(axes[0]), speed(axes[1]), speed(axes[2])};
        return box.strainRate - before;
    }
    /// Moves the images to where they are after a step (s), about the same middle.
    static void move(PeriodicBox& box, double step) {
        const Vector<double> middle = box.middle();
        const auto grow = [step](double& length, double& rate) {
            const double factor = 1 + step * rate;
            length *= factor;
            rate /= factor;
        };
        grow(box.length.x, box.strainRate.x);
        grow(box.length.y, box.strainRate.y);
        grow(box.length.z, box.strainRate.z);
        box.lowest = middle - 0.5 * box.length;
    }
};

}  // namespace pendular
