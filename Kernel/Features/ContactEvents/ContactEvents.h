#pragma once

#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/ContactEvent.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Ranks/AllRanks.h"

namespace pendular {

class WallHandler;

/// The events of a step, found from the bits of blocks before and after it: no work for the kernel, and none
/// at all in a scene that does not listen.
class ContactEvents {
public:
    void setWalls(const WallHandler& ofScene) { walls = &ofScene; }
    void listen(bool on) { listening = on; }
    [[nodiscard]] bool isListening() const { return listening; }

    /// Places of grains from there on are those of ghosts: events of contacts of which one is body 1 are
    /// those of another rank.
    void setOwnPlaces(std::size_t count) { ownPlaces = count; }

    /// Keeps the changes of each step, for physics that follows from them.
    void watch(bool on) { watching = on; }
    [[nodiscard]] bool areListenedTo() const { return listening; }
    /// The changes of contacts in this step, in the order of the list.
    [[nodiscard]] const std::vector<ContactChange>& changes() const { return changesOfStep; }

    /// A step begins: what has ended since the last one, because bodies were removed or changed, belongs to
    /// it.
    void begin() {
        events.clear();
        events.swap(early);
        changesOfStep.clear();
    }
    /// Events since the last step belong to the next one.
    void leaveForNextStep();
    /// Those that the function finds belong to the next step; those of the last one stay.
    template <class Function>
    void forNextStep(Function&& function) {
        std::vector<ContactEvent> told = std::exchange(events, {});
        function();
        leaveForNextStep();
        events = std::move(told);
    }
    /// Called before and after the forces of a bucket; after() also gives the columns of contacts that
    /// begin to act the numbers with which they start.
    void before(const ContactStore& store, const Bucket& bucket) {
        if (listening || watching || !startsOfColumns.empty())
            states.assign(&store.states[bucket.begin], &store.states[bucket.begin] + bucket.size());
    }
    void after(ContactStore& store, const Bucket& bucket, const std::vector<std::uint32_t>& identity);
    /// A contact begins to act besides those that the kernel found: its columns get the numbers with which
    /// they start.
    void startColumns(ContactStore& store, std::uint32_t contact) const {
        if (!startsOfColumns.empty()) store.memory.named.set(store.slotOf(contact), startsOfColumns.data());
    }
    /// Something has happened to a contact besides what the kernel found.
    void add(const ContactStore& store, std::uint32_t contact, const std::vector<std::uint32_t>& identity,
             ContactEvent::Kind kind);
    /// A contact is about to end because a body is removed or changed.
    void end(const ContactStore& store, std::uint32_t contact, const std::vector<std::uint32_t>& identity);
    /// Puts the events of the step into the order of identities, those of one contact as they happened, and
    /// counts them.
    void finish();

    /// A contact has a column more, which starts at this number.
    void addColumn(double initial) { startsOfColumns.push_back(initial); }

    [[nodiscard]] const std::vector<ContactEvent>& ofStep() const { return events; }
    [[nodiscard]] const ContactEventCounts& counts() const { return sums; }
    /// Each rank gets what all have heard and counted, until they share the grains again: from then on the
    /// first one goes on with it, and the others forget it.
    void gather(const AllRanks& ranks);
    void leaveToFirstRank();
    /// Each has the events of its last step again that it had heard itself.
    void keepOwn() { events = std::exchange(ownBefore, {}); }
    void visitState(StateArchive& archive);

private:
    void startColumns(ContactStore& store, const Bucket& bucket) const;
    [[nodiscard]] bool isHeardHere(const ContactStore& store, std::uint32_t contact) const {
        return listening && store.blocks[contact / Pack::lanes].first[contact % Pack::lanes] < ownPlaces;
    }
    [[nodiscard]] ContactEvent eventOf(const ContactStore& store, const Bucket& bucket, std::uint32_t contact,
                                       const std::vector<std::uint32_t>& identity,
                                       ContactEvent::Kind kind) const;

    const WallHandler* walls = nullptr;
    bool listening = false, watching = false;
    std::size_t ownPlaces = ~std::size_t{0};
    std::vector<double> startsOfColumns;
    std::vector<BlockState> states;  // of a bucket before the step
    std::vector<ContactEvent> events, early;
    std::vector<ContactEvent> ownBefore;  // events of the step that this rank has heard, when it got all
    std::vector<ContactChange> changesOfStep;
    ContactEventCounts sums;
};

}  // namespace pendular
