/// The force of a liquid bridge between two spheres, or a sphere and a wall, over the separation of their
/// surfaces.

#include <fmt/format.h>

#include <numbers>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Kernel/Scene/BridgeLaws.h"

using namespace pendular;

namespace {

struct Options {
    std::string model = "LiquidBridgeBagheri";
    double radius1 = unset, volume = unset, surfaceTension = unset;
    std::string radius2 = "inf";
    double contactAngle = 0;
    int points = 101;
    std::vector<double> separations;
    bool list = false, rawFit = false;
};

std::vector<std::string_view> modelNames() {
    std::vector<std::string_view> names;
    forEachBridgeLaw([&]<class Law>() { names.push_back(Law::name); });
    return names;
}

void listModels() {
    forEachBridgeLaw(
        []<class Law>() { fmt::print("{:<30} {}; {}\n", Law::name, Law::summary, Law::domain); });
}

double parseRadius(const std::string& text) {
    std::size_t end = 0;
    double value = unset;
    try {
        value = std::stod(text, &end);
    } catch (const std::exception&) {}
    if (end != text.size() || !(value > 0))
        throw InputError(fmt::format(
            "bridge-force: radius2-m = {} is not a radius; it must be greater than 0 m, or inf for a wall.",
            text));
    return value;
}

template <class Law>
void printForces(const Options& options) {
    checkValue("bridge-force", "radius1-m", options.radius1, "m", positive);
    checkValue("bridge-force", "points", options.points, "", {2, 1e7});
    const Bodies bodies{options.radius1, parseRadius(options.radius2)};
    Law law;
    checkValue("bridge-force", "contact-angle-deg", options.contactAngle, "degrees", fromZeroTo(180));
    law.setLiquidBridgeVolume(options.volume);
    law.setContactAngle(options.contactAngle * std::numbers::pi / 180);
    law.setSurfaceTension(options.surfaceTension);
    if constexpr (requires { law.setRawFit(true); }) law.setRawFit(options.rawFit);
    if constexpr (requires { law.objection(bodies); })
        if (const auto objection = law.objection(bodies)) throw InputError(*objection);

    const BridgeScales scales = law.scales(bodies);
    const auto bridge = law.prepare(bodies);
    fmt::print(
        "# model: {}\n# rupture distance: {} m\n# V*: {}\n# R: {} m\n# r2: {} m (inf: a "
        "wall)\nseparation_m,force_N\n",
        Law::name, bridge.range(), scales.volume, scales.radius, bodies.radius2);
    const auto print = [&](double separation) {
        checkValue("bridge-force", "separation-m", separation, "m", notNegative);
        fmt::print("{},{}\n", separation, separation < bridge.range() ? bridge.force(separation) : 0.0);
    };
    for (const double separation : options.separations) print(separation);
    // The last point lies just inside the rupture distance, beyond which there is no force.
    if (options.separations.empty())
        for (int k = 0; k < options.points; ++k)
            print(std::min(bridge.range() * k / (options.points - 1), std::nextafter(bridge.range(), 0.0)));
}

int run(const Options& options) {
    if (options.list) {
        listModels();
        return 0;
    }
    const std::string wanted = canonicalLawName(options.model);
    bool found = false;
    forEachBridgeLaw([&]<class Law>() {
        if (wanted != Law::name) return;
        found = true;
        printForces<Law>(options);
    });
    if (!found) unknownName("bridge model", options.model, modelNames());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("The force of a liquid bridge (N, attraction positive) over the separation (m), as CSV.");
    Options o;
    app.add_flag("--list", o.list, "name the models");
    app.add_option("--model", o.model, "bridge model by name")->capture_default_str();
    app.add_option("--radius1-m", o.radius1, "radius of the first sphere, m");
    app.add_option("--radius2-m", o.radius2, "radius of the second sphere, m, or inf for a wall")
        ->capture_default_str();
    app.add_option("--volume-m3", o.volume, "liquid volume, m^3 (10 nl = 1e-11)");
    app.add_option("--contact-angle-deg", o.contactAngle, "contact angle, degrees")->capture_default_str();
    app.add_option("--surface-tension-N/m", o.surfaceTension, "surface tension, N/m");
    app.add_option("--points", o.points, "separations from 0 to rupture")->capture_default_str();
    app.add_option("--separation-m", o.separations, "separations, m, instead of points");
    app.add_flag("--raw-fit", o.rawFit, "take a fit even where it has a pole or changes its sign");
    addFormerName(app, "--r1", o.radius1);
    addFormerName(app, "--r2", o.radius2);
    addFormerName(app, "--volume", o.volume);
    addFormerName(app, "--surface-tension", o.surfaceTension);
    addFormerName(app, "--separation", o.separations);
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
