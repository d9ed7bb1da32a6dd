#include "Kernel/Core/Contacts/ContactList.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Core/Contacts/ContactRecall.h"
#include "Kernel/Core/Contacts/PairSearch.h"
#include "Kernel/Core/Contacts/RememberedContacts.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Foundation/Base/LargePages.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {
namespace {

bool isBridged(const RememberedContacts::Entry& entry) {
    return (entry.state & RememberedContacts::bridged) != 0;
}

}  // namespace

double largestRange(const ContactLaws& laws, const ParticleStore& grains) {
    std::vector<Bodies> extremes(laws.speciesCount(), {infinity, 0});
    for (std::size_t k = 0; k < grains.size(); ++k) {
        Bodies& e = extremes[grains.species[k]];
        e = {std::min(e.radius1, grains.translation[k].radius),
             std::max(e.radius2, grains.translation[k].radius)};
    }
    double largest = 0;
    for (std::size_t a = 0; a < extremes.size(); ++a)
        for (std::size_t b = 0; b < extremes.size(); ++b)
            for (const double r1 : {extremes[a].radius1, extremes[a].radius2})
                for (const double r2 : {extremes[b].radius1, extremes[b].radius2})
                    if (r1 > 0 && r2 > 0 && r1 < infinity && r2 < infinity)
                        largest =
                            std::max(largest, laws.range(static_cast<int>(a), static_cast<int>(b), {r1, r2}));
    return largest;
}

std::size_t ContactList::rebuild(Grains& grains, ContactStore& store, const RememberedContacts& old,
                                 bool keepsCells, double apart) {
    const std::size_t pairsBefore = store.firstWallBlock() * Pack::lanes;
    store.releaseList();  // so that the old list and the search are not there at the same time
    formerPlace = spatialOrder(grains.translation, 2 * grains.smallestRadius() + skin, threads);
    std::erase_if(formerPlace, [&](std::uint32_t place) { return grains.isGap(place); });
    grains.bodies.keepTogether(grains, formerPlace);
    if (const std::size_t own = grains.ownSize(); own < grains.size())
        std::stable_partition(formerPlace.begin(), formerPlace.end(),
                              [own](std::uint32_t place) { return place < own; });
    grains.reorder(formerPlace, threads);
    grains.bodies.refresh(grains);
    if (reachOfFilms > 0)
        reachOfAll = std::max(reachOfAll, std::min(reachOfFilms, largestRange(laws, grains)));
    findPairs(grains, old, pairsBefore, keepsCells);
    if (!keepsCells) found.reset();
    findWallContacts(grains, old);
    fill(grains, store);
    const std::size_t recalled =
        ContactRecall(laws, grains, formerPlace, threads, keepsBridges).into(store, old, apart);
    store.beginSides(grains.identity, threads);
    return recalled;
}

ContactList::Group& ContactList::groupOf(Groups& all, int species1, int species2, int wall) {
    for (Group& group : all) {
        const Bucket& bucket = group.bucket;
        if (bucket.species1 == species1 && bucket.species2 == species2 && bucket.wall == wall) return group;
    }
    all.push_back({{0, 0, species1, species2, wall}, {}});
    return all.back();
}

template <class Function>
void ContactList::listInParts(std::size_t grainCount, Function&& function) {
    std::vector<Groups> parts(static_cast<std::size_t>(threads));
    inParts(
        grainCount, threads,
        [&](int part, std::size_t begin, std::size_t end) {
            function(parts[static_cast<std::size_t>(part)], begin, end);
        },
        worthAThread);
    for (Groups& part : parts)
        for (Group& found : part) {
            Group& group = groupOf(groups, found.bucket.species1, found.bucket.species2, found.bucket.wall);
            // Not empty(): after it, g++ 14 warns of a copy to the memory in front of a vector.
            if (group.contacts.capacity() == 0) group.contacts.swap(found.contacts);
            else group.contacts.insert(group.contacts.end(), found.contacts.begin(), found.contacts.end());
            found.contacts = {};
        }
}

void ContactList::findPairs(const Grains& grains, const RememberedContacts& old, std::size_t pairsBefore,
                            bool keepsCells) {
    const double margin = skin + std::max(reachOfAll, laws.actsApart ? largestRange(laws, grains) : 0);
    const PairSearch search(grains.translation, margin, periodic, threads);
    const bool usable = search.isUsable();
    if (keepsCells || !usable) found.emplace(grains.translation, margin, periodic, threads);
    listInParts(grains.size(), [&](Groups& own, std::size_t begin, std::size_t end) {
        for (std::size_t a = 0; a < laws.speciesCount(); ++a)
            for (std::size_t b = a; b < laws.speciesCount(); ++b)
                own.push_back({{0, 0, static_cast<int>(a), static_cast<int>(b), -1}, {}});
        // A vector's own growth would take up to twice the memory.
        const std::size_t share = pairsBefore * (end - begin) / std::max<std::size_t>(grains.size(), 1);
        if (own.size() == 1) own[0].contacts.reserve(share + share / 16);
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
            const auto add = [&](std::uint32_t j, double gap, double closing) {
                if (!laws.actsApart || nearEnough(grains, i, j)) addPair(own, grains, i, j, gap, closing);
            };
            if (usable) search.forEachPartner(i, add);
            else found->forEachPartner(i, [&](std::uint32_t j) { add(j, gapOf(grains, i, j), 0); });
            if (!laws.formsAtContact) continue;
            for (const auto& entry : old.of(formerPlace[i])) {
                if (entry.wall != 0 || !isBridged(entry)) continue;
                const std::uint32_t j = grains.placeOf(entry.other);
                if (!(usable ? search.reaches(i, j) : found->reaches(i, j)))
                    addPair(own, grains, i, j, gapOf(grains, i, j));
            }
        }
    });
}

bool ContactList::nearEnough(const Grains& grains, std::uint32_t i, std::uint32_t j) const {
    const TranslationRecord& a = grains.translation[i];
    const TranslationRecord& b = grains.translation[j];
    double reach = a.radius + b.radius + skin;
    reach += std::max(
        reachOfAll, laws.actsApart ? rangeOf(grains.species[i], grains.species[j], {a.radius, b.radius}) : 0);
    return squaredNorm(periodic.nearest(b.position - a.position)) < reach * reach;
}

void ContactList::addPair(Groups& all, const Grains& grains, std::uint32_t i, std::uint32_t j, double gap,
                          double closing) const {
    if (!listsOfHeld.pairs && grains.translation[i].inverseMass == 0 &&
        grains.translation[j].inverseMass == 0)
        return;
    if (std::min(i, j) >= grains.ownSize()) return;
    if (grains.bodies.areJoinedAt(i, j)) return;
    const std::size_t low = std::min(grains.species[i], grains.species[j]);
    const std::size_t high = std::max(grains.species[i], grains.species[j]);
    // The groups of pairs stand first, in the order of a triangle of species.
    const std::size_t group = low * laws.speciesCount() - low * (low + 1) / 2 + high;
    const bool isOrdered = grains.identity[i] < grains.identity[j];
    const std::uint32_t first = isOrdered ? i : j, second = isOrdered ? j : i;
    if (laws.actsApart || reachOfAll > 0) gap -= actsFrom(grains, first, second);
    all[group].contacts.push_back(
        {first, second, static_cast<float>(gap), static_cast<float>(gap - horizon * closing)});
}

void ContactList::findWallContacts(const Grains& grains, const RememberedContacts& old) {
    if (nearWalls.farther > 0 && walls.getSize() > 0) nearWalls.flags.assign(grains.size(), 0);
    for (const PresentWall& wall : walls.present())
        listInParts(grains.ownSize(), [&](Groups& own, std::size_t begin, std::size_t end) {
            std::vector<std::uint32_t> parts;
            for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i)
                findWallContacts(grains, old, wall.number, i, own, parts);
        });
}

void ContactList::findWallContacts(const Grains& grains, const RememberedContacts& old, std::size_t w,
                                   std::uint32_t i, Groups& all, std::vector<std::uint32_t>& parts) {
    const Wall& wall = walls.getObject(w);
    const TranslationRecord& grain = grains.translation[i];
    if (grain.inverseMass == 0 && !listsOfHeld.atWall(w)) return;
    // A bridge may pass on to the next part of a wall, or to another wall: then all within its range are
    // listed.
    bool far = laws.actsApart;
    if (laws.formsAtContact)
        for (const auto& entry : old.of(formerPlace[i])) far |= entry.wall != 0 && isBridged(entry);
    double apart = reachOfAll;
    if (far || reachOfFilms > apart) {
        const double range = rangeOf(grains.species[i], wall.getSpeciesIndex(), {grain.radius});
        apart = std::max(apart, far ? range : std::min(reachOfFilms, range));
    }
    const auto listWithin = [&](double gap) {
        parts.clear();
        wall.listParts(grain.position, grain.radius + gap, parts);
        return !parts.empty();
    };
    if (!nearWalls.flags.empty()) {
        if (!listWithin(apart + skin + nearWalls.farther)) return;
        nearWalls.flags[i] = 1;
    }
    if (!listWithin(apart + skin)) return;
    Group& group = groupOf(all, grains.species[i], wall.getSpeciesIndex(), static_cast<int>(w));
    for (const std::uint32_t part : parts) group.contacts.push_back({i, part});
}

void ContactList::sortPairs(Group& g) const {
    constexpr std::size_t stretch = 2048;
    const PairOrder order(skin + reachOfAll);
    inParts(
        (g.contacts.size() + stretch - 1) / stretch, threads, [&](int, std::size_t first, std::size_t last) {
            PairOrder::Buffer buffer;
            for (std::size_t begin = first * stretch; begin < std::min(last * stretch, g.contacts.size());
                 begin += stretch)
                order.sort({g.contacts.data() + begin, std::min(stretch, g.contacts.size() - begin)}, buffer);
        });
}

double ContactList::gapOf(const Grains& grains, std::uint32_t i, std::uint32_t j) const {
    const TranslationRecord& a = grains.translation[i];
    const TranslationRecord& b = grains.translation[j];
    return norm(periodic.nearest(b.position - a.position)) - (a.radius + b.radius);
}

double ContactList::actsFrom(const Grains& grains, std::uint32_t first, std::uint32_t second) const {
    const double gap = laws.filmContactGap(grains.species[first], grains.species[second]);
    if (!laws.actsApart) return gap;
    const Bodies bodies{grains.translation[first].radius, grains.translation[second].radius};
    return gap + rangeOf(grains.species[first], grains.species[second], bodies);
}

void ContactList::separateThoseOfOthers(const Grains& grains) {
    Groups all;
    for (Group& g : groups) {
        const auto others = std::stable_partition(
            g.contacts.begin(), g.contacts.end(),
            [own = grains.ownSize()](const ListedPair& contact) { return contact.first < own; });
        Group ofOthers{g.bucket, {others, g.contacts.end()}};
        g.contacts.erase(others, g.contacts.end());
        all.push_back(std::move(g));
        if (!ofOthers.contacts.empty()) all.push_back(std::move(ofOthers));
    }
    groups = std::move(all);
}

void ContactList::fill(const Grains& grains, ContactStore& store) {
    if (grains.ownSize() < grains.size()) separateThoseOfOthers(grains);
    std::size_t blocks = 0, wallBlocks = 0;
    store.buckets.clear();
    for (Group& g : groups) {
        if (g.contacts.empty()) continue;
        if (g.bucket.wall < 0) sortPairs(g);
        g.bucket.begin = static_cast<std::uint32_t>(blocks);
        const std::size_t own = (g.contacts.size() + Pack::lanes - 1) / Pack::lanes;
        blocks += own;
        if (g.bucket.wall >= 0) wallBlocks += own;
        g.bucket.end = static_cast<std::uint32_t>(blocks);
        store.buckets.push_back(g.bucket);
    }
    reserveLarge(store.blocks, blocks);
    store.blocks.assign(blocks, {});
    store.states.assign(blocks, {});
    store.slots.assign(blocks, ContactStore::asleep);
    store.gaps.assign(blocks, -infinity);  // of walls none is known: they are always looked at
    store.wallPoints.assign(wallBlocks, {});
    for (const Group& g : groups)
        inParts(
            g.bucket.end - g.bucket.begin, threads,
            [&](int, std::size_t begin, std::size_t end) {
                for (std::size_t b = begin; b < end; ++b) fillBlock(g, b, store);
            },
            worthAThread);
    const auto touching =
        std::count_if(store.gaps.begin(), store.gaps.end(), [](double g) { return g <= 0; });
    store.memory.makeRoom(static_cast<std::size_t>(touching));
    groups = {};
}

void ContactList::fillBlock(const Group& g, std::size_t b, ContactStore& store) const {
    const std::size_t block = g.bucket.begin + b;
    const std::size_t count = std::min<std::size_t>(g.contacts.size() - b * Pack::lanes, Pack::lanes);
    float least = infinity;
    for (std::size_t lane = 0; lane < count; ++lane) {
        const ListedPair& contact = g.contacts[b * Pack::lanes + lane];
        store.blocks[block].first[lane] = contact.first;
        store.blocks[block].second[lane] = contact.second;
        least = std::min(least, contact.gap);
    }
    store.states[block].listed = static_cast<std::uint8_t>((1u << count) - 1);
    if (g.bucket.wall >= 0) return;
    store.blocks[block].pointToListed(store.states[block].listed);
    // Gaps are rounded to float.
    store.gaps[block] = least - 1e-6 * std::abs(least) - 1e-9 * skin;
}

}  // namespace pendular
