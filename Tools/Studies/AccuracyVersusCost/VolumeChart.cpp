#include "Tools/Studies/AccuracyVersusCost/VolumeChart.h"

#include <fmt/format.h>

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/AccuracyVersusCost/DryingBridges.h"
#include "Tools/Timing/BridgeTiming.h"

namespace pendular {
namespace {

template <class Law>
void writeLaw(CsvFile& file, int runs) {
    const auto bridges = BridgePopulation{{1e-3, 1e-3}, 0, {1e-4, 0.01}, {0, 0}}.draw(16 * Pack::lanes, 1);
    const double force = forceTime<Law>(bridges, runs), prepare = prepareTime<Law>(bridges, runs);
    for (const double share : {1e-3, 1e-4, 1e-5})
        for (const double threshold : {0.0, 1e-4, 1e-3, 1e-2}) {
            const StaleForce found = dryBridges<Law>(threshold, share, 8);
            const double cost = force + found.preparations * prepare;
            file.line(fmt::format("{},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.2f},{:.1f},{:.2f}", Law::name,
                                  100 * share, 100 * threshold, 100 * found.rootMeanSquare,
                                  100 * found.largest, 100 * found.beyondRupture, found.preparations, force,
                                  prepare, cost));
            fmt::print("{:<26} {:6} % a step, at {:4} %: force {:8.3g} % rms, {:8.2f} ns\n", Law::name,
                       100 * share, 100 * threshold, 100 * found.rootMeanSquare, cost);
        }
}

}  // namespace

void chartVolumes(const VolumeChartOptions& options) {
    checkValue("accuracy-versus-cost", "volume runs", options.runs, "", {1, 1e7});
    CsvFile file(
        options.file,
        "law,change_of_volume_percent_per_step,prepared_at_change_percent,force_rms_error_percent,"
        "force_largest_error_percent,lost_beyond_rupture_percent,preparations_per_step,force_ns_per_bridge,"
        "prepare_ns_per_bridge,cost_ns_per_bridge_and_step");
    writeLaw<LiquidBridgeWillett>(file, options.runs);
    writeLaw<LiquidBridgeLianSeville>(file, options.runs);
    writeLaw<LiquidBridgeBagheri>(file, options.runs);
    writeLaw<LiquidBridgeYoungLaplace>(file, options.runs);
    file.close();
}

}  // namespace pendular
