/// Advises how soft the grains of a run may be for the figures that are wanted of it.

#include <fmt/format.h>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Scene/TimeStep/SoftestModulus.h"

using namespace pendular;

namespace {

struct Options {
    SoftnessQuestion question;
    double errorPercent = 1;
    std::vector<std::string> figures;
    std::string keep;
};

KeptCohesion keptOf(const std::string& word) {
    if (word.empty()) return KeptCohesion::NotSaid;
    return word == "strength" ? KeptCohesion::Strength : KeptCohesion::Collisions;
}

int run(Options o) {
    o.question.error = 0.01 * o.errorPercent;
    o.question.kept = keptOf(o.keep);
    for (const std::string& name : o.figures) o.question.figures.push_back(wantedFigure(name));
    fmt::print("{}\n", softestModulus(o.question).text());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Advises the softest Young's modulus of grains, for the figures that a run is made for, and how much "
        "faster the run is. The page on the time step says where it comes from.");
    Options o;
    std::string names;
    for (const WantedFigure figure : allWantedFigures())
        names += fmt::format("{}{}", names.empty() ? "" : ", ", nameOf(figure));
    app.add_option("--modulus-Pa", o.question.modulus,
                   "Young's modulus of the material, Pa; no more is advised")
        ->required();
    app.add_option("--density-kg-m3", o.question.density, "density of the grains, kg/m^3")->required();
    app.add_option("--diameter-m", o.question.diameter, "diameter of the smallest grains, m")->required();
    app.add_option("--figures", o.figures, "what the run is made for, several apart by commas: " + names)
        ->required()
        ->delimiter(',');
    app.add_option("--poisson-ratio", o.question.poissonRatio, "Poisson's ratio")->capture_default_str();
    app.add_option("--pressure-Pa", o.question.pressure,
                   "pressure at the bottom of the grains, of pistons and targets, Pa")
        ->capture_default_str();
    app.add_option("--speed-m-s", o.question.speed, "speed at which grains meet each other and walls, m/s")
        ->capture_default_str();
    app.add_option("--pull-N", o.question.pull, "largest attraction of a contact, N")->capture_default_str();
    app.add_option("--keep", o.keep,
                   "what of cohesion is to stay: strength (heaps, slopes, drums) or collisions (grains that "
                   "fly, sprays)")
        ->check(CLI::IsMember({"strength", "collisions"}));
    app.add_option("--error-percent", o.errorPercent, "error that the figures may have, %; 0.01 to 10")
        ->capture_default_str();
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
