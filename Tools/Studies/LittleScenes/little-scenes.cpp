/// Measures what a step of a scene with few grains takes, and prints a row of CSV for each scene.

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Drivers/Shared/ProcessorTime.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/MercuryNames.h"
#include "Kernel/Scene/StateHash.h"

using namespace pendular;

namespace {

enum class Energies { None, Springs, Ledger };

struct Options {
    std::string scene = "all", energies = "none";
    double share = 1;  // of the steps
    int runs = 7;
};

struct Kind {
    std::string_view name;
    int grains, row;  // so many side by side, and the others above them
    bool isOnPlane;
    std::size_t steps;
};
constexpr std::array kinds{Kind{"two", 2, 2, false, 300000}, Kind{"two-on-plane", 2, 2, true, 100000},
                           Kind{"ten-on-plane", 10, 5, true, 60000},
                           Kind{"hundred-on-plane", 100, 10, true, 12000}};

/// Grains of 2 mm that touch their neighbours, with Hertz's and Mindlin's laws: on a plane they stay
/// together; two without one part in the first steps, and fly on.
class Few : public Simulation<HertzianViscoelasticMindlinSpecies> {
public:
    Few(const Kind& kind, Energies energies) {
        HertzianViscoelasticMindlinSpecies species;
        species.setDensity(2500);
        species.setEffectiveElasticModulus(5e6);
        species.setEffectiveShearModulus(3e6);
        species.setSlidingFrictionCoefficient(0.5);
        const auto* const added = speciesHandler.copyAndAddObject(species);
        SphericalParticle grain(added);
        grain.setRadius(radius);
        for (int k = 0; k < kind.grains; ++k) {
            const int above = k / kind.row, along = k % kind.row;
            grain.setPosition(apart * Vec3D(along, 0, above) + Vec3D(0, 0, 0.999 * radius));
            particleHandler.copyAndAddObject(grain);
        }
        if (kind.isOnPlane) addPlane(added);
        if (energies == Energies::Springs) keepSpringEnergy();
        if (energies == Energies::Ledger) keepEnergyLedger();
        setTimeStep(1e-7);
        setQuiet();
    }

private:
    template <class S>
    void addPlane(const S* species) {
        setGravity({0, 0, -9.81});
        InfiniteWall plane;
        plane.setSpecies(species);
        plane.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(plane);
    }

    static constexpr double radius = 1e-3, apart = 1.999 * radius;  // m
};

Energies energiesNamed(const std::string& name) {
    constexpr std::array<std::string_view, 3> names{"none", "springs", "ledger"};
    for (std::size_t k = 0; k < names.size(); ++k)
        if (name == names[k]) return static_cast<Energies>(k);
    throw InputError(
        fmt::format("little-scenes: energies = '{}'; they must be none, springs or ledger.", name));
}

void measure(const Kind& kind, const Options& options) {
    const auto steps =
        static_cast<std::size_t>(std::max(options.share * static_cast<double>(kind.steps), 1.0));
    Few scene(kind, energiesNamed(options.energies));
    scene.initialise();
    scene.step(1000);  // caches, and two that part
    const double least = leastTimeOf(static_cast<std::size_t>(options.runs), [&] { scene.step(steps); });
    fmt::print("{},{},{},{},{},{:.1f},{:016x}\n", kind.name, kind.grains, scene.contacts().counts().touching,
               options.energies, steps, 1e9 * least / static_cast<double>(steps),
               stateHash(scene.particleHandler.store()));
}

int run(const Options& options) {
    checkValue("little-scenes", "runs", options.runs, "", {1, 1e6});
    checkValue("little-scenes", "share of the steps", options.share, "", {1e-6, 1e6});
    bool isKnown = false;
    fmt::print("scene,particles,touching,energies,steps,processor_ns_per_step,state_hash\n");
    for (const Kind& kind : kinds) {
        if (options.scene != "all" && options.scene != kind.name) continue;
        isKnown = true;
        measure(kind, options);
    }
    if (!isKnown)
        throw InputError(fmt::format("little-scenes: there is no scene '{}'; see --help.", options.scene));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Prints a row of CSV for each scene of few grains: the processor time of a step, the shortest of "
        "some "
        "runs, and a hash of the state.");
    Options o;
    app.option_defaults()->always_capture_default();
    app.add_option("--scene", o.scene, "two, two-on-plane, ten-on-plane, hundred-on-plane or all");
    app.add_option("--energies", o.energies,
                   "what is kept of them: none, springs (keepSpringEnergy()) or ledger (keepEnergyLedger())");
    app.add_option("--share", o.share, "share of the steps that a run has by itself");
    app.add_option("--runs", o.runs, "runs, of which the fastest counts");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
