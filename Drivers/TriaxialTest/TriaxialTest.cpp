/// Triaxial test without walls: grains that repeat themselves are pressed, then compressed along z only.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/StressCell.h"

namespace {

struct Options {
    std::size_t number = 1000;  // about
    double friction = 0.3, inertialNumber = 1e-3;
    double stiffness = 1e4;  // over pressure x diameter
    double strain = 0.15, interval = 0.002;
    RunOptions run{.output = "TriaxialTest-output"};
};

const std::string columns =
    "time_s,in_test,axial_strain,volumetric_strain,solid_fraction,axial_stress_Pa,lateral_stress_Pa,"
    "sine_of_friction_angle,contacts_of_a_grain";

class TriaxialTest : public StressCell {
public:
    explicit TriaxialTest(const Options& given) : StressCell(given.run, columns), options(given) {
        setTimeMax(compressionTime() + options.strain / rate());
    }

    void setupInitialConditions() override {
        addMaterial(options.stiffness * pressure * diameter, 0.6, options.friction);
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, edge() * spacing);
        addGrains();  // also of a run that goes on: the step is chosen for them
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25));
        // The time of the servo: some twice that in which sound passes the cell, at
        // diameter x sqrt(stiffness / mass) = 2.2 diameters in a contact time of 25 steps or more.
        for (int axis = 0; axis < 3; ++axis)
            setTargetStress(axis, pressure, 25 * edge() * getTimeStep(), 2 * rate());
        setInterval(options.interval / rate(), 20);
        begin = getPeriodicBox().length;
    }
    void actionsBeforeTimeStep() override {
        if (inTest > 0 || getTime() < compressionTime()) return;
        setStrainRate(2, -rate());
        begin = getPeriodicBox().length;
        inTest = 1, forgetStates();
    }
    void writeRow(const Means& means) override {
        const auto length = getPeriodicBox().length;
        const double axial = means.stress(2, 2), lateral = 0.5 * (means.stress(0, 0) + means.stress(1, 1));
        const double volume = length.x * length.y * length.z;
        table.row(getTime(), inTest, std::log(begin.z / length.z),
                  std::log(begin.x * begin.y * begin.z / volume), getTotalMass() / density / volume, axial,
                  lateral, (axial - lateral) / (axial + lateral), means.contacts);
    }
    void visitState(StateArchive& archive) override {
        StressCell::visitState(archive);
        archive.record<double>("begin", begin);
        archive.value("inTest", inTest);
    }

private:
    static constexpr double pressure = 1000;            // Pa
    static constexpr double spacing = 1.02 * diameter;  // m, of the lattice from which the grains start

    [[nodiscard]] int edge() const { return std::max(4, int(std::lround(std::cbrt(options.number)))); }
    /// 1/s; the inertial number is rate x diameter x sqrt(density / pressure).
    [[nodiscard]] double rate() const {
        return options.inertialNumber / (diameter * std::sqrt(density / pressure));
    }
    /// s; the lengths shrink by some 8 % at up to twice the rate, then the grains come to rest.
    [[nodiscard]] double compressionTime() const { return 0.1 / rate(); }
    void addGrains() {
        for (int k = 0, n = edge(); k < n * n * n; ++k) {
            const double radius = random.uniform(0.9, 1.0);
            addGrain(spacing * Vec3D(k % n + 0.5, k / n % n + 0.5, k / (n * n) + 0.5), radius,
                     0.1 * std::sqrt(pressure / density));
        }
    }

    Options options;
    Vector<double> begin{0, 0, 0};  // m, lengths of the box when the compression or the test began
    int inTest = 0;
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "TriaxialTest",
        .description = "Grains without walls: pressed to a pressure, then a triaxial test.",
        .options = o.run,
        .files = "stress.csv",
        .numbers = {
            {"number", "", &o.number, {1, 1e8}, "number of grains, about"},
            {"friction", "", &o.friction, {0, 10}, "coefficient of friction of the grains"},
            {"inertial-number", "", &o.inertialNumber, {1e-6, 0.1}, "of the rate of the compression"},
            {"stiffness", "", &o.stiffness, {1e2, 1e8}, "of a contact, over pressure x diameter"},
            {"strain", "", &o.strain, {0, 1}, "axial strain (logarithm of the length) at the end"},
            {"interval-strain", "", &o.interval, positive, "over which a row of the table is a mean"}}};
    return runDriver(driver, argc, argv, [&] { TriaxialTest(o).solve(); });
}
