/// A bed of wet grains dries: its bridges shrink and pull harder, until one after the other ruptures or is
/// gone. The capillary tension of the bed is compared with that of Rumpf (1970) for bridges of no volume.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/GrainLattice.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/MercuryNames.h"

namespace {

using Material = LinearViscoelasticSlidingFrictionLiquidMigrationYoungLaplaceSpecies;

struct Options {
    std::size_t number = 1000;
    double radius = 5e-4;                                  // m, of the largest grain
    double film = 1e-11;                                   // m^3, on each grain at the start
    double surfaceTension = 0.0728, contactAngle = 0;      // N/m, degrees
    double flux = 1e-3;                                    // m/s
    double begin = 0.05, endTime = 0.25, interval = 1e-3;  // s
    std::size_t steps = 50;                                // between two updates of the volumes
    RunOptions run{.output = "DryingBed-output"};
};

class DryingBed : public Simulation<Material> {
public:
    explicit DryingBed(const Options& given) : options(given) {
        options.run.apply(*this);
        setTimeMax(options.endTime);
    }

    void setupInitialConditions() override {
        material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500);
        material->setStiffness(200);
        material->setDissipation(1e-3);
        material->setSlidingStiffness(200 * 2.0 / 7);
        material->setSlidingDissipation(1e-3 * 2.0 / 7);
        material->setSlidingFrictionCoefficient(0.5);
        // Larger bridges of three grains would meet.
        material->setLiquidBridgeVolumeMax(0.0577 * std::pow(0.8 * options.radius, 3));
        material->setContactAngle(options.contactAngle * constants::pi / 180);
        material->setSurfaceTension(options.surfaceTension);
        // The floor only holds the bed: it is dry.
        auto* const floorMaterial = speciesHandler.copyAndAddObject(*material);
        speciesHandler.getMixedObject(material, floorMaterial)->setLiquidBridgeVolumeMax(0);
        InfiniteWall floor;
        floor.setSpecies(floorMaterial);
        floor.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(floor);
        setPeriodic(0, 0, width()), setPeriodic(1, 0, width());
        setGravity({0, 0, -9.81});
        Evaporation drying;
        drying.setFlux(options.flux);
        drying.setInterval(options.steps);
        drying.setStartTime(options.begin);
        setEvaporation(drying);
        if (!isRestarted()) addBed();
        setTimeStep(5e-6);
        setSaveCount(stepsOf(options.interval, getTimeStep()));
    }
    void writeOutput() override {
        double work = 0, force = 0, bridges = 0;
        for (const ObservedContact& seen : interactions()) {
            if (!(seen.bridgeVolume > 0)) continue;
            work += seen.adhesiveForce * norm(seen.shift);
            force += seen.adhesiveForce;
            bridges += 1;
        }
        double solid = 0, height = 0;
        for (auto&& grain : particleHandler) {
            solid += 4.0 / 3 * constants::pi * std::pow(grain.getRadius(), 3);
            height += 2 * grain.getPosition().z();  // the middle of an even bed is at half of its height
        }
        const auto grains = static_cast<double>(particleHandler.getSize());
        const double volume = width() * width() * height / grains, diameter = 1.8 * options.radius;
        // Rumpf: a contact pulls with 2 pi R gamma cos(theta), R = d/2, z bridges of a grain.
        const double rumpf = solid / volume * (2 * bridges / grains) * options.surfaceTension *
                             std::cos(material->getContactAngle()) / diameter;
        const LiquidLedger ledger = liquidLedger();
        table.row(getTime(), ledger.films, ledger.bridges, ledger.evaporated, 2 * bridges / grains,
                  bridges > 0 ? force / bridges : 0, work / (3 * volume), rumpf, solid / volume);
    }
    void completeOutput() override {
        table.close();
        if (!options.run.quiet) fmt::print("Wrote {}/drying.csv\n", options.run.output);
    }
    void visitState(StateArchive& archive) override { table.visitState(archive); }

private:
    /// m, of the square base: the bed is about as high as wide.
    [[nodiscard]] double width() const {
        return 2.1 * options.radius * std::ceil(std::cbrt(static_cast<double>(options.number)));
    }
    void addBed() {
        UniformRandom random(1);
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setLiquidVolume(options.film);
        const double edge = 2 * latticeLooseness * options.radius;
        const Vec3D highest(width(), width(), 2 * width());
        for (const Vec3D& cell : latticeCells({0, 0, 0}, highest, edge, [](const Vec3D&) { return true; })) {
            if (particleHandler.getSize() == options.number) break;
            const GrainRow place = jittered(random.uniform(0.8, 1) * options.radius, cell, random);
            grain.setRadius(place.radius);
            grain.setPosition(place.position);
            particleHandler.copyAndAddObject(grain);
        }
    }

    Options options;
    Material* material = nullptr;
    RunTable table{options.run.output + "/drying.csv",
                   "time_s,films_m3,bridges_m3,evaporated_m3,bridges_of_a_grain,mean_force_N,tension_Pa,"
                   "rumpf_Pa,solid_fraction"};
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "DryingBed",
        .description = "A bed of wet grains dries: its capillary tension over time.",
        .options = o.run,
        .files = "drying.csv",
        .numbers = {
            {"number", "", &o.number, {1, 1e8}, "grains"},
            {"radius", "m", &o.radius, {1e-4, 1e-2}, "of the largest grain; the smallest have 0.8 of it"},
            {"film", "m3", &o.film, notNegative, "liquid on each grain at the start"},
            {"surface-tension", "N/m", &o.surfaceTension, notNegative, "of the liquid"},
            {"contact-angle", "deg", &o.contactAngle, {0, 89}, "of the liquid"},
            {"flux", "m/s", &o.flux, notNegative, "volume that a free surface loses for its area and time"},
            {"drying-steps", "", &o.steps, {1, 1e9}, "steps between two updates of the volumes"},
            {"begin", "s", &o.begin, notNegative, "when the bed begins to dry"},
            {"end-time", "s", &o.endTime, notNegative, "end of the run"},
            {"interval", "s", &o.interval, positive, "time between two rows"}}};
    return runDriver(driver, argc, argv, [&] { DryingBed(o).solve(); });
}
