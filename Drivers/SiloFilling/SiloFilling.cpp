/// A silo is filled by a stream of grains of many sizes: pressure on its wall over depth, against Janssen.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/WallPressure.h"
#include "Kernel/Analysis/Output/GrainFlowFiles.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "Kernel/MercuryNames.h"

namespace {

struct Options {
    double radius = 0.0125, mass = 0.06, friction = 0.4;                     // m, kg
    double median = 2.5e-3, deviation = 1.15;                                // m, geometric
    std::string sizes;                                                       // file; empty: lognormal
    double fillTime = 0.6, endTime = 1, averageTime = 0.1, interval = 2e-3;  // s
    RunOptions run{.output = "SiloFilling-output"};
};

struct SiloFilling : Simulation<HertzianViscoelasticMindlinIncrementalSpecies> {
    explicit SiloFilling(const Options& given) : o(given) { o.run.apply(*this), setTimeMax(o.endTime); }

    void setupInitialConditions() override {
        auto* const glass = speciesHandler.copyAndAddObject({});
        glass->setDensity(2500), glass->setElasticModulusAndPoissonRatio(2e7, 0.3);
        glass->setEffectiveShearModulus(computeEffectiveShearModulus(2e7, 0.3));
        glass->setRestitutionCoefficient(0.5), glass->setSlidingFrictionCoefficient(o.friction);
        InfiniteWall plate;
        plate.setSpecies(glass), plate.set({0, 0, -1}, {0, 0, 0});
        floor = wallHandler.copyAndAddObject(plate);
        InfiniteCylinder tube;
        tube.setSpecies(glass), tube.set({0, 0, 1}, {0, 0, 0}, o.radius, CylinderSide::Inside);
        wallHandler.copyAndAddObject(tube);
        SphericalParticle grain;
        grain.setSpecies(glass), grain.setVelocity({0, 0, -0.5});
        const double top = o.mass / (1250 * constants::pi * o.radius * o.radius);  // m, above the bed
        Inlet inlet;
        inlet.setRegion(CylinderRegion({0, 0, top}, {0, 0, top + o.radius}, o.radius));
        inlet.setSizes(o.sizes.empty()
                           ? lognormalSizes(o.median, o.deviation, o.median / 1.5, 1.5 * o.median).sizes
                           : readSizeTable(o.sizes));
        inlet.setGrain(grain);
        inlet.setMassFlow(o.mass / o.fillTime), inlet.setTimes(0, o.fillTime);
        inletHandler.copyAndAddObject(inlet), addOutput(InletFile(0.01));
        setGravity({0, 0, -9.81}), setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 15));
    }
    void actionsAfterTimeStep() override {
        const auto in = [&](double time) { return std::max<std::size_t>(stepsOf(time, getTimeStep()), 1); };
        const std::size_t step = getNumberOfTimeSteps();
        // The floor sinks, so that the friction of the wall is mobilised, as Janssen's balance had it.
        if (step == in(o.fillTime + 0.2)) floor->setVelocity({0, 0, -2.5 * o.median});
        if (step == in(o.fillTime + 0.3)) floor->setVelocity({0, 0, 0});
        if (step % in(o.interval) == 0 && getTime() > o.endTime - o.averageTime) pressure.sample(*this, 1);
    }
    void completeOutput() override {
        if (pressure.isEmpty()) return;
        pressure.write(o.run.output + "/pressure.csv");
        const WallPressure::Law law = pressure.law();
        if (!isQuiet())
            fmt::print("K = {:.3f}, friction {:.3f}, length {:.4f} m, on the wall {:.1f} % of the weight\n",
                       law.ratio, law.friction, law.length, 100 * law.shareOfWall);
    }
    void visitState(StateArchive& archive) override { pressure.visitState(archive); }

    Options o;
    InfiniteWall* floor = nullptr;
    WallPressure pressure{o.radius};
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "SiloFilling",
        .description = "A silo is filled: its wall pressure against Janssen's law.",
        .options = o.run,
        .addOptions =
            [&](CLI::App& app) {
                app.add_option("--sizes", o.sizes,
                               "CSV file of sizes instead (see the page on size distributions)")
                    ->type_name(fileName);
            },
        .files = "pressure.csv",
        .numbers = {
            {"radius", "m", &o.radius, positive, "of the silo"},
            {"mass", "kg", &o.mass, positive, "of the filling"},
            {"median", "m", &o.median, positive, "diameters by number, cut at a factor of 1.5"},
            {"deviation", "", &o.deviation, {1, 10, false}, "geometric standard deviation of the diameters"},
            {"friction", "", &o.friction, {0, 10}, "of grains and wall"},
            {"fill-time", "s", &o.fillTime, positive, "until all grains have come"},
            {"end-time", "s", &o.endTime, notNegative, "end of the run"},
            {"average", "s", &o.averageTime, positive, "before the end, in which pressures are averaged"},
            {"interval", "s", &o.interval, positive, "between two states of the mean"}}};
    return runDriver(driver, argc, argv, [&] {
        checkValue("SiloFilling", "--average-s", o.averageTime, "s", {o.interval, o.endTime});
        SiloFilling(o).solve();
    });
}
