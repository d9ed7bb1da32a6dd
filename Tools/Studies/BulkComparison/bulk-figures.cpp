/// Runs one scene of the comparison of bulk figures with LIGGGHTS and LAMMPS, or reads what they have run.

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Drivers/Shared/ProcessorTime.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Scene/TimeStep/SoftestModulus.h"
#include "Tools/Studies/BulkComparison/PeerFiles.h"
#include "Tools/Studies/BulkComparison/PeerScene.h"

using namespace pendular;

namespace {

struct Options {
    std::string scene = "bed", integrator = "default", data, start, frames;
    std::uint64_t seed = 1;
    double step = 0.1;            // of Rayleigh's time; a share, or the error of collisions
    std::optional<double> speed;  // m/s, of collisions for the error
    std::string figure;           // by whose error the step is chosen
    double seconds = 0;           // of the processor, that another code has taken
};

void setUp(bulk::PeerScene& scene, const Options& o) {
    const double rayleigh = bulk::PeerMaterial::rayleighTime();
    scene.setTimeStep(o.step * rayleigh);
    if (o.integrator == "at-limit") return scene.setTimeStep(o.step * scene.stabilityLimit());
    if (o.integrator == "adaptive") {
        scene.setTimeStep(0.5 * scene.stabilityLimit());
        scene.setAdaptiveTimeStep(o.step);
        return;
    }
    if (o.integrator == "advised") {
        scene.setTimeStep(o.step * std::min(scene.stabilityLimit(), scene.shortestContactTime() / 25));
        return;
    }
    scene.acceptUnstableTimeStep();
    if (o.integrator == "for-error") return scene.setStepFor(o.step, o.speed);
    if (o.integrator == "for-figure") return scene.setStepFor(wantedFigure(o.figure), o.step);
    if (o.integrator == "springs-in-step") scene.setIntegrator(integrators::springsInStep);
    else if (o.integrator == "velocity-verlet") scene.setIntegrator(integrators::velocityVerlet);
    else if (o.integrator != "default")
        unknownName("integrator", o.integrator,
                    std::vector<std::string_view>{"default", "at-limit", "advised", "for-error", "for-figure",
                                                  "springs-in-step", "velocity-verlet", "adaptive"});
}

/// The figures of a run, and the time of the processor (s) that its steps have taken.
double runOurs(const bulk::BulkScene& start, const Options& o, bulk::FrameFigures& figures,
               std::size_t& steps) {
    bulk::PeerScene scene(start);
    setUp(scene, o);
    double seconds = 0;
    try {
        scene.initialise();
        figures.add(0, start.grains);
        for (double next = start.interval; next < start.endTime + 0.5 * start.interval;
             next += start.interval) {
            seconds += processorTimeOf([&] {
                while (scene.getTime() < next - 0.5 * scene.getTimeStep()) scene.step();
            });
            figures.add(scene.getTime(), scene.grainsNow(start));
        }
    } catch (const RunError& error) {
        fmt::print(stderr, "{}\n", error.what());
    }
    steps = scene.getNumberOfTimeSteps();
    return seconds;
}

void run(const Options& o) {
    bulk::BulkScene start =
        o.start.empty() ? bulk::startOf(o.scene, o.seed) : bulk::bulkScene(o.scene, o.seed);
    if (!o.start.empty()) bulk::readPeerData(o.start, start);
    if (!o.data.empty()) {
        bulk::writePeerData(o.data, start);
        fmt::print("{} {} {} {}\n", bulk::PeerMaterial::rayleighTime(), start.endTime, start.interval,
                   start.grains.size());
        return;
    }
    bulk::FrameFigures figures(start);
    double seconds = o.seconds, step = o.step * bulk::PeerMaterial::rayleighTime();
    if (!o.frames.empty()) bulk::readPeerFrames(o.frames, start, step, figures);
    else {
        std::size_t steps = 0;
        seconds = runOurs(start, o, figures, steps);
        step = start.endTime / static_cast<double>(steps);
    }
    fmt::print("{:.4g},{},{:.5g}", step, figures.survived() ? 1 : 0, seconds / start.endTime);
    if (figures.survived())
        for (const auto& [name, value] : figures.figures()) fmt::print(",{},{:.6g}", name, value);
    fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "A scene that Pendular, LIGGGHTS and LAMMPS have from the same start: prints step (s), whether all "
        "grains stayed (1 or 0), s of the processor for a second of the scene, and its bulk figures by "
        "name.");
    Options o;
    app.option_defaults()->always_capture_default();
    app.add_option("--scene", o.scene, "bed, drum, hopper, silo or impact");
    app.add_option("--seed", o.seed, "of the grains");
    app.add_option(
        "--integrator", o.integrator,
        "default, at-limit (the default, by its stability limit), advised (by the smaller of that and "
        "a contact's time / 25), for-error (setStepFor()), for-figure, springs-in-step, velocity-verlet or "
        "adaptive");
    app.add_option("--step", o.step,
                   "over Rayleigh's time of the largest grain; of at-limit, advised and adaptive: the share; "
                   "of for-error and for-figure: the error");
    app.add_option("--figure", o.figure, "of for-figure: as of softest-modulus");
    app.add_option("--speed-m-s", o.speed, "of for-error: at which grains meet; as estimated if not given");
    app.add_option("--modulus-Pa", bulk::PeerMaterial::elasticModulus, "Young's; the others have 5e6");
    app.add_option("--restitution", bulk::PeerMaterial::restitution, "the others have 0.5");
    auto* data = app.add_option("--data", o.data,
                                "write the start to this file, for read_data of the others, and print "
                                "Rayleigh's time, the end, the time between frames (s) and the grains");
    app.add_option("--start", o.start, "read the start that --data has written")->excludes(data);
    app.add_option("--frames", o.frames, "read the frames of another code, which ran with --step")
        ->excludes(data);
    app.add_option("--seconds", o.seconds, "of the processor, which the other code took");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] {
        checkValue("bulk-figures", "step", o.step, "", positive);
        checkValue("bulk-figures", "restitution", bulk::PeerMaterial::restitution, "", {0, 1, false, true});
        checkValue("bulk-figures", "modulus", bulk::PeerMaterial::elasticModulus, "Pa", positive);
        run(o);
        return 0;
    });
}
