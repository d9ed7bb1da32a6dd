#include "Kernel/Core/Step/Feature.h"

#include <fmt/format.h>

#include <array>

namespace pendular {

std::string_view nameOf(Feature feature) {
    static constexpr std::array<std::string_view, static_cast<std::size_t>(Feature::Count)> names{
        "walls",
        "walls other than planes across an axis that is not periodic",
        "membranes",
        "walls that forces move (setPiston(), setTargetForce(), setSlider(), setRotor(), setFreeBody())",
        "walls that forces turn (setRotor(), setFreeBody())",
        "walls that keep their wear (keepWear())",
        "wear by impacts (WearLaw::finnie())",
        "grains",
        "grains that are held (fixParticle(), setHeldAxes())",
        "rigid bodies",
        "superquadrics",
        "periodic faces (setPeriodic())",
        "shear (setLeesEdwards())",
        "strain (setStrainRate(), setTargetStress())",
        "a target stress (setTargetStress(), setTargetShearStress())",
        "gravity",
        "gravity along the gradient of the shear",
        "an integrator that remembers the last step (adamsMoulton)",
        "springs in the step (integrators::springsInStep)",
        "the adaptive time step (setAdaptiveTimeStep())",
        "the energy ledger (keepEnergyLedger())",
        "liquid that moves",
        "viscous bridges",
        "the mass of films (setLiquidDensity())",
        "sprays",
        "inlets",
        "outlets",
        "flux planes",
        "a part of the driver's own (addPart())",
        "events of contacts (listenToContacts())",
        "several ranks (setRanks())"};
    return names[static_cast<std::size_t>(feature)];
}

std::string Features::shown(Feature feature) const {
    const auto at = found.find(feature);
    if (at == found.end() || at->second.empty()) return std::string(nameOf(feature));
    return fmt::format("{} ({})", nameOf(feature), at->second);
}

}  // namespace pendular
