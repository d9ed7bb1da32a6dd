#include <array>

#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Scene/SceneInside.h"

// The state of a scene in a restart file.

namespace pendular {

void Scene::Inside::visitAll(StateArchive& archive) {
    // A file holds bodies, laws and contacts that fit together: what hooks have just changed is taken over.
    if (archive.isWriting() && scene.hasBegun()) {
        takeOverChanges();
        MembraneMotion::renewForces(scene.wallHandler, contacts, context.grains(), context.gravity,
                                    context.threads);
    }
    visitScene(archive);
    if (archive.isReading()) prepare();
    if (periodicWalls.haveEnds())
        archive.group("periodicWalls", [&] { periodicWalls.visitState(archive, scene.wallHandler); });
    archive.group("contacts", [&] { contacts.visitState(archive, scene.particleHandler.store()); });
    archive.group("parts", [&] { parts.visitStates(archive, context); });
    archive.value("noRoomWasTold", noRoomWasTold);
    scene.visitOutputs(archive);
}

void Scene::Inside::visitScene(StateArchive& archive) {
    archive.group("species", [&] { laws().visitState(archive, speciesChanged); });
    if (archive.isReading() && speciesChanged) laws().mixAll();
    archive.group("walls", [&] { scene.wallHandler.visitState(archive); });
    scene.visitSteps(archive);
    contextNow(0);
    archive.same("integrator", description(integrator));
    archive.value("springsInStep", context.springsInStep);
    visitSurroundings(archive);
    archive.group("settings", [&] { parts.visitSettings(archive, context); });
    archive.finite("approachUnseen", approachUnseen);
    archive.value("smallestRadius", context.smallestRadius);
    archive.require(context.smallestRadius > 0, "smallestRadius", "is not positive");
    archive.finite("largestReach", context.largestReach);
    archive.group("particles", [&] { scene.particleHandler.visitState(archive); });
}

/// The directions in which the scene repeats itself are as they were set up, and so is gravity unless the run
/// has changed it.
void Scene::Inside::visitSurroundings(StateArchive& archive) {
    constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
    archive.value("gravityChanged", gravityChanged);
    if (gravityChanged) archive.finite("gravity", context.gravity);
    ParticleHandler::Inside::setGravity(scene.particleHandler, context.gravity);
    archive.value("heldContactsChanged", heldContactsChanged);
    int held = static_cast<int>(contacts.getHeldContacts());
    if (heldContactsChanged) {
        archive.value("heldContacts", held);
        archive.require(held >= 0 && held <= static_cast<int>(HeldContacts::None), "heldContacts",
                        "is no setting of setHeldContacts()");
        contacts.setHeldContacts(static_cast<HeldContacts>(held));
    } else {
        archive.same("heldContacts", held, {}, "setHeldContacts(): 0 is WhereAsked, 1 All, 2 None");
    }
    for (std::size_t k = 0; k < 3; ++k) {
        if (!gravityChanged)
            archive.group("gravity", [&] { archive.same(axes[k], context.gravity.*vectorAxes[k], "m/s^2"); });
        archive.group("periodicLowest", [&] { archive.same(axes[k], lowestAtSetUp.*vectorAxes[k], "m"); });
        archive.group("periodicLength", [&] { archive.same(axes[k], lengthAtSetUp.*vectorAxes[k], "m"); });
    }
}

}  // namespace pendular
