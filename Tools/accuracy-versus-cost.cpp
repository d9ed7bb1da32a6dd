/// Charts accuracy against cost.

#include <CLI/CLI.hpp>

#include "Kernel/InputError.h"
#include "Kernel/Simulation/Program.h"
#include "Tools/AccuracyVersusCost/BridgeChart.h"

using namespace pendular;

int main(int argc, char** argv) {
    CLI::App app("Accuracy against cost, as CSV for a chart.");
    BridgeChartOptions bridges;
    bool ofBridges = false;
    app.add_flag(
        "--bridges", ofBridges,
        "liquid bridge laws: errors of force, rupture distance and work of rupture (%) over populations of "
        "bridges, against the time of force and preparation (ns)");
    app.add_option("--output", bridges.file, "table to write")->capture_default_str();
    app.add_option("--count", bridges.bridges, "bridges of each population")->capture_default_str();
    app.add_option("--seed", bridges.seed, "of the random bridges")->capture_default_str();
    app.add_option("--runs", bridges.runs, "measurements of time, of which the fastest counts")
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    return runProgram([&] {
        if (!ofBridges) throw InputError("accuracy-versus-cost: nothing to chart; give --bridges.");
        chartBridges(bridges);
        return 0;
    });
}
