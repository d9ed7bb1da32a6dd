#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/Fluid/DragLaw.h"
#include "Kernel/Features/Fluid/FluidHost.h"

namespace pendular {

class GrainReference;

/// How the force of the pressure on a grain is counted: Z. Y. Zhou, S. B. Kuang, K. W. Chu and A. B. Yu, J.
/// Fluid Mech. 661 (2010) 482, sets II (A) and III (B), after D. Gidaspow. In a homogeneous bed both are the
/// same force.
enum class PressureModel {
    /// A grain feels the drag F and -V grad p; the fluid's equation has -eps grad p and the drag.
    A,
    /// A grain feels F/eps and its buoyancy -V rho g; the fluid's equation has -grad p and F/eps.
    B
};

/// What a fluid has done to grains since the start.
struct FluidLedger {
    double work = 0;                  // J, on all grains that move
    Vector<double> impulse{0, 0, 0};  // N s, on all grains, held ones too
};

/// The forces of a fluid on the grains in it: a drag law and the gradient of the pressure, on a grid of cells
/// that a FluidHost fills. One set of weights (sharesAt()) spreads volumes and forces and reads fields, so
/// that what grains get the fluid gives, to rounding.
///
/// The force of a step is found in prepare(), implicitly in the drag with the resistance at the start of the
/// step: that of the velocity
///     v' = (v + k u + dt (F_p/m + a))/(1 + k),  k = dt resistance/m,
/// which the grain will have with the acceleration a by all that acts on it besides; it is stable for any
/// step. It acts from the start of the step to its end, as the forces of contacts do, so that these are
/// computed with the velocities of a grain that is pushed. The energy ledger books its work as given by the
/// driver.
class FluidPart : public StepPart {
public:
    /// Throws InputError for a grid or a fluid that cannot be.
    FluidPart(const FluidGrid& grid, const FluidMaterial& fluid, const DragLaw& law,
              std::unique_ptr<FluidHost> host, PressureModel model = PressureModel::A);

    [[nodiscard]] const FluidGrid& grid() const { return cells; }
    /// Of the last step.
    [[nodiscard]] const FluidFields& fields() const { return now; }
    [[nodiscard]] const FluidLedger& ledger() const { return total; }
    /// N s: of the drag on all grains in the last step, F of model A and F/eps of model B, without the force
    /// of the pressure. The sum of `source` over cells and step is the opposite.
    [[nodiscard]] Vector<double> dragImpulse() const { return ofStep; }

    [[nodiscard]] std::string_view name() const override { return "fluid"; }
    [[nodiscard]] std::span<const Conflict> ownConflicts() const override;
    void check(const StepContext& scene) override;
    void prepare(StepContext& step) override;
    void beforeMotion(StepContext& step) override;
    void accelerate(StepContext& step) override;
    void finish(StepContext& step) override;
    void takeBack(StepContext& step) override;
    void compareSetUp(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

private:
    /// A grain in the fluid, at the start of the step.
    struct Immersed {
        std::uint32_t identity;
        std::array<CellShare, 8> shares;
        double resistance = 0;             // kg/s, of model A
        Vector<double> change{0, 0, 0};    // m/s^2, by the fluid in this step; none of a grain that is held
        Vector<double> velocity{0, 0, 0};  // m/s, at the start of the step
        // m/s^2, m/s, before the fluid has changed them
        Vector<double> accelerationBefore{0, 0, 0}, velocityBefore{0, 0, 0};
    };

    void spreadGrains(StepContext& step);
    void spreadDrag(StepContext& step);
    void findForce(const StepContext& step, const GrainReference& grain, Immersed& here);
    void leaveAccelerations(StepContext& step);
    [[nodiscard]] double resistanceOf(const GrainReference& grain, const std::array<CellShare, 8>& shares,
                                      const Vector<double>& slip) const;
    void requireInside(const StepContext& step, const GrainReference& grain) const;
    void countOutside(const DragState& state) const;

    FluidGrid cells;
    FluidMaterial fluid;
    DragLaw law;
    std::unique_ptr<FluidHost> host;
    PressureModel model;
    FluidFields now;
    std::vector<Immersed> immersed;  // in the order of grains
    bool isInAccelerations = false;  // the change of a step is
    bool isInVelocities = false;     // the share of its end is
    FluidLedger total;
    Vector<double> ofStep{0, 0, 0};
    mutable std::uint64_t asked = 0, outside = 0;  // how often the law was asked, and beyond where it holds
};

}  // namespace pendular
