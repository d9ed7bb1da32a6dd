#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Kernel/Insertion/Inlet.h"
#include "Kernel/Step/StepPart.h"

namespace pendular {

/// Gives the grains that come through an inlet random velocities, each part even between two bounds: the same
/// for the same identity, whatever the threads and restarts.
class InletVelocities : public StepPart {
public:
    /// @param lowest, highest m/s
    InletVelocities(const InletHandler& ofScene, std::size_t ofInlet, const Vec3D& lowest,
                    const Vec3D& highest);
    [[nodiscard]] std::string_view name() const override { return ownName; }
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void prepare(StepContext& step) override;
    void atEnd(StepContext& step) override;

private:
    const InletHandler* inlets;
    std::size_t inlet;
    Vec3D low, high;  // m/s
    std::string ownName;
    // At the start of the step: the identity of what comes next, and what has come through each inlet.
    std::uint32_t first = 0;
    std::vector<std::uint64_t> before;
};

}  // namespace pendular
