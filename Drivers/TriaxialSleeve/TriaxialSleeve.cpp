/// Triaxial test in a flexible sleeve: grains in a membrane under a pressure, between two platens.

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/TriaxialSleeve/SleeveCell.h"

namespace {

const std::string columns =
    "time_s,in_test,axial_strain,volumetric_strain,solid_fraction,axial_stress_Pa,lateral_stress_Pa,"
    "sine_of_friction_angle,contacts_of_a_grain,platen_stress_Pa,deviator_stress_Pa,sleeve_pull_Pa";

class TriaxialSleeve : public SleeveCell {
public:
    explicit TriaxialSleeve(const SleeveOptions& given) : SleeveCell(given, columns) {
        setTimeMax(compressionTime() + (1 - std::exp(-options.strain)) / rate());
    }

    void actionsBeforeTimeStep() override {
        if (inTest == 0 && getTime() >= compressionTime()) {
            beginHeight = height(), beginVolume = volume();
            upper->setVelocity({0, 0, -rate() * beginHeight});
            inTest = 1, push = pushes = 0, forgetStates();
        }
        followPlaten();
    }
    void actionsAfterTimeStep() override {
        StressCell::actionsAfterTimeStep();
        push += upper->getForce().z(), pushes += 1;
    }
    void writeRow(const Means& means) override {
        const double axial = means.stress(2, 2), lateral = 0.5 * (means.stress(0, 0) + means.stress(1, 1));
        const double area = volume() / height();
        const double platen = std::exchange(push, 0) / std::exchange(pushes, 0) / area;
        table.row(getTime(), inTest, inTest == 0 ? 0 : std::log(beginHeight / height()),
                  inTest == 0 ? 0 : std::log(beginVolume / volume()), getTotalMass() / density / volume(),
                  axial, lateral, (axial - lateral) / (axial + lateral), means.contacts, platen,
                  platen - pressure - sleevePull(area), sleevePull(area));
    }
    void visitState(StateArchive& archive) override {
        StressCell::visitState(archive);
        archive.value("inTest", inTest);
        archive.value("push", push);
        archive.value("pushes", pushes);
        archive.value("beginHeight", beginHeight);
        archive.value("beginVolume", beginVolume);
    }

private:
    int inTest = 0;
    double push = 0, pushes = 0;              // N, of the upper platen; over the steps since the last row
    double beginHeight = 0, beginVolume = 0;  // m, m^3, when the test began
};

}  // namespace

int main(int argc, char** argv) {
    SleeveOptions o;
    const DriverProgram driver{
        .name = "TriaxialSleeve",
        .description = "Grains in a flexible sleeve under a pressure, between platens: a triaxial test.",
        .options = o.run,
        .files = "stress.csv",
        .numbers = {
            {"number", "", &o.number, {100, 1e8}, "number of grains"},
            {"friction", "", &o.friction, {0, 10}, "coefficient of friction of the grains, at all bodies"},
            {"inertial-number", "", &o.inertialNumber, {1e-6, 0.1}, "of the rate of the compression"},
            {"stiffness", "", &o.stiffness, {1e2, 1e8}, "of a contact, over pressure x diameter"},
            {"sleeve-stiffness", "", &o.sleeveStiffness, {0.01, 100}, "E t / (pressure x grain diameter)"},
            {"strain", "", &o.strain, {0, 1}, "axial strain (logarithm of the height) at the end"},
            {"interval-strain", "", &o.interval, positive, "over which a row of the table is a mean"}}};
    return runDriver(driver, argc, argv, [&] { TriaxialSleeve(o).solve(); });
}
