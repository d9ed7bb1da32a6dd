/// A sphere meets a rigid plane at varied angles: the measurements of Kharaz, Gorham and Salman (2001), and
/// test 4 of Chung and Ooi (2011).

#include <CLI/CLI.hpp>

#include "Drivers/Shared/SphereImpact.h"
#include "Kernel/Output/CsvFile.h"

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
    std::string output = "ObliqueImpact";
};

scenes::SphereImpact::Sphere incoming(const Options& options, double angle) {
    return {.radius = options.radius,
            .velocity = options.speed * Vec3D(std::sin(angle), 0, -std::cos(angle))};
}

void impact(const Options& options, double springFactor, double angleDegrees, CsvFile& file) {
    const auto before = incoming(options, angleDegrees * std::numbers::pi / 180);
    auto material =
        scenes::ImpactMaterial::againstRigid(options.density, options.youngModulus, options.poissonRatio)
            .with(options.restitution, options.friction);
    material.springFactor = springFactor;
    scenes::SphereImpact scene(material, before, options.steps);
    scene.setName(options.output + "/stopped");
    scene.finish();
    const auto after = scene.sphere();
    const double contactPoint = after.velocity.x() - options.radius * after.spin.y();
    file.row(springFactor, angleDegrees, -after.velocity.z() / before.velocity.z(),
             after.velocity.x() / before.velocity.x(), after.spin.y(),
             std::atan2(contactPoint, after.velocity.z()) * 180 / std::numbers::pi);
}

void run(const Options& options) {
    const std::string path = options.output + "/impacts.csv";
    CsvFile file(path,
                 "spring_factor,incidence_deg,normal_restitution,tangential_restitution,spin_rad/s,"
                 "rebound_of_contact_deg");
    for (const double factor : options.springFactors)
        for (const double angle : options.angles) impact(options, factor, angle, file);
    file.close();
    fmt::print("{} impacts at {} m/s; wrote {}\n", options.springFactors.size() * options.angles.size(),
               options.speed, path);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    for (int angle = 2; angle < 89; ++angle) options.angles.push_back(angle);
    CLI::App app(
        "A sphere meets a rigid plane at varied angles: restitution along the plane, spin, rebound angle.");
    app.add_option("--radius-m", options.radius)->capture_default_str();
    app.add_option("--density-kg/m3", options.density)->capture_default_str();
    app.add_option("--elastic-modulus-Pa", options.youngModulus)->capture_default_str();
    app.add_option("--poisson-ratio", options.poissonRatio)->capture_default_str();
    app.add_option("--restitution", options.restitution)->capture_default_str();
    app.add_option("--friction", options.friction)->capture_default_str();
    app.add_option("--spring-factors", options.springFactors,
                   "of Mindlin's spring, a curve for each: 1, and MercuryDPM's 2/3");
    app.add_option("--speed-m/s", options.speed)->capture_default_str();
    app.add_option("--angles-deg", options.angles, "of incidence, from the normal; the default is 2 to 88")
        ->check(CLI::Range(0.001, 89.999));
    app.add_option("--steps", options.steps, "for the time of a contact")
        ->capture_default_str()
        ->check(CLI::Range(10, 1000000));
    app.add_option("--output", options.output, "folder of the table")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    return runProgram([&] {
        run(options);
        return 0;
    });
}
