/// Spheres, clumps, ellipsoids and blocks fill a hopper through an inlet and leave it through an orifice:
/// their flow over its diameter, and Beverloo's law fitted to it.

#include <fmt/format.h>

#include "Drivers/MixedHopper/MixedHopperScene.h"
#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/MeanFlow.h"
#include "Kernel/Foundation/Files/CsvFile.h"

using namespace pendular;

namespace {

struct Options {
    MixedHopper hopper;
    std::vector<double> orifices{0.02, 0.024, 0.028};  // m, diameters
    std::vector<double> shares{1, 1, 1, 1};            // of spheres, clumps, ellipsoids, blocks
    double begin = 0.07;                               // s, of the steady part
    double endTime = 0.17;                             // s
    double interval = 0.002;                           // s
    RunOptions run{.output = "MixedHopper-output"};
};

void check(Options& o) {
    checkNumberOfGrains("MixedHopper", o.hopper.number);
    double sum = 0;
    for (const double share : o.shares) {
        checkValue("MixedHopper", "--shares", share, "", {0, 1e6});
        sum += share;
    }
    checkValue("MixedHopper", "sum of --shares", sum, "", positive);
    std::copy(o.shares.begin(), o.shares.end(), o.hopper.shares.begin());
    checkValue("MixedHopper", "--end-time-s", o.endTime, "s", {o.begin, infinity, false, false});
    for (const double orifice : o.orifices)
        checkValue("MixedHopper", "--orifice-m", orifice, "m", {0, o.hopper.diameter, false, false});
}

/// From one time (s) to another one.
MeanFlow flowOf(const MixedHopperScene& scene, double from, double to) {
    const auto part = partOf(scene.getCurve(), from, to);
    return part.size() < 2 ? MeanFlow{0, unset} : meanFlow(part);
}

struct Discharge {
    double orifice, density, flow, error, change;  // m, kg/m^3, kg/s, kg/s, change over the flow
};

Discharge discharge(const Options& o, double orifice, CsvFile& curves) {
    MixedHopperScene scene(o.hopper, orifice, o.interval);
    o.run.apply(scene, dischargeName(orifice));
    scene.setTimeMax(o.hopper.fillingTime() + o.endTime);
    scene.solve();
    for (const CurvePoint& p : scene.getCurve()) curves.row(orifice, p.x, p.y);
    if (scene.getCurve().empty()) return {orifice, 0, 0, unset, 0};
    const double end = std::min(o.endTime, scene.getCurve().back().x), middle = 0.5 * (o.begin + end);
    const auto [flow, error] = flowOf(scene, o.begin, end);
    return {orifice, scene.getBulkDensity(), flow, error,
            flow > 0 ? (flowOf(scene, middle, end).flow - flowOf(scene, o.begin, middle).flow) / flow : 0};
}

void run(const Options& o) {
    CsvFile curves(o.run.output + "/discharge.csv", "orifice_m,time_s,mass_kg");
    std::vector<Discharge> runs;
    std::vector<CurvePoint> flows;
    for (const double orifice : o.orifices) {
        runs.push_back(discharge(o, orifice, curves));
        if (runs.back().flow > 0) flows.push_back({orifice, runs.back().flow});
        if (!o.run.quiet)
            fmt::print(
                "orifice {:.4g} m: {:.4g} +- {:.2g} kg/s ({:+.1f} % from the first half to the second), bulk "
                "density {:.0f} kg/m^3\n",
                orifice, runs.back().flow, runs.back().error, 100 * runs.back().change, runs.back().density);
    }
    curves.close();
    if (flows.size() < 2)
        throw InputError(
            fmt::format("MixedHopper: bodies flowed through {} of {} orifices from {:g} s to {:g} s, and the "
                        "law needs two: take "
                        "wider ones, or another time.",
                        flows.size(), runs.size(), o.begin, o.endTime));
    checkValue("MixedHopper", "bulk density of the filling", runs.front().density, "kg/m^3", positive);
    const BeverlooLaw law = fitBeverloo(flows, runs.front().density, MixedHopper::gravity, o.hopper.size);
    CsvFile table(o.run.output + "/flow.csv",
                  "orifice_m,flow_kg/s,change_of_flow,bulk_density_kg/m3,beverloo_kg/s,flow_error_kg/s");
    for (const Discharge& one : runs)
        table.row(one.orifice, one.flow, one.change, one.density, law.flow(one.orifice), one.error);
    table.close();
    if (!o.run.quiet)
        fmt::print(
            "Beverloo's law: C = {:.3f}, k = {:.2f}, with d of equal volume; wrote {}/discharge.csv and "
            "{}/flow.csv\n",
            law.coefficient, law.emptyAnnulus, o.run.output, o.run.output);
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "MixedHopper",
        .description =
            "Spheres, clumps, ellipsoids and blocks fill a hopper and leave it through an orifice.",
        .options = o.run,
        .addOptions =
            [&](CLI::App& app) {
                app.option_defaults()->always_capture_default();
                app.add_option("--orifice-m", o.orifices, "diameters of the orifices, m, one run for each")
                    ->expected(2, 100);
                app.add_option("--shares", o.shares,
                               "of spheres, clumps, ellipsoids and blocks, of the number of bodies")
                    ->expected(4);
                addRunOptionsOfSeveral(app, o.run, "discharge.csv and flow.csv", "orifice-DIAMETER");
            },
        .numbers = {
            {"number", "", &o.hopper.number, {1, 1e6}, "of bodies"},
            {"diameter", "m", &o.hopper.size, {1e-4, 0.1}, "of spheres of a mean body's volume, d"},
            {"hopper-diameter", "m", &o.hopper.diameter, positive, "of the hopper"},
            {"elastic-modulus", "Pa", &o.hopper.youngModulus, positive, "Young's modulus"},
            {"friction", "", &o.hopper.friction, {0, 10}, "coefficient of friction of bodies and walls"},
            {"begin",
             "s",
             &o.begin,
             {0, infinity, true, false},
             "start of the steady part, after the opening"},
            {"end-time", "s", &o.endTime, positive, "end of each run, after the opening"},
            {"interval", "s", &o.interval, positive, "between two rows of discharge.csv"},
            {"seed", "", &o.hopper.seed, {0, 1e9}, "of the places and turns with which bodies come"}}};
    return runDriver(driver, argc, argv, [&] {
        check(o);
        run(o);
    });
}
