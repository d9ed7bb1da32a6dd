/// Measures what fields cost, and how they err, over the grid, the cut-off of the kernel and the time between
/// samples.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "BuildFolders.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Drivers/Shared/ProcessorTime.h"
#include "Drivers/Shared/RunOptions.h"
#include "Drivers/Shared/SettledGrains.h"
#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/MercuryNames.h"

using namespace pendular;

namespace {

using Sum = FieldSums::Sum;

struct Options {
    std::string positions;
    std::filesystem::path states = folders::benchmarkStates;
    std::size_t particles = 25000, samples = 5;
    double strain = 4;
};

constexpr double width = 2e-3;  // m, of the kernel: a diameter of the bed's grains

double pressureAt(const FieldSums& sums, std::size_t point) {
    return (sums.ofAll(Sum::ContactStress, point) + sums.ofAll(Sum::ContactStress + 4, point) +
            sums.ofAll(Sum::ContactStress + 8, point)) /
           3;
}
double densityAt(const FieldSums& sums, std::size_t point) { return sums.ofAll(Sum::Mass, point); }

/// A box around all grains with so much room (m) on each side.
std::array<Vector<double>, 2> boxAround(const GrainState& state, double room) {
    Vector<double> low{infinity, infinity, infinity}, high = -low;
    for (const GrainState::Grain& grain : state.grains) {
        const Vector<double>& p = grain.position;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vector<double> all{room, room, room};
    return {low - all, high + all};
}

/// Fields of one state of a bed, with a grid and a cut-off.
class BedFields {
public:
    BedFields(Scene& measured, std::size_t calls)
        : scene(measured), samples(calls), state(stateOf(measured)) {
        for (const GrainState::Grain& grain : state.grains) mass += grain.mass;
        for (const GrainState::Contact& contact : state.contacts)
            virial -= dot(contact.force, contact.shift) / 3;
        GrainState again;
        gathering[0] = leastTimeOf(samples, [&] { takeState(scene, again, FieldContent::WithoutContacts); });
        gathering[1] = leastTimeOf(samples, [&] { takeState(scene, again); });
        steps = leastTimeOf(10, [&] { scene.step(10); }) * 10;
        fmt::print(
            "study,coordinates,spacing_over_width,cut_off_over_width,steps_between_samples,"
            "error_of_integral,error_between_points,error_of_cut_off,error_of_mean,"
            "processor_time_ms,percent_of_run\n");
    }

    void row(const std::string& study, const std::string& coordinates, double spacing, double cutOff,
             FieldContent content = FieldContent::All) {
        const bool withContacts = content == FieldContent::All;
        const FieldSums fields = made(coordinates, spacing, cutOff, 0, content);
        FieldSums again = fields;
        const double time = leastTimeOf(samples, [&] { again.add(state); }) + gathering[withContacts];
        const double cell = fields.grid().volume() / static_cast<double>(fields.grid().size());
        double density = 0, pressure = 0;
        for (std::size_t k = 0; k < fields.grid().size(); ++k) {
            density += cell * densityAt(fields, k);
            if (withContacts) pressure += cell * pressureAt(fields, k);
        }
        const double integral = withContacts
                                    ? std::max(std::abs(density / mass - 1), std::abs(pressure / virial - 1))
                                    : std::abs(density / mass - 1);
        const auto text = [](double error) { return std::isnan(error) ? "" : fmt::format("{:.3g}", error); };
        fmt::print("{},{},{:g},{:g},100,{:.3g},{},{},,{:.3g},{:.3g}\n", study, coordinates, spacing, cutOff,
                   integral, text(withContacts ? betweenPoints(fields, coordinates, spacing, cutOff) : NAN),
                   text(withContacts ? ofCutOff(fields, coordinates, spacing) : NAN), 1e3 * time,
                   100 * time / steps);
        std::fflush(stdout);
    }

private:
    /// @param moved m, the grid along z
    FieldSums made(const std::string& coordinates, double spacing, double cutOff, double moved,
                   FieldContent content = FieldContent::All) const {
        auto [low, high] = boxAround(state, 8 * width);
        low.z += moved, high.z += moved;
        const FieldGrid grid(coordinates, low, high, spacing * width);
        FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, grid.dimensions(), width, cutOff * width),
                       GrainGroups::none(), content);
        sums.add(state);
        return sums;
    }
    /// rms of a difference of two fields over the rms of the second: the larger one of density and pressure.
    template <class First>
    static double difference(std::size_t points, First&& first, const FieldSums& second) {
        double worst = 0;
        for (const auto field : {densityAt, pressureAt}) {
            double off = 0, all = 0;
            for (std::size_t k = 0; k < points; ++k) {
                const double expected = field(second, k), d = first(field, k) - expected;
                off += d * d, all += expected * expected;
            }
            worst = std::max(worst, std::sqrt(off / all));
        }
        return worst;
    }
    /// Straight lines between points that are neighbours along z, against fields in their middle.
    double betweenPoints(const FieldSums& fields, const std::string& coordinates, double spacing,
                         double cutOff) const {
        const FieldSums middles = made(coordinates, spacing, cutOff, 0.5 * fields.grid().spacing(2));
        // Where z is the fastest, the point behind the last of a row is empty as the last one is.
        return difference(
            fields.grid().size() - 1,
            [&](auto field, std::size_t k) { return 0.5 * (field(fields, k) + field(fields, k + 1)); },
            middles);
    }
    /// Against a cut-off at 8 w, where a Gauss is 1e-14.
    double ofCutOff(const FieldSums& fields, const std::string& coordinates, double spacing) const {
        if (spacing != 1) return NAN;  // it depends on the cut-off alone
        const FieldSums whole = made(coordinates, spacing, 8, 0);
        return difference(
            whole.grid().size(), [&](auto field, std::size_t k) { return field(fields, k); }, whole);
    }

    Scene& scene;
    std::size_t samples;
    GrainState state;
    double mass = 0, virial = 0;       // kg; J, a third of it
    double gathering[2]{}, steps = 0;  // s of a processor, without and with contacts; of 100 steps
};

void measureBed(const Options& o) {
    using Dry = Species<HertzianViscoelastic, Mindlin>;
    const scenes::Settled bed = o.positions.empty() ? scenes::settledBed(o.particles, o.states, 1)
                                                    : scenes::publishedBedOf(o.positions);
    scenes::BoxScene<Dry> scene(scenes::BedMaterial{}.species<Dry>(), bed.grains, bed.box, 5e-7);
    scene.setQuiet();
    scene.initialise();
    scene.step(20);
    BedFields fields(scene, o.samples);
    for (const std::string coordinates : {"Z", "XZ", "XYZ"}) {
        for (const double cutOff : {1.5, 2.0, 2.5, 3.0, 4.0}) fields.row("cut-off", coordinates, 1, cutOff);
        for (const double spacing : {0.5, 0.7, 1.0, 1.4, 2.0}) fields.row("grid", coordinates, spacing, 3);
        fields.row("without contacts", coordinates, 1, 3, FieldContent::WithoutContacts);
    }
}

/// A thousand grains in shear, whose fields fluctuate.
class Sheared : public Simulation<LinearViscoelasticSlidingFrictionSpecies> {
public:
    static constexpr double rate = 10, diameter = 2e-3, density = 2500, solidFraction = 0.5;

    Sheared() {
        constexpr int edge = 10;
        const double spacing = diameter * std::cbrt(constants::pi / 6 / solidFraction);
        auto* const material = speciesHandler.copyAndAddObject({});
        material->setDensity(density);
        material->setStiffnessAndRestitutionCoefficient(1e5 * density * std::pow(diameter, 3) * rate * rate,
                                                        0.7,
                                                        density * constants::pi / 6 * std::pow(diameter, 3));
        material->setSlidingStiffness(2.0 / 7 * material->getStiffness());
        material->setSlidingDissipation(material->getDissipation());
        material->setSlidingFrictionCoefficient(0.3);
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, edge * spacing);
        setLeesEdwards(0, 1, rate);
        UniformRandom random(1);
        const auto speed = [&] { return random.uniform(-1, 1) * rate * diameter; };
        for (int k = 0; k < edge * edge * edge; ++k) {
            SphericalParticle grain;
            grain.setSpecies(material), grain.setRadius(0.5 * diameter);
            grain.setPosition(spacing *
                              Vec3D(k % edge + 0.5, k / edge % edge + 0.5, k / (edge * edge) + 0.5));
            const double x = speed(), y = speed();
            grain.setVelocity(shearFlowAt(grain.getPosition()) + Vec3D(x, y, speed()));
            particleHandler.copyAndAddObject(grain);
        }
        setTimeStep(shortestContactTime() / 50), setQuiet();
    }
};

/// Means over a strain from samples at intervals, against those from samples ten times in a contact.
void measureIntervals(const Options& o) {
    Sheared scene;
    scene.initialise();
    const auto stepsOf = [&](double strain) {
        return static_cast<std::size_t>(strain / Sheared::rate / scene.getTimeStep());
    };
    scene.step(stepsOf(3));
    constexpr std::array<std::size_t, 9> intervals{5, 10, 25, 50, 100, 200, 500, 1000, 2000};
    const PeriodicBox& box = scene.getPeriodicBox();
    const FieldGrid grid("Y", box.lowest, box.lowest + box.length, Sheared::diameter);
    std::vector<FieldSums> means(intervals.size(),
                                 FieldSums(grid, SmoothingKernel(KernelShape::Gauss, 1, Sheared::diameter)));
    GrainState state;
    double sampleTime = infinity, stepTime = infinity;  // s of a processor
    for (std::size_t step = 0; step < stepsOf(o.strain); step += intervals[0]) {
        stepTime = std::min(
            stepTime, processorTimeOf([&] { scene.step(intervals[0]); }) / static_cast<double>(intervals[0]));
        for (std::size_t k = 0; k < intervals.size(); ++k) {
            if (step % intervals[k] != 0) continue;
            const double time = processorTimeOf([&] {
                takeState(scene, state);
                takeFlowAway(state);
                means[k].add(state);
            });
            sampleTime = std::min(sampleTime, time);
        }
    }
    for (std::size_t k = 0; k < intervals.size(); ++k) {
        double worst = 0;
        for (const std::size_t sum : {std::size_t{Sum::Flux}, std::size_t{Sum::ContactStress}}) {
            double off = 0, all = 0;
            for (std::size_t point = 0; point < grid.size(); ++point) {
                const double expected = means[0].ofAll(sum, point), d = means[k].ofAll(sum, point) - expected;
                off += d * d, all += expected * expected;
            }
            worst = std::max(worst, std::sqrt(off / all));
        }
        fmt::print("interval,Y,1,3,{},,,,{:.3g},{:.3g},{:.3g}\n", intervals[k], worst, 1e3 * sampleTime,
                   100 * sampleTime / (stepTime * static_cast<double>(intervals[k])));
    }
}

int run(const Options& o) {
    checkNumberOfGrains("field-costs", o.particles);
    checkValue("field-costs", "strain", o.strain, "", {0.1, 1e3});
    checkValue("field-costs", "samples", static_cast<double>(o.samples), "", {1, 1e6});
    measureBed(o);
    measureIntervals(o);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Prints CSV of what fields cost in processor time, and how they err: those of a bed over the grid "
        "and "
        "the cut-off of a Gauss as wide as a grain, and means of a shear flow over the steps between "
        "samples.");
    Options o;
    app.option_defaults()->always_capture_default();
    app.add_option("--particles", o.particles, "number of grains of the bed, about");
    app.add_option(
        "--positions", o.positions,
        "file of rows radius x y z (m): the bed of Dosta et al. (2024); made by the program if not "
        "given, which takes minutes");
    app.add_option("--states", o.states, "folder in which beds are kept that the program made");
    app.add_option("--samples", o.samples, "of each kind; the fastest counts");
    app.add_option("--strain", o.strain, "of the shear flow over which fields are averaged");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
