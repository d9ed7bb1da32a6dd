#include "Kernel/Features/Fluid/ColumnFlow.h"

#include <fmt/format.h>

#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

ColumnFlow::ColumnFlow(const FluidMaterial& material, std::function<double(double)> superficialSpeed)
    : fluid(material), speed(std::move(superficialSpeed)) {
    checkFields(fluid);
}

void ColumnFlow::check(const FluidGrid& grid) const {
    if (grid.cells[0] != 1 || grid.cells[1] != 1)
        throw InputError(
            fmt::format("fluid: the grid has {} x {} cells across the column; ColumnFlow takes 1 x 1.",
                        grid.cells[0], grid.cells[1]));
}

void ColumnFlow::findVelocity(const FluidGrid& grid, FluidFields& fields, double time) {
    const double flux = speed(time);
    if (!std::isfinite(flux))
        throw RunError(fmt::format(
            "At time {:.6g} s fluid: superficialSpeed = {} m/s; it must be a finite number.", time, flux));
    for (std::size_t k = 0; k < grid.size(); ++k) {
        if (!(fields.porosity[k] > 0))
            throw RunError(
                fmt::format("At time {:.6g} s fluid: grains fill cell {} of the column, whose porosity is "
                            "{:.4g}; it must be above 0.",
                            time, k, fields.porosity[k]));
        fields.velocity[k] = {0, 0, (flux - fields.solidFlux[k].z) / fields.porosity[k]};
    }
}

void ColumnFlow::findPressure(const FluidGrid& grid, FluidFields& fields, const Vector<double>& gravity) {
    drop = 0;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        const double byDrag = fields.drag[k].z / fields.porosity[k];
        fields.pressureGradient[k] = fluid.density * gravity - Vector<double>{0, 0, byDrag};
        drop += byDrag * grid.spacing().z;
    }
}

void ColumnFlow::compareSetUp(StateArchive& archive, double now) {
    compareFluid(archive, fluid);
    archive.sameValues("superficialSpeed", {speed(0), speed(now)}, "m/s");
}

void ColumnFlow::visitState(StateArchive& archive) { archive.finite("pressureDrop", drop); }

}  // namespace pendular
