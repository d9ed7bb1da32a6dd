/// Grains turn in a drum with lifters: where they wear it, by Archard's law.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/GrainLattice.h"
#include "Drivers/WornDrum/LifterDrum.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/MercuryNames.h"

namespace {

using Material = LinearViscoelasticSlidingFrictionSpecies;

struct Options {
    LifterDrum drum;
    double radius = 1e-3;                       // m, of the grains
    double speed = 60;                          // turns a minute
    double coefficient = 1e-3, hardness = 1e9;  // K, H in Pa
    double endTime = 2, interval = 0.05;        // s
    RunOptions run{.output = "WornDrum-output"};
};

class WornDrum : public Simulation<Material> {
public:
    explicit WornDrum(const Options& given) : options(given) {
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
        TriangleWall mesh;
        mesh.setSpecies(material);
        mesh.set(options.drum.triangles(2 * options.radius));
        mesh.setAngularVelocity({0, -options.speed * constants::pi / 30, 0}, {0, 0, 0});
        mesh.keepWear(WearLaw::archard(options.coefficient, options.hardness));
        drum = wallHandler.copyAndAddObject(mesh);
        setPeriodic(1, 0, options.drum.length);
        setGravity({0, 0, -9.81});
        if (!isRestarted()) addGrains();
        setTimeStep(2e-5);
        setSaveCount(stepsOf(options.interval, getTimeStep()));
    }
    void writeOutput() override {
        const WornTriangles& wear = drum->getWear();
        std::array<double, LifterDrum::faceCount> volumes{};  // m^3
        for (std::size_t t = 0; t < wear.size(); ++t)
            volumes[static_cast<std::size_t>(options.drum.faceOf(t))] += wear.of(t).volume;
        const SurfaceWear sum = wear.sum();
        table.row(getTime(), getTime() * options.speed / 60, volumes[0], volumes[1], volumes[2], volumes[3],
                  sum.slidingWork, sum.impactWork, sum.impacts);
    }
    void completeOutput() override {
        table.close();
        if (!options.run.quiet) fmt::print("Wrote {}/worn.csv\n", options.run.output);
    }
    void visitState(StateArchive& archive) override { table.visitState(archive); }

private:
    /// Adds grains in the lower half of what the lifters leave free; they fall.
    void addGrains() {
        UniformRandom random(1);
        SphericalParticle grain;
        grain.setSpecies(material);
        const double edge = 2 * latticeLooseness * options.radius,
                     free = options.drum.radius - options.drum.height - edge;
        const auto fits = [&](const Vec3D& cell) { return std::hypot(cell.x(), cell.z()) < free; };
        for (const Vec3D& cell :
             latticeCells({-free, 0, -free}, {free, options.drum.length, 0.25 * free}, edge, fits)) {
            const GrainRow place = jittered(options.radius, cell, random);
            grain.setRadius(place.radius);
            grain.setPosition(place.position);
            particleHandler.copyAndAddObject(grain);
        }
    }

    Options options;
    Material* material = nullptr;
    TriangleWall* drum = nullptr;
    RunTable table{
        options.run.output + "/worn.csv",
        "time_s,turns,shell_m3,leading_m3,tops_m3,trailing_m3,sliding_work_J,impact_work_J,impacts"};
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "WornDrum",
        .description = "Grains turn in a drum with lifters: where they wear it, by Archard's law.",
        .options = o.run,
        .files = "worn.csv",
        .numbers = {
            {"drum-radius", "m", &o.drum.radius, {0.01, 1}, "of the drum"},
            {"length", "m", &o.drum.length, positiveUpTo(1), "of the drum, along which it repeats itself"},
            {"lifters", "", &o.drum.lifters, {2, 100}, "on the shell"},
            {"lifter-height", "m", &o.drum.height, positive, "of the lifters, as wide as high"},
            {"radius", "m", &o.radius, {1e-4, 0.1}, "of the grains"},
            {"speed", "rpm", &o.speed, {0, 300}, "of the drum"},
            {"archard", "", &o.coefficient, notNegative, "K of Archard's law"},
            {"hardness", "Pa", &o.hardness, positive, "H of the drum"},
            {"end-time", "s", &o.endTime, notNegative, "end of the run"},
            {"interval", "s", &o.interval, positive, "time between two rows"}}};
    return runDriver(driver, argc, argv, [&] {
        checkValue("WornDrum", "--radius-m", o.radius, "m", {1e-4, 0.1 * o.drum.radius});
        checkValue("WornDrum", "--length-m", o.drum.length, "m", {4.8 * o.radius, 1});
        checkValue("WornDrum", "--lifter-height-m", o.drum.height, "m", {o.radius, 0.3 * o.drum.radius});
        checkValue("WornDrum", "--lifters", o.drum.lifters, "", {2, 2 * o.drum.radius / o.drum.height});
        WornDrum(o).solve();
    });
}
