/// Grains of two sizes in a turning drum: case 2 of Dosta et al., "Comparing open-source DEM frameworks for
/// simulations of common bulk processes", Comput. Phys. Commun. 296 (2024) 109066.

#include <CLI/CLI.hpp>

#include <optional>

#include "Drivers/Shared/DrumScene.h"
#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Output/CsvFile.h"
#include "Kernel/Output/ParaViewOutput.h"

using namespace pendular;

namespace {

struct Options {
    std::string grains, walls;  // files; both empty: a generated state
    std::size_t number = 3000;  // of a generated state
    double softening = 1;
    double speed = DrumScene::publishedSpeed;  // rad/s
    double endTime = 5;                        // s
    double interval = 0.01;                    // s
    int threads = 1;
    bool paraView = false;
    std::string output = "RotatingDrum";
};

class RotatingDrum : public DrumScene {
public:
    template <class Walls>
    RotatingDrum(const Options& options, std::span<const GrainRow> grains, const Walls& walls)
        : DrumScene(grains, walls, options.softening), folder(options.output) {
        setName(folder + "/stopped");
        turn(options.speed);
        setTimeMax(options.endTime);
        setSaveCount(stepsOf(options.interval, getTimeStep()));
        setNumberOfThreads(options.threads);
        if (options.paraView) addOutput(ParaViewOutput(options.output + "/RotatingDrum"));
    }

    void writeOutput() override {
        if (!zones) openTables();  // once the scene has passed its checks
        const auto n = countQuarters();
        zones->row(getTime(), n[0][M1], n[1][M1], n[2][M1], n[3][M1], n[0][M2], n[1][M2], n[2][M2], n[3][M2]);
    }

    void complete() {
        zones->close();
        CsvFile last(folder + "/grains.csv", "x_m,y_m,z_m,radius_m,material");
        for (const GrainRow& grain : grainRows(particleHandler))
            last.row(grain.position.x(), grain.position.y(), grain.position.z(), grain.radius,
                     materialOf(grain) == M1 ? "M1" : "M2");
        last.close();
        fmt::print("{} grains, {:.4g} s in {} steps; wrote {}/zones.csv and {}/grains.csv\n",
                   particleHandler.getSize(), getTime(), getNumberOfTimeSteps(), folder, folder);
    }

private:
    void openTables() {
        zones.emplace(folder + "/zones.csv",
                      "time_s,M1_right_top,M1_left_top,M1_left_bottom,M1_right_bottom,M2_right_top,"
                      "M2_left_top,M2_left_bottom,M2_right_bottom");
    }

    std::string folder;
    std::optional<CsvFile> zones;
};

void describe(CLI::App& app, Options& o) {
    app.option_defaults()->always_capture_default();
    auto* grains = app.add_option("--grains", o.grains, "file of the initial state: rows radius x y z, in m");
    auto* walls = app.add_option("--walls", o.walls, "file of the drum: rows of nine numbers, in m, or STL");
    grains->needs(walls), walls->needs(grains);
    app.add_option("--number", o.number, "grains of the generated state, taken where no files are given")
        ->excludes(grains);
    app.add_option("--softening", o.softening,
                   "divides Young's moduli; the time step grows with its square root");
    app.add_option("--speed-rad/s", o.speed, "of the drum about -y, rad/s");
    app.add_option("--end-time-s", o.endTime, "end of the run, s");
    app.add_option("--interval-s", o.interval, "time between two rows of zones.csv, s");
    app.add_option("--threads", o.threads, "OpenMP threads; the results do not depend on their number");
    app.add_flag("--paraview", o.paraView,
                 "writes files for ParaView at each interval, RotatingDrum.pvd in the folder");
    app.add_option("--output", o.output, "folder for zones.csv and grains.csv");
}

template <class Walls>
void run(const Options& options, const std::vector<GrainRow>& grains, const Walls& walls) {
    RotatingDrum drum(options, grains, walls);
    drum.solve();
    drum.complete();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Grains of two sizes in a turning drum; counts them in the quarters of the drum over time.");
    Options options;
    describe(app, options);
    CLI11_PARSE(app, argc, argv);
    return runProgram([&] {
        checkRun("RotatingDrum", options.number, options.endTime, options.interval, options.threads);
        if (options.grains.empty()) {
            const DrumShape shape = drumFor(options.number);
            run(options, settledDrumGrains(options.number, shape, options.softening), shape);
        } else {
            run(options, readGrainFile(options.grains), readTriangles(options.walls));
        }
        return 0;
    });
}
