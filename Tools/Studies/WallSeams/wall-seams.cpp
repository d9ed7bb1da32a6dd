/// The force on a grain over a crack, a step and a groove of two plates, against their sizes.

#include <fmt/format.h>
#include <cmath>
#include <vector>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/Simulation.h"

using namespace pendular;

namespace {

using Smooth = Species<HertzianViscoelastic>;

struct Options {
    double overlap = 0.01;
    int points = 120;
};

constexpr double radius = 1e-3;  // m

struct Push {
    double force;  // N, up
    int contacts;  // that touch
};

std::vector<Triangle> rectangle(const Vector<double>& corner, const Vector<double>& a,
                                const Vector<double>& b) {
    return {{corner, corner + a, corner + a + b}, {corner, corner + a + b, corner + b}};
}

/// The push of plates on a grain at rest.
Push pushOf(const std::vector<std::vector<Triangle>>& plates, const Vec3D& centre) {
    Simulation<Smooth> scene;
    scene.setQuiet();
    Smooth species;
    species.setDensity(2500);
    species.setElasticModulusAndPoissonRatio(5e7, 0.25);
    const Smooth* added = scene.speciesHandler.copyAndAddObject(species);
    SphericalParticle grain;
    grain.setSpecies(added);
    grain.setRadius(radius);
    grain.setPosition(centre);
    scene.particleHandler.copyAndAddObject(grain);
    std::vector<Triangle> all;
    for (const auto& plate : plates) all.insert(all.end(), plate.begin(), plate.end());
    TriangleWall wall;
    wall.set(all);
    wall.setSpecies(added);
    scene.wallHandler.copyAndAddObject(wall);
    scene.acceptUnstableTimeStep();  // of 1 ns, for overlaps of any size
    scene.setTimeStep(1e-9);
    scene.initialise();
    scene.step();
    int contacts = 0;
    for (const ObservedContact& contact : scene.interactions()) contacts += contact.touching ? 1 : 0;
    return {scene.particleHandler.getObject(0).getForce().z(), contacts};
}

int run(const Options& options) {
    checkValue("wall-seams", "--overlap", options.overlap, "", {0, 0.1, true, false});
    const double overlap = options.overlap * radius, a = std::sqrt(radius * overlap);
    const Vector<double> x{0.1, 0, 0}, y{0, 0.1, 0};
    const auto left = [&](double at, double height) { return rectangle({at - 0.1, -0.05, height}, x, y); };
    const auto right = [&](double at, double height) { return rectangle({at, -0.05, height}, x, y); };
    const double hertz = pushOf({left(0.05, 0)}, {0, 0, radius - overlap}).force;
    fmt::print("case,size,size_m,force_of_hertz,contacts\n");
    const auto row = [&](const char* name, double share, double size, const Push& push) {
        fmt::print("{},{:.6g},{:.6g},{:.6g},{}\n", name, share, size, push.force / hertz, push.contacts);
    };
    for (int k = 0; k <= options.points; ++k) {
        const double share = 3.0 * k / options.points, width = share * a;
        row("slit_middle", share, width,
            pushOf({left(-0.5 * width, 0), right(0.5 * width, 0)}, {0, 0, radius - overlap}));
        row("slit_edge", share, width, pushOf({left(0, 0), right(width, 0)}, {0, 0, radius - overlap}));
    }
    for (int k = 0; k <= options.points; ++k) {
        // In the corner of the step, where both press as deep.
        const double share = 3.0 * k / options.points, height = share * overlap, d = radius - overlap;
        row("step", share, height,
            pushOf({left(0, height), right(0, 0)}, {std::sqrt(d * d - (d - height) * (d - height)), 0, d}));
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Prints CSV: the vertical force on a grain over the middle and at the edge of a slit between two "
        "plates, "
        "against the width over the radius of Hertz' contact, and in the corner of a step, against the "
        "height "
        "over the overlap. Forces are over that of a plane at the same overlap.");
    Options o;
    app.option_defaults()->always_capture_default();
    app.add_option("--overlap", o.overlap, "of the radius");
    app.add_option("--points", o.points, "of each curve");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
