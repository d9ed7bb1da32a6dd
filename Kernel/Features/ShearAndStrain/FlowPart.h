#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/ShearAndStrain/HomogeneousStrain.h"
#include "Kernel/Features/ShearAndStrain/LeesEdwards.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

/// Sets a state. Throws InputError, and leaves it, where the refusal throws one: the scene does not go
/// together with it.
template <class State, class Refusal>
void takeUnlessRefused(State& now, const State& asked, Refusal&& refuse) {
    const State before = std::exchange(now, asked);
    try {
        refuse();
    } catch (const InputError&) {
        now = before;
        throw;
    }
}

/// Images of a periodic scene that move: shear and strain, at a rate or by a servo.
class FlowPart : public StepPart {
public:
    /// Throws InputError where a change in a run does not go together with the scene; empty at set-up.
    using Refusal = std::function<void()>;

    [[nodiscard]] std::string_view name() const override { return "flow"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return strain.isSet; }
    void check(const StepContext& scene) override;
    void begin(StepContext& scene, bool isRestarted) override;
    /// Takes the rates for the step to come, where a target of a stress is set.
    void prepare(StepContext& step) override;
    /// The grains go along with the flow of the step to come.
    void beforeMotion(StepContext& step) override;
    void moveSurroundings(StepContext& step) override;
    /// Throws RunError where a wall has turned so that the flow would carry images through it.
    void afterMotion(StepContext& step) override;
    void takeBack(StepContext& step) override;
    /// visitSetting() compares them.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void visitSetting(StateArchive& archive, StepContext& scene) override;

    // The functions of Scene with these names call these:
    void setPeriodic(PeriodicBox& box, int axis, double lowest, double highest, double now);
    void setLeesEdwards(PeriodicBox& box, int flow, int gradient, double rate, double now);
    void setShearRate(StepContext& scene, double rate, bool inRun);
    void setTargetShearStress(double stress, double time, std::optional<double> largest,
                              const Refusal& inRun);
    void setStrainRate(PeriodicBox& box, int axis, double rate, const Refusal& inRun);
    void setTargetStress(PeriodicBox& box, int axis, double stress, double time,
                         std::optional<double> largest, const Refusal& inRun);
    [[nodiscard]] double shearRate() const { return shear.rate; }
    [[nodiscard]] double strainRate(int axis) const;

    /// Grains that have left a scene whose images move go over to the velocity of their image inside, before
    /// they are brought back.
    static void takeVelocitiesOfImages(StepContext& step);

    /// The shortest time (s) in which a servo reaches its aim; infinite without one.
    [[nodiscard]] double shortestServoTime() const;

private:
    AxisStrain& axisToStrain(const PeriodicBox& box, int axis, std::string_view what, bool inRun);
    void setStrain(PeriodicBox& box, int axis, const AxisStrain& how, const Refusal& inRun);
    /// m/s, by which the flow at a place (m) changes with the start of the step.
    [[nodiscard]] Vector<double> changeOfFlow(const PeriodicBox& box, const Vector<double>& place) const;
    void checkServo(const StepContext& scene, double time, std::string_view what) const;

    LeesEdwards shear, shearAtSetUp, shearBefore;
    HomogeneousStrain strain, strainAtSetUp;
    PeriodicBox boxBefore;                 // the step
    Vector<double> strainChange{0, 0, 0};  // 1/s, with which the step began
    Vector<double> shearChange{0, 0, 0};   // m/s, of the image along the gradient
};

}  // namespace pendular
