#include "Tools/Studies/AccuracyVersusCost/ViscousChart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/AccuracyVersusCost/ViscousPair.h"
#include "Tools/Studies/AccuracyVersusCost/ViscousTiming.h"

namespace pendular {
namespace {

/// Longer steps need more starts, and take less time.
int startsFor(double way, int starts) { return std::max(4, static_cast<int>(std::min(way, 1.0) * starts)); }

struct NamedScheme {
    const char* name;
    ViscousScheme scheme;
    double normal = infinity, withTangential = infinity;  // ns
};

/// The schemes take turns, so that a clock that is faster for a while is so for all.
void measureTimes(std::array<NamedScheme, 3>& schemes, int runs) {
    const int runsOfTurn = std::min(runs, 10);
    for (int run = 0; run < runs; run += runsOfTurn)
        for (NamedScheme& s : schemes) {
            const auto time = [&](TangentialLubrication tangential) {
                return viscousTime(s.scheme, tangential, runsOfTurn);
            };
            s.normal = std::min(s.normal, time(TangentialLubrication::None));
            s.withTangential = std::min(s.withTangential, time(TangentialLubrication::Pair));
        }
}

}  // namespace

void chartViscousBridges(const ViscousChartOptions& options) {
    checkValue("accuracy-versus-cost", "viscous starts", options.starts, "", {1, 1e4});
    checkValue("accuracy-versus-cost", "viscous runs", options.runs, "", {1, 1e7});
    std::array<NamedScheme, 3> schemes{{{"gap", ViscousScheme::Gap},
                                        {"implicit", ViscousScheme::Implicit},
                                        {"explicit", ViscousScheme::Explicit}}};
    measureTimes(schemes, options.runs);
    CsvFile file(options.file,
                 "scheme,stokes_number,way_of_a_step_over_roughness,viscosity_Pa_s,radius_m,speed_m/s,"
                 "touching_speed_error_over_speed,restitution_error,stopping_gap_error_over_gap,"
                 "normal_ns_per_bridge_and_step,with_tangential_ns_per_bridge_and_step");
    for (const NamedScheme& s : schemes) {
        fmt::print("{:<9} {:5.2f} ns a bridge and step, {:5.2f} with slip and rolling\n", s.name, s.normal,
                   s.withTangential);
        for (const double stokes : {0.1, 0.3, 1.0, 5.0, 10.0, 30.0, 100.0, 300.0, 1000.0})
            for (const double way : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0}) {
                if (way < options.shortestWay) continue;
                for (const double viscosity : {1e-3, 0.1, 10.0})
                    for (const double radius : {1e-5, 2e-4, 5e-3}) {
                        const ViscousPair pair{radius, viscosity, stokes};
                        const auto errors =
                            viscousErrors(pair, s.scheme, way, startsFor(way, options.starts));
                        file.line(fmt::format("{},{},{},{},{},{:.4g},{:.3g},{:.3g},{:.3g},{:.2f},{:.2f}",
                                              s.name, stokes, way, viscosity, radius, pair.speed(),
                                              errors.touchingSpeed, errors.restitution, errors.stoppingGap,
                                              s.normal, s.withTangential));
                    }
            }
    }
    file.close();
}

}  // namespace pendular
