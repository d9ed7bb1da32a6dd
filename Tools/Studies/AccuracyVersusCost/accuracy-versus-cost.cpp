/// Accuracy against cost, and where methods fail, as tables for charts.

#include <array>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/Studies/AccuracyVersusCost/BridgeChart.h"
#include "Tools/Studies/AccuracyVersusCost/BulkChart.h"
#include "Tools/Studies/AccuracyVersusCost/ContactMaps.h"
#include "Tools/Studies/AccuracyVersusCost/CriticalChart.h"
#include "Tools/Studies/AccuracyVersusCost/FailureMap.h"
#include "Tools/Studies/AccuracyVersusCost/FrictionChart.h"
#include "Tools/Studies/AccuracyVersusCost/TimeChart.h"
#include "Tools/Studies/AccuracyVersusCost/TurningChart.h"
#include "Tools/Studies/AccuracyVersusCost/ViscousChart.h"
#include "Tools/Studies/AccuracyVersusCost/ViscousStability.h"
#include "Tools/Studies/AccuracyVersusCost/VolumeChart.h"

using namespace pendular;

int main(int argc, char** argv) {
    CLI::App app("Accuracy against cost, and where methods fail, as tables for charts.");
    BridgeChartOptions chart;
    FailureMapOptions map;
    TimeChartOptions time;
    BulkChartOptions bulk;
    ContactMapOptions contacts;
    CriticalChartOptions critical;
    FrictionChartOptions friction;
    ViscousChartOptions viscous;
    VolumeChartOptions volumes;
    ViscousStabilityOptions stability;
    TurningChartOptions turning;
    std::string output;
    const auto addMode = [&](const char* name, const std::string& text) { return app.add_flag(name, text); };
    CLI::Option* const ofBridges = addMode(
        "--bridges",
        "liquid bridge laws: errors of force, rupture distance and work of rupture (%) over populations "
        "of bridges, against the time of force and preparation (ns)");
    CLI::Option* const ofFailures =
        addMode("--failure-maps",
                "liquid bridge laws: the largest error of the force (%) for each V* and contact angle");
    CLI::Option* const ofTime =
        addMode("--time",
                "integrators: errors of collisions (%) over the steps for the time of a contact, and what "
                "they cost");
    CLI::Option* const ofBulk =
        addMode("--bulk",
                "dry laws and time steps: deviations (%) of bulk figures of a poured bed and a rotating drum "
                "from those of hard Hertz-Mindlin grains, and what they cost");
    CLI::Option* const ofContacts =
        addMode("--contact-maps",
                "dry laws: restitution, pull of dashpots, onset of sliding, and overlaps over the speed");
    CLI::Option* const ofSteps = addMode(
        "--critical-steps",
        "each law: the largest stable time step, measured, against the stability limit that is given (%)");
    CLI::Option* const ofFriction = addMode(
        "--friction",
        "friction laws: errors of force, restitution, spin and loss (%) against the exact contact with "
        "partial slip, over populations of paths and impacts, and what they cost (ns)");
    CLI::Option* const ofViscous = addMode(
        "--viscous",
        "schemes of viscous bridges: errors of the speed of a touch and of restitution against closed forms, "
        "over the step, Stokes number, viscosity and radius, and what they cost (ns)");
    CLI::Option* const ofVolumes = addMode(
        "--bridge-volumes",
        "bridges whose volume changes: errors of the force (%) where they are prepared again in each step, "
        "or only after changes of 0.01, 0.1 and 1 %, and what that costs (ns)");
    CLI::Option* const ofStability = addMode(
        "--viscous-stability",
        "schemes of viscous bridges: the largest step, over m*/c, in a pair, a chain, crystals and a random "
        "bed, measured");
    CLI::Option* const ofTurning = addMode(
        "--turning",
        "schemes that turn a free rigid body: the angle (rad) by which they err after 20 s, and what they "
        "cost (ns)");
    app.add_option("--output", output,
                   "table to write, or folder of --contact-maps and --friction; MODE.csv, contact-maps or "
                   "friction, if not given");
    // An option is refused where its mode is not asked for.
    const auto add = [&](CLI::Option* mode, const char* name, auto& value, const char* text) {
        return app.add_option(name, value, text)->capture_default_str()->needs(mode);
    };
    add(ofBridges, "--count", chart.bridges, "bridges of each population");
    add(ofBridges, "--seed", chart.seed, "of the random bridges");
    add(ofBridges, "--runs", chart.runs, "measurements of time, of which the fastest counts");
    add(ofFailures, "--volumes", map.volumes, "of a failure map, from V* = 1e-9 to 10");
    add(ofFailures, "--angles", map.angles, "of a failure map, from 0 to 180 degrees");
    add(ofTime, "--offsets", time.offsets, "starts of a touch within a step");
    add(ofTime, "--step-lengths", time.stepLengths,
        "lengths of the step between the time of a contact over n and over n + 1");
    add(ofContacts, "--map-offsets", contacts.offsets, "starts of a touch within a step");
    add(ofBulk, "--elastic-modulus-Pa", bulk.elasticModulus, "Young's modulus of the reference, Pa");
    addFormerName(app, "--elastic-modulus-pa", bulk.elasticModulus)->needs(ofBulk);
    add(ofBulk, "--scene", bulk.scene, "bed, drum or both");
    add(ofBulk, "--law", bulk.law,
        "one law alone beside the reference, by its name in the table; all if not given");
    const std::array ofBed{
        add(ofBulk, "--beds", bulk.beds, "beds of each law, from different grains"),
        add(ofBulk, "--bed-particles", bulk.bedGrains, "grains of the bed"),
    };
    const std::array ofDrum{
        add(ofBulk, "--drums", bulk.drums, "drums of each law, of four measured times each"),
        add(ofBulk, "--turned-rad", bulk.turned, "angle by which the drum turns while it is measured, rad"),
    };
    add(ofFriction, "--paths", friction.paths, "paths of each population, and impacts");
    add(ofFriction, "--friction-seed", friction.seed, "of the random paths");
    add(ofFriction, "--friction-runs", friction.runs, "measurements of time, of which the fastest counts");
    add(ofViscous, "--viscous-starts", viscous.starts,
        "gaps from which a pair starts, for steps of a roughness and more");
    add(ofViscous, "--shortest-way", viscous.shortestWay,
        "of a step at the first speed, over the roughness: shorter ones are left out");
    add(ofViscous, "--viscous-runs", viscous.runs, "measurements of time, of which the fastest counts");
    add(ofVolumes, "--volume-runs", volumes.runs, "measurements of time, of which the fastest counts");
    add(ofBulk, "--rounds", bulk.rounds, "measurements of time, of which the median counts");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] {
        std::size_t modes = 0;
        for (const CLI::Option* mode : {ofBridges, ofFailures, ofTime, ofBulk, ofContacts, ofSteps,
                                        ofFriction, ofViscous, ofVolumes, ofStability, ofTurning})
            modes += mode->count();
        if (modes != 1)
            throw InputError(
                "accuracy-versus-cost: give one of --bridges, --failure-maps, --time, --bulk, "
                "--contact-maps, --critical-steps, --friction, --viscous, --bridge-volumes, "
                "--viscous-stability and --turning.");
        const auto refuse = [&](const auto& options, std::string_view scene) {
            for (const CLI::Option* option : options)
                if (option->count() > 0)
                    throw InputError(
                        fmt::format("accuracy-versus-cost: {} is of another scene than --scene {}.",
                                    option->get_name(), scene));
        };
        if (bulk.scene == "bed") refuse(ofDrum, bulk.scene);
        if (bulk.scene == "drum") refuse(ofBed, bulk.scene);
        if (!output.empty())
            chart.file = map.file = time.file = bulk.file = contacts.folder = critical.file = viscous.file =
                volumes.file = stability.file = turning.file = friction.folder = output;
        if (*ofBridges) chartBridges(chart);
        else if (*ofFailures) mapFailures(map);
        else if (*ofTime) chartTime(time);
        else if (*ofBulk) chartBulk(bulk);
        else if (*ofContacts) mapContacts(contacts);
        else if (*ofSteps) chartCriticalSteps(critical);
        else if (*ofFriction) chartFriction(friction);
        else if (*ofViscous) chartViscousBridges(viscous);
        else if (*ofVolumes) chartVolumes(volumes);
        else if (*ofStability) chartViscousStability(stability);
        else chartTurning(turning);
        return 0;
    });
}
