/// A law outside the kernel: a constant attraction within a given gap, composed into a species like any
/// other.

#include <array>

#include "Drivers/Shared/CommandLine.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Scene/Simulation.h"

using namespace pendular;

/// A square well: the force `strength` pulls wherever the surfaces are nearer than `width`.
struct SquareWell {
    static constexpr std::string_view name = "SquareWell";
    static constexpr std::string_view summary = "constant attraction within a gap";
    static constexpr std::string_view domain = "everywhere";
    static constexpr bool acts = true;
    static constexpr bool formsAtContact = false;  // acts within the range, touched before or not

    double strength = unset;  // N
    double width = unset;     // m

    static constexpr auto fields() {
        return std::to_array<Field<SquareWell>>(
            {{"strength", &SquareWell::strength, "N", notNegative, Mixing::Geometric, "attraction",
              "this driver"},
             {"width", &SquareWell::width, "m", positive, Mixing::Arithmetic, "largest gap", "this driver"}});
    }
    template <class T>
    struct Interaction {
        T strength, width;
        [[nodiscard]] T force(T) const { return strength; }
        [[nodiscard]] T range() const { return width; }
    };
    [[nodiscard]] Interaction<double> prepare(const Bodies&) const { return {strength, width}; }
    [[nodiscard]] double range(const Bodies&) const { return width; }
};

int main(int argc, char** argv) {
    RunOptions options{.output = "UserDefinedLaw-output"};
    double endTime = 0.05;  // s
    const DriverProgram driver{.name = "UserDefinedLaw",
                               .description = "Two grains attract each other by a law of this driver.",
                               .options = options,
                               .files = "what the run writes",
                               .numbers = {{"end-time", "s", &endTime, notNegative, "end of the run"}}};
    return runDriver(driver, argc, argv, [&] {
        Species<HertzianViscoelastic, NoFriction, SquareWell> species;
        species.setDensity(2000);
        species.setEffectiveElasticModulusAndRestitutionCoefficient(1e6, 0.5);
        species.strength = 1e-6;
        species.width = 1e-4;

        Simulation<decltype(species)> scene;
        options.apply(scene);
        SphericalParticle grain;
        grain.setSpecies(scene.speciesHandler.copyAndAddObject(species));
        grain.setRadius(0.5e-3);
        scene.particleHandler.copyAndAddObject(grain);
        grain.setPosition({1.05e-3, 0, 0});  // a gap of 50 micrometres, inside the well
        auto second = scene.particleHandler.copyAndAddObject(grain);
        scene.setTimeStep(1e-6);
        scene.setTimeMax(endTime);
        scene.solve();
        if (options.quiet) return;
        fmt::print("{}: gap after {} s: {:.4g} m\n", species.getName(), scene.getTimeMax(),
                   (second.getPosition() - scene.particleHandler.getObject(0).getPosition()).norm() - 1e-3);
    });
}
