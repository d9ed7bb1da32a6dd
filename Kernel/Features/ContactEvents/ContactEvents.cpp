#include "Kernel/Features/ContactEvents/ContactEvents.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Core/Walls/WallImages.h"
#include "Kernel/Features/ContactEvents/EventsOfRanks.h"

namespace pendular {

namespace {

using Kind = ContactEvent::Kind;
using Row = std::array<std::uint32_t, 6>;  // an event in a file; the wall's number + 1, 0: none

auto contactOf(const ContactEvent& event) {
    return std::tuple(event.particle1, event.particle2, event.wall, event.image, event.part);
}

/// Calls function(lane, kind) for each bit that differs.
template <class Function>
void forEachChange(const BlockState& before, const BlockState& after, Function&& function) {
    const auto look = [&](unsigned old, unsigned now, Kind begins, Kind ends) {
        for (unsigned changed = old ^ now, lane = 0; changed != 0; changed >>= 1, ++lane)
            if ((changed & 1) != 0) function(lane, (now >> lane & 1) != 0 ? begins : ends);
    };
    look(before.touching, after.touching, Kind::TouchBegins, Kind::TouchEnds);
    look(before.bridged, after.bridged, Kind::BridgeForms, Kind::BridgeRuptures);
}

}  // namespace

ContactEvent ContactEvents::eventOf(const ContactStore& store, const Bucket& bucket, std::uint32_t contact,
                                    const std::vector<std::uint32_t>& identity, Kind kind) const {
    const ContactBlock& block = store.blocks[contact / Pack::lanes];
    const std::uint32_t first = identity[block.first[contact % Pack::lanes]],
                        second = block.second[contact % Pack::lanes];
    if (bucket.wall < 0) return {first, identity[second], -1, 0, kind};
    if (!walls->getObject(static_cast<std::size_t>(bucket.wall)).isRepeated())
        return {first, ContactEvent::none, bucket.wall, second, kind};
    return {first,       ContactEvent::none,
            bucket.wall, WallImages::partOf(second),
            kind,        WallImages::imageOf(second) / WallImages::mostParts};
}

void ContactEvents::leaveForNextStep() {
    early.insert(early.end(), events.begin(), events.end());
    events.clear();
    changesOfStep.clear();
}

void ContactEvents::startColumns(ContactStore& store, const Bucket& bucket) const {
    for (std::uint32_t b = bucket.begin; b < bucket.end; ++b) {
        const BlockState &then = states[b - bucket.begin], &now = store.states[b];
        const unsigned before = unsigned{then.touching} | then.bridged;
        const unsigned begins = (unsigned{now.touching} | now.bridged) & ~before;
        for (std::size_t lane = 0; begins >> lane != 0; ++lane)
            if ((begins >> lane & 1) != 0)
                store.memory.named.set(store.slotOf(b * Pack::lanes + lane), startsOfColumns.data());
    }
}

void ContactEvents::after(ContactStore& store, const Bucket& bucket,
                          const std::vector<std::uint32_t>& identity) {
    if (!startsOfColumns.empty()) startColumns(store, bucket);
    if (!listening && !watching) return;
    for (std::uint32_t b = bucket.begin; b < bucket.end; ++b)
        forEachChange(states[b - bucket.begin], store.states[b], [&](unsigned lane, Kind kind) {
            const std::uint32_t contact = b * Pack::lanes + lane;
            if (watching) changesOfStep.push_back({contact, kind});
            if (isHeardHere(store, contact))
                events.push_back(eventOf(store, bucket, contact, identity, kind));
        });
}

void ContactEvents::add(const ContactStore& store, std::uint32_t contact,
                        const std::vector<std::uint32_t>& identity, Kind kind) {
    if (isHeardHere(store, contact))
        events.push_back(eventOf(store, store.bucketOf(contact / Pack::lanes), contact, identity, kind));
}

void ContactEvents::end(const ContactStore& store, std::uint32_t contact,
                        const std::vector<std::uint32_t>& identity) {
    if (!isHeardHere(store, contact)) return;
    const std::size_t block = contact / Pack::lanes;
    BlockState ended = store.states[block];
    for (std::uint8_t* bits : {&ended.touching, &ended.bridged})
        *bits = static_cast<std::uint8_t>(*bits & ~(1u << contact % Pack::lanes));
    forEachChange(store.states[block], ended, [&](unsigned, Kind kind) {
        early.push_back(eventOf(store, store.bucketOf(block), contact, identity, kind));
    });
}

void ContactEvents::finish() {
    std::ranges::stable_sort(events, {}, contactOf);
    for (const ContactEvent& event : events) sums.add(event.kind);
}

/// Each event is heard on one rank, so that those of one contact stay as they happened.
static std::vector<ContactEvent> heardByAll(const std::vector<ContactEvent>& own, const AllRanks& ranks) {
    std::vector<ContactEvent> all = ranks.gather(own);
    std::ranges::stable_sort(all, {}, contactOf);
    return all;
}

std::vector<ContactEvent> eventsOfAll(const ContactEvents& own, const AllRanks& ranks) {
    return heardByAll(own.ofStep(), ranks);
}

ContactEventCounts countsOfAll(const ContactEvents& own, const AllRanks& ranks) {
    ContactEventCounts all = own.counts();
    for (std::uint64_t* const sum :
         {&all.touchesBegun, &all.touchesEnded, &all.bridgesFormed, &all.bridgesRuptured})
        *sum = ranks.sum(*sum);
    return all;
}

void ContactEvents::gather(const AllRanks& ranks) {
    if (!listening) return;
    ownBefore = events;
    for (std::vector<ContactEvent>* const list : {&events, &early}) *list = heardByAll(*list, ranks);
    sums = countsOfAll(*this, ranks);
}

void ContactEvents::leaveToFirstRank() {
    early.clear();
    sums = {};
}

void ContactEvents::visitState(StateArchive& archive) {
    archive.record<std::uint64_t>("counts", sums);
    // As they will be told, however many ranks have heard them.
    if (archive.isWriting()) std::ranges::stable_sort(early, {}, contactOf);
    std::vector<Row> rows;
    for (const ContactEvent& e : early)
        rows.push_back({e.particle1, e.particle2, static_cast<std::uint32_t>(e.wall + 1), e.part,
                        static_cast<std::uint32_t>(e.kind), e.image});
    archive.column<std::uint32_t>("beforeNextStep", rows);
    early.clear();
    for (const auto& [particle1, particle2, wall, part, kind, image] : rows) {
        archive.require(kind <= static_cast<std::uint32_t>(Kind::BridgeRuptures), "beforeNextStep",
                        "has an event of no kind that there is");
        early.push_back(
            {particle1, particle2, static_cast<int>(wall) - 1, part, static_cast<Kind>(kind), image});
    }
}

}  // namespace pendular
