/// Grains in a cylinder whose rough floor is split: a disc in its middle turns, the ring around it and the
/// side wall stand. The shear band above the split, by coarse graining: Fenistein and van Hecke, Nature 425
/// (2003) 256; Fenistein, van de Meent and van Hecke, Phys. Rev. Lett. 92 (2004) 094301.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/GrainLattice.h"
#include "Kernel/CoarseGraining/FieldSums.h"
#include "Kernel/CoarseGraining/SceneState.h"
#include "Kernel/MercuryNames.h"
#include "Kernel/Output/RunTable.h"
#include "Kernel/Walls/InfiniteCylinder.h"

namespace {

using Material = LinearViscoelasticSlidingFrictionSpecies;

constexpr double radius = 1e-3;     // m, of the largest grain; the others have 0.8 of it and more
constexpr double interval = 0.012;  // s, between two states of the mean

struct Options {
    double disc = 0.024, cylinder = 0.036;    // m, radii
    int layers = 8;                           // of loose grains, from which the bed settles
    double rate = 1, begin = 2, endTime = 6;  // rad/s, of the disc; s; s
    RunOptions run{.output = "SplitBottom-output"};
};

class SplitBottom : public Simulation<Material> {
public:
    explicit SplitBottom(const Options& given) : options(given) {
        options.run.apply(*this), setTimeMax(options.endTime);
    }

    void setupInitialConditions() override {
        auto* const material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500), material->setStiffness(100), material->setDissipation(1.2e-3);
        material->setSlidingStiffness(100 * 2.0 / 7), material->setSlidingDissipation(1.2e-3 * 2.0 / 7);
        material->setSlidingFrictionCoefficient(0.5);
        InfiniteWall floor;  // at the middles of the held grains, so that none falls between two of them
        floor.setSpecies(material), floor.set({0, 0, -1}, {0, 0, -radius});
        wallHandler.copyAndAddObject(floor);
        InfiniteCylinder side;
        side.setSpecies(material), side.set({0, 0, 1}, {0, 0, 0}, options.cylinder, CylinderSide::Inside);
        wallHandler.copyAndAddObject(side);
        setGravity({0, 0, -9.81}), setTimeStep(3e-5);  // 1/17 of a contact
        setSaveCount(stepsOf(interval, getTimeStep()));
        if (isRestarted()) return;
        addBed(material);
        bed = particleHandler.getSize();
        for (double r = options.disc - radius; r > 0; r -= 2 * radius) addRing(material, r);
        discEnd = particleHandler.getSize();
        for (double r = options.disc + radius; r < options.cylinder; r += 2 * radius) addRing(material, r);
    }
    void actionsBeforeTimeStep() override {
        const Vec3D turn(0, 0, options.rate);
        for (std::size_t k = bed; k < discEnd; ++k) {
            auto grain = particleHandler.getObject(k);
            // That of the middle of the step, so that grains stay on their circle.
            const Vec3D velocity = turn.cross(grain.getPosition());
            grain.setVelocity(velocity + 0.5 * getTimeStep() * turn.cross(velocity));
            grain.setAngularVelocity(turn);
        }
    }
    void writeOutput() override {
        if (getTime() < options.begin) return;
        GrainState state = stateOf(*this);
        state.contacts.clear();
        state.grains.erase(state.grains.begin() + static_cast<std::ptrdiff_t>(bed), state.grains.end());
        sums.add(state, getNumberOfThreads());
    }
    void completeOutput() override {
        CsvFile file(options.run.output + "/profile.csv", "r_m,z_m,solid_fraction,angular_velocity_of_disc");
        const FieldGrid& grid = sums.grid();
        for (std::size_t point = 0; point < grid.size(); ++point) {
            const double r = grid.at(0, point / grid.counts()[2]),
                         solid = sums.ofAll(FieldSums::Volume, point);
            // Nearer to the axis, means over the kernel's width are not those at r.
            if (r > 2 * radius && solid > 0.1)
                file.row(r, grid.at(2, point % grid.counts()[2]), solid,
                         sums.ofAll(FieldSums::Momentum + 1, point) / sums.ofAll(FieldSums::Mass, point) / r /
                             options.rate);
        }
        file.close();
        if (!options.run.quiet) fmt::print("Wrote {}/profile.csv\n", options.run.output);
    }
    void visitState(StateArchive& archive) override {
        std::uint64_t states = sums.states(), first = bed, end = discEnd;
        std::vector<double> numbers = sums.numbers();
        archive.value("bed", first), archive.value("disc_end", end), archive.value("states", states);
        archive.column<double>("sums", numbers);
        if (archive.isReading()) bed = first, discEnd = end, sums.setNumbers(numbers, states);
    }

private:
    auto add(const Material* material, const GrainRow& row) {
        SphericalParticle grain;
        grain.setSpecies(material), grain.setRadius(row.radius), grain.setPosition(row.position);
        return particleHandler.copyAndAddObject(grain);
    }
    /// On a lattice 1.9 times as high as the bed that they settle to.
    void addBed(const Material* material) {
        const double reach = options.cylinder, edge = 2 * latticeLooseness * radius;
        const Vec3D high(reach, reach, (options.layers + 0.5) * edge);
        const auto isInside = [&](const Vec3D& at) { return at.head<2>().norm() < reach - 0.5 * edge; };
        for (const Vec3D& cell : latticeCells({-reach, -reach, 0}, high, edge, isInside))
            add(material, jittered(random.uniform(0.8, 1) * radius, cell, random));
    }
    /// Held grains; their tops are at a height of 0 or a little below.
    void addRing(const Material* material, double r) {
        for (double k = 0, count = std::ceil(constants::pi * r / radius); k < count; ++k) {
            const double a = 2 * constants::pi * k / count;
            const Vec3D place(r * std::cos(a), r * std::sin(a), -radius);
            add(material, {random.uniform(0.8, 1) * radius, place}).fixParticle();
        }
    }

    Options options;
    std::size_t bed = 0, discEnd = 0;  // how many grains the bed has, and then the bed and the disc
    UniformRandom random{1};
    FieldSums sums{FieldGrid("RZ", {-options.cylinder, -options.cylinder, 0},
                             {options.cylinder, options.cylinder, 1.2 * radius*(options.layers + 2)}, radius),
                   SmoothingKernel(KernelShape::Gauss, 2, 0.5 * radius)};
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "SplitBottom",
        .description = "Grains on a split floor.",
        .options = o.run,
        .files = "profile.csv",
        .numbers = {{"disc", "m", &o.disc, positive, "radius of the disc that turns"},
                    {"cylinder", "m", &o.cylinder, {0.008, 0.2}, "radius of the cylinder"},
                    {"layers", "", &o.layers, {2, 150}, "of loose grains; each becomes 1.1 mm of the bed"},
                    {"rate", "rad/s", &o.rate, {1e-6, 10}, "at which the disc turns"},
                    {"begin", "s", &o.begin, notNegative, "time from which on the profile is a mean"},
                    {"end-time", "s", &o.endTime, {interval, 1e6}, "end of the run"}}};
    return runDriver(driver, argc, argv, [&] {
        checkValue("SplitBottom", "--disc-m", o.disc, "m", {0.004, o.cylinder});
        checkValue("SplitBottom", "--begin-s", o.begin, "s", {0, o.endTime - interval});
        SplitBottom(o).solve();
    });
}
