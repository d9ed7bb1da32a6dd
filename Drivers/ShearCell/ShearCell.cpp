/// Grains in homogeneous shear without walls (Lees and Edwards): the stress at a solid fraction, and so the
/// friction of the bulk over the inertial number.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/StressCell.h"

namespace {

struct Options {
    double solidFraction = 0.58;
    double inertialNumber = 0;  // 0: at the solid fraction
    std::size_t number = 1000;  // about
    double friction = 0.5, restitution = 0.7;
    double stiffness = 1e6;     // over density x diameter^3 x rate^2
    double collisionError = 0;  // 0: 50 steps a contact
    double strain = 10, interval = 1;
    RunOptions run{.output = "ShearCell-output"};
};

class ShearCell : public StressCell {
public:
    explicit ShearCell(const Options& given)
        : StressCell(given.run,
                     "time_s,strain,solid_fraction,pressure_Pa,shear_stress_Pa,friction,inertial_number,"
                     "granular_temperature_m2/s2,contacts_of_a_grain"),
          options(given) {
        setTimeMax(options.strain / rate);
    }

    void setupInitialConditions() override {
        addMaterial(options.stiffness * density * std::pow(diameter, 3) * rate * rate, options.restitution,
                    options.friction);
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, cells() * cell());
        setLeesEdwards(0, 1, rate);
        addGrains();  // also of a run that goes on: the step is chosen for them
        const double step = shortestContactTime() / 50;
        setTimeStep(step);
        if (options.collisionError > 0) setStepFor(options.collisionError, rate * diameter);
        // The time of the servo: some twice that in which sound passes the cell, at up to
        // diameter x sqrt(stiffness / mass) = 2.2 diameters in a contact time of 50 steps.
        if (options.inertialNumber > 0) setTargetStress(1, pressure(), 80 * cells() * step, rate);
        setInterval(options.interval / rate, 100);
    }
    void writeRow(const Means& means) override {
        const double p = means.stress.trace() / 3, shear = -means.stress(0, 1);
        // Made with the pressure that is held, as --inertial-number is.
        const double ofNumber = options.inertialNumber > 0 ? means.stress(1, 1) : p;
        // That of the grains as they were drawn, in the cell as it is at the end of the row.
        const Vector<double> length = getPeriodicBox().length;
        const double solidFraction = getTotalMass() / density / (length.x * length.y * length.z);
        table.row(getTime(), rate * getTime(), solidFraction, p, shear, shear / p,
                  rate * diameter * std::sqrt(density / ofNumber), means.kinetic / (density * solidFraction),
                  means.contacts);
    }

private:
    static constexpr double rate = 10;  // 1/s

    /// Pa, along the gradient.
    [[nodiscard]] double pressure() const {
        return density * std::pow(rate * diameter / options.inertialNumber, 2);
    }
    /// The number of cells, along each axis, of the face-centred lattice from which the grains start.
    [[nodiscard]] int cells() const {
        return std::max(3, static_cast<int>(std::lround(std::cbrt(static_cast<double>(options.number) / 4))));
    }
    [[nodiscard]] double cell() const {
        return diameter * std::cbrt(4 * constants::pi / 6 / options.solidFraction);
    }
    void addGrains() {
        for (int k = 0; k < 4 * cells() * cells() * cells(); ++k) {
            const int at = k / 4, of = cells();
            const Vec3D site(at % of, at / of % of, at / of / of);
            const Vec3D within(k % 4 == 1 || k % 4 == 2, k % 4 == 1 || k % 4 == 3, k % 4 == 2 || k % 4 == 3);
            const double radius = random.uniform(0.95, 1.05);
            addGrain(cell() * (site + Vec3D::Constant(0.25) + 0.5 * within), radius, rate * diameter);
        }
        const Vec3D mean = getTotalMomentum() / getTotalMass();  // else the flow would wander
        for (auto&& each : particleHandler) each.setVelocity(each.getVelocity() - mean);
    }

    Options options;
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "ShearCell",
        .description = "Grains in homogeneous shear: stress, friction, inertial number.",
        .options = o.run,
        .files = "stress.csv",
        .numbers = {
            {"solid-fraction",
             "",
             &o.solidFraction,
             {0.01, 0.63},
             "volume of the grains over the cell's, at the start of a run under a pressure"},
            {"inertial-number",
             "",
             &o.inertialNumber,
             {0, 1},
             "rate x diameter x sqrt(density / pressure along the gradient), which is held; 0: the volume "
             "is"},
            {"number", "", &o.number, {1, 1e8}, "number of grains, about"},
            {"friction", "", &o.friction, {0, 10}, "coefficient of friction of the grains"},
            {"restitution", "", &o.restitution, {0.01, 1}, "coefficient of restitution of the grains"},
            {"stiffness", "", &o.stiffness, {1e3, 1e12}, "of a contact, over density x diameter^3 x rate^2"},
            {"collision-error",
             "",
             &o.collisionError,
             {0, 0.1},
             "of velocities after a collision at rate x diameter, for which the time step is chosen; 0: 50 "
             "steps a contact"},
            {"strain", "", &o.strain, notNegative, "rate x time at the end of the run"},
            {"interval-strain", "", &o.interval, positive, "over which a row of the table is a mean"}}};
    return runDriver(driver, argc, argv, [&] { ShearCell(o).solve(); });
}
