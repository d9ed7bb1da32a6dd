#include "Kernel/Core/Contacts/ContactRecall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/RememberedContacts.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"

namespace pendular::contactRecallTest {
namespace {

using Dry = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // place of body 1, wall + 1, other

/// A box in which grains fall onto each other, some steps after its last list.
template <class S>
class ContactRecallOf : public testing::Test {
protected:
    ContactRecallOf() {
        box.initialise();
        for (int n = 0; n < 1500; ++n) box.step();
        const std::size_t lists = contacts().rebuildCount();
        while (contacts().rebuildCount() == lists) box.step();
        for (int n = 0; n < 10; ++n) box.step();
    }
    [[nodiscard]] const ContactSystem& contacts() const { return box.contacts(); }
    [[nodiscard]] const ContactStore& store() const { return contacts().store(); }
    [[nodiscard]] const ParticleStore& grains() const { return box.particleHandler.store(); }

    /// What acts, with its place in the memory.
    [[nodiscard]] std::map<Key, std::size_t> acting() const {
        std::map<Key, std::size_t> found;
        store().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            if (!store().acts(contact)) return;
            const std::uint32_t second = store().secondOf(contact);
            const std::uint32_t other = bucket.wall < 0 ? grains().identity[second] : second;
            found[{store().firstOf(contact), static_cast<std::uint32_t>(bucket.wall + 1), other}] =
                store().slotOf(contact);
        });
        return found;
    }

    [[nodiscard]] ContactStore copyOfList() const {
        ContactStore copy;
        copyListInto(copy);
        copy.memory = store().memory;
        return copy;
    }
    void copyListInto(ContactStore& copy) const {
        copy.buckets = store().buckets;
        copy.blocks = store().blocks;
        copy.states = store().states;
        copy.slots = store().slots;
        copy.gaps = store().gaps;
        copy.wallPoints = store().wallPoints;
    }

    /// Recalls what acts into a new list, and returns its slots, states and numbers.
    [[nodiscard]] auto recalled(double apart, int threads = 1) const {
        RememberedContacts old;
        old.take(store(), grains().identity, threads);
        ContactStore fresh = copyOfList();
        fresh.slots.assign(fresh.blockCount(), ContactStore::asleep);
        for (BlockState& state : fresh.states) state = {.listed = state.listed};
        std::vector<std::uint32_t> same(grains().size());
        std::iota(same.begin(), same.end(), 0u);
        const ContactRecall recall(contacts().laws(), grains(), same, threads, true);
        EXPECT_EQ(recall.into(fresh, old, apart), old.size());
        std::vector<double> numbers(fresh.memory.slotCount() * fresh.memory.numberCount());
        for (std::size_t slot = 0; slot < fresh.memory.slotCount(); ++slot)
            fresh.memory.getNumbers(slot, &numbers[slot * fresh.memory.numberCount()]);
        return std::tuple(fresh.slots, fresh.states, fresh.memory.blockOf, numbers);
    }

    scenes::SettlingBox<S> box{6};
};
using AllSpecies = testing::Types<Dry, Wet>;
TYPED_TEST_SUITE(ContactRecallOf, AllSpecies);

// Each contact that acts is filed once, under its first body, in the order of walls and others.
TYPED_TEST(ContactRecallOf, takesWhatActsInTheOrderOfItsPartners) {
    const std::map<Key, std::size_t> expected = this->acting();
    EXPECT_GT(expected.size(), 50u);
    for (const int threads : {1, 3}) {
        RememberedContacts taken;
        taken.take(this->store(), this->grains().identity, threads);
        EXPECT_EQ(taken.size(), expected.size());
        auto next = expected.begin();
        std::uint32_t number = 0;
        for (std::uint32_t place = 0; place < this->grains().size(); ++place)
            for (const RememberedContacts::Entry& entry : taken.of(place)) {
                ASSERT_NE(next, expected.end());
                EXPECT_EQ(Key(place, entry.wall, entry.other), next->first);
                EXPECT_EQ(entry.owner, this->grains().identity[place]);
                EXPECT_EQ(taken.slotOf(number), next->second);
                EXPECT_EQ(taken.find(place, entry.wall, entry.other), number++);
                ++next;
            }
    }
}

// Whatever is looked up first, the same contacts are found.
TYPED_TEST(ContactRecallOf, findsTheSameWhereverItLooksFirst) {
    const auto all = this->recalled(infinity);
    const double r = this->box.smallRadius;
    for (const double apart : {-r, -1e-4 * r, 0.0, 1e-6 * r, 1e-3 * r, 0.1 * r})
        EXPECT_TRUE(this->recalled(apart) == all) << apart;
    EXPECT_TRUE(this->recalled(1e-3 * r, 3) == all);
}

// The contacts of one grain that are found among all are those of the whole list, in the same order; where
// many are looked up, the list is made.
TYPED_TEST(ContactRecallOf, findsTheContactsOfOneGrainAmongAll) {
    const auto& identities = this->grains().identity;
    ContactStore whole = this->copyOfList(), searched = this->copyOfList();
    for (ContactStore* each : {&whole, &searched}) each->beginSides(identities, 1);
    std::size_t withMemory = 0;
    for (std::uint32_t place = 0; place < 40; ++place) {
        const ContactStore::OwnSides own = searched.ownSidesOf(place);
        EXPECT_EQ(searched.sides.areMade(), place >= 32);
        EXPECT_TRUE(std::ranges::equal(own.withMemory, whole.sidesOf(place))) << place;
        EXPECT_TRUE(std::ranges::is_permutation(own.asleep, whole.asleepSidesOf(place))) << place;
        withMemory += own.withMemory.size();
    }
    EXPECT_GT(withMemory, 40u);
}

// Contacts with memory come in the order of their partners, and the others once each.
TYPED_TEST(ContactRecallOf, listsSidesInTheOrderOfTheirPartners) {
    for (const int threads : {1, 3}) {
        ContactStore fresh = this->copyOfList();
        fresh.beginSides(this->grains().identity, 1);
        (void)fresh.sidesOf(0);
        // Those of the last list were asked for: they are made at once, by all threads.
        fresh.releaseList();
        this->copyListInto(fresh);
        fresh.beginSides(this->grains().identity, threads);
        ASSERT_TRUE(fresh.sides.areMade());
        std::size_t count = 0;
        for (std::uint32_t place = 0; place < this->grains().size(); ++place) {
            const auto awake = fresh.sidesOf(place), asleep = fresh.asleepSidesOf(place);
            EXPECT_TRUE(std::ranges::is_sorted(awake, {}, [&](std::uint32_t side) {
                return fresh.keyOf(fresh.contactAt(side / 2), side % 2, this->grains().identity);
            }));
            const std::set<std::uint32_t> others(asleep.begin(), asleep.end());
            EXPECT_EQ(others.size(), asleep.size());
            for (const std::uint32_t side : asleep)
                EXPECT_EQ(fresh.slots[side / 2 / Pack::lanes], ContactStore::asleep);
            count += awake.size() + asleep.size();
        }
        std::size_t expected = 0;
        fresh.forEachListed(
            [&](const Bucket& bucket, std::uint32_t) { expected += bucket.wall < 0 ? 2 : 1; });
        EXPECT_EQ(count, expected);
    }
}

}  // namespace
}  // namespace pendular::contactRecallTest
