#pragma once

#include <functional>
#include <vector>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/StepPart.h"

namespace pendular {

/// A grain in computeExternalForces(), with what the driver adds there.
class MercuryForcedGrain : public GrainReference {
public:
    /// What acts on a grain.
    struct Load {
        Vec3D force = Vec3D::Zero(), torque = Vec3D::Zero();  // N, N m
    };
    MercuryForcedGrain(const GrainReference& grain, Load& of) : GrainReference(grain), load(&of) {}
    [[nodiscard]] MercuryForcedGrain* operator->() { return this; }
    [[nodiscard]] const MercuryForcedGrain* operator->() const { return this; }
    void addForce(const Vec3D& force) const { load->force += force; }      // N
    void addTorque(const Vec3D& torque) const { load->torque += torque; }  // N m

private:
    Load* load;
};

/// The forces that a driver gives each grain in computeExternalForces(), beside those of contacts and
/// gravity, at the end of each step, whose time getTime() is then. They count as given by the driver in the
/// energy ledger.
class MercuryForces : public StepPart {
public:
    using Ask = std::function<void(MercuryForcedGrain)>;
    explicit MercuryForces(Ask ofDriver) : ask(std::move(ofDriver)) {}
    /// Whether the driver has forces. Where that is not known it is asked for them, but scenes that they do
    /// not fit are not refused.
    enum class Known { Some, None, Unknown };
    void setKnown(Known of) { known = of; }

    [[nodiscard]] std::string_view name() const override { return "forces of the driver"; }
    [[nodiscard]] Features features(const StepContext& /*scene*/) const override {
        return known == Known::None ? Features{} : Features{Feature::OwnPart};
    }
    [[nodiscard]] std::span<const Conflict> ownConflicts() const override;
    void addAccelerations(StepContext& step, std::span<const std::uint32_t> places) override;
    void beforeMotion(StepContext& step) override;
    void afterForces(StepContext& step) override;
    void accelerate(StepContext& step) override;
    void finish(StepContext& step) override;
    void takeBack(StepContext& step) override;
    /// A restart file cannot keep the function of the driver.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void visitState(StateArchive& archive, StepContext& scene) override;

private:
    /// A grain that can move, in the order of identities.
    struct Pushed {
        std::uint32_t identity = 0;
        MercuryForcedGrain::Load load = {}, before = {};
        Vector<double> velocity{0, 0, 0}, spin{0, 0, 0};              // m/s, rad/s, at the start of the step
        Vector<double> velocityBefore{0, 0, 0}, spinBefore{0, 0, 0};  // before the part of the new force
    };
    void book(StepContext& step) const;
    static void changeAcceleration(ParticleStore& grains, std::uint32_t place, const Pushed& one);

    Ask ask;
    std::vector<Pushed> pushed;
    Known known = Known::Some;
    bool isAccelerated = false;
};

}  // namespace pendular
