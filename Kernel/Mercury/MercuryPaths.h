#pragma once

#include <functional>
#include <map>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/StepPart.h"

namespace pendular {

/// Grains of a MercuryScene that are held and move on a path that the driver prescribes: in each step with
/// the velocity that brings them to its next point.
class MercuryPaths : public StepPart {
public:
    [[nodiscard]] std::string_view name() const override { return "prescribed paths"; }
    [[nodiscard]] Features features(const StepContext&) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void prepare(StepContext& step) override;
    /// Paths are compared by their values at the start and now.
    void compareSetUp(StateArchive& archive, StepContext& scene) override;

    /// Throw InputError for a grain that is not held altogether.
    /// @param now s: the grain is put where the path is then
    void setPosition(GrainReference grain, std::function<Vec3D(double)> path, double now);
    void setVelocity(const GrainReference& grain, std::function<Vec3D(double)> velocity);

private:
    struct Path {
        std::function<Vec3D(double)> position, velocity;  // one of them; m, m/s, by s
    };
    std::map<std::uint32_t, Path> paths;  // by the identity of the grain
};

}  // namespace pendular
