#include "Tools/Studies/AccuracyVersusCost/ViscousStability.h"

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/AccuracyVersusCost/ViscousBed.h"

namespace pendular {

void chartViscousStability(const ViscousStabilityOptions& options) {
    CsvFile file(options.file,
                 "bed,bridges_of_a_grain,fastest_rate_times_effective_mass_over_resistance,scheme,"
                 "largest_step_times_resistance_over_effective_mass,in_closed_form,advised");
    for (const BridgeNetwork& network : {networks::pair(), networks::chain(), networks::simpleCubic(),
                                         networks::faceCentred(), networks::random()}) {
        const double rate = network.fastestRate();
        for (const BedScheme& scheme : bedSchemes) {
            const double measured = criticalResistance(network, scheme);
            file.line(fmt::format("{},{:.4g},{:.5g},{},{:.4g},{:.4g},{:.4g}", network.name,
                                  network.bridgesOfAGrain(), rate, scheme.name, measured, scheme.limit(rate),
                                  ViscousBed(network, scheme, 1).advised()));
            fmt::print("{:<20} {:<26} {:8.4g}, in closed form {:8.4g}\n", network.name, scheme.name, measured,
                       scheme.limit(rate));
        }
    }
    file.close();
}

}  // namespace pendular
