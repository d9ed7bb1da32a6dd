#include "Tools/Studies/AccuracyVersusCost/FailureMap.h"

#include "Kernel/Foundation/Files/CsvFile.h"

namespace pendular {
namespace {

template <class Law>
void writeMap(CsvFile& file, std::string_view name, const std::vector<ExactBridge>& exact, const Law& law) {
    for (const ExactBridge& bridge : exact) {
        const BridgeDeviation errors = deviation(modelBridge(bridge.bridge, law), bridge);
        file.line(fmt::format("{},{:.5g},{:.5g},{},{:.4g},{:.4g}", name, std::log10(bridge.bridge.volume),
                              bridge.bridge.contactAngle * (180 / std::numbers::pi),
                              static_cast<int>(regionOf(errors)), 100 * errors.largestOfForce(),
                              100 * errors.ofRuptureDistance));
    }
}

}  // namespace

void mapFailures(const FailureMapOptions& options) {
    checkValue("accuracy-versus-cost", "volumes", options.volumes, "", {2, 1e4});
    checkValue("accuracy-versus-cost", "angles", options.angles, "", {2, 1e4});
    CsvFile file(options.file,
                 "law,log10_dimensionless_volume,contact_angle_deg,region,largest_force_error_percent,"
                 "rupture_distance_error_percent");
    file.comment("regions: 0 within 5 %, 1 within 20 %, 2 beyond, 3 wrong sign, 4 not finite, 5 refused");
    const auto exact = solveExactly(mapOfBridges(options));
    forEachBridgeLaw([&]<class Law>() {
        writeMap(file, Law::name, exact, Law());
        if constexpr (requires(Law law) { law.setSolveOutsideTable(true); }) {
            Law solving;
            solving.setSolveOutsideTable(true);
            writeMap(file, fmt::format("{}+solveOutsideTable", Law::name), exact, solving);
        }
    });
    file.close();
}

}  // namespace pendular
