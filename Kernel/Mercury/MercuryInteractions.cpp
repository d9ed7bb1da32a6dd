#include "Kernel/Mercury/MercuryInteractions.h"

#include <fmt/format.h>

#include "Kernel/Base/InputError.h"

namespace pendular {

MercuryInteraction MercuryInteractionHandler::getObject(std::size_t number) const {
    const std::vector<ObservedContact> all = scene->interactions();
    if (number >= all.size())
        throw InputError(fmt::format(
            "InteractionHandler: there is no interaction {}; the last step has {}, counted from 0.", number,
            all.size()));
    return MercuryInteraction(all[number]);
}

MercuryInteraction MercuryInteractionHandler::getLastObject() const {
    const std::vector<ObservedContact> all = scene->interactions();
    if (all.empty())
        throw InputError("InteractionHandler: getLastObject() needs an interaction, and there is none.");
    return MercuryInteraction(all.back());
}

MercuryInteraction MercuryInteractionHandler::getInteraction(const GrainReference& one,
                                                             const GrainReference& other) const {
    const std::uint32_t a = one.getId(), b = other.getId();
    for (const ObservedContact& contact : scene->interactionsOf(a))
        if (contact.wall < 0 && ((contact.particle1 == a && contact.particle2 == b) ||
                                 (contact.particle1 == b && contact.particle2 == a)))
            return MercuryInteraction(contact);
    return {};
}

MercuryInteraction MercuryInteractionHandler::getInteraction(const GrainReference& grain,
                                                             const Wall* wall) const {
    MercuryInteraction found;
    for (const ObservedContact& contact : scene->interactionsOf(grain.getId()))
        if (contact.wall >= 0 &&
            &scene->wallHandler.getObject(static_cast<std::size_t>(contact.wall)) == wall &&
            (!found || contact.overlap() > found.getOverlap()))
            found = MercuryInteraction(contact);
    return found;
}

}  // namespace pendular
