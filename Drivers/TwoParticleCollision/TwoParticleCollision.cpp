/// Two grains collide head-on, and a liquid bridge forms, stretches and ruptures: Figures 3 and 4 of Bagheri,
/// Roy and Poeschel, "Discrete Element Simulations of particles interacting via capillary forces using
/// MercuryDPM".

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Kernel/Scene/BridgeAdvice.h"
#include "Kernel/Scene/BridgeLaws.h"

using namespace pendular;

namespace {

/// The defaults are those of Table 1 and Figure 3a; the speed is not in the paper (see the README of this
/// folder).
struct Options {
    double radius1 = 0.5e-3, radius2 = 0.8e-3;  // m
    double volume = 10e-12;                     // m^3
    double surfaceTension = 0.079;              // N/m
    double contactAngle = 0;                    // degrees
    double speed = 0.5;                         // m/s, of each grain
    double elasticModulus = 5e6;                // Pa
    double poissonRatio = 0.35;
    double density = 2000;  // kg/m^3
    double restitution = 0.86;
    double friction = 0.5;
    std::string adhesion = "LiquidBridgeBagheri";
    bool solveOutsideTable = false;  // of LiquidBridgeYoungLaplace
    double timeStep = 0;             // s; 0: 1/50 of the Rayleigh time
    double timeMax = 0.02;           // s
    double adviceTolerance = 0;      // %; 0: no advice
    RunOptions run{.output = "TwoParticleCollision-output"};
};

/// What a driver of liquid bridges can do with: a bridge, or nothing.
template <class Law>
struct IsBridgeOrNothing : std::bool_constant<!Law::acts || BridgeLaw<Law>> {};
using Bridges = FilteredTypes<IsBridgeOrNothing, AdhesionLaws>::type;

template <class Adhesion>
class TwoParticleCollision : public Simulation<Species<HertzianViscoelastic, Mindlin, Adhesion>> {
public:
    using Material = Species<HertzianViscoelastic, Mindlin, Adhesion>;

    static constexpr bool solvesOutsideTable = requires(Material m) { m.setSolveOutsideTable(true); };

    explicit TwoParticleCollision(const Options& given) : options(given) {
        if (options.solveOutsideTable && !solvesOutsideTable)
            throw InputError(fmt::format(
                "--solve-outside-table: the adhesion model {} has no table, so leave the option out.",
                Adhesion::name));
        options.run.apply(*this);
    }

    void setupInitialConditions() override {
        const Material* material = this->speciesHandler.copyAndAddObject(makeMaterial());
        const double gap = 0.1 * std::min(options.radius1, options.radius2);
        addGrain(material, options.radius1, -options.radius1 - 0.5 * gap, options.speed);
        addGrain(material, options.radius2, options.radius2 + 0.5 * gap, -options.speed);
        const double smaller = std::min(options.radius1, options.radius2);
        const double shearModulus = 0.5 * options.elasticModulus / (1 + options.poissonRatio);
        const double advice = rayleighTime(smaller, shearModulus, options.poissonRatio, options.density) / 50;
        this->setTimeStep(options.timeStep == 0 ? advice : options.timeStep);
        this->setTimeMax(options.timeMax);
        this->setSaveCount(1);
        this->keepEnergyLedger();
        if constexpr (BridgeLaw<Adhesion>)
            if (options.adviceTolerance > 0 && !options.run.quiet)
                fmt::print("{}\n", bridgeAdvice(*this, 0.01 * options.adviceTolerance));
    }

    void writeOutput() override {
        const double time = this->getTime();
        // Also where a contact is listed: when it is, depends on the ranks.
        const double separation = distance() - options.radius1 - options.radius2;
        double normal = 0, capillary = 0;
        bool bridged = false;
        this->contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            const ObservedContact seen =
                this->contacts().observe(this->particleHandler.store(), bucket, contact);
            normal = seen.normalForce;
            capillary = 0.0 - seen.adhesiveForce;  // no negative zero
            bridged = seen.bridged;
        });
        touched = touched || separation < 0;
        parted = touched && separation > 0 && !bridged;
        forces.row(time, separation, normal, capillary, bridged ? 1 : 0);
        const EnergyLedger& ledger = this->energyLedger();
        energies.row(time, ledger.kinetic, ledger.elastic, ledger.normalDashpots, ledger.adhesionWork(),
                     ledger.total());
    }

    /// Runs until the grains have parted and the bridge, if there is one, has ruptured.
    [[nodiscard]] bool continueSolve() const override { return !parted; }

    void visitState(StateArchive& archive) override {
        archive.value("touched", touched);
        archive.value("parted", parted);
        forces.visitState(archive);
        energies.visitState(archive);
    }

    void completeOutput() override {
        forces.close();
        energies.close();
        if (options.run.quiet) return;
        fmt::print("{}: {} after {:.4g} s and {} steps; wrote {}/force_separation.csv and {}/energy.csv\n",
                   Material::name, parted ? "parted" : "still together", this->getTime(),
                   this->getNumberOfTimeSteps(), options.run.output, options.run.output);
    }

private:
    Material makeMaterial() const {
        Material material;
        material.setDensity(options.density);
        material.setElasticModulusAndPoissonRatio(options.elasticModulus, options.poissonRatio);
        material.setRestitutionCoefficient(options.restitution);
        material.setEffectiveShearModulus(
            computeEffectiveShearModulus(options.elasticModulus, options.poissonRatio));
        material.setSlidingFrictionCoefficient(options.friction);
        if constexpr (Adhesion::acts) {
            material.setLiquidBridgeVolume(options.volume);
            material.setContactAngle(options.contactAngle * std::numbers::pi / 180);
            material.setSurfaceTension(options.surfaceTension);
        }
        if constexpr (solvesOutsideTable) material.setSolveOutsideTable(options.solveOutsideTable);
        return material;
    }
    void addGrain(const Material* material, double radius, double position, double speed) {
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setRadius(radius);
        grain.setPosition({position, 0, 0});
        grain.setVelocity({speed, 0, 0});
        this->particleHandler.copyAndAddObject(grain);
    }
    double distance() {
        return (this->particleHandler.getObject(1).getPosition() -
                this->particleHandler.getObject(0).getPosition())
            .norm();
    }

    Options options;
    RunTable forces{options.run.output + "/force_separation.csv",
                    "time_s,separation_m,normal_force_N,capillary_force_N,bridge"};
    RunTable energies{options.run.output + "/energy.csv",
                      "time_s,kinetic_J,elastic_J,dissipated_J,bridge_work_J,total_J"};
    bool touched = false;
    bool parted = false;
};

void describe(CLI::App& app, Options& o) {
    app.option_defaults()->always_capture_default();
    app.add_option("--radius1-m", o.radius1, "radius of the first grain, m");
    app.add_option("--radius2-m", o.radius2, "radius of the second grain, m");
    app.add_option("--volume-m3", o.volume, "liquid volume of the bridge, m^3 (10 nl = 1e-11)");
    app.add_option("--surface-tension-N/m", o.surfaceTension, "surface tension of the liquid, N/m");
    app.add_option("--contact-angle-deg", o.contactAngle, "contact angle, degrees");
    app.add_option("--speed-m/s", o.speed, "speed of each grain, m/s");
    app.add_option("--elastic-modulus-Pa", o.elasticModulus, "Young's modulus, Pa");
    app.add_option("--poisson-ratio", o.poissonRatio, "Poisson's ratio");
    app.add_option("--density-kg/m3", o.density, "density of the grains, kg/m^3");
    app.add_option("--restitution", o.restitution, "restitution coefficient of the dry contact");
    app.add_option("--friction", o.friction, "coefficient of sliding friction");
    app.add_option("--adhesion", o.adhesion,
                   fmt::format("adhesion model: {}", listOfNames(lawNames<Bridges>())));
    app.add_flag("--solve-outside-table", o.solveOutsideTable,
                 "LiquidBridgeYoungLaplace only: solve the equation for bridges outside of its table");
    app.add_option("--time-step-s", o.timeStep, "time step, s; 0 takes 1/50 of the Rayleigh time");
    app.add_option("--time-max-s", o.timeMax, "end of the run, s, if the grains have not parted before");
    app.add_option("--advise-within-percent", o.adviceTolerance,
                   "say how far the bridge law is from the exact solution, and which law is the cheapest one "
                   "within this error, %; 0: say nothing");
    addRunOptions(app, o.run, "force_separation.csv and energy.csv");
}

void run(const Options& options) {
    checkValue("TwoParticleCollision", "speed", options.speed, "m/s", positive);
    checkValue("TwoParticleCollision", "advise-within-percent", options.adviceTolerance, "%", notNegative);
    withLawNamed<Bridges>("adhesion model", options.adhesion,
                          [&]<class Adhesion>() { TwoParticleCollision<Adhesion>(options).solve(); });
}

}  // namespace

int main(int argc, char** argv) {
    return runDriver("TwoParticleCollision",
                     "Two grains collide head-on and are joined by a liquid bridge until it ruptures.",
                     Options(), describe, run, argc, argv);
}
