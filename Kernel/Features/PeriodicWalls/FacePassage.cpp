#include "Kernel/Features/PeriodicWalls/FacePassage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "Kernel/Core/Particles/GrainName.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {

namespace {

/// A wall may look different to a grain before and behind a face, by this share of its radius. Walls are
/// checked to a tenth of it, and the nearest point of a part may shift by a few times what the part does.
constexpr double passageTolerance = 1e-3;

}  // namespace

double FacePassage::rangeAt(const Grains& grains, std::uint32_t place, std::uint32_t wall) const {
    if (laws.layout.interaction == 0) return 0;
    return laws.range(grains.species[place], walls.getObject(wall).getSpeciesIndex(),
                      {grains.translation[place].radius});
}

FacePassage::Seen FacePassage::seenAt(const Grains& grains, std::uint32_t place, std::uint32_t wall,
                                      std::uint32_t part, bool isCovered) const {
    const TranslationRecord& grain = grains.translation[place];
    std::array<WallPoint, 1> point{};  // of one part alone no other one covers it
    walls.getObject(wall).findPoints(grain.position, infinity, std::array{part}, point);
    return {.wall = wall,
            .part = part,
            .foot = point[0].distance * point[0].normal,
            .distance = point[0].distance,
            .isCovered = isCovered,
            .contact = 0};
}

void FacePassage::leave(const Grains& grains, std::span<const std::uint32_t> places) {
    for (const std::uint32_t place : places) {
        Passing& passing = grainsThatPass.emplace_back();
        passing.place = place;
        passing.position = grains.translation[place].position;
        if (place >= store.sides.grainCount()) continue;  // it came after the list
        for (const std::uint32_t side : store.sidesOf(place))
            note(grains, store.contactAt(side / 2), passing);
        const auto others = store.asleepSidesOf(place);
        std::vector<std::uint32_t> asleep(others.begin(), others.end());
        std::ranges::sort(asleep);  // the same order for any number of threads
        for (const std::uint32_t side : asleep) note(grains, side / 2, passing);
    }
}

void FacePassage::note(const Grains& grains, std::uint32_t contact, Passing& passing) const {
    const std::size_t block = contact / Pack::lanes, lane = contact % Pack::lanes;
    if (block < store.firstWallBlock() || !ContactStore::bitOf(store.states[block].listed, contact)) return;
    const auto wall = static_cast<std::uint32_t>(store.bucketOf(block).wall);
    if (!isFollowed[wall]) return;
    const double distance = store.wallPoints[block - store.firstWallBlock()].distance.lane[lane];
    passing.before.push_back(
        seenAt(grains, passing.place, wall, store.blocks[block].second[lane], !std::isfinite(distance)));
    passing.before.back().contact = contact;
}

std::vector<FacePassage::Seen> FacePassage::allSeenAt(const Grains& grains, std::uint32_t place,
                                                      std::uint32_t number, double listReach) const {
    const Wall& wall = walls.getObject(number);
    const TranslationRecord& grain = grains.translation[place];
    const double range = rangeAt(grains, place, number);
    std::vector<std::uint32_t> parts;
    wall.listParts(grain.position, grain.radius + std::max(range, listReach), parts);
    std::vector<WallPoint> points(parts.size());
    if (!parts.empty()) wall.findPoints(grain.position, grain.radius + range, parts, points);
    std::vector<Seen> found;
    for (std::size_t k = 0; k < parts.size(); ++k)
        found.push_back(seenAt(grains, place, number, parts[k], !std::isfinite(points[k].distance)));
    return found;
}

void FacePassage::arrive(const Grains& grains, double reach, double time) {
    for (Passing& passing : grainsThatPass) {
        const bool isHeld = grains.translation[passing.place].inverseMass == 0;
        for (const PresentWall& present : walls.present()) {
            const auto wall = static_cast<std::uint32_t>(present.number);
            if (isHeld && !listsOfHeld.atWall(wall)) continue;
            if (present.object->isRepeated()) goOnAtImages(grains, passing, wall);
            else if (isFollowed[wall] && !findPartners(grains, passing, wall, reach))
                throw RunError(fmt::format(
                    "At time {:.6g} s {} goes through a face of the periodic scene where wall {} is "
                    "not the same on both sides: only meshes are repeated, so let this one go on through the "
                    "faces, or keep grains away from where it does not.",
                    time, nameOfGrain(grains, grains.identity[passing.place]), wall));
        }
    }
}

void FacePassage::goOnAtImages(const Grains& grains, Passing& passing, std::uint32_t wall) {
    const Vector<double> way = grains.translation[passing.place].position - passing.position;
    for (const Seen& before : passing.before) {
        if (before.wall != wall) continue;
        meetsWalls = true;
        if (store.acts(before.contact))
            passing.parts.push_back({wall, before.part, walls.getObject(wall).partAfter(way, before.part)});
    }
}

/// One of two parts that the grain sees in the same place, as above their common edge, is covered: that goes
/// on as such. In a shallow groove round-off may cover the other one; the contact is handed over then.
FacePassage::Seen* FacePassage::partnerOf(const Seen& before, std::vector<Seen>& now, double radius) {
    const double most = passageTolerance * radius;  // m
    const auto apart = [&](const Seen& each) {
        if (each.isTaken || !(each.distance < infinity)) return infinity;
        const double between = norm(each.foot - before.foot);
        return between <= most ? between + (each.isCovered != before.isCovered ? most : 0) : infinity;
    };
    const auto nearest = std::ranges::min_element(now, {}, apart);
    return nearest != now.end() && apart(*nearest) < infinity ? &*nearest : nullptr;
}

bool FacePassage::findPartners(const Grains& grains, Passing& passing, std::uint32_t wall, double reach) {
    std::vector<Seen> now = allSeenAt(grains, passing.place, wall, reach);
    meetsWalls |= !now.empty();
    const double radius = grains.translation[passing.place].radius, touch = (1 - passageTolerance) * radius,
                 range = rangeAt(grains, passing.place, wall);
    // Beside a point that the grain sees on the other side, too, it is one contact with that (WallPatches),
    // though the parts there are cut otherwise, or have a crack.
    const auto isBeside = [&](const Seen& point, const std::vector<Seen>& others) {
        return std::ranges::any_of(others, [&](const Seen& other) {
            return other.wall == wall && other.distance < infinity &&
                   norm(other.foot - point.foot) <= 0.05 * radius;
        });
    };
    for (const bool acting : {true, false})  // what remembers has the choice
        for (const Seen& before : passing.before) {
            const bool acts = store.acts(before.contact);
            if (before.wall != wall || acts != acting) continue;
            if (Seen* const partner = partnerOf(before, now, radius)) {
                partner->isTaken = true;
                if (acts) passing.parts.push_back({wall, before.part, partner->part});
                continue;
            }
            if (!before.isCovered && before.distance < touch + (acts ? range : 0) && !isBeside(before, now))
                return false;
            if (acts) contactsToEnd.push_back(before.contact);
        }
    meetsWalls |= !passing.parts.empty();
    return std::ranges::none_of(now, [&](const Seen& each) {
        return !each.isTaken && !each.isCovered && each.distance < touch && !isBeside(each, passing.before);
    });
}

std::vector<std::uint32_t> FacePassage::arriveChanged(const Grains& grains, double reach,
                                                      ContactStore& contacts) {
    std::vector<std::uint32_t> places;
    for (const Passing& passing : grainsThatPass) {
        if (passing.before.empty()) continue;
        places.push_back(passing.place);
        const TranslationRecord& grain = grains.translation[passing.place];
        const Vector<double> way = grain.position - passing.position;
        std::map<std::uint32_t, std::vector<Seen>> now;  // by wall
        for (Seen before : passing.before) {
            if (!store.acts(before.contact)) continue;
            std::uint32_t& part =
                contacts.blocks[before.contact / Pack::lanes].second[before.contact % Pack::lanes];
            if (walls.getObject(before.wall).isRepeated()) {
                part = walls.getObject(before.wall).partAfter(way, part);
                continue;
            }
            std::vector<Seen>& seen = now[before.wall];
            if (seen.empty()) seen = allSeenAt(grains, passing.place, before.wall, reach);
            before.isCovered = false;  // it acts
            Seen* const partner = partnerOf(before, seen, grain.radius);
            if (!partner) continue;
            partner->isTaken = true;
            part = partner->part;
        }
    }
    return places;
}

void FacePassage::rename(RememberedContacts& remembered) const {
    for (const Passing& passing : grainsThatPass)
        if (!passing.parts.empty()) remembered.goOn(passing.place, passing.parts);
}

}  // namespace pendular
