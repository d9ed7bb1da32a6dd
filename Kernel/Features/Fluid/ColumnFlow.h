#pragma once

#include <functional>

#include "Kernel/Features/Fluid/FluidHost.h"
#include "Kernel/Features/Fluid/FluidPart.h"

namespace pendular {

/// The flow of a fluid up a column, without change across it: the least fluid that carries grains. By volume,
/// fluid and grains together have the superficial speed U(t) everywhere, which gives the fluid's velocity;
/// its momentum without the terms of its acceleration gives the pressure, -eps dp/dz = drag + eps rho g.
class ColumnFlow : public FluidHost {
public:
    /// @param superficialSpeed m/s, up (along z), over the time (s): the one at the start of a step holds for
    /// it
    ColumnFlow(const FluidMaterial& fluid, std::function<double(double)> superficialSpeed);

    /// Pa: the pressure below minus that above the cells of the last step, without the weight of the fluid.
    [[nodiscard]] double pressureDrop() const { return drop; }

    void check(const FluidGrid& grid) const override;
    void findVelocity(const FluidGrid& grid, FluidFields& fields, double time) override;
    void findPressure(const FluidGrid& grid, FluidFields& fields, const Vector<double>& gravity) override;
    /// The speed is compared at the start and now: what it will be is not known to a restart file.
    void compareSetUp(StateArchive& archive, double now) override;
    void visitState(StateArchive& archive) override;

private:
    FluidMaterial fluid;
    std::function<double(double)> speed;
    double drop = 0;
};

}  // namespace pendular
