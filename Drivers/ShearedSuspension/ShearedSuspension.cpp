/// Wet grains in a viscous liquid that is sheared, without walls: bridges hold clusters together, and shear
/// tears them apart. After Figures 7 and 8 of Yang, Sega and Harting, with Stokes's drag in place of their
/// lattice Boltzmann fluid.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/ShearedSuspension/SuspensionLaws.h"
#include "Kernel/Analysis/Observables/Clusters.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/MercuryNames.h"

namespace {

struct Options {
    std::string law = "model-c";
    double cohesion = 1, stokes = 0.05;
    double contactAngle = 123;  // degrees
    double friction = 0, restitution = 0.5;
    std::size_t number = 2000, seed = 1;
    double strain = 16, begin = 4, interval = 0.1;
    RunOptions run{.output = "ShearedSuspension-output"};
};

template <class Law>
class ShearedSuspension : public Simulation<Species<LinearViscoelastic, SlidingFriction, Law>> {
public:
    explicit ShearedSuspension(const Options& given) : options(given) {
        options.run.apply(*this);
        this->setTimeMax(options.strain / rate);
    }

    void setupInitialConditions() override {
        auto* const material = this->speciesHandler.copyAndAddObject({});
        const double contactTime = 2.5e-3 / rate;
        material->setDensity(density);
        material->setCollisionTimeAndRestitutionCoefficient(contactTime, options.restitution, mass);
        material->setSlidingStiffness(2.0 / 7 * material->getStiffness());
        material->setSlidingDissipation(2.0 / 7 * material->getDissipation());
        material->setSlidingFrictionCoefficient(options.friction);
        setBridges(*material);
        const auto count = static_cast<double>(options.number);
        edge = radius * std::cbrt(4 * constants::pi / 3 * count / solidFraction);
        for (int axis = 0; axis < 3; ++axis) this->setPeriodic(axis, 0, edge);
        this->setLeesEdwards(0, 1, rate);
        if (!this->isRestarted()) addGrains(material);
        for (const char* name : {"cluster", "cluster_size"})
            columns.push_back(this->particleHandler.addColumn(name, "1"));
        this->setTimeStep(contactTime / 20);
        samplePeriod = stepsOf(options.interval / rate, this->getTimeStep());
        this->setSaveCount(samplePeriod);
    }
    /// Stokes's drag 6 pi eta R and its torque 8 pi eta R^3, exact for a step in which they act alone. In
    /// turn with the kernel's step that is a splitting of second order (Strang's, seen half a drag later).
    void actionsAfterTimeStep() override {
        const double kept = std::exp(-this->getTimeStep() / relaxation());
        const double spinKept = std::exp(-this->getTimeStep() / (0.3 * relaxation()));
        const Vec3D spin(0, 0, -0.5 * rate);  // of the flow
        for (GrainReference grain : this->particleHandler.ownGrains()) {
            const Vec3D flow = this->shearFlowAt(grain.getPosition());
            grain.setVelocity(flow + kept * (grain.getVelocity() - flow));
            grain.setAngularVelocity(spin + spinKept * (grain.getAngularVelocity() - spin));
        }
        if (this->getNumberOfTimeSteps() % samplePeriod == 0) sample();
    }
    void sample() {
        this->gather();  // on several ranks
        const Clusters near = clustersWithin(*this, cutOff), joined = clustersOfContacts(*this);
        for (std::size_t k = 0; k < near.ids.size(); ++k) {
            const auto identity = static_cast<std::uint32_t>(near.ids[k]);
            columns[0][identity] = static_cast<double>(near.of[k]);
            columns[1][identity] = static_cast<double>(near.list[near.of[k]].size);
        }
        const double strain = rate * this->getTime();
        table.row(this->getTime(), strain, options.cohesion, options.stokes, near.list.size(),
                  100 * near.aloneOfMembers(), 100 * near.aloneOfClusters(), near.largest(),
                  near.list[0].gyrationRadius / radius, int(near.list[0].isEndless), joined.largest(),
                  100 * joined.aloneOfMembers());
        if (strain < options.begin * (1 - 1e-9)) return;
        samples += 1;
        for (const Cluster& cluster : near.list) histogram[cluster.size] += 1;
    }
    void completeOutput() override {
        table.close();
        CsvFile file(options.run.output + "/histogram.csv", "cluster_size,clusters,grains_percent");
        for (std::size_t size = 1; size < histogram.size(); ++size)
            if (histogram[size] > 0)
                file.row(size, histogram[size] / samples,
                         100 * static_cast<double>(size * histogram[size]) / samples /
                             static_cast<double>(options.number));
        file.close();
        if (!options.run.quiet)
            fmt::print("Wrote {0}/clusters.csv and {0}/histogram.csv\n", options.run.output);
    }
    void visitState(StateArchive& archive) override {
        archive.value("samples", samples);
        archive.column<double>("histogram", histogram);
        table.visitState(archive);
    }

private:
    static constexpr double radius = 1e-3, density = 2500, rate = 10;  // m, kg/m^3, 1/s
    static constexpr double mass = density * 4 * constants::pi / 3 * radius * radius * radius;  // kg
    static constexpr double solidFraction = 0.1079;  // 2000 of radius 3 in a box of 128, as in the paper
    static constexpr double cutOff = 6.5 / 3 * radius;

    [[nodiscard]] double relaxation() const { return options.stokes / rate; }  // s, m / (6 pi eta R)
    /// Gives the law bridges of 5e-6 of a grain's volume each, with the surface tension at which they have
    /// the cohesion number.
    void setBridges(Law& law) const {
        law.liquidBridgeVolume = options.cohesion > 0 ? 5e-6 * mass / density : 0;
        law.contactAngle = options.contactAngle * constants::pi / 180;
        law.surfaceTension = 1;
        if (options.cohesion == 0) return;
        const double pull = law.prepare({radius, radius}).force(0.0);  // N, for 1 N/m
        if (!(pull > 0))
            throw InputError(fmt::format(
                "ShearedSuspension: --law {} does not pull at contact at a contact angle of {} degrees, so "
                "that no surface tension gives a cohesion number of {}: give an angle below 90, or 0.",
                options.law, options.contactAngle, options.cohesion));
        law.surfaceTension = options.cohesion * mass / relaxation() * radius * rate / pull;
    }
    /// Adds grains at random places where there is room.
    template <class Material>
    void addGrains(const Material* material) {
        UniformRandom random{options.seed};
        std::vector<Vector<double>> placed;
        while (placed.size() < options.number) {
            const double x = random.uniform(0, edge), y = random.uniform(0, edge);
            const Vector<double> place{x, y, random.uniform(0, edge)};
            if (std::ranges::any_of(placed, [&](const Vector<double>& other) {
                    return norm(this->getPeriodicBox().nearest(place - other)) < 2 * radius;
                }))
                continue;
            placed.push_back(place);
            SphericalParticle grain;
            grain.setSpecies(material);
            grain.setRadius(radius);
            grain.setPosition(toEigen(place));
            grain.setVelocity(this->shearFlowAt(grain.getPosition()));
            this->particleHandler.copyAndAddObject(grain);
        }
    }

    Options options;
    std::size_t samplePeriod = 1;
    double edge = 0, samples = 0;  // m, -
    std::vector<double> histogram = std::vector<double>(options.number + 1);
    std::vector<GrainColumnReference> columns;
    RunTable table{
        options.run.output + "/clusters.csv",
        "time_s,strain,cohesion_number,stokes_number,clusters,alone_percent_of_grains,"
        "alone_percent_of_clusters,largest_cluster,gyration_radius_of_largest_R,largest_is_endless,"
        "largest_joined_by_contacts,alone_percent_by_contacts"};
};

void run(const Options& o) {
    checkValue("ShearedSuspension", "--interval-strain", o.interval, "", {1e-4, o.strain});
    checkValue("ShearedSuspension", "--begin-strain", o.begin, "", {0, o.strain - o.interval});
    if (o.law == "model-c") return ShearedSuspension<ModelC>(o).solve();
    if (o.law == "model-c-near") return ShearedSuspension<ModelCNear>(o).solve();
    if (o.law == "exact") return ShearedSuspension<LiquidBridgeYoungLaplace>(o).solve();
    if (o.law == "decay") return ShearedSuspension<Decay>(o).solve();
    throw InputError("ShearedSuspension: --law " + o.law +
                     " is none of model-c, model-c-near, exact and decay.");
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "ShearedSuspension",
        .description = "Wet grains in a sheared liquid: sizes of clusters.",
        .options = o.run,
        .addOptions =
            [&](CLI::App& app) {
                app.add_option("--law", o.law,
                               "of the bridges: model-c (the paper's, from touch to rupture), model-c-near "
                               "(without a touch), exact, or decay (a plain attraction without a touch)")
                    ->capture_default_str();
            },
        .files = "clusters.csv, histogram.csv",
        .numbers = {
            {"cohesion",
             "",
             &o.cohesion,
             {0, 1000},
             "force at contact over 6 pi viscosity radius^2 rate; 0: dry"},
            {"stokes", "", &o.stokes, {1e-3, 1e3}, "mass x rate over 6 pi viscosity radius"},
            {"contact-angle", "deg", &o.contactAngle, {0, 180}, "of the bridges"},
            {"friction", "", &o.friction, {0, 10}, "coefficient of friction of the grains"},
            {"restitution", "", &o.restitution, {0.01, 1}, "coefficient of restitution of the grains"},
            {"number", "", &o.number, {3, 1e5}, "number of grains"},
            {"seed", "", &o.seed, {0, 1e18}, "of the places at the start"},
            {"strain", "", &o.strain, positive, "rate x time at the end of the run"},
            {"begin-strain", "", &o.begin, notNegative, "strain from which on the histogram is a mean"},
            {"interval-strain", "", &o.interval, positive, "strain between two rows of the table"}}};
    return runDriver(driver, argc, argv, [&] { run(o); });
}
