/// Wet grains in a split-bottom cell: the halves of a rough floor, with the walls beside them, move against
/// each other. Bridges in the shear band above the slit rupture again and again, and liquid leaves it: Mani,
/// Kadau, Or and Herrmann, Phys. Rev. Lett. 109 (2012) 248001.

#include <array>

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/GrainLattice.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/MercuryNames.h"

namespace {

using Material = LinearViscoelasticSlidingFrictionLiquidMigrationBagheriSpecies;

struct Options {
    double length = 0.02, width = 0.044, height = 0.013;  // m, of the bed
    double speed = 0.04;                                  // m/s, of one half against the other
    double film = 3e-11;                                  // m^3, on each grain at the start
    double volumeMax = 9e-11;                             // m^3, of a bridge
    double volumeMin = 0;                                 // m^3
    double share = 1;                   // of a ruptured bridge, that is offered to other bridges
    double endTime = 20, interval = 1;  // s
    RunOptions run{.output = "LiquidInShear-output"};
};

/// What is in a slice of the cell along y; summed over the samples since the last row.
struct Slice {
    double grains = 0;
    double velocity = 0;            // m/s, along x
    double films = 0, bridges = 0;  // m^3
};

class LiquidInShear : public Simulation<Material> {
public:
    explicit LiquidInShear(const Options& given) : options(given) {
        options.run.apply(*this);
        setTimeMax(options.endTime);
    }

    void setupInitialConditions() override {
        addMaterial();
        addWalls();
        setPeriodic(0, 0, options.length);
        setGravity({0, 0, -9.81});
        if (!isRestarted()) addFloor(), addBed();
        setTimeStep(2e-5);
        setSaveCount(stepsOf(options.interval, getTimeStep()));
        samplePeriod = std::max<std::size_t>(stepsOf(options.interval, getTimeStep()) / 100, 1);
    }

    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % samplePeriod == 0) sample();
    }
    void writeOutput() override {
        if (getNumberOfTimeSteps() == 0) sample();
        for (std::size_t k = 0; k < slices.size(); ++k) {
            const Slice& slice = slices[k];
            if (slice.grains == 0) continue;
            profile.row(getTime(), middleOf(k), slice.grains / samples, slice.velocity / slice.grains,
                        slice.films / slice.grains, slice.bridges / slice.grains);
        }
        slices = {};
        samples = 0;
    }
    void completeOutput() override {
        profile.close();
        if (!options.run.quiet) fmt::print("Wrote {}/profile.csv\n", options.run.output);
    }
    void visitState(StateArchive& archive) override {
        archive.record<double>("slices", slices);
        archive.value("samples", samples);
        profile.visitState(archive);
    }

private:
    static constexpr double radius = 1e-3;  // m, of the largest grain
    static constexpr std::size_t count = 22;

    void addMaterial() {
        material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500);
        material->setStiffness(300);
        material->setDissipation(2e-3);
        material->setSlidingStiffness(300 * 2.0 / 7);
        material->setSlidingDissipation(2e-3 * 2.0 / 7);
        material->setSlidingFrictionCoefficient(0.5);
        material->setLiquidBridgeVolumeMax(options.volumeMax);
        material->setLiquidBridgeVolumeMin(options.volumeMin);
        material->setDistributionCoefficient(options.share);
        material->setContactAngle(20 * constants::pi / 180);
        material->setSurfaceTension(0.010);
        // The walls only hold the bed together: they are dry.
        wallMaterial = speciesHandler.copyAndAddObject(*material);
        speciesHandler.getMixedObject(material, wallMaterial)->setLiquidBridgeVolumeMax(0);
    }
    /// The floor is below the held grains, so that none falls through between two of them.
    void addWalls() {
        for (const double side : {-1.0, 1.0}) {
            InfiniteWall wall;
            wall.setSpecies(wallMaterial);
            wall.set({0, side, 0}, {0, 0.5 * side * options.width, 0});
            wall.setVelocity(velocityAt(side));
            wallHandler.copyAndAddObject(wall);
        }
        InfiniteWall floor;
        floor.setSpecies(wallMaterial);
        floor.set({0, 0, -1}, {0, 0, -radius});
        wallHandler.copyAndAddObject(floor);
    }
    [[nodiscard]] Vec3D velocityAt(double y) const { return {(y < 0 ? -0.5 : 0.5) * options.speed, 0, 0}; }
    /// Dry grains that are held and move with their half, at places that are a little irregular.
    void addFloor() {
        SphericalParticle grain;
        grain.setSpecies(wallMaterial);
        for (const Vec3D& cell : latticeCells({0, -0.5 * options.width, -radius},
                                              {options.length, 0.5 * options.width, 1.1 * radius}, 2 * radius,
                                              [](const Vec3D&) { return true; })) {
            grain.setRadius(random.uniform(0.8, 1) * radius);
            grain.setPosition({cell.x(), cell.y(), random.uniform(-0.4, 0) * radius});
            auto added = particleHandler.copyAndAddObject(grain);
            added.fixParticle();
            added.setVelocity(velocityAt(cell.y()));
        }
    }
    void addBed() {
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setLiquidVolume(options.film);
        const double edge = 2 * latticeLooseness * radius;
        const Vec3D lowest(0, -0.5 * options.width, 1.1 * radius),
            highest(options.length, 0.5 * options.width, 1.1 * radius + 1.35 * options.height);
        for (const Vec3D& cell : latticeCells(lowest, highest, edge, [](const Vec3D&) { return true; })) {
            const GrainRow place = jittered(random.uniform(0.8, 1) * radius, cell, random);
            grain.setRadius(place.radius);
            grain.setPosition(place.position);
            grain.setVelocity(velocityAt(place.position.y()));
            particleHandler.copyAndAddObject(grain);
        }
    }

    [[nodiscard]] double middleOf(std::size_t slice) const {
        return options.width * ((static_cast<double>(slice) + 0.5) / count - 0.5);
    }
    Slice& sliceAt(double y) {
        const double place = (y / options.width + 0.5) * count;
        return slices[static_cast<std::size_t>(std::clamp(place, 0.0, count - 1.0))];
    }
    void sample() {
        gather();  // on several ranks
        samples += 1;
        for (auto&& grain : particleHandler) {
            if (grain.isFixed()) continue;
            Slice& slice = sliceAt(grain.getPosition().y());
            slice.grains += 1;
            slice.velocity += grain.getVelocity().x();
            slice.films += grain.getLiquidVolume();
        }
        for (const ObservedContact& seen : interactions())
            if (seen.bridgeVolume > 0) sliceAt(seen.point.y).bridges += seen.bridgeVolume;
    }

    Options options;
    Material *material = nullptr, *wallMaterial = nullptr;
    UniformRandom random{1};
    std::array<Slice, count> slices{};
    double samples = 0;
    std::size_t samplePeriod = 1;
    RunTable profile{options.run.output + "/profile.csv",
                     "time_s,y_m,grains,velocity_m/s,film_m3,bridges_m3"};
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "LiquidInShear",
        .description = "Wet grains in a split-bottom cell: liquid leaves the shear band.",
        .options = o.run,
        .files = "profile.csv",
        .numbers = {
            {"length", "m", &o.length, {0.01, 1}, "of the bed along the slit, in which it repeats itself"},
            {"width", "m", &o.width, {0.01, 1}, "of the bed across the slit"},
            {"height", "m", &o.height, {0.004, 1}, "of the bed, about"},
            {"speed", "m/s", &o.speed, {-1, 1}, "of one half of the floor against the other"},
            {"film", "m3", &o.film, notNegative, "liquid on each grain at the start"},
            {"bridge-volume-max", "m3", &o.volumeMax, notNegative, "largest volume of a bridge; 0: dry"},
            {"bridge-volume-min", "m3", &o.volumeMin, notNegative,
             "two films form a bridge if they offer more than this"},
            {"distribution-coefficient", "", &o.share, fromZeroTo(1),
             "share of a ruptured bridge that is offered to others"},
            {"end-time", "s", &o.endTime, notNegative, "end of the run"},
            {"interval", "s", &o.interval, positive, "time between two profiles"}}};
    return runDriver(driver, argc, argv, [&] { LiquidInShear(o).solve(); });
}
