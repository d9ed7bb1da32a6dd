#include "Kernel/Features/RigidBodies/BodySizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "Kernel/Features/RigidBodies/RoundedBox.h"

namespace pendular {

/// Of bodies of the same mass both: the smallest and the largest grains of them.
static void takeIf(bool isBeyond, const BodiesAlike::Size& size, BodiesAlike::Size& known) {
    if (size.mass == known.mass) {
        known.smallest = std::min(known.smallest, size.smallest);
        known.largest = std::max(known.largest, size.largest);
        known.face = std::max(known.face, size.face);
    } else if (isBeyond) known = size;
}

void BodiesAlike::add(const Size& lightest, const Size& heaviest) {
    takeIf(lightest.mass < least.mass, lightest, least);
    takeIf(heaviest.mass > most.mass, heaviest, most);
}

void BodiesAlike::add(const BodiesAlike& others) {
    add(others.least, others.most);
    count += others.count;
}

bool BodiesAlike::hold(const BodiesAlike& others) const {
    constexpr double rounding = 1e-9;
    return species == others.species && isBlock == others.isBlock && others.around.areWithin(around) &&
           others.least.mass >= least.mass * (1 - rounding) && others.most.mass <= most.mass * (1 + rounding);
}

void addTo(std::vector<BodiesAlike>& all, const BodiesAlike& bodies) {
    const auto same = std::ranges::find_if(all, [&](const BodiesAlike& b) { return b.isLike(bodies); });
    if (same == all.end()) all.push_back(bodies);
    else same->add(bodies);
}

/// What Hertz's law takes of a block.
static BodiesAlike::Size sizeOfBlock(const ParticleStore& grains, std::size_t at) {
    const BodyMember& corner = grains.bodies.membersOf(at)[1];
    const Vector<double>& arm = corner.arm;
    const RoundedBox box{{std::abs(arm.x), std::abs(arm.y), std::abs(arm.z)},
                         grains.translation[grains.place[corner.grain]].radius};
    const Vector<double> outer = box.outer();
    const double face = 4 * std::max({outer.x * outer.y, outer.x * outer.z, outer.y * outer.z});
    return {grains.bodies[at].mass, box.radius, box.largestContactRadius(), face};
}

std::vector<BodiesAlike> bodiesAt(const ParticleStore& grains, std::size_t at) {
    const RigidBodies& bodies = grains.bodies;
    std::vector<BodiesAlike> found;
    if (bodies.isHeld(at) || bodies.isSphere(grains, at)) return found;
    const bool isBlock = bodies.isBlock(at);
    for (const BodyMember& member : bodies.membersOf(at)) {
        const std::uint32_t place = grains.place[member.grain];
        const double radius = grains.translation[place].radius;
        BodiesAlike one{
            .species = grains.species[place], .isBlock = isBlock, .around = bodies.contactsAt(grains, at)};
        one.add(isBlock ? sizeOfBlock(grains, at) : BodiesAlike::Size{bodies.dryMassOf(at), radius, radius});
        addTo(found, one);
        if (isBlock) break;
    }
    for (BodiesAlike& one : found) one.count = 1;  // of its grains there are more
    return found;
}

std::vector<BodiesAlike> bodiesOf(const ParticleStore& grains, const AllRanks& ranks) {
    std::vector<BodiesAlike> own;
    for (std::size_t k = 0; k < grains.bodies.size(); ++k)
        for (const BodiesAlike& one : bodiesAt(grains, k)) own.push_back(one);
    // By shape, so that a scene of many has few of them.
    using Key = std::tuple<std::size_t, bool, decltype(ContactsAround{}.numbers())>;
    const auto keyOf = [](const BodiesAlike& b) -> Key { return {b.species, b.isBlock, b.around.numbers()}; };
    const auto merged = [&](const std::vector<BodiesAlike>& all) {
        std::map<Key, BodiesAlike> byShape;
        for (const BodiesAlike& one : all) {
            const auto [place, isNew] = byShape.try_emplace(keyOf(one), one);
            if (!isNew) place->second.add(one);
        }
        std::vector<BodiesAlike> few;
        for (const auto& [key, one] : byShape) few.push_back(one);
        return few;
    };
    return ranks.areSeveral() ? merged(ranks.gather(merged(own))) : merged(own);
}

}  // namespace pendular
