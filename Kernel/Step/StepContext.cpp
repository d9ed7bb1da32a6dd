#include "Kernel/Step/StepContext.h"

#include "Kernel/Motion/Integrator.h"
#include "Kernel/Particles/ParticleHandler.h"
#include "Kernel/Particles/ParticleHandlerInside.h"

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
