#include "Kernel/Mercury/InletVelocities.h"

#include <fmt/format.h>

#include "Kernel/Math/CountedRandom.h"
#include "Kernel/Particles/ParticleHandler.h"

namespace pendular {

InletVelocities::InletVelocities(const InletHandler& ofScene, std::size_t ofInlet, const Vec3D& lowest,
                                 const Vec3D& highest)
    : inlets(&ofScene),
      inlet(ofInlet),
      low(lowest),
      high(highest),
      ownName(fmt::format("velocities of inlet {}", ofInlet)) {}

void InletVelocities::prepare(StepContext& step) {
    first = step.grains().nextIdentity();
    before.clear();
    for (std::size_t k = 0; k < inlets->getSize(); ++k) before.push_back(inlets->countOf(k).number);
}

/// What has come through the inlets in the step has identities that follow each other, inlet by inlet.
void InletVelocities::atEnd(StepContext& step) {
    std::uint32_t identity = first;
    for (std::size_t k = 0; k < inlet; ++k)
        identity += static_cast<std::uint32_t>(inlets->countOf(k).number - before[k]);
    const CountedRandom random(inlet);
    for (auto left = inlets->countOf(inlet).number - before[inlet]; left > 0; --left, ++identity) {
        Vec3D velocity;
        for (int axis = 0; axis < 3; ++axis)
            velocity[axis] =
                random.uniform(low[axis], high[axis], identity, 0, static_cast<std::uint32_t>(axis));
        step.particles.getObject(identity).setVelocity(velocity);
    }
}

}  // namespace pendular
