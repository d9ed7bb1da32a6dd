/// A sphere meets a rigid plane at varied angles: beside the measurements of Kharaz, Gorham and Salman
/// (2001), and test 4 of Chung and Ooi (2011), whose computed curve is that of a spring factor of 1.

#include <algorithm>
#include <fstream>
#include <optional>

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/SphereImpact.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Foundation/Files/FileFault.h"

using namespace pendular;

namespace {

/// Aluminium oxide, 5 mm: Kharaz et al.
struct Options {
    double radius = 2.5e-3;        // m
    double density = 4000;         // kg/m^3
    double youngModulus = 3.8e11;  // Pa
    double poissonRatio = 0.23;
    double restitution = 0.98;
    double friction = 0.092;
    std::vector<double> springFactors = {1, 2.0 / 3.0};
    double speed = 3.9;  // m/s
    std::vector<double> angles;
    int steps = 100;
    bool energy = false;
    RunOptions run{.output = "ObliqueImpact-output"};

    [[nodiscard]] std::size_t impacts() const { return springFactors.size() * angles.size(); }
    [[nodiscard]] double springFactorOf(std::size_t impact) const {
        return springFactors[impact / angles.size()];
    }
    [[nodiscard]] double angleOf(std::size_t impact) const { return angles[impact % angles.size()]; }
};

scenes::SphereImpact::Sphere incoming(const Options& options, std::size_t impact) {
    const double angle = options.angleOf(impact) * std::numbers::pi / 180;
    return {.radius = options.radius,
            .velocity = options.speed * Vec3D(std::sin(angle), 0, -std::cos(angle))};
}

scenes::SphereImpact sceneOf(const Options& options, std::size_t impact) {
    auto material =
        scenes::ImpactMaterial::againstRigid(options.density, options.youngModulus, options.poissonRatio)
            .with(options.restitution, options.friction);
    material.springFactor = options.springFactorOf(impact);
    return scenes::SphereImpact(material, incoming(options, impact), options.steps);
}

/// The tables of a run: impacts.csv, and energy.csv where it is asked for. One that goes on keeps the rows
/// that both have, which must be those of its options; one that starts again leaves no table of another run.
class Tables {
public:
    explicit Tables(const Options& options) {
        const std::filesystem::path folder = options.run.output, energy = folder / "energy.csv";
        std::vector<std::filesystem::path> paths{folder / "impacts.csv"};
        if (options.energy) paths.push_back(energy);
        if (options.run.resume) {
            kept = options.impacts();
            for (const auto& path : paths) kept = std::min(kept, rowsIn(path, options));
        }
        if (!options.energy) leaveNoEnergy(energy);
        open(impacts, paths[0],
             "spring_factor,incidence_deg,normal_restitution,tangential_restitution,spin_rad/s,"
             "rebound_of_contact_deg");
        if (options.energy)
            open(energies, energy,
                 "spring_factor,incidence_deg,kinetic_before_J,kinetic_after_J,elastic_left_J,"
                 "lost_in_normal_dashpots_J,lost_in_tangential_dashpots_J,lost_in_sliding_J,"
                 "lost_in_stiffening_J,step_error_J,balance_J");
    }
    [[nodiscard]] std::size_t rows() const { return kept; }  // of a run of before
    void close() {
        impacts->close();
        if (energies) energies->close();
    }

    std::optional<CsvFile> impacts, energies;

private:
    /// A table that has rows to be kept is gone on with; else a complete one stays until the new one is.
    void open(std::optional<CsvFile>& table, const std::filesystem::path& path, std::string_view header) {
        if (kept > 0) table.emplace(path, header, bytesOf(path, kept));
        else table.emplace(path, header);
    }
    /// The lines that have their end, of the table that is not complete if there is one: CsvFile goes on
    /// with that.
    static std::vector<std::string> linesOf(const std::filesystem::path& table) {
        std::ifstream file(partOrWhole(table));
        std::vector<std::string> lines;
        for (std::string line; std::getline(file, line) && !file.eof();) lines.push_back(line);
        return lines;
    }
    /// 0 where there is no table. Throws InputError unless the rows are of the first impacts of the options.
    static std::size_t rowsIn(const std::filesystem::path& table, const Options& options) {
        const std::vector<std::string> lines = linesOf(table);
        if (lines.empty()) return 0;
        const std::size_t rows = lines.size() - 1;
        if (rows > options.impacts())
            throw InputError(fmt::format(
                "ObliqueImpact: {} has {} impacts, and these options have {}; --resume needs the options of "
                "the run that wrote it.",
                table.string(), rows, options.impacts()));
        for (std::size_t k = 0; k < rows; ++k)
            if (!lines[k + 1].starts_with(
                    fmt::format("{},{},", options.springFactorOf(k), options.angleOf(k))))
                throw InputError(fmt::format(
                    "ObliqueImpact: row {} of {} is not of a spring factor of {} and an angle of {} degrees "
                    "as in these options; --resume needs the options of the run that wrote it.",
                    k + 1, table.string(), options.springFactorOf(k), options.angleOf(k)));
        return rows;
    }
    /// The size (bytes) of the header and the first rows; 0 for no rows.
    static std::uintmax_t bytesOf(const std::filesystem::path& table, std::size_t rows) {
        if (rows == 0) return 0;
        const std::vector<std::string> lines = linesOf(table);
        std::uintmax_t bytes = 0;
        for (std::size_t k = 0; k <= rows; ++k) bytes += lines[k].size() + 1;
        return bytes;
    }
    /// Removes what another run has left of the energy, in a run without --energy. Throws InputError where it
    /// is of the rows that are kept.
    void leaveNoEnergy(const std::filesystem::path& table) const {
        const std::filesystem::path part = table.string() + ".part";
        if (kept > 0 && (isThere(table) || isThere(part)))
            throw InputError(fmt::format(
                "ObliqueImpact: the run of {} was one with --energy; --resume needs that option too.",
                table.string()));
        std::error_code ignored;
        std::filesystem::remove(table, ignored);
        std::filesystem::remove(part, ignored);
    }

    std::size_t kept = 0;
};

/// What the kernel's ledger says of an impact; the balance is round-off.
void writeEnergy(CsvFile& file, double springFactor, double angleDegrees, double before,
                 const EnergyLedger& after) {
    file.row(springFactor, angleDegrees, before, after.kinetic, after.springs(), after.normalDashpots,
             after.tangentialDashpots, after.sliding, after.stiffening, after.stepError,
             before - after.closed());
}

void impact(const Options& options, std::size_t number, Tables& tables) {
    const double springFactor = options.springFactorOf(number), angleDegrees = options.angleOf(number);
    const auto before = incoming(options, number);
    auto scene = sceneOf(options, number);
    scene.setQuiet();  // in so short a time no weak dashpot matters, of which it would warn at each impact
    scene.setName(options.run.output + "/stopped");
    scene.setNumberOfThreads(options.run.threads);
    scene.keepEnergyLedger(options.energy);
    scene.finish();
    const auto after = scene.sphere();
    const double contactPoint = after.velocity.x() - options.radius * after.spin.y();
    tables.impacts->row(springFactor, angleDegrees, -after.velocity.z() / before.velocity.z(),
                        after.velocity.x() / before.velocity.x(), after.spin.y(),
                        std::atan2(contactPoint, after.velocity.z()) * 180 / std::numbers::pi);
    if (tables.energies)
        writeEnergy(*tables.energies, springFactor, angleDegrees,
                    0.5 / before.inverseMass(options.density) * before.velocity.squaredNorm(),
                    scene.energyLedger());
}

/// A run that was asked to stop leaves tables with the impacts so far; --resume goes on with the others.
void run(const Options& options) {
    checkValue("ObliqueImpact", "restitution", options.restitution, "", positiveUpTo(1));
    for (const double angle : options.angles)  // the command line lets nan through
        checkValue("ObliqueImpact", "angle of incidence", angle, "degrees", {0.001, 89.999});
    for (std::size_t k = 0; k < options.impacts(); k += options.angles.size())
        sceneOf(options, k);  // refuses what no scene takes, before a table is touched
    Tables tables(options);
    RunControl control;
    for (std::size_t k = tables.rows(); k < options.impacts(); ++k) {
        if (control.request(k) == RunControl::Request::Stop) {
            tables.close();
            throw RunStopped(
                fmt::format("The run was asked to stop after {} of {} impacts; --resume goes on.", k,
                            options.impacts()),
                RunControl::stopped(0, k, "", control.heard(k)).exitCode);
        }
        impact(options, k, tables);
    }
    tables.close();
    if (options.run.quiet) return;
    fmt::print("{} impacts at {} m/s; wrote {}/impacts.csv{}\n", options.impacts(), options.speed,
               options.run.output, options.energy ? " and energy.csv" : "");
}

void describe(CLI::App& app, Options& options) {
    app.add_option("--radius-m", options.radius, "of the sphere")->capture_default_str();
    app.add_option("--density-kg/m3", options.density, "of the sphere")->capture_default_str();
    app.add_option("--elastic-modulus-Pa", options.youngModulus, "Young's modulus of the sphere")
        ->capture_default_str();
    app.add_option("--poisson-ratio", options.poissonRatio, "of the sphere")->capture_default_str();
    app.add_option("--restitution", options.restitution, "of the normal speed, above 0")
        ->capture_default_str();
    app.add_option("--friction", options.friction, "Coulomb's coefficient")->capture_default_str();
    app.add_option("--spring-factors", options.springFactors,
                   "of Mindlin's spring, a curve for each: 1, and MercuryDPM's 2/3");
    app.add_option("--speed-m/s", options.speed, "of the impact, at every angle")->capture_default_str();
    app.add_option("--angles-deg", options.angles, "of incidence, from the normal; the default is 2 to 88")
        ->check(CLI::Range(0.001, 89.999));
    app.add_option("--steps", options.steps, "for the time of a contact")
        ->capture_default_str()
        ->check(CLI::Range(10, 1000000));
    app.add_flag("--energy", options.energy,
                 "write energy.csv: the energy of each impact by mechanism; else no account is kept");
    addRunOptions(app, options.run, "the tables");
    app.get_option("--resume")
        ->description(
            "keep the rows that the tables in the output folder have, and add the other impacts; give the "
            "same --angles-deg, --spring-factors and --energy, else it is refused, and the other options as "
            "before too, which the tables do not tell");
    for (const char* none : {"--restart", "--restart-interval-s", "--paraview-interval-s",
                             "--hdf5-interval-s", "--energy-interval-s", "--wall-force-interval-s"})
        app.remove_option(app.get_option(none));  // each impact is a scene of a few microseconds
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    for (int angle = 2; angle < 89; ++angle) options.angles.push_back(angle);
    return runDriver(
        "ObliqueImpact",
        "A sphere meets a rigid plane at varied angles: restitution along the plane, spin, rebound angle.",
        options, describe, run, argc, argv);
}
