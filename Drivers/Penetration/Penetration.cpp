/// A steel sphere hits a bed of grains: case 3 of Dosta et al., "Comparing open-source DEM frameworks for
/// simulations of common bulk processes", Comput. Phys. Commun. 296 (2024) 109066.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/FirstState.h"
#include "Drivers/Shared/PenetrationScene.h"
#include "Kernel/Analysis/Output/RunTable.h"

using namespace pendular;

namespace {

struct Options : FirstState {
    Options() { number = 5000; }

    double speed = PenetrationScene::publishedSpeed;  // m/s
    double endTime = 0.1;                             // s
    double interval = 5e-4;                           // s
    bool wholeTime = false;
    RunOptions run{.output = "Penetration-output"};
};

class Penetration : public PenetrationScene {
public:
    template <class Walls>
    Penetration(const Options& given, const PenetrationGrains& grains, const Walls& walls)
        : PenetrationScene(grains, walls, given.speed, given.softening), options(given) {
        if (!options.grains.empty()) acceptOverlaps(largestSoundOverlap);  // has not settled here
        setTimeMax(options.endTime);
        setSaveCount(stepsOf(options.interval, getTimeStep()));
        options.run.apply(*this);
    }

    void writeOutput() override {
        depths.row(getTime(), intruder().getPosition().z(), intruder().getVelocity().z(), penetration(),
                   intruder().getForce().z());
    }
    void actionsAfterTimeStep() override {
        const Fall now = fall();
        deepest = std::max(deepest, now.depth);
        stopped = now.depth > 0 && now.velocity >= 0;
    }
    [[nodiscard]] bool continueSolve() const override { return options.wholeTime || !stopped; }

    void visitState(StateArchive& archive) override {
        PenetrationScene::visitState(archive);
        archive.same("speed", options.speed, "m/s");
        archive.value("deepest", deepest);
        archive.value("stopped", stopped);
        depths.visitState(archive);
    }

    void completeOutput() override {
        depths.close();
        if (options.run.quiet) return;
        fmt::print(
            "{} grains, {:.4g} s in {} steps: deepest point {:.4g} m below the surface{}; wrote "
            "{}/depth.csv\n",
            particleHandler.getSize(), getTime(), getNumberOfTimeSteps(), deepest,
            stopped || options.wholeTime ? "" : ", still moving", options.run.output);
    }

private:
    Options options;
    RunTable depths{options.run.output + "/depth.csv", "time_s,height_m,velocity_m/s,depth_m,force_N"};
    double deepest = -infinity;  // m
    bool stopped = false;
};

void describe(CLI::App& app, Options& o) {
    app.option_defaults()->always_capture_default();
    addFirstState(
        app, o,
        {.grains = "file of the initial state: rows radius x y z, in m; the largest grain is the intruder",
         .walls = "file of the box: rows of nine numbers, STL, OBJ or PLY, in m",
         .number = "grains of the generated bed, taken where no files are given; at least 100"});
    app.add_option("--speed-m/s", o.speed, "of the intruder, downwards, m/s");
    app.add_option("--end-time-s", o.endTime, "end of the run, s, if the intruder has not stopped before");
    app.add_flag("--whole-time", o.wholeTime, "go on to the end time after the intruder has stopped");
    app.add_option("--interval-s", o.interval, "time between two rows of depth.csv, s");
    addRunOptions(app, o.run, "depth.csv");
}

/// Grains that a run begins with; none for one that goes on, which has its own.
PenetrationGrains firstGrains(const Options& options, const BedBox& box) {
    if (!options.run.restartSource().empty()) return {};
    if (!options.grains.empty()) return separateIntruder(readGrainFile(options.grains));
    return settledBed(options.number, box, options.softening, options.run);
}

void run(const Options& options) {
    checkRun("Penetration", options.number, options.endTime, options.interval);
    checkValue("Penetration", "speed", options.speed, "m/s", positive);
    const BedBox box = bedBoxFor(options.number);
    solveWithin<Penetration>(options, firstGrains(options, box), box);
}

}  // namespace

int main(int argc, char** argv) {
    return runDriver("Penetration", "A steel sphere hits a bed of grains; gives its depth over time.",
                     Options(), describe, run, argc, argv);
}
