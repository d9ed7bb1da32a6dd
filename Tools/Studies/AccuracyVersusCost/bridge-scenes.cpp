/// Measures what each liquid bridge law costs in a whole scene, and what it changes in bulk.

#include "BuildFolders.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Tools/Studies/AccuracyVersusCost/SceneComparison.h"

using namespace pendular;

int main(int argc, char** argv) {
    CLI::App app(
        "Time of each liquid bridge law / that of LiquidBridgeBagheri, in a settled wet bed and in a sheared "
        "cell of "
        "wet grains, and bulk figures of the cell (means over the seeds, with standard errors), as CSV.");
    SceneComparisonOptions o;
    o.states = folders::benchmarkStates;
    double degrees = 20;
    app.add_option("--output", o.file, "table to write")->capture_default_str();
    app.add_option("--particles", o.bedGrains, "grains of the bed")->capture_default_str();
    app.add_option("--rounds", o.rounds, "measurements of time in the bed, of 100 steps each")
        ->capture_default_str();
    app.add_option("--states", o.states, "folder of settled beds")
        ->type_name("TEXT or ''")
        ->capture_default_str();
    app.add_option("--seeds", o.seeds, "runs of the sheared cell")->capture_default_str();
    app.add_option("--strain", o.cell.strainMeasured,
                   "strain of the cell over which the figures are averaged")
        ->capture_default_str();
    app.add_option("--strain-before", o.cell.strainBefore,
                   "strain of the cell before that; in its first half the cell is compressed")
        ->capture_default_str();
    app.add_option("--dimensionless-volume", o.cell.dimensionlessVolume, "V* of the bridges in the cell")
        ->capture_default_str();
    app.add_option("--contact-angle-deg", degrees, "in the cell, degrees")->capture_default_str();
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] {
        checkValue("bridge-scenes", "contact-angle-deg", degrees, "degrees", fromZeroTo(180));
        o.cell.contactAngle = degrees * std::numbers::pi / 180;
        writeScenes(o);
        return 0;
    });
}
