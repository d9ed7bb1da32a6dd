/// Accuracy against cost, and where methods fail, as tables for charts.

#include <CLI/CLI.hpp>

#include "Kernel/InputError.h"
#include "Kernel/Simulation/Program.h"
#include "Tools/AccuracyVersusCost/BridgeChart.h"
#include "Tools/AccuracyVersusCost/FailureMap.h"
#include "Tools/AccuracyVersusCost/TimeChart.h"

using namespace pendular;

int main(int argc, char** argv) {
    CLI::App app("Accuracy against cost, and where methods fail, as tables for charts.");
    BridgeChartOptions chart;
    FailureMapOptions map;
    TimeChartOptions time;
    bool ofBridges = false, ofFailures = false, ofTime = false;
    std::string output;
    app.add_flag(
        "--bridges", ofBridges,
        "liquid bridge laws: errors of force, rupture distance and work of rupture (%) over populations "
        "of bridges, against the time of force and preparation (ns)");
    app.add_flag("--failure-maps", ofFailures,
                 "liquid bridge laws: the largest error of the force (%) for each V* and contact angle");
    app.add_flag("--time", ofTime,
                 "integrators: errors of collisions (%) over the steps for the time of a contact, and what "
                 "they cost");
    app.add_option("--output", output,
                   "table to write; bridges.csv, failure-maps.csv or time.csv if not given");
    app.add_option("--count", chart.bridges, "bridges of each population")->capture_default_str();
    app.add_option("--seed", chart.seed, "of the random bridges")->capture_default_str();
    app.add_option("--runs", chart.runs, "measurements of time, of which the fastest counts")
        ->capture_default_str();
    app.add_option("--volumes", map.volumes, "of a failure map, from V* = 1e-9 to 10")->capture_default_str();
    app.add_option("--angles", map.angles, "of a failure map, from 0 to 180 degrees")->capture_default_str();
    app.add_option("--offsets", time.offsets, "begins of a touch within a step")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    return runProgram([&] {
        if (ofBridges + ofFailures + ofTime != 1)
            throw InputError("accuracy-versus-cost: give one of --bridges, --failure-maps and --time.");
        if (!output.empty()) chart.file = map.file = time.file = output;
        if (ofBridges) chartBridges(chart);
        else if (ofFailures) mapFailures(map);
        else chartTime(time);
        return 0;
    });
}
