#include "Kernel/Scene/ListedContacts.h"

#include <fmt/format.h>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

static bool areListed(const Scene& scene) { return scene.contacts().rebuildCount() > 0; }

void requireListedContacts(const Scene& scene, std::string_view call) {
    if (!areListed(scene))
        throw InputError(fmt::format(
            "Simulation: {} needs a scene that has begun; call initialise() before it, and not in "
            "a function that initialise() calls, as that of a wall's motion or of a part of the step.",
            call));
}

const PeriodicBox& boxOfContacts(const Scene& scene) {
    return areListed(scene) ? scene.contacts().periodicBox() : scene.getPeriodicBox();
}

}  // namespace pendular
