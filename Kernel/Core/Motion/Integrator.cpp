#include "Kernel/Core/Motion/Integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

/// Null where it is one's own.
const Integrator* known(const Integrator& integrator) {
    const auto found = std::ranges::find(integrators::all, integrator);
    return found == integrators::all.end() ? nullptr : &*found;
}

}  // namespace

std::string shownName(const Integrator& integrator) {
    if (const Integrator* const same = known(integrator)) return std::string(same->name);
    return fmt::format("{} of your own", integrator.name);
}

std::string description(const Integrator& i) {
    if (known(i)) return shownName(i);
    return fmt::format(
        "{} (position {} {}, velocity {} {}, corrector {} {} {}, implicit forces {}, timed touches {}, "
        "springs in step {})",
        shownName(i), i.position0, i.position1, i.velocity0, i.velocity1, i.corrector, i.now, i.earlier,
        i.contacts.implicitForces, i.contacts.timesTouches, i.contacts.springsInStep);
}

void checkIntegrator(const Integrator& i) {
    for (const Integrator::Coefficient& c : Integrator::coefficients())
        checkValue(fmt::format("integrator {}", i.name), c.name, i.*c.value, "", anyFinite);
    const double position = i.position0 + i.position1,
                 velocity = i.velocity0 + i.velocity1 + i.corrector * (1 - i.now + i.earlier);
    constexpr double rounding = 1e-12;
    if (!(std::abs(position - 0.5) <= rounding) || !(std::abs(velocity - 1) <= rounding))
        throw InputError(
            fmt::format("integrator {}: a constant acceleration a must give h^2/2 a in the position and h a "
                        "in the velocity of a "
                        "step of length h; position0 + position1 = {:.6g} must be 0.5, and velocity0 + "
                        "velocity1 + corrector (1 - "
                        "now + earlier) = {:.6g} must be 1.",
                        i.name, position, velocity));
    if (!(SignChange(i).spring > 0))
        throw InputError(
            fmt::format("integrator {}: no step is stable: its coefficients turn springs around.", i.name));
}

}  // namespace pendular
