/// Grains leave a hopper through circular orifices; their flow is compared with Beverloo's law.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/HopperScene.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "Kernel/Foundation/Files/CsvFile.h"

using namespace pendular;

namespace {

struct Options {
    Hopper hopper{.number = 12000};                     // a head of two orifices to the end
    std::string sizes;                                  // file; empty: none
    double cone = 0;                                    // degrees
    std::vector<double> orifices{0.012, 0.015, 0.018};  // m, diameters
    double begin = 0.1;                                 // s, of the steady part
    double endTime = 0.4;                               // s
    double interval = 0.002;                            // s
    RunOptions run{.output = "HopperDischarge-output"};
};

void describe(CLI::App& app, Options& o) {
    app.option_defaults()->always_capture_default();
    app.add_option("--orifice-m", o.orifices, "diameters of the orifices, m, one run for each; two at least")
        ->expected(2, 100);
    app.add_option("--hopper-diameter-m", o.hopper.diameter, "diameter of the hopper, m");
    app.add_option("--grain-diameter-m", o.hopper.grainDiameter,
                   "mean diameter of the grains, m; they spread by 10 % to either side");
    app.add_option("--sizes", o.sizes,
                   "CSV file of the grains' sizes, as the page on size distributions says; the mean diameter "
                   "is then the "
                   "median by volume")
        ->type_name(fileName)
        ->excludes("--grain-diameter-m");
    app.add_option("--cone-deg", o.cone,
                   "slope of a conical bottom, degrees to the horizontal, which empties; 0: a flat bottom");
    app.add_option("--number", o.hopper.number, "grains in the hopper");
    app.add_option("--elastic-modulus-Pa", o.hopper.youngModulus, "Young's modulus, Pa");
    app.add_option("--friction", o.hopper.friction, "coefficient of sliding friction of grains and walls");
    app.add_option("--begin-s", o.begin, "start of the steady part, s after the orifice is opened");
    app.add_option("--end-time-s", o.endTime, "end of each run, s after the orifice is opened");
    app.add_option("--interval-s", o.interval, "time between two rows of discharge.csv, s");
    addRunOptionsOfSeveral(app, o.run, "discharge.csv and flow.csv", "orifice-DIAMETER");
}

void writeCurves(const Options& options, const std::vector<Discharge>& runs) {
    CsvFile curves(options.run.output + "/discharge.csv", "orifice_m,time_s,mass_kg");
    for (const Discharge& run : runs)
        for (const CurvePoint& p : run.curve) curves.row(run.orifice, p.x, p.y);
    curves.close();
}
void writeFlows(const Options& options, const std::vector<Discharge>& runs, const BeverlooLaw& law) {
    CsvFile flows(options.run.output + "/flow.csv",
                  "orifice_m,flow_kg/s,change_of_flow,beverloo_kg/s,flow_error_kg/s,head_at_end");
    for (const Discharge& run : runs)
        flows.row(run.orifice, run.mean.flow, run.change, law.flow(run.orifice), run.mean.error, run.head);
    flows.close();
}

void run(const Options& options) {
    std::vector<std::string> names;
    for (const double orifice : options.orifices) names.push_back(dischargeName(orifice));
    const std::vector<GrainRow> grains = settledHopperGrains(options.hopper, options.run, names);
    std::vector<Discharge> runs;
    std::vector<CurvePoint> flows;
    for (const double orifice : options.orifices) {
        runs.push_back(discharge(options.hopper, grains, orifice, options.begin, options.endTime,
                                 options.interval, options.run));
        flows.push_back({orifice, runs.back().mean.flow});
    }
    writeCurves(options, runs);  // also where no law can be fitted
    const BeverlooLaw law =
        fitBeverloo(flows, runs.front().bulkDensity, Hopper::gravity, options.hopper.grainDiameter);
    writeFlows(options, runs, law);
    if (options.run.quiet) return;
    for (const Discharge& run : runs)
        fmt::print(
            "orifice {:.4g} m: {:.4g} +- {:.2g} kg/s from {:.4g} s to {:.4g} s ({:+.1f} % from the first "
            "half "
            "to the second), the head is {:.2g} orifices at the end{}; the law gives {:.4g} kg/s; {} of {} "
            "grains have left\n",
            run.orifice, run.mean.flow, run.mean.error, options.begin, run.end, 100 * run.change, run.head,
            run.head < leastHead ? " (below 2 the flow falls)" : "", law.flow(run.orifice), run.number,
            grains.size());
    fmt::print(
        "Beverloo's law: C = {:.3f}, k = {:.2f}, with a bulk density of {:.0f} kg/m^3; wrote "
        "{}/discharge.csv and {}/flow.csv\n",
        law.coefficient, law.emptyAnnulus, law.bulkDensity, options.run.output, options.run.output);
}

void checkAndRun(const Options& given) {
    Options options = given;
    if (!options.sizes.empty()) {
        options.hopper.sizes = readSizeTable(options.sizes);
        options.hopper.grainDiameter = options.hopper.sizes->quantile(SizeBasis::Volume, 0.5);
    }
    options.hopper.coneSlope = options.cone * std::numbers::pi / 180;
    checkRun("HopperDischarge", options.hopper.number, options.endTime, options.interval);
    checkValue("HopperDischarge", "start of the steady part", options.begin, "s",
               {0, options.endTime, true, false});
    for (const double orifice : options.orifices)
        checkValue("HopperDischarge", "orifice diameter", orifice, "m",
                   {0, options.hopper.diameter, false, false});
    run(options);
}

}  // namespace

int main(int argc, char** argv) {
    return runDriver(
        "HopperDischarge",
        "Grains leave a flat-bottomed hopper through circular orifices: mass over time, and Beverloo's law.",
        Options(), describe, checkAndRun, argc, argv);
}
