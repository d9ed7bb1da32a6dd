/// Grains in a turning drum are sprayed: how evenly the liquid lies on them, over time, against what an ideal
/// mixer would give.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/GrainLattice.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/MercuryNames.h"

namespace {

using Material = LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies;

struct Options {
    double drumRadius = 0.025, length = 0.015;            // m
    double radius = 1e-3;                                 // m, of the grains
    double speed = 60;                                    // turns a minute
    double dropRadius = 1e-4, dropSpeed = 2, angle = 60;  // m, m/s, degrees
    double dropsOfAGrain = 20;                            // until the end
    double spread = 0;                                    // of the volumes of droplets
    double volumeMax = 0;                                 // m^3, of a bridge
    double begin = 0.5, endTime = 10.5, interval = 0.1;   // s
    RunOptions run{.output = "SprayCoating-output"};
};

class SprayCoating : public Simulation<Material> {
public:
    explicit SprayCoating(const Options& given) : options(given) {
        options.run.apply(*this);
        setTimeMax(options.endTime);
    }

    void setupInitialConditions() override {
        material = speciesHandler.copyAndAddObject({});
        material->setDensity(2000);
        material->setStiffness(300);
        material->setDissipation(2e-3);
        material->setSlidingStiffness(300 * 2.0 / 7);
        material->setSlidingDissipation(2e-3 * 2.0 / 7);
        material->setSlidingFrictionCoefficient(0.5);
        material->setLiquidBridgeVolumeMax(options.volumeMax);
        material->setContactAngle(0.3);
        material->setSurfaceTension(0.05);
        InfiniteCylinder drum;
        drum.setSpecies(material);
        drum.set({0, 1, 0}, {0, 0, 0}, options.drumRadius, CylinderSide::Inside);
        drum.setAngularVelocity({0, -options.speed * constants::pi / 30, 0}, {0, 0, 0});
        wallHandler.copyAndAddObject(drum);
        setPeriodic(1, 0, options.length);
        setGravity({0, 0, -9.81});
        addSpray();
        if (!isRestarted()) addGrains();
        setTimeStep(2e-5);
        setSaveCount(stepsOf(options.interval, getTimeStep()));
    }
    void writeOutput() override {
        double count = 0, dry = 0, sum = 0, squares = 0;
        for (auto&& grain : particleHandler) {
            const double volume = grain.getLiquidVolume();
            count += 1, sum += volume, squares += volume * volume;
            dry += volume > 0 ? 0 : 1;
        }
        if (sum == 0) return;
        const double mean = sum / count, lambda = mean / dropVolume;
        const double variation = std::sqrt(std::max(squares / count / (mean * mean) - 1, 0.0));
        const LiquidLedger ledger = liquidLedger();
        table.row(getTime(), lambda, variation,
                  std::sqrt((1 + options.spread * options.spread - 1 / count) / lambda), dry / count,
                  std::exp(-lambda), ledger.airborne, ledger.lost);
    }
    void completeOutput() override {
        table.close();
        if (!options.run.quiet) fmt::print("Wrote {}/coating.csv\n", options.run.output);
    }
    void visitState(StateArchive& archive) override { table.visitState(archive); }

private:
    [[nodiscard]] std::vector<Vec3D> cells() const {
        const double edge = 2 * latticeLooseness * options.radius, inner = options.drumRadius - 0.6 * edge;
        // The lower two thirds of the drum, which settle to a third or so.
        const Vec3D lowest(-options.drumRadius, 0, -options.drumRadius),
            highest(options.drumRadius, options.length, options.drumRadius / 4);
        return latticeCells(lowest, highest, edge, [&](const Vec3D& cell) {
            return std::hypot(cell.x(), cell.z()) < inner - 0.2 * edge;
        });
    }
    /// A nozzle above the middle of the bed, of which the drum takes the upper part towards +x.
    void addSpray() {
        Spray spray;
        const double height = 0.6 * options.drumRadius;
        spray.setCone({0.2 * options.drumRadius, 0.5 * options.length, height}, {0, 0, -1},
                      options.angle * constants::pi / 180);
        spray.setDropletRadius(options.dropRadius);
        spray.setSpeed(options.dropSpeed);
        spray.setVolumeSpread(options.spread);
        spray.setTimes(options.begin, options.endTime);
        dropVolume = spray.dropletVolume();
        const auto count = static_cast<double>(cells().size());
        spray.setFlow(options.dropsOfAGrain * count * dropVolume / (options.endTime - options.begin));
        sprayHandler.copyAndAddObject(spray);
    }
    void addGrains() {
        UniformRandom random(1);
        SphericalParticle grain;
        grain.setSpecies(material);
        for (const Vec3D& cell : cells()) {
            const GrainRow place = jittered(options.radius, cell, random);
            grain.setRadius(place.radius);
            grain.setPosition(place.position);
            particleHandler.copyAndAddObject(grain);
        }
    }

    Options options;
    Material* material = nullptr;
    double dropVolume = 0;  // m^3
    RunTable table{options.run.output + "/coating.csv",
                   "time_s,drops_of_a_grain,variation,variation_if_mixed,dry_share,dry_share_if_mixed,"
                   "airborne_m3,lost_m3"};
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "SprayCoating",
        .description = "Grains in a drum are sprayed: how even the liquid is.",
        .options = o.run,
        .files = "coating.csv",
        .numbers = {
            {"drum-radius", "m", &o.drumRadius, {0.01, 1}, "of the drum"},
            {"length", "m", &o.length, positiveUpTo(1), "of the drum, along which it repeats itself"},
            {"radius", "m", &o.radius, {1e-4, 0.1}, "of the grains"},
            {"speed", "rpm", &o.speed, {0, 300}, "of the drum"},
            {"drop-radius", "m", &o.dropRadius, positive, "of the droplets"},
            {"drop-speed", "m/s", &o.dropSpeed, notNegative, "of the droplets at the nozzle"},
            {"angle", "deg", &o.angle, positiveUpTo(360), "of the spray's cone"},
            {"drops-of-a-grain", "", &o.dropsOfAGrain, positive, "droplets that come out, over the grains"},
            {"volume-spread", "", &o.spread, notNegative,
             "relative standard deviation of the volumes of droplets"},
            {"bridge-volume-max", "m3", &o.volumeMax, notNegative,
             "largest volume of a bridge; 0: films only"},
            {"begin", "s", &o.begin, notNegative, "when the spray begins"},
            {"end-time", "s", &o.endTime, notNegative, "end of the run"},
            {"interval", "s", &o.interval, positive, "time between two rows"}}};
    return runDriver(driver, argc, argv, [&] {
        checkValue("SprayCoating", "--radius-m", o.radius, "m", {1e-4, 0.1 * o.drumRadius});
        checkValue("SprayCoating", "--length-m", o.length, "m", {8 * o.radius, 1});
        checkValue("SprayCoating", "--begin-s", o.begin, "s", {0, o.endTime, true, false});
        SprayCoating(o).solve();
    });
}
