#include "Kernel/Motion/Integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "Kernel/Species/Field.h"

namespace pendular {

namespace {

bool isOwn(const Integrator& integrator) { return std::ranges::count(integrators::all, integrator) == 0; }

}  // namespace

std::string shownName(const Integrator& integrator) {
    return fmt::format("{}{}", integrator.name, isOwn(integrator) ? " of your own" : "");
}

std::string description(const Integrator& i) {
    if (!isOwn(i)) return std::string(i.name);
    return fmt::format(
        "{} (position {} {}, velocity {} {}, corrector {} {} {}, implicit forces {}, timed touches {}, "
        "springs in step {})",
        shownName(i), i.position0, i.position1, i.velocity0, i.velocity1, i.corrector, i.now, i.earlier,
        i.contacts.implicitForces, i.contacts.timesTouches, i.contacts.springsInStep);
}

void checkIntegrator(const Integrator& i) {
    for (const auto& [field, value] : {std::pair{"position0", i.position0},
                                       {"position1", i.position1},
                                       {"velocity0", i.velocity0},
                                       {"velocity1", i.velocity1},
                                       {"corrector", i.corrector},
                                       {"now", i.now},
                                       {"earlier", i.earlier}})
        checkValue(fmt::format("integrator {}", i.name), field, value, "", anyFinite);
}

}  // namespace pendular
