#include "Kernel/Core/Contacts/ObservedContact.h"

#include <optional>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Contacts/LocalBodies.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Walls/Wall.h"

namespace pendular {

ObservedContact observeContact(const ContactStore& contacts, const ContactLaws& laws,
                               const ParticleStore& grains, const PeriodicBox& periodic, const Bucket& bucket,
                               const Wall* wall, std::uint32_t contact) {
    const ContactBlock& block = contacts.blocks[contact / Pack::lanes];
    const BlockState& state = contacts.states[contact / Pack::lanes];
    const std::size_t lane = contact % Pack::lanes;
    const TranslationRecord& first = grains.translation[block.first[lane]];
    ObservedContact seen{grains.identity[block.first[lane]],
                         ObservedContact::none,
                         bucket.wall,
                         0,
                         contacts.normalForceOf(contact),
                         0,
                         (state.bridged >> lane & 1) != 0,
                         {},
                         contacts.forceOf(contact),
                         contacts.touches(contact),
                         0,
                         {},
                         contact};
    if (bucket.wall < 0) {
        const TranslationRecord& second = grains.translation[block.second[lane]];
        seen.particle2 = grains.identity[block.second[lane]];
        seen.shift = periodic.nearest(second.position - first.position);
        seen.separation = norm(seen.shift) - (first.radius + second.radius);
        seen.point = first.position + (first.radius + 0.5 * seen.separation) * seen.normal();
    } else if (!laws.shapes()) {
        const std::uint32_t part = block.second[lane];
        WallPoint point;
        wall->findPoints(first.position, first.radius, {&part, 1}, {&point, 1});
        seen.separation = point.distance - first.radius;
        seen.shift = point.distance * point.normal;
        seen.point = first.position + seen.shift;
    }
    const GrainShapes* const shapes = laws.shapes();
    std::optional<ShapedTouch> touch;
    if (shapes) {
        const double range = seen.bridged ? laws.range(bucket.species1, bucket.species2, {first.radius}) : 0;
        touch = wall ? shapes->touchAtWall(grains, block.first[lane], *wall, block.second[lane], range)
                     : shapes->touch(grains, block.first[lane], block.second[lane], seen.shift);
        seen.separation = -touch->depth;
        seen.ownNormal = touch->normal;
        if (wall) seen.shift = touch->arm1 - (0.5 * touch->depth) * touch->normal;
        seen.point = first.position + (wall ? seen.shift : touch->arm1);
    }
    if (seen.bridged) {
        ContactNumbers interaction;
        if (touch) {
            Bodies around{first.radius};
            if (!wall) around.radius2 = grains.translation[block.second[lane]].radius;
            const LocalBodies local(around, laws.bridgeVolume(bucket.species1, bucket.species2).value_or(0));
            laws.prepareAdhesion(bucket.species1, bucket.species2, local.with(touch->radius, touch->own),
                                 interaction.data());
        } else contacts.memory.interaction.get(contacts.slotOf(contact), interaction.data());
        seen.adhesiveForce =
            laws.adhesiveForce(bucket.species1, bucket.species2, interaction.data(), seen.separation);
    }
    if (seen.bridged)
        seen.bridgeVolume = laws.liquidRules(bucket.species1, bucket.species2)
                                ? contacts.memory.volumeOf(contacts.slotOf(contact))
                                : laws.bridgeVolume(bucket.species1, bucket.species2).value_or(0);
    seen.normalForce += seen.adhesiveForce;
    return seen;
}

}  // namespace pendular
