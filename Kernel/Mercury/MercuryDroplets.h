#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "Kernel/Mercury/MercuryBoundaries.h"

namespace pendular {

/// Droplets that a driver makes itself; where liquid moves. They fall freely, and go where they touch a
/// grain, to whose film they add their volume, or a wall. For sprays of the kernel see sprayHandler.
class DropletBoundary : public MercuryBoundary, public ActsInSteps {
public:
    struct Droplet {
        Vec3D position, velocity;  // m, m/s
        double radius;             // m
    };
    std::vector<Droplet> droplets_;

    DropletBoundary() : MercuryBoundary("DropletBoundary") {}
    /// @param function called in each step; it adds to droplets_
    void setGenerateDroplets(std::function<void(DropletBoundary&)> function);
    /// m^3, what grains have caught
    [[nodiscard]] double getVolumeCaught() const { return caught; }
    /// m^3, what has met walls
    [[nodiscard]] double getVolumeLost() const { return lost; }

    void act(StepContext& step) override;
    /// The function of the driver cannot be kept.
    void compareSetUp(StateArchive& /*archive*/, double /*now*/) const override {}
    void visitState(StateArchive& archive) override;

private:
    [[nodiscard]] bool isSet() const override { return generate != nullptr; }
    void handOver(Scene& of) override;
    /// Whether it has met something, and is gone.
    bool meets(StepContext& step, const Droplet& droplet);

    std::function<void(DropletBoundary&)> generate;
    double caught = 0, lost = 0;  // m^3
};

}  // namespace pendular
