#include "Kernel/Core/Contacts/ContactRecall.h"

#include <algorithm>
#include <numeric>

#include "Kernel/Core/Contacts/Rearrangement.h"
#include "Kernel/Core/Contacts/WakeBlock.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

namespace {

constexpr std::size_t blocksWorthAThread = 128;  // blocks

bool isNone(std::uint32_t entry) { return entry == RememberedContacts::none; }

}  // namespace

template <class Function>
void ContactRecall::forEachBlock(const ContactStore& store, Function&& function) const {
    for (const Bucket& bucket : store.buckets)
        inParts(
            bucket.size(), threads,
            [&](int, std::size_t begin, std::size_t end) {
                for (std::size_t b = begin; b < end; ++b) function(bucket, bucket.begin + b);
            },
            blocksWorthAThread);
}

std::size_t ContactRecall::into(ContactStore& store, const RememberedContacts& old, double apart) const {
    const std::vector<std::uint32_t> entries = entriesOf(old, store, apart);
    std::vector<std::uint32_t> origins(Pack::lanes), blocks{0};
    std::iota(origins.begin(), origins.end(), 0u);  // block 0 stays
    std::size_t recalled = 0;
    for (std::uint32_t b = 0; b < store.blocks.size(); ++b) {
        const std::uint32_t* const own = &entries[std::size_t{b} * Pack::lanes];
        if (std::all_of(own, own + Pack::lanes, isNone)) continue;
        store.slots[b] = static_cast<std::uint32_t>(blocks.size());
        blocks.push_back(b);
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
            origins.push_back(isNone(own[lane]) ? Rearrangement::nothing : old.slotOf(own[lane]));
            if (isNone(own[lane])) continue;
            ++recalled;
            RememberedContacts::setState(old.entry(own[lane]), lane, store.states[b]);
        }
    }
    store.memory.rearrange(std::move(origins), std::move(blocks), threads);
    if (laws.layout.interaction > 0) prepareBridges(entries, store);
    return recalled;
}

std::vector<std::uint32_t> ContactRecall::entriesOf(const RememberedContacts& old, const ContactStore& store,
                                                    double apart) const {
    std::vector<std::uint32_t> entries(store.blocks.size() * Pack::lanes, RememberedContacts::none);
    // Bodies that are bridged may be far apart.
    const double near = laws.formsAtContact || laws.actsApart || laws.breaks ? infinity : apart;
    lookUp(old, store, -infinity, near, entries);
    if (near < infinity && static_cast<std::size_t>(std::ranges::count_if(
                               entries, [](std::uint32_t entry) { return !isNone(entry); })) != old.size())
        lookUp(old, store, near, infinity, entries);
    return entries;
}

void ContactRecall::lookUp(const RememberedContacts& old, const ContactStore& store, double from, double to,
                           std::vector<std::uint32_t>& entries) const {
    forEachBlock(store, [&](const Bucket& bucket, std::size_t b) {
        if (!(store.gaps[b] >= from && store.gaps[b] < to)) return;
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
            if (!store.bitOf(store.states[b].listed, lane)) continue;
            const std::uint32_t second = store.blocks[b].second[lane];
            entries[b * Pack::lanes + lane] = old.find(placeBefore[store.blocks[b].first[lane]],
                                                       static_cast<std::uint32_t>(bucket.wall + 1),
                                                       bucket.wall >= 0 ? second : grains.identity[second]);
        }
    });
}

void ContactRecall::prepareBridges(const std::vector<std::uint32_t>& entries, ContactStore& store) const {
    forEachBlock(store, [&](const Bucket& bucket, std::size_t b) {
        if (store.slots[b] == ContactStore::asleep) return;
        std::uint8_t fresh = store.states[b].listed;
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
            const std::size_t contact = b * Pack::lanes + lane;
            if (isNone(entries[contact])) continue;
            fresh &= static_cast<std::uint8_t>(~(1u << lane));
            if (keepsPrepared) continue;
            ContactNumbers before{};
            store.memory.interaction.get(store.slotOf(contact), before.data());
            prepareAgain(store, laws, bucket, contact, grains, before.data());
        }
        prepareBlock(store, b, fresh, bucket, laws, grains);
    });
}

}  // namespace pendular
