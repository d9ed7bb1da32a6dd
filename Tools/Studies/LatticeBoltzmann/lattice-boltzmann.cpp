/// Bridges and drops by the lattice Boltzmann method, as CSV.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Base/Parallel.h"
#include "Kernel/Capillary/CapillaryBridge.h"
#include "Kernel/Simulation/Program.h"
#include "Kernel/Species/Field.h"
#include "Tools/Studies/LatticeBoltzmann/Bridge.h"

using namespace pendular;
using namespace pendular::lattice;

namespace {

struct Options {
    bool tension = false, angles = false, bridge = false;
    BridgeCase scene;
    double degrees = 0;
    std::size_t mostSteps = 60000;
};

void printTensions(const FluidSettings& fluid) {
    fmt::print("majority,minority,tension\n");
    for (const double density : {0.66, 0.68, 0.70, 0.72, 0.74}) {
        const FlatInterface flat = flatInterface(fluid, {density, 0.04});
        fmt::print("{:.5f},{:.5f},{:.6f}\n", flat.majority, flat.minority, flat.tension);
    }
}

void printAngles(const Options& o) {
    fmt::print("wetting,angle_on_plane_deg,radius_of_sphere,angle_on_sphere_deg\n");
    for (const double wetting : {-0.1, -0.05, 0.0, 0.05, 0.075, 0.1, 0.125, 0.15}) {
        fmt::print("{},{:.2f},", wetting, angleOnPlane(wetting, 25, o.scene.fluid));
        fmt::print("{},{:.2f}\n", o.scene.radius, angleOnSphere(wetting, o.scene.radius, o.scene.fluid));
        std::fflush(stdout);
    }
}

/// Of the exact bridge at this angle and the measured volume, for R = gamma = 1.
double exactForce(const BridgeCase& scene, double degrees, double volume) {
    const double angle = degrees * std::numbers::pi / 180, ofSphere = 4 * std::numbers::pi / 3;
    const auto exact = solveBridge({{1, angle}, {1, angle}, volume * ofSphere}, scene.gap);
    return exact ? exact->force() : std::numeric_limits<double>::quiet_NaN();
}

void printBridge(const Options& o) {
    checkValue("lattice-boltzmann", "--angle-deg", o.degrees, "degrees", {0, 180, true, false});
    const TensionLine line(o.scene.fluid);
    TwoFluids fluids = beginBridge(o.scene);
    const std::size_t steps = pour(fluids, o.scene, 0.005, o.mostSteps);
    const BridgeState state = measure(fluids, o.scene, line);
    fmt::print(
        "radius,gap,volume,wetting,angle_deg,force,thrust,exact_force,tension,liquid,other,capillary_number,"
        "steps\n");
    fmt::print("{},{},{:.5f},{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.4f},{}\n", o.scene.radius,
               o.scene.gap, state.volume, o.scene.wetting, o.degrees, state.force, state.thrust,
               exactForce(o.scene, o.degrees, state.volume), state.tension, state.liquid, state.other,
               state.capillaryNumber, steps);
}

int run(const Options& o) {
    if (o.tension) printTensions(o.scene.fluid);
    if (o.angles) printAngles(o);
    if (o.bridge) printBridge(o);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Prints CSV of two fluids by the lattice Boltzmann method of Shan and Chen, as Yang, Sega and "
        "Harting use it: "
        "the tension of a flat interface, the contact angle over Delta rho, or a bridge between two equal "
        "spheres "
        "beside the exact one. In lattice units; gaps are in R, volumes in those of a sphere, forces in "
        "gamma R.");
    Options o;
    o.scene.fluid.threads = processorCount();
    app.option_defaults()->always_capture_default();
    auto* what = app.add_option_group("what", "what is computed");
    what->add_flag("--tension", o.tension, "over the density");
    what->add_flag("--angles", o.angles, "over Delta rho, on a plane and on a sphere");
    what->add_flag("--bridge", o.bridge, "the force of a bridge");
    what->require_option(1);
    app.add_option("--radius", o.scene.radius, "of a sphere, nodes");
    app.add_option("--gap", o.scene.gap, "between the spheres");
    app.add_option("--volume", o.scene.volume, "of the liquid");
    app.add_option("--wetting", o.scene.wetting, "Delta rho");
    app.add_option("--angle-deg", o.degrees,
                   "of this Delta rho on this sphere (--angles), for the exact bridge");
    app.add_option("--coupling", o.scene.fluid.coupling, "G, with neighbours weighted 2 and 1");
    app.add_option("--relaxation", o.scene.fluid.relaxation, "tau");
    app.add_option("--most-steps", o.mostSteps, "until the force is at rest");
    app.add_option("--threads", o.scene.fluid.threads, "share the lattice");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
