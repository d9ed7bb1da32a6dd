#include <gtest/gtest.h>

#include <type_traits>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ParticleSum.h"
#include "Kernel/Core/Contacts/SpeciesLaws.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "SelfTests/Support/EveryLaw.h"

// A scene pays, in time and in memory, only for the physics in it.

namespace pendular::noCostTest {
namespace {

using Dry = Species<HertzianViscoelastic>;
using Rough = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<HertzianViscoelastic, NoFriction, LiquidBridgeBagheri>;
using RoughAndWet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

template <class S>
inline constexpr std::size_t historyColumns = layoutOf<S>.history;
template <class S>
inline constexpr std::size_t interactionColumns = layoutOf<S>.interaction;
template <class S>
inline constexpr std::size_t bytesPerContact = ContactStore::bytesPerContact(layoutOf<S>);
template <class T>
concept HasTorque = requires(T sum) {
    sum.torque;
};

// Memory of a contact.
static_assert(historyColumns<Dry> == 0 && interactionColumns<Dry> == 0);
static_assert(historyColumns<Wet> == 0 && interactionColumns<Wet> == 6);
static_assert(historyColumns<Rough> == 3 && interactionColumns<Rough> == 0);
static_assert(historyColumns<RoughAndWet> == 3 && interactionColumns<RoughAndWet> == 6);
static_assert(interactionColumns<Species<LinearViscoelastic, NoFriction, LiquidBridgeWillett>> == 3);

// Only laws that depend on the past, and those with a torque of their own, have memory for it.
using Plastic = Species<LinearPlasticViscoelastic>;
using Rolling = Species<HertzianViscoelastic, MindlinRollingTorsion>;
template <class S>
inline constexpr std::size_t normalHistoryColumns = layoutOf<S>.normalHistory;
static_assert(normalHistoryColumns<RoughAndWet> == 0 && normalHistoryColumns<Plastic> == 1);
static_assert(historyColumns<Plastic> == 0 && historyColumns<Rolling> == 8);
static_assert(historyColumns<Species<LinearViscoelastic, SlidingFriction>> == 4);
static_assert(historyColumns<Species<HertzianViscoelastic, MindlinIncremental>> == 4);
static_assert(historyColumns<Species<HertzianViscoelastic, MindlinIncrementalRollingTorsion>> == 9);
static_assert(!RoughAndWet::hasContactTorque && !Plastic::hasContactTorque && Rolling::hasContactTorque);
static_assert(!layoutOf<Plastic>.hasTorque && layoutOf<Rolling>.hasTorque);
static_assert(bytesPerContact<Rolling> == bytesPerContact<Rough> + sizeof(TorqueRecord) + 5 * sizeof(double));

// What a contact gives to its bodies.
static_assert(!Dry::hasTorque && !Wet::hasTorque && Rough::hasTorque && RoughAndWet::hasTorque);
static_assert(!layoutOf<Dry>.hasTorque);
static_assert(!layoutOf<Wet>.hasTorque);
static_assert(layoutOf<Rough>.hasTorque);
static_assert(sizeof(ForceRecord) == 32 && sizeof(ForceTorqueRecord) == 64);

// What a grain sums.
static_assert(!HasTorque<ForceAndTorque<false>> && HasTorque<ForceAndTorque<true>>);
static_assert(sizeof(ForceAndTorque<false>) == sizeof(Four) &&
              sizeof(ForceAndTorque<true>) == 2 * sizeof(Four));

// A law that does nothing has no size; a species is no larger than the numbers of its laws.
static_assert(std::is_empty_v<NoFriction> && std::is_empty_v<NoAdhesion>);
static_assert(sizeof(Dry::Mixed) == sizeof(HertzianViscoelastic));
static_assert(sizeof(RoughAndWet::Mixed) ==
              sizeof(HertzianViscoelastic) + sizeof(Mindlin) + sizeof(LiquidBridgeBagheri));
static_assert(!std::is_polymorphic_v<RoughAndWet>);

// Memory is trivially copied; blocks of it are arrays of packs.
static_assert(std::is_trivially_copyable_v<TangentialSpring<Pack>>);
static_assert(std::is_trivially_copyable_v<LiquidBridgeBagheri::Interaction<Pack>>);
static_assert(sizeof(LiquidBridgeBagheri::Interaction<Pack>) == 6 * sizeof(Pack));

// Bytes: places 8, state, slot and gap 16 a block; record 32 or 64; two sides 8; memory 8 for each number.
static_assert(bytesPerContact<Dry> <= 10 + 32 + 8);
static_assert(bytesPerContact<Rough> <= 10 + 64 + 8 + 3 * 8);
static_assert(bytesPerContact<Wet> <= 10 + 32 + 8 + 6 * 8);
// Without friction, half the memory of a contact with it.
static_assert(2 * bytesPerContact<Dry> <= bytesPerContact<Rough>);

template <class S>
ContactMemory memoryOf() {
    ContactMemory memory;
    memory.setLayout(layoutOf<S>);
    return memory;
}

TEST(NoCost, absentLawsHaveNoColumns) {
    ContactMemory dry = memoryOf<Dry>();
    dry.history.resize(100);
    dry.interaction.resize(100);
    EXPECT_TRUE(dry.history.columns.empty());
    EXPECT_TRUE(dry.interaction.columns.empty());

    ContactMemory full = memoryOf<RoughAndWet>();
    full.history.resize(100);
    full.interaction.resize(100);
    EXPECT_EQ(full.history.columns.size(), 300u);
    EXPECT_EQ(full.interaction.columns.size(), 600u);
}

TEST(NoCost, grainsWithoutSpinHaveNoRotation) {
    ParticleStore smooth, spinning;
    spinning.hasSpin = true;
    const TranslationRecord grain{{0, 0, 0}, 1e-3, {0, 0, 0}, 1e5};
    for (int k = 0; k < 4; ++k) {
        smooth.add(grain, {1, 2, 3}, 0);
        spinning.add(grain, {1, 2, 3}, 0);
    }
    smooth.reorder({3, 1, 2, 0});
    spinning.reorder({3, 1, 2, 0});
    EXPECT_EQ(smooth.size(), 4u);
    EXPECT_EQ(smooth.rotation.capacity(), 0u);
    EXPECT_EQ(spinning.rotation.size(), 4u);
}

TEST(NoCost, torquesOfContactsAreKeptForLawsThatHaveThem) {
    ContactMemory smooth = memoryOf<Wet>(), rough = memoryOf<Rough>(), rolling = memoryOf<Rolling>();
    for (int k = 0; k < 3; ++k) smooth.add(0), rough.add(0), rolling.add(0);
    EXPECT_EQ(smooth.records.columns.capacity(), 0u);
    EXPECT_EQ(rough.forces.capacity(), 0u);
    EXPECT_EQ(rough.torques.capacity(), 0u);
    EXPECT_EQ(rolling.torques.size() * RecordColumns::numbers, rolling.records.columns.size() * Pack::lanes);
}

TEST(NoCost, everySpeciesHasTheMemoryOfItsLawsAndNoMore) {
    support::forSpeciesWithEveryLaw([]<class S>() {
        using F = typename S::Friction;
        using A = typename S::Adhesion;
        static_assert(S::hasTorque == (F::acts || bridgeResists<A> >= BridgeResists::Sliding));
        EXPECT_EQ(historyColumns<S> > 0, F::acts) << S::name;
        EXPECT_EQ(interactionColumns<S> > 0, A::acts) << S::name;
    });
}

}  // namespace
}  // namespace pendular::noCostTest
