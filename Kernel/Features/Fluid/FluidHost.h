#pragma once

#include "Kernel/Features/Fluid/FluidGrid.h"

namespace pendular {

class StateArchive;

/// Who computes the fluid: a closed form, a solver of one's own, another program. A FluidPart calls it in
/// each step, in this order.
class FluidHost {
public:
    FluidHost() = default;
    FluidHost(const FluidHost&) = delete;
    FluidHost& operator=(const FluidHost&) = delete;
    virtual ~FluidHost() = default;

    /// Throws InputError for what cannot be; at set-up.
    virtual void check(const FluidGrid&) const {}
    /// Sets `velocity`, of `porosity` and `solidFlux`. @param time s, at the start of the step
    virtual void findVelocity(const FluidGrid& grid, FluidFields& fields, double time) = 0;
    /// Sets `pressureGradient`, of `drag`. @param gravity m/s^2
    virtual void findPressure(const FluidGrid& grid, FluidFields& fields, const Vector<double>& gravity) = 0;
    /// The step's `source` is known; the number is the length of the step (s).
    virtual void take(const FluidGrid&, const FluidFields&, double /*length*/) {}
    /// Lists all that is set of it, each by archive.same(name, value, unit), so that no run goes on with
    /// another fluid; empty where nothing is. @param now s
    virtual void compareSetUp(StateArchive& archive, double now) = 0;
    /// Visits what it remembers from step to step.
    virtual void visitState(StateArchive&) {}
};

}  // namespace pendular
