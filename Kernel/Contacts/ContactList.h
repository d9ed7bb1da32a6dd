#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Contacts/NeighbourSearch.h"
#include "Kernel/Contacts/RememberedContacts.h"
#include "Kernel/Contacts/WakeBlock.h"
#include "Kernel/Species/SpeciesHandler.h"
#include "Kernel/Walls/WallHandler.h"

namespace pendular {

/// Lists anew the contacts that can act before two bodies have approached by the skin, and takes over the
/// memory of those that were listed before. A bridge that forms at contact only needs no search at its own
/// length: the pairs it joins are remembered, and all others must touch first.
template <class S>
class ContactList {
public:
    using Grains = ParticleStore<S::hasTorque>;

    ContactList(const SpeciesHandler<S>& speciesHandler, const WallHandler& wallHandler,
                const PeriodicBox& box, double skinWidth, bool withLedger)
        : species(speciesHandler), walls(wallHandler), periodic(box), skin(skinWidth), ledger(withLedger) {}

    /// Sorts the grains in space and lists their contacts.
    void rebuild(Grains& grains, ContactStore<S>& store) {
        const RememberedContacts<S> old(store, grains.identity);
        for (TranslationRecord& grain : grains.translation) grain.position = periodic.wrap(grain.position);
        grains.reorder(spatialOrder(grains.translation, 2 * grains.smallestRadius() + skin));
        findPairs(grains, old);
        findWallContacts(grains, old);
        fill(grains, store);
        recall(old, grains, store);
        listSides(grains.size(), store);
    }

private:
    /// Whether bodies may act on each other without having touched.
    static constexpr bool actsApart = S::Adhesion::acts && !S::Adhesion::formsAtContact;

    struct Listed {
        std::uint32_t first, second;
    };
    struct Group {
        Bucket bucket;
        std::vector<Listed> contacts;
    };

    double rangeOf(int a, int b, const Bodies& bodies) const { return species.mixture(a, b).range(bodies); }

    /// The largest range (m) that two grains of the scene can have; a law's range is taken to be monotonous
    /// in the radii.
    double largestRange(const Grains& grains) const {
        std::vector<Bodies> extremes(species.getSize(), {infinity, 0});
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
                            largest = std::max(largest,
                                               rangeOf(static_cast<int>(a), static_cast<int>(b), {r1, r2}));
        return largest;
    }

    std::size_t groupOf(int species1, int species2, int wall) {
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const Bucket& bucket = groups[g].bucket;
            if (bucket.species1 == species1 && bucket.species2 == species2 && bucket.wall == wall) return g;
        }
        groups.push_back({{0, 0, species1, species2, wall}, {}});
        return groups.size() - 1;
    }

    void findPairs(const Grains& grains, const RememberedContacts<S>& old) {
        const NeighbourSearch search(grains.translation, skin + (actsApart ? largestRange(grains) : 0),
                                     periodic);
        for (std::size_t a = 0; a < species.getSize(); ++a)
            for (std::size_t b = a; b < species.getSize(); ++b)
                groupOf(static_cast<int>(a), static_cast<int>(b), -1);
        for (std::uint32_t i = 0; i < grains.size(); ++i) {
            search.forEachPartner(i, [&](std::uint32_t j) {
                if (nearEnough(grains, i, j)) addPair(grains, i, j);
            });
            if constexpr (S::Adhesion::acts && S::Adhesion::formsAtContact)
                for (const auto& entry : old.of(grains.identity[i]))
                    if (entry.wall == 0 && entry.bridged && !nearEnough(grains, i, grains.place[entry.other]))
                        addPair(grains, i, grains.place[entry.other]);
        }
    }

    bool nearEnough(const Grains& grains, std::uint32_t i, std::uint32_t j) const {
        const TranslationRecord& a = grains.translation[i];
        const TranslationRecord& b = grains.translation[j];
        double reach = a.radius + b.radius + skin;
        if constexpr (actsApart) reach += rangeOf(grains.species[i], grains.species[j], {a.radius, b.radius});
        return squaredNorm(periodic.nearest(b.position - a.position)) < reach * reach;
    }

    void addPair(const Grains& grains, std::uint32_t i, std::uint32_t j) {
        if (grains.translation[i].inverseMass == 0 && grains.translation[j].inverseMass == 0) return;
        const std::size_t low = std::min(grains.species[i], grains.species[j]);
        const std::size_t high = std::max(grains.species[i], grains.species[j]);
        // The groups of pairs stand first, in the order of a triangle of species.
        const std::size_t group = low * species.getSize() - low * (low + 1) / 2 + high;
        groups[group].contacts.push_back({std::min(i, j), std::max(i, j)});
    }

    void findWallContacts(const Grains& grains, const RememberedContacts<S>& old) {
        std::vector<std::uint32_t> parts;
        for (std::size_t w = 0; w < walls.getSize(); ++w) {
            const Wall& wall = walls.getObject(w);
            for (std::uint32_t i = 0; i < grains.size(); ++i) {
                const TranslationRecord& grain = grains.translation[i];
                if (grain.inverseMass == 0) continue;
                parts.clear();
                // A bridge may pass on to the next part of the wall: then all within its range are listed.
                bool far = actsApart;
                if constexpr (S::Adhesion::acts && S::Adhesion::formsAtContact)
                    for (const auto& entry : old.of(grains.identity[i]))
                        far |= entry.wall == w + 1 && entry.bridged;
                const double apart = far ? rangeOf(grains.species[i], wall.species, {grain.radius}) : 0;
                wall.listParts(grain.position, grain.radius + apart + skin, parts);
                if (parts.empty()) continue;
                Group& group = groups[groupOf(grains.species[i], wall.species, static_cast<int>(w))];
                for (const std::uint32_t part : parts) group.contacts.push_back({i, part});
            }
        }
    }

    /// Within each stretch of the list, puts the pairs that touch before those that do not, and these in the
    /// order of their gaps: the blocks of the former are full, and those of the latter cost nothing until
    /// bodies have approached by their smallest gap. Stretches are short enough for the grains to stay in the
    /// cache.
    void sortByGap(Group& g, const Grains& grains) const {
        constexpr std::size_t stretch = 2048;
        std::vector<std::pair<double, Listed>> pairs;
        for (std::size_t begin = 0; begin < g.contacts.size(); begin += stretch) {
            const std::size_t end = std::min(begin + stretch, g.contacts.size());
            pairs.clear();
            for (std::size_t k = begin; k < end; ++k)
                pairs.emplace_back(gapOf(grains, g.contacts[k]), g.contacts[k]);
            const auto apart =
                std::stable_partition(pairs.begin(), pairs.end(), [](const auto& p) { return p.first <= 0; });
            std::stable_sort(apart, pairs.end(),
                             [](const auto& p, const auto& q) { return p.first < q.first; });
            for (std::size_t k = begin; k < end; ++k) g.contacts[k] = pairs[k - begin].second;
        }
    }

    /// How far two grains must approach (m) before the pair acts.
    double gapOf(const Grains& grains, const Listed& pair) const {
        const TranslationRecord& a = grains.translation[pair.first];
        const TranslationRecord& b = grains.translation[pair.second];
        double reach = a.radius + b.radius;
        if constexpr (actsApart)
            reach += rangeOf(grains.species[pair.first], grains.species[pair.second], {a.radius, b.radius});
        return norm(periodic.nearest(b.position - a.position)) - reach;
    }

    /// Turns the groups into blocks.
    void fill(const Grains& grains, ContactStore<S>& store) {
        std::size_t blocks = 0, wallBlocks = 0;
        store.buckets.clear();
        for (Group& g : groups) {
            if (g.contacts.empty()) continue;
            if (g.bucket.wall < 0) sortByGap(g, grains);
            g.bucket.begin = static_cast<std::uint32_t>(blocks);
            const std::size_t own = (g.contacts.size() + Pack::lanes - 1) / Pack::lanes;
            blocks += own;
            if (g.bucket.wall >= 0) wallBlocks += own;
            g.bucket.end = static_cast<std::uint32_t>(blocks);
            store.buckets.push_back(g.bucket);
        }
        store.blocks.assign(blocks, {});
        store.states.assign(blocks, {});
        store.slots.assign(blocks, ContactStore<S>::asleep);
        store.gaps.assign(blocks, 0);
        store.memory.clear(ledger);
        store.wallPoints.assign(wallBlocks, {});
        for (const Group& g : groups) {
            for (std::size_t k = 0; k < g.contacts.size(); ++k) {
                const std::size_t block = g.bucket.begin + k / Pack::lanes, lane = k % Pack::lanes;
                store.blocks[block].first[lane] = g.contacts[k].first;
                store.blocks[block].second[lane] = g.contacts[k].second;
                store.states[block].listed |= static_cast<std::uint8_t>(1u << lane);
                // The first of a block has the smallest gap. Of walls none is known.
                if (lane == 0 && g.bucket.wall < 0)
                    store.gaps[block] = gapOf(grains, g.contacts[k]) - 1e-9 * skin;
            }
        }
        groups.clear();
    }

    /// Copies the memory of contacts that were touching or joined before.
    void recall(const RememberedContacts<S>& old, const Grains& grains, ContactStore<S>& store) const {
        store.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            const ContactBlock& block = store.blocks[c / Pack::lanes];
            const std::uint32_t first = grains.identity[block.first[c % Pack::lanes]];
            const std::uint32_t second = block.second[c % Pack::lanes];
            const std::uint32_t other = bucket.wall >= 0 ? second : grains.identity[second];
            const bool exchanged = bucket.wall < 0 && other < first;
            const auto* entry = exchanged
                                    ? old.find(other, 0, first)
                                    : old.find(first, static_cast<std::uint32_t>(bucket.wall + 1), other);
            if (!entry) return;
            if (store.slots[c / Pack::lanes] == ContactStore<S>::asleep)
                wakeBlock(store, c / Pack::lanes, bucket, species.mixture(bucket.species1, bucket.species2),
                          grains);
            RememberedContacts<S>::recall(*entry, exchanged, store, c);
        });
    }

    static void listSides(std::size_t grainCount, ContactStore<S>& store) {
        const auto forEachSide = [&](auto&& function) {
            store.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
                function(store.blocks[c / Pack::lanes].first[c % Pack::lanes], c, 0u);
                if (bucket.wall < 0) function(store.blocks[c / Pack::lanes].second[c % Pack::lanes], c, 1u);
            });
        };
        store.sides.list(grainCount, forEachSide, [&](std::uint32_t c) { return store.slotOf(c); });
    }

    const SpeciesHandler<S>& species;
    const WallHandler& walls;
    const PeriodicBox& periodic;
    double skin;
    bool ledger;
    std::vector<Group> groups;
};

}  // namespace pendular
