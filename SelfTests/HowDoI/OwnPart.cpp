#include "Kernel/Core/Step/SummaryRows.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
/// Air at rest, by Stokes' drag: 6 pi viscosity radius speed.
struct StillAir : StepPart {
    explicit StillAir(double airViscosity) : viscosity(airViscosity) {}  // Pa s
    std::string_view name() const override { return "still air"; }
    std::span<const Conflict> ownConflicts() const override {
        static constexpr Conflict bodies{Feature::OwnPart, Feature::RigidBodies,
                                         "the drag is that of spheres", "leave the air out"};
        return {&bodies, 1};
    }
    void prepare(StepContext& step) override {
        for (GrainReference grain : step.particles.ownGrains()) {
            if (grain.isFixed()) continue;
            const double rate = 6 * M_PI * viscosity * grain.getRadius() / grain.getMass();
            const Vec3D before = grain.getVelocity();
            grain.setVelocity(std::exp(-rate * step.length) * before);
            taken += 0.5 * grain.getMass() * (before.squaredNorm() - grain.getVelocity().squaredNorm());
        }
    }
    void compareSetUp(StateArchive& archive, StepContext&) override {
        archive.same("viscosity", viscosity, "Pa s");  // a run is resumed with the same air
    }
    void visitState(StateArchive& archive, StepContext&) override { archive.finite("taken", taken); }
    void addTo(SummaryRows& rows) const override { rows.addNumber("energy taken by the air", taken, "J"); }

    double viscosity, taken = 0;  // Pa s, J
};

struct GrainInAir : FirstDriver {
    StillAir& air = addPart<StillAir>(1.8e-5);
};
// [end]

TEST_F(HowDoI, OwnPart) {
    WithPlate<GrainInAir> scene;
    run(scene);
    EXPECT_GT(scene.air.taken, 0);
    // 6 pi 1.8e-5 Pa s x radius x speed: with speeds up to sqrt(2 g h) over some mm it is less than 1e-6 N,
    // and all ways are less than a metre.
    EXPECT_LT(scene.air.taken, 1e-6);
}

}  // namespace
