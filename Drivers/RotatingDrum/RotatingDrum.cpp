/// Grains of two sizes in a turning drum: case 2 of Dosta et al., "Comparing open-source DEM frameworks for
/// simulations of common bulk processes", Comput. Phys. Commun. 296 (2024) 109066.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/DrumScene.h"
#include "Drivers/Shared/FirstState.h"
#include "Kernel/Analysis/Output/RunTable.h"

using namespace pendular;

namespace {

struct Options : FirstState {
    Options() { number = 3000; }

    double speed = DrumScene::publishedSpeed;  // rad/s
    double endTime = 5;                        // s
    double interval = 0.01;                    // s
    RunOptions run{.output = "RotatingDrum-output"};
};

class RotatingDrum : public DrumScene {
public:
    template <class Walls>
    RotatingDrum(const Options& options, std::span<const GrainRow> grains, const Walls& walls)
        : DrumScene(grains, walls, options.softening),
          folder(options.run.output),
          speed(options.speed),
          quiet(options.run.quiet) {
        turn(speed);
        if (!options.grains.empty()) acceptOverlaps(largestSoundOverlap);  // has not settled here
        setTimeMax(options.endTime);
        setSaveCount(stepsOf(options.interval, getTimeStep()));
        options.run.apply(*this);
    }

    void writeOutput() override {
        const auto n = countQuarters();
        zones.row(getTime(), n[0][M1], n[1][M1], n[2][M1], n[3][M1], n[0][M2], n[1][M2], n[2][M2], n[3][M2]);
    }

    void visitState(StateArchive& archive) override {
        archive.same("speed", speed, "rad/s");
        zones.visitState(archive);
    }

    void completeOutput() override {
        zones.close();
        CsvFile last(folder + "/grains.csv", "x_m,y_m,z_m,radius_m,material");
        for (const GrainRow& grain : grainRows(particleHandler))
            last.row(grain.position.x(), grain.position.y(), grain.position.z(), grain.radius,
                     materialOf(grain) == M1 ? "M1" : "M2");
        last.close();
        if (quiet) return;
        fmt::print("{} grains, {:.4g} s in {} steps; wrote {}/zones.csv and {}/grains.csv\n",
                   particleHandler.getSize(), getTime(), getNumberOfTimeSteps(), folder, folder);
    }

private:
    std::string folder;
    double speed;  // rad/s
    bool quiet;
    RunTable zones{folder + "/zones.csv",
                   "time_s,M1_right_top,M1_left_top,M1_left_bottom,M1_right_bottom,M2_right_top,"
                   "M2_left_top,M2_left_bottom,M2_right_bottom"};
};

void describe(CLI::App& app, Options& o) {
    app.option_defaults()->always_capture_default();
    addFirstState(app, o,
                  {.grains = "file of the initial state: rows radius x y z, in m",
                   .walls = "file of the drum: rows of nine numbers, STL, OBJ or PLY, in m",
                   .number = "grains of the generated state, taken where no files are given"});
    app.add_option("--speed-rad/s", o.speed, "of the drum about -y, rad/s");
    app.add_option("--end-time-s", o.endTime, "end of the run, s");
    app.add_option("--interval-s", o.interval, "time between two rows of zones.csv, s");
    addRunOptions(app, o.run, "zones.csv and grains.csv");
}

/// Grains that a run begins with; none for one that goes on, which has its own.
std::vector<GrainRow> firstGrains(const Options& options, const DrumShape& shape) {
    if (!options.run.restartSource().empty()) return {};
    if (!options.grains.empty()) return readGrainFile(options.grains);
    return settledDrumGrains(options.number, shape, options.softening, options.run);
}

void run(const Options& options) {
    checkRun("RotatingDrum", options.number, options.endTime, options.interval);
    checkValue("RotatingDrum", "speed", options.speed, "rad/s", anyFinite);
    const DrumShape shape = drumFor(options.number);
    solveWithin<RotatingDrum>(options, firstGrains(options, shape), shape);
}

}  // namespace

int main(int argc, char** argv) {
    return runDriver(
        "RotatingDrum",
        "Grains of two sizes in a turning drum; counts them in the quarters of the drum over time.",
        Options(), describe, run, argc, argv);
}
