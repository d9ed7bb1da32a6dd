/// A part of the step outside the kernel: a draught of air that drags grains along.

#include <cmath>
#include <numbers>

#include "Drivers/Shared/CommandLine.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Scene/Simulation.h"

using namespace pendular;

/// Air of one velocity, which grains do not change. The drag of a sphere, up to Re = 800, is Stokes' times
/// 1 + 0.15 Re^0.687: Schiller and Naumann (1933), Z. VDI 77, 318, by the speed at the start of a step.
struct Draught : StepPart {
    explicit Draught(const Vec3D& velocity) : air(velocity) {}
    [[nodiscard]] std::string_view name() const override { return "draught"; }
    [[nodiscard]] std::span<const Conflict> ownConflicts() const override {
        static constexpr Conflict bodies{Feature::OwnPart, Feature::RigidBodies,
                                         "the drag is that of single spheres", "take single grains"};
        return {&bodies, 1};
    }
    /// It needs no grain but the one that it drags.
    [[nodiscard]] bool actsOnRanks() const override { return true; }
    void prepare(StepContext& step) override {
        ExactSum workOfStep;  // J
        for (GrainReference grain : step.particles.ownGrains()) {
            if (grain.isFixed()) continue;
            const Vec3D before = grain.getVelocity(), slip = air - before;
            const double d = 2 * grain.getRadius(), reynolds = density * slip.norm() * d / viscosity;
            const double drag = 3 * std::numbers::pi * viscosity * d * (1 + 0.15 * std::pow(reynolds, 0.687));
            grain.setVelocity(before - std::expm1(-drag / grain.getMass() * step.length) * slip);
            workOfStep.add(0.5 * grain.getMass() *
                           (grain.getVelocity().squaredNorm() - before.squaredNorm()));
        }
        work += step.contacts.ranks().sum(workOfStep);
    }
    void compareSetUp(StateArchive& archive, StepContext& /*scene*/) override {
        archive.same("density", density, "kg/m^3"), archive.same("viscosity", viscosity, "Pa s");
        archive.sameRecord<double>("velocity", toVector(air), "m/s");
    }
    void visitState(StateArchive& archive, StepContext& /*scene*/) override { archive.finite("work", work); }
    void addTo(SummaryRows& rows) const override { rows.addNumber("work of the draught", work, "J"); }

    static constexpr double density = 1.2, viscosity = 1.8e-5;  // of air: kg/m^3, Pa s
    Vec3D air;                                                  // m/s
    double work = 0;                                            // J, on all grains
};

int main(int argc, char** argv) {
    RunOptions options{.output = "UserDefinedPart-output"};
    double endTime = 3;  // s
    const DriverProgram driver{.name = "UserDefinedPart",
                               .description = "A grain falls in a draught of air, a part of this driver.",
                               .options = options,
                               .files = "what the run writes",
                               .numbers = {{"end-time", "s", &endTime, notNegative, "end of the run"}}};
    return runDriver(driver, argc, argv, [&] {
        Simulation<LinearViscoelasticSpecies> scene;
        options.apply(scene);
        scene.addPart<Draught>(Vec3D(0.5, 0, 0));
        auto* const glass = scene.speciesHandler.copyAndAddObject({});
        glass->setDensity(2500), glass->setStiffness(100), glass->setDissipation(1e-4);
        SphericalParticle grain;
        grain.setSpecies(glass), grain.setRadius(1e-4);
        auto falling = scene.particleHandler.copyAndAddObject(grain);
        scene.setGravity({0, 0, -9.81}), scene.setTimeStep(5e-6), scene.setTimeMax(endTime);
        scene.solve();
        if (!options.quiet) fmt::print("velocity: {:.4f} m/s\n", fmt::join(falling.getVelocity(), " "));
    });
}
