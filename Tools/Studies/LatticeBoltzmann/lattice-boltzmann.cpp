/// Bridges and drops by the lattice Boltzmann method, as CSV.

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Tools/Studies/LatticeBoltzmann/Bridge.h"
#include "Tools/Studies/LatticeBoltzmann/Pair.h"
#include "Tools/Studies/LatticeBoltzmann/Trimer.h"

using namespace pendular;
using namespace pendular::lattice;

namespace {

struct Options {
    bool tension = false, angles = false, bridge = false, pair = false, part = false, trimer = false;
    BridgeCase scene;
    double degrees = 0;
    double otherRadius = 1, otherWetting = 0.1, otherDegrees = 0;  // of the second sphere, of a pair
    std::vector<double> drops{0.9};
    std::vector<double> volumes{0.05, 0.075, 0.1, 0.125, 0.15};
    bool isClosed = false;
    double farthest = 1.5, speed = 0.005;
    std::vector<double> wettings{-0.1, -0.05, 0.0, 0.05, 0.075, 0.1, 0.125, 0.15};
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
    checkValue("lattice-boltzmann", "--radius", o.scene.radius, "nodes", {8, 200});
    const double least = 10 / o.scene.radius;  // nodes within 6 of the sphere do not count
    for (const double drop : o.drops) checkValue("lattice-boltzmann", "--drops", drop, "R", {least, 1.4});
    fmt::print("wetting,angle_on_plane_deg,radius_of_sphere,drop,angle_on_sphere_deg,line_deg\n");
    for (const double wetting : o.wettings) {
        const double onPlane = angleOnPlane(wetting, 25, o.scene.fluid);
        for (const double drop : o.drops) {
            const DropOnSphere found = dropOnSphere(wetting, o.scene.radius, drop, o.scene.fluid);
            fmt::print("{},{:.2f},{},{},{:.2f},{:.1f}\n", wetting, onPlane, o.scene.radius, drop, found.angle,
                       found.line);
            std::fflush(stdout);
        }
    }
}

constexpr double ofSphere = 4 * std::numbers::pi / 3;

/// The exact bridge at these angles, for a mean radius and a tension of 1; none where there is none.
std::optional<CapillaryBridge> exactBridge(const std::array<double, 2>& radii,
                                           const std::array<double, 2>& degrees, double gap, double volume) {
    if (std::isnan(degrees[0] + degrees[1])) return {};
    const auto body = [&](std::size_t k) {
        return WettedBody{radii[k], degrees[k] * std::numbers::pi / 180};
    };
    return solveBridge({body(0), body(1), volume * ofSphere}, gap);
}

double exactForce(const std::array<double, 2>& radii, const std::array<double, 2>& degrees, double gap,
                  double volume) {
    const auto exact = exactBridge(radii, degrees, gap, volume);
    return exact ? exact->force() : std::numeric_limits<double>::quiet_NaN();
}

/// Where there is none: 0.
double pressureOf(const std::array<double, 2>& radii, const std::array<double, 2>& degrees, double gap,
                  double volume) {
    const auto exact = exactBridge(radii, degrees, gap, volume);
    return exact ? exact->pressure() : 0;
}

/// The angle in degrees at which the exact bridge has this waist, by halving: that of the bridge itself,
/// whose line lies where the surface of a sphere has other steps than at its pole. Not a number beyond 5 to
/// 120.
double angleOfWaist(double waist, double gap, double volume) {
    const auto waistAt = [&](double degrees) {
        const double angle = degrees * std::numbers::pi / 180;
        const auto exact = solveBridge({{1, angle}, {1, angle}, volume * ofSphere}, gap);
        return exact ? exact->profile(3)[1].radius : std::numeric_limits<double>::quiet_NaN();
    };
    double low = 5, high = 120;
    if (!(waistAt(low) < waist)) return std::numeric_limits<double>::quiet_NaN();
    for (int k = 0; k < 30; ++k) {
        const double middle = 0.5 * (low + high);
        (waistAt(middle) < waist ? low : high) = middle;  // not a number: no bridge on the axis, too large
    }
    return low;
}

void printBridge(const Options& o) {
    checkValue("lattice-boltzmann", "--angle-deg", o.degrees, "degrees", {0, 180, true, false});
    const TensionLine line(o.scene.fluid);
    BridgeCase scene = o.scene;
    scene.pressure = pressureOf({1, 1}, {o.degrees, o.degrees}, scene.gap, scene.volume);
    TwoFluids fluids = beginBridge(scene);
    const std::size_t steps = pour(fluids, scene, 0.005, o.mostSteps);
    const BridgeState state = measure(fluids, scene, line);
    const double fitted = angleOfWaist(state.waist, o.scene.gap, state.volume);
    fmt::print(
        "radius,gap,volume,wetting,angle_deg,force,thrust,exact_force,tension,liquid,other,capillary_number,"
        "off_axis,waist,angle_of_waist_deg,exact_force_of_waist,steps\n");
    fmt::print(
        "{},{},{:.5f},{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.4f},{:.4f},{:.5f},{:.2f},{:.5f},{}"
        "\n",
        o.scene.radius, o.scene.gap, state.volume, o.scene.wetting, o.degrees, state.force, state.thrust,
        exactForce({1, 1}, {o.degrees, o.degrees}, o.scene.gap, state.volume), state.tension, state.liquid,
        state.other, state.capillaryNumber, state.offAxis, state.waist, fitted,
        exactForce({1, 1}, {fitted, fitted}, o.scene.gap, state.volume), steps);
}

/// Gaps and volumes in the mean radius.
PairCase pairOf(const Options& o) {
    PairCase pair;
    pair.radius = {o.scene.radius, o.otherRadius * o.scene.radius};
    pair.wetting = {o.scene.wetting, o.otherWetting};
    const double mean = 0.5 * (pair.radius[0] + pair.radius[1]);
    pair.gap = o.scene.gap * mean;
    pair.volume = o.scene.volume * ofSphere * mean * mean * mean;
    pair.pressure = pressureOf({pair.radius[0] / mean, pair.radius[1] / mean}, {o.degrees, o.otherDegrees},
                               o.scene.gap, o.scene.volume);
    pair.fluid = o.scene.fluid;
    return pair;
}

void printPair(const Options& o) {
    const TensionLine line(o.scene.fluid);
    const PairCase pair = pairOf(o);
    TwoFluids fluids = beginPair(pair);
    const std::size_t steps = pour(fluids, pair, 0.005, o.mostSteps);
    const PairState state = measure(fluids, pair, line);
    const double mean = 0.5 * (pair.radius[0] + pair.radius[1]), unit = state.tension * mean,
                 volume = state.volume / (ofSphere * mean * mean * mean);
    fmt::print(
        "radius,other_radius,gap,volume,wetting,other_wetting,force,other_force,exact_force,tension,steps\n");
    fmt::print("{},{},{},{:.5f},{},{},{:.5f},{:.5f},{:.5f},{:.5f},{}\n", pair.radius[0], pair.radius[1],
               o.scene.gap, volume, o.scene.wetting, o.otherWetting, state.force[0] / unit,
               state.force[1] / unit,
               exactForce({pair.radius[0] / mean, pair.radius[1] / mean}, {o.degrees, o.otherDegrees},
                          o.scene.gap, volume),
               state.tension, steps);
}

void printParting(const Options& o) {
    checkValue("lattice-boltzmann", "--farthest", o.farthest, "R", {o.scene.gap, 10, true, false});
    const TensionLine line(o.scene.fluid);
    PairCase pair = pairOf(o);
    const double mean = 0.5 * (pair.radius[0] + pair.radius[1]), ofMean = ofSphere * mean * mean * mean;
    pair.room = (o.farthest - o.scene.gap) * mean;
    TwoFluids fluids = beginPair(pair);
    pour(fluids, pair, 0.005, o.mostSteps);
    fmt::print(
        "radius,other_radius,wetting,other_wetting,speed,gap,volume,force,other_force,share,other_share\n");
    const std::string what = fmt::format("{},{},{},{},{}", pair.radius[0], pair.radius[1], pair.wetting[0],
                                         pair.wetting[1], o.speed);
    const PartingEnd end = part(fluids, pair, {o.speed}, line, [&](const PartingRow& row) {
        fmt::print("{},{:.4f},{:.5f},{:.5f},{:.5f},,\n", what, row.gap / mean, row.volume / ofMean,
                   row.force[0] / mean, row.force[1] / mean);
    });
    fmt::print("{},{:.4f},,,,{:.5f},{:.5f}\n", what, end.gap / mean, end.share[0], end.share[1]);
    fmt::print("# of the liquid, {:.4f} was given or taken so that its mass stays\n", end.corrected);
}

/// One run in which liquid is added, at rest after each time. Beside it what separate exact bridges have:
/// they meet on a sphere at a filling angle of 30 degrees.
void printTrimer(const Options& o) {
    for (const double volume : o.volumes)
        checkValue("lattice-boltzmann", "--volumes", volume, "of a sphere", {0.001, 1});
    const TensionLine line(o.scene.fluid);
    TrimerCase trimer;
    trimer.radius = o.scene.radius, trimer.gap = o.scene.gap, trimer.wetting = o.scene.wetting;
    trimer.volume = o.volumes.at(0), trimer.isClosed = o.isClosed, trimer.fluid = o.scene.fluid;
    const int bridges = trimer.isClosed ? 3 : 2;
    trimer.pressure = pressureOf({1, 1}, {o.degrees, o.degrees}, trimer.gap, trimer.volume / bridges);
    TwoFluids fluids = beginTrimer(trimer);
    fmt::print(
        "radius,gap,wetting,bridges,volume,pair_force,other_pair_force,section,pocket_full,"
        "third_gap_full,exact_force,exact_filling_deg,steps\n");
    for (const double volume : o.volumes) {
        const std::size_t steps = pour(fluids, trimer, volume, 0.005, o.mostSteps);
        const TrimerState state = measure(fluids, trimer, line);
        fmt::print("{},{},{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:d},{:d},", trimer.radius, trimer.gap,
                   trimer.wetting, bridges, state.volume, state.pairForce, state.otherPairForce,
                   state.section, state.isPocketFull, state.isThirdGapFull);
        const auto exact = exactBridge({1, 1}, {o.degrees, o.degrees}, trimer.gap, state.volume / bridges);
        if (exact)
            fmt::print("{:.5f},{:.2f},", exact->force(), exact->firstFillingAngle() * 180 / std::numbers::pi);
        else fmt::print(",,");
        fmt::print("{}\n", steps);
        std::fflush(stdout);
    }
}

int run(const Options& o) {
    if (o.tension) printTensions(o.scene.fluid);
    if (o.angles) printAngles(o);
    if (o.bridge) printBridge(o);
    if (o.pair) printPair(o);
    if (o.part) printParting(o);
    if (o.trimer) printTrimer(o);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Prints CSV of two fluids by the lattice Boltzmann method of Shan and Chen, as Yang, Sega and "
        "Harting use it: "
        "the tension of a flat interface, the contact angle over Delta rho, a bridge between two spheres "
        "beside the exact one, one that is drawn out until it breaks, or bridges that merge. In lattice "
        "units; gaps are in R, "
        "volumes in those of a sphere, forces in "
        "gamma R.");
    Options o;
    o.scene.fluid.threads = processorCount();
    app.option_defaults()->always_capture_default();
    auto* what = app.add_option_group("what", "what is computed");
    what->add_flag("--tension", o.tension, "over the density");
    what->add_flag("--angles", o.angles, "over Delta rho, on a plane and on a sphere");
    what->add_flag("--bridge", o.bridge, "the force of a bridge");
    what->add_flag("--pair", o.pair, "the forces of a bridge between spheres of unlike radii or angles");
    what->add_flag("--part", o.part, "a bridge of a pair that parts at a speed until it breaks");
    what->add_flag("--trimer", o.trimer, "bridges between three spheres, to which liquid is added");
    what->require_option(1);
    app.add_option("--radius", o.scene.radius, "of a sphere, nodes");
    app.add_option("--gap", o.scene.gap, "between the spheres");
    app.add_option("--volume", o.scene.volume, "of the liquid");
    app.add_option("--wetting", o.scene.wetting, "Delta rho");
    app.add_option("--angle-deg", o.degrees,
                   "of this Delta rho on this sphere (--angles), for the exact bridge");
    app.add_option("--start", o.scene.start, "off the axis, where the liquid begins, in R (--bridge)");
    app.add_option("--radius2", o.otherRadius, "of the second sphere, over the first one's; R is their mean");
    app.add_option("--wetting2", o.otherWetting, "Delta rho of the second sphere");
    app.add_option("--angle2-deg", o.otherDegrees, "of the second sphere");
    app.add_option("--farthest", o.farthest, "gap to which a pair parts");
    app.add_option("--speed", o.speed, "of parting, nodes a step");
    app.add_option("--wettings", o.wettings, "of --angles")->delimiter(',');
    app.add_option("--volumes", o.volumes, "of all liquid, one after the other (--trimer)")->delimiter(',');
    app.add_flag("--closed", o.isClosed, "begin with three bridges, not two (--trimer)");
    app.add_option("--drops", o.drops, "of --angles on the sphere: radii at the beginning, R")
        ->delimiter(',');
    app.add_option("--coupling", o.scene.fluid.coupling, "G, with neighbours weighted 2 and 1");
    app.add_option("--most-steps", o.mostSteps, "until the force is at rest");
    app.add_option("--threads", o.scene.fluid.threads, "share the lattice");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
