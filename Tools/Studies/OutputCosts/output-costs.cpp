/// Measures what a frame of a bed takes in each format of files: bytes, and time beside that of 1000 steps.

#include <fmt/format.h>

#include "Drivers/Shared/BenchmarkScenes.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Drivers/Shared/ProcessorTime.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Mercury/MercuryOutput.h"
#include "Kernel/Scene/LastState.h"

using namespace pendular;

namespace {

struct Options {
    scenes::BenchmarkChoice bed;
    std::size_t steps = 300;
    std::string folder = "output-costs";
    int threads = 1;
};

constexpr std::size_t framesTimed = 15, stepsTogether = 10;

/// Writes frames of a scene in one format after the other, into a folder for each.
class FormatCosts {
public:
    /// @param stepTime s of a processor
    FormatCosts(Scene& measured, std::filesystem::path outputFolder, double stepTime)
        : scene(measured), folder(std::move(outputFolder)), step(stepTime) {}

    /// A row of the table.
    template <class Output>
    void row(const std::string& format, bool withContacts, const Output& output) {
        const auto own = folder / fmt::format("{}{}", format, withContacts ? "-contacts" : "");
        scene.setName((own / "frame").string());
        const double least = leastTimeOf(framesTimed, [&] {
            Output fresh = output;
            fresh.write(scene);
        });
        std::uintmax_t bytes = 0;
        for (const auto& entry : std::filesystem::directory_iterator(own)) bytes += entry.file_size();
        fmt::print("Pendular,{},{},{},{},{:.4g},{:.3g}\n", format, withContacts ? "yes" : "no",
                   scene.particleHandler.getSize(), bytes, least, 0.1 * least / step);
    }

private:
    Scene& scene;
    std::filesystem::path folder;
    double step;  // s
};

/// Tables as a run leaves them that cannot go on.
struct Tables {
    bool withContacts;

    void write(const Scene& scene) const {
        const auto& grains = scene.particleHandler.store();
        writeGrains(scene.getName() + "-grains.csv", grains, scene.laws(), "grains");
        if (withContacts)
            writeContacts(scene.getName() + "-contacts.csv", scene.contacts(), grains, "contacts");
    }
};

void measure(Scene& scene, const Options& options) {
    scene.setNumberOfThreads(options.threads);
    scene.initialise();
    const double stepsTime =
        leastTimeOf((options.steps + stepsTogether - 1) / stepsTogether, [&] { scene.step(stepsTogether); });
    FormatCosts costs(scene, options.folder, stepsTime / stepsTogether);
    fmt::print("writer,format,contacts,grains,bytes,processor_time_s,percent_of_1000_steps\n");
    for (const bool contacts : {false, true}) {
        for (const bool doubles : {false, true}) {
            const char* bits = doubles ? "64" : "32";
            costs.row(fmt::format("vtp-{}", bits), contacts,
                      ParaViewOutput().withContacts(contacts).withDoubles(doubles));
            if (Hdf5File::isAvailable())
                costs.row(fmt::format("hdf5-{}", bits), contacts,
                          Hdf5Output().withContacts(contacts).withDoubles(doubles));
        }
        costs.row("mercury", contacts, MercuryOutput().withEnergies(false).withContacts(contacts));
        costs.row("csv", contacts, Tables{contacts});
    }
}

int run(const Options& options) {
    checkNumberOfGrains("output-costs", options.bed.particles);
    checkValue("output-costs", "steps", static_cast<double>(options.steps), "", {1, 1e12});
    checkValue("output-costs", "number of threads", options.threads, "", {1, 4096});
    std::error_code problem;
    if (std::filesystem::exists(options.folder, problem))
        throw InputError(
            fmt::format("output-costs: the folder {} exists; give the name of a new one.", options.folder));
    scenes::withSceneOf(HertzianViscoelasticMindlinSpecies::name, options.bed, options.threads,
                        [&](auto& scene) { measure(scene, options); });
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Prints a row of CSV for each format of files: the bytes of a frame of a bed, and the processor time "
        "that it takes, beside that of 1000 steps; both are the shortest of many measurements.");
    Options o;
    o.bed.particles = 250000;
    app.option_defaults()->always_capture_default();
    app.add_option("--particles", o.bed.particles, "number of grains, about");
    app.add_option("--positions", o.bed.positions,
                   "file of rows radius x y z (m): the bed of Dosta et al. (2024), repeated along x; made by "
                   "the program if not given, which takes minutes");
    app.add_option("--states", o.bed.states, "folder in which beds are kept that the program made");
    app.add_option("--steps", o.steps, "steps that are timed, in tens: the fastest ten count");
    app.add_option("--threads", o.threads, "threads");
    app.add_option("--output", o.folder, "new folder for the frames");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
