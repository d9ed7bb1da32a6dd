/// Grains in a cylinder whose rough floor is split: a disc in its middle turns, the ring around it and the
/// side wall stand. The shear band above the split, by coarse graining: Fenistein and van Hecke, Nature 425
/// (2003) 256; Fenistein, van de Meent and van Hecke, Phys. Rev. Lett. 92 (2004) 094301.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/SplitCylinder.h"
#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Output/RunTable.h"

namespace {

constexpr double interval = 0.012;  // s, between two states of the mean

struct Options {
    SplitShape shape;
    double begin = 2, endTime = 6;  // s
    RunOptions run{.output = "SplitBottom-output"};
};

class SplitBottom : public SplitCylinder {
public:
    explicit SplitBottom(const Options& given) : SplitCylinder(given.shape), options(given) {
        options.run.apply(*this), setTimeMax(options.endTime);
    }

    void setupInitialConditions() override {
        SplitCylinder::setupInitialConditions();
        setSaveCount(stepsOf(interval, getTimeStep()));
    }
    void writeOutput() override {
        if (getTime() < options.begin) return;
        GrainState state = stateOf(*this, FieldContent::WithoutContacts);
        state.grains.resize(bedSize());
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
                             options.shape.rate);
        }
        file.close();
        if (!options.run.quiet) fmt::print("Wrote {}/profile.csv\n", options.run.output);
    }
    void visitState(StateArchive& archive) override {
        SplitCylinder::visitState(archive);
        std::uint64_t states = sums.states();
        std::vector<double> numbers = sums.numbers();
        archive.value("states", states), archive.column<double>("sums", numbers);
        if (archive.isReading()) sums.setNumbers(numbers, states);
    }

private:
    Options options;
    FieldSums sums{
        FieldGrid("RZ", {-options.shape.cylinder, -options.shape.cylinder, 0},
                  {options.shape.cylinder, options.shape.cylinder, 1.2 * radius*(options.shape.layers + 2)},
                  radius),
        SmoothingKernel(KernelShape::Gauss, 2, 0.5 * radius), GrainGroups::none(),
        FieldContent::WithoutContacts};
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "SplitBottom",
        .description = "Grains on a split floor.",
        .options = o.run,
        .files = "profile.csv",
        .numbers = {
            {"disc", "m", &o.shape.disc, positive, "radius of the disc that turns"},
            {"cylinder", "m", &o.shape.cylinder, {0.008, 0.2}, "radius of the cylinder"},
            {"layers", "", &o.shape.layers, {2, 150}, "of loose grains; each becomes 1.1 mm of the bed"},
            {"rate", "rad/s", &o.shape.rate, {1e-6, 10}, "at which the disc turns"},
            {"begin", "s", &o.begin, notNegative, "time from which on the profile is a mean"},
            {"end-time", "s", &o.endTime, {interval, 1e6}, "end of the run"}}};
    return runDriver(driver, argc, argv, [&] {
        checkValue("SplitBottom", "--disc-m", o.shape.disc, "m", {0.004, o.shape.cylinder});
        checkValue("SplitBottom", "--begin-s", o.begin, "s", {0, o.endTime - interval});
        SplitBottom(o).solve();
    });
}
