/// A sphere meets a plate under a layer of liquid, at any speed, angle and spin: the force balance model of
/// wet particle-wall collisions, of whose Figures 6 to 13 make-figures.sh draws the curves.

#include <fstream>

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/WetWallImpact.h"
#include "Kernel/Foundation/Files/CsvFile.h"

using namespace pendular;

namespace {

struct Options {
    scenes::WetWallCase given;
    std::vector<double> speeds{0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1, 1.25, 1.5, 2, 3, 4, 5};  // m/s, normal
    std::vector<double> angles{0};                                                       // degrees
    std::vector<double> spins{0};                                                        // rad/s
    std::vector<double> steps{50};                                                       // of a contact
    bool energy = false;
    RunOptions run{.output = "WetWallCollision-output"};

    /// All collisions, and what is wrong with one that no scene takes.
    [[nodiscard]] std::vector<scenes::WetWallCase> cases() const {
        std::vector<scenes::WetWallCase> all;
        for (const double step : steps)
            for (const double spin : spins)
                for (const double angle : angles)
                    for (const double speed : speeds) {
                        all.push_back(given);
                        all.back().stepsPerContact = step, all.back().spin = spin;
                        all.back().angle = angle, all.back().speed = speed;
                        scenes::WetWallImpact{all.back()}.setQuiet();  // bad input is refused here
                    }
        return all;
    }
};

constexpr std::string_view header =
    "steps_per_contact,speed_m/s,angle_deg,spin_rad/s,normal_restitution,tangential_restitution,"
    "spin_after_rad/s,end,duration_s,lost_in_contact_J/kg,lost_to_gravity_J/kg,lost_to_viscosity_J/kg,"
    "lost_to_capillarity_J/kg";

/// The rows that a table has, as a number of bytes too. Throws InputError unless they are of the first cases.
struct KeptRows {
    std::size_t rows = 0;
    std::uintmax_t bytes = 0;

    KeptRows() = default;
    KeptRows(const std::filesystem::path& table, const std::vector<scenes::WetWallCase>& cases) {
        std::ifstream file(partOrWhole(table));
        std::string line;
        if (!std::getline(file, line) || file.eof()) return;
        bytes = line.size() + 1;
        for (; std::getline(file, line) && !file.eof(); ++rows, bytes += line.size() + 1) {
            const auto* given = rows < cases.size() ? &cases[rows] : nullptr;
            if (!given || !line.starts_with(fmt::format("{},{},{},{},", given->stepsPerContact, given->speed,
                                                        given->angle, given->spin)))
                throw InputError(
                    fmt::format("WetWallCollision: row {} of {} is of none of these options; --resume needs "
                                "the options of "
                                "the run that wrote it.",
                                rows + 1, table.string()));
        }
    }
};

void run(const Options& options) {
    const auto cases = options.cases();
    const std::filesystem::path path = options.run.output + "/collisions.csv";
    const KeptRows kept = options.run.resume ? KeptRows(path, cases) : KeptRows();
    CsvFile table = kept.rows > 0 ? CsvFile(path, header, kept.bytes) : CsvFile(path, header);
    RunControl control;
    for (std::size_t k = kept.rows; k < cases.size(); ++k) {
        if (control.request(k) == RunControl::Request::Stop) {
            table.close();
            throw RunStopped(
                fmt::format("The run was asked to stop after {} of {} collisions; --resume goes on.", k,
                            cases.size()),
                RunControl::stopped(0, k, "", control.heard(k)).exitCode);
        }
        const scenes::WetWallCase& given = cases[k];
        scenes::WetWallImpact scene(given);
        scene.setQuiet();  // one of hundreds, whose results are the rows of one table
        scene.setName(options.run.output + "/stopped");
        scene.setNumberOfThreads(options.run.threads);
        scene.keepEnergyLedger(options.energy);
        const auto result = scene.finish();
        table.row(given.stepsPerContact, given.speed, given.angle, given.spin, result.normalRestitution,
                  result.tangentialRestitution, result.spin, result.end, result.duration, result.contact,
                  result.gravity, result.viscous, result.capillary);
    }
    table.close();
    if (!options.run.quiet)
        fmt::print("{} collisions; wrote {}/collisions.csv\n", cases.size(), options.run.output);
}

void describe(CLI::App& app, Options& o) {
    app.option_defaults()->always_capture_default();
    auto& g = o.given;
    const auto number = [&](const char* name, double& value, const char* text) {
        app.add_option(name, value, text);
    };
    app.add_option("--speeds-m/s", o.speeds, "normal speeds of the impact");
    app.add_option("--angles-deg", o.angles, "angles of the path from the normal; the normal speed stays");
    app.add_option("--spins-rad/s", o.spins,
                   "initial spins; positive: the lowest point moves forward with the sphere");
    app.add_option("--steps", o.steps, "for the time of a dry contact");
    number("--radius-m", g.radius, "of the sphere");
    number("--density-kg/m3", g.density, "of the sphere");
    number("--elastic-modulus-Pa", g.youngModulus, "of the sphere");
    number("--poisson-ratio", g.poissonRatio, "of the sphere");
    number("--plate-elastic-modulus-Pa", g.plateModulus, "of the plate");
    number("--plate-poisson-ratio", g.platePoissonRatio, "of the plate");
    number("--restitution", g.restitution, "of the dry contact");
    number("--friction", g.friction, "coefficient of sliding friction");
    number("--layer-m", g.layer, "thickness of the layer; 0 is a dry plate");
    number("--half-filling-angle-deg", g.halfFillingAngle, "from the axis to the contact line on the sphere");
    number("--contact-angle-deg", g.contactAngle, "at the sphere");
    number("--viscosity-Pa-s", g.viscosity, "of the liquid");
    number("--liquid-density-kg/m3", g.liquidDensity, "of the liquid");
    number("--surface-tension-N/m", g.surfaceTension, "of the liquid");
    number("--roughness-m", g.roughness, "smallest gap in the viscous forces");
    number("--gravity-m/s2", g.gravity, "towards the plate, on sphere and bridge");
    app.add_flag(
        "--growing-bridge", g.growingBridge,
        "the bridge's volume is that of the toroid at each moment (A); else it stays as it forms (B)");
    app.add_flag("--energy", o.energy, "fill the columns of the energy by mechanism; else they are 0");
    addRunOptions(app, o.run, "collisions.csv");
    app.get_option("--resume")
        ->description(
            "keep the rows that the table in the output folder has, and add the others; give the "
            "same options as before");
    for (const char* none : {"--restart", "--restart-interval-s", "--paraview-interval-s",
                             "--hdf5-interval-s", "--energy-interval-s", "--wall-force-interval-s"})
        app.remove_option(app.get_option(none));  // each collision is a scene of a tenth of a second
}

}  // namespace

int main(int argc, char** argv) {
    return runDriver(
        "WetWallCollision",
        "A sphere meets a plate under a layer of liquid: restitution, spin and energy over speed and angle.",
        Options(), describe, run, argc, argv);
}
