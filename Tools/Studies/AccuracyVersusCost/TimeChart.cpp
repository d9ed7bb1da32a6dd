#include "Tools/Studies/AccuracyVersusCost/TimeChart.h"

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/AccuracyVersusCost/CollisionCases.h"
#include "Tools/Studies/AccuracyVersusCost/IntegratorCost.h"

namespace pendular {
namespace {

constexpr std::array stepsPerContact{5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300, 500};

template <class S>
void writeCollision(CsvFile& file, const CollisionCase<S>& studied, const IntegratorCosts& costs,
                    const TimeChartOptions& options) {
    const Aftermath exact =
        finish(studied, options.referenceSteps, 2.5, integrators::predictedVelocityVerlet);
    for (std::size_t k = 0; k < integrators::all.size(); ++k) {
        const Integrator& integrator = integrators::all[k];
        for (const int steps : stepsPerContact) {
            const auto errors =
                errorsOf(studied, exact, steps, integrator, options.offsets, options.stepLengths);
            file.row(studied.name, integrator.name, steps, steps * costs[k], 100 * errors.parting,
                     100 * errors.spin, 100 * errors.energy, 100 * errors.meanParting());
        }
    }
}

}  // namespace

void chartTime(const TimeChartOptions& options) {
    checkValue("accuracy-versus-cost", "offsets", options.offsets, "", {1, 1e6});
    checkValue("accuracy-versus-cost", "step-lengths", options.stepLengths, "", {1, 1e6});
    CsvFile file(options.file,
                 "collision,integrator,steps_per_contact,cost_in_default_steps,parting_error_percent,"
                 "spin_error_percent,energy_error_percent,mean_parting_error_percent");
    const IntegratorCosts costs = measureIntegratorCosts();
    writeCollision(file, collisions::linear(), costs, options);
    writeCollision(file, collisions::hertz(), costs, options);
    writeCollision(file, collisions::oblique(), costs, options);
    writeCollision(file, collisions::wet(), costs, options);
    writeCollision(file, collisions::sticky(), costs, options);
    file.close();
}

}  // namespace pendular
