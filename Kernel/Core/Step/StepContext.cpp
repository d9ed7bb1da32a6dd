#include "Kernel/Core/Step/StepContext.h"

#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/ParticleHandlerInside.h"

namespace pendular {

Integrator contactScheme(const StepContext& scene) {
    if (!scene.springsInStep) return *scene.scheme;
    if (*scene.scheme == integrators::predictedVelocityVerlet) return integrators::springsInStep;
    Integrator own = *scene.scheme;
    own.contacts = integrators::springsInStep.contacts;
    return own;
}

ParticleStore& StepContext::grains() const { return ParticleHandler::Inside::grainsInStep(particles); }

}  // namespace pendular
