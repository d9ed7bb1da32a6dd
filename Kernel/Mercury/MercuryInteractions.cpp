#include "Kernel/Mercury/MercuryInteractions.h"

#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

MercuryInteraction MercuryInteractionHandler::getObject(std::size_t number) const {
    const std::vector<ObservedContact> all = scene->interactions();
    if (number >= all.size())
        throw InputError(fmt::format(
            "InteractionHandler: there is no interaction {}; the last step has {}, counted from 0.", number,
            all.size()));
    return {all[number], *bonds};
}

MercuryInteraction MercuryInteractionHandler::getLastObject() const {
    const std::vector<ObservedContact> all = scene->interactions();
    if (all.empty())
        throw InputError("InteractionHandler: getLastObject() needs an interaction, and there is none.");
    return {all.back(), *bonds};
}

/// None before they are listed at the start of the run.
static std::vector<ObservedContact> contactsOf(const Scene& scene, const GrainReference& grain) {
    return scene.contacts().rebuildCount() > 0 ? scene.interactionsOf(grain.getId())
                                               : std::vector<ObservedContact>{};
}

/// A driver may keep the pointer to a wall that was removed.
static int numberOf(const WallHandler& walls, const Wall* wall) {
    const auto found = std::ranges::find_if(
        walls.present(), [wall](const PresentWall& present) { return present.object.get() == wall; });
    if (found == walls.present().end())
        throw InputError("InteractionHandler: getInteraction() needs a wall of this scene.");
    return static_cast<int>(found->number);
}

MercuryInteraction MercuryInteractionHandler::getInteraction(const GrainReference& one,
                                                             const GrainReference& other,
                                                             double /*time*/) const {
    const std::uint32_t a = one.getId(), b = other.getId();
    for (const ObservedContact& contact : contactsOf(*scene, one))
        if (contact.wall < 0 && ((contact.particle1 == a && contact.particle2 == b) ||
                                 (contact.particle1 == b && contact.particle2 == a)))
            return {contact, *bonds};
    return {MercuryBonds::Pair{a, b, -1}, *bonds};
}

MercuryInteraction MercuryInteractionHandler::getInteraction(const GrainReference& grain, const Wall* wall,
                                                             double /*time*/) const {
    const int number = numberOf(scene->wallHandler, wall);
    MercuryInteraction found(MercuryBonds::Pair{grain.getId(), ObservedContact::none, number}, *bonds);
    for (const ObservedContact& contact : contactsOf(*scene, grain))
        if (contact.wall == number && (!found || contact.overlap() > found.getOverlap()))
            found = {contact, *bonds};
    return found;
}

}  // namespace pendular
