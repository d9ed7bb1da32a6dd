/// Glass in a column of water that rises ever faster: a fixed bed, its lift-off, and how far it expands,
/// beside the closed form of the drag law and the power law of Richardson and Zaki.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "Drivers/FluidisedColumn/ColumnBed.h"
#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Foundation/Math/Halving.h"

using namespace pendular;

namespace {

struct FluidisedColumn : ColumnBed {
    std::string folder;
    double stage = 1.5, largest = 3;  // s; of the speed at lift-off
    bool isModelB = false;

    void setupInitialConditions() override {
        cellsOfColumn = 4 * cellsOfBed;
        model = isModelB ? PressureModel::B : PressureModel::A;
        table.emplace(folder + "/column.csv",
                      "time_s,superficial_speed_m_s,over_lift_off,porosity,porosity_of_the_law,"
                      "porosity_richardson_zaki,height_m,pressure_drop_Pa,weight_over_area_Pa");
        liftOff = balanced(porosity);
        alone = terminalSpeed(material.diameter, material.density, material.fluid, gravity);
        fill([this](double time) { return speedAt(time); });
        setTimeMax(stage * stages);
        setSaveCount(static_cast<std::size_t>(std::lround(0.1 * stage / getTimeStep())));
    }
    /// m/s, superficial: in stages from a half of that at lift-off to the largest.
    [[nodiscard]] double speedAt(double time) const {
        const double begun = std::min(std::floor(time / stage), stages - 1.0);
        return liftOff * (0.5 + (largest - 0.5) * begun / (stages - 1));
    }
    /// Of the closed form: where drag is the weight, but not below that of the chain at rest.
    [[nodiscard]] double expandedPorosity(double speed) const {
        return turningPoint(porosity, 1, [&](double share) { return balanced(share) < speed; }).holds;
    }
    void writeOutput() override {
        if (getTime() == 0) return;  // no step has asked for the fluid yet
        const double speed = speedAt(getTime());
        table->row(getTime(), speed, speed / liftOff, porosityInside(), expandedPorosity(speed),
                   std::max(porosity, std::pow(speed / alone, 1 / richardsonZaki())), height(),
                   column->pressureDrop(), weightInFluid() / area());
    }
    void completeOutput() override { table->close(); }
    void visitState(StateArchive& archive) override {
        archive.same("stage", stage, "s");
        archive.same("largest", largest);
        table->visitState(archive);
    }

private:
    /// The exponent of the porosity, over the Reynolds number of a grain alone: J. F. Richardson and W. N.
    /// Zaki, Trans. Inst. Chem. Eng. 32 (1954) 35, without the share of the column's width.
    [[nodiscard]] double richardsonZaki() const {
        const double reynolds = material.fluid.density * alone * material.diameter / material.fluid.viscosity;
        if (reynolds < 0.2) return 4.65;
        if (reynolds < 1) return 4.35 * std::pow(reynolds, -0.03);
        return reynolds < 500 ? 4.45 * std::pow(reynolds, -0.1) : 2.39;
    }

    static constexpr int stages = 11;
    double liftOff = 0, alone = 0;  // m/s
    std::optional<RunTable> table;
};

}  // namespace

int main(int argc, char** argv) {
    FluidisedColumn scene;
    RunOptions options{.output = "FluidisedColumn-output"};
    const DriverProgram driver{
        .name = "FluidisedColumn",
        .description = "Water rises through a column of glass, ever faster: the bed lifts off and expands.",
        .options = options,
        .addOptions =
            [&](CLI::App& app) {
                app.add_option("--law", scene.law, "of the drag")->capture_default_str();
                app.add_flag("--model-b", scene.isModelB,
                             "no gradient of the pressure on grains, drag over porosity");
            },
        .files = "column.csv, and what the run writes",
        .numbers = {
            {"cells", "", &scene.cellsOfBed, {2, 1000}, "of the grid in the bed, with four grains each"},
            {"stage", "s", &scene.stage, {1e-3, 1000}, "for which the speed stays"},
            {"largest", "", &scene.largest, {0.5, 20}, "speed, over that at which the bed lifts off"}}};
    return runDriver(driver, argc, argv, [&] {
        options.apply(scene);
        scene.folder = options.output;
        scene.solve();
    });
}
