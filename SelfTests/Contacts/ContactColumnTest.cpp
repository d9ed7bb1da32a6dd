#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Numbers that a driver keeps of each contact.

namespace pendular::contactColumnTest {
namespace {

using support::contains;

using Dry = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

/// Settling grains whose contacts know their age, in the column and in a map of the test's own.
template <class S>
struct Ageing : scenes::SettlingBox<S> {
    explicit Ageing(int threads = 1) : scenes::SettlingBox<S>(5) { this->setNumberOfThreads(threads); }

    void actionsAfterTimeStep() override {
        std::map<Key, double> now;
        for (const ObservedContact& contact : this->interactions()) {
            const Key key{contact.particle1, contact.particle2, contact.wall};
            now[key] = (expected.contains(key) ? expected[key] : start) + this->getTimeStep();
            age[contact] += this->getTimeStep();
            force[contact] = contact.normalForce;
        }
        ended += expected.size();
        for (const auto& [key, value] : now) ended -= expected.count(key);
        expected.swap(now);
    }
    void steps(int count) {
        for (int k = 0; k < count; ++k) this->step();
    }

    using Key = std::tuple<std::uint32_t, std::uint32_t, int>;
    static constexpr double start = 0.25;  // s
    ContactColumnReference age = this->addContactColumn("age", "s", start);
    ContactColumnReference force = this->addContactColumn("force_before", "N");
    std::map<Key, double> expected;
    std::size_t ended = 0;
};

template <class S>
class ContactColumn : public testing::Test {};
using Both = testing::Types<Dry, Wet>;
TYPED_TEST_SUITE(ContactColumn, Both);

TYPED_TEST(ContactColumn, livesAsLongAsItsContact) {
    Ageing<TypeParam> scene(2);
    scene.initialise();
    scene.steps(2500);
    EXPECT_GT(scene.contacts().rebuildCount(), 10u);
    EXPECT_GT(scene.ended, 100u);
    ASSERT_GT(scene.expected.size(), 20u);
    std::size_t seen = 0;
    for (const ObservedContact& contact : scene.interactions()) {
        const typename Ageing<TypeParam>::Key key{contact.particle1, contact.particle2, contact.wall};
        if (!scene.expected.contains(key)) continue;
        EXPECT_EQ(scene.age[contact], scene.expected[key]);  // the same sums in the same order
        ++seen;
    }
    EXPECT_EQ(seen, scene.expected.size());
}

TYPED_TEST(ContactColumn, isInRestartsBitForBit) {
    const support::TestFolder folder;
    const auto file = [&](const char* name) { return folder.path() / name; };
    Ageing<TypeParam> whole;
    whole.initialise();
    whole.steps(600);
    whole.writeRestart(file("half.h5"));
    whole.steps(600);
    whole.writeRestart(file("whole.h5"));
    Ageing<TypeParam> resumed(3);
    resumed.restartFrom(file("half.h5"));
    resumed.initialise();
    resumed.writeRestart(file("again.h5"));
    support::expectSameState(file("half.h5"), file("again.h5"));
    resumed.steps(600);
    resumed.writeRestart(file("resumed.h5"));
    support::expectSameState(file("whole.h5"), file("resumed.h5"));
}

TEST(ContactColumns, areFieldsOfFrames) {
    Ageing<Dry> scene;
    scene.initialise();
    scene.steps(600);
    const PolyData lines =
        contactLines<double>(scene.contacts(), scene.particleHandler.store(), scene.laws());
    const PolyDataField *ages = lines.cellField("age_s"), *forces = lines.cellField("force_before_N");
    ASSERT_TRUE(ages && forces);
    ASSERT_EQ(ages->size(), scene.expected.size());
    EXPECT_EQ(forces->size(), ages->size());
    std::size_t k = 0;
    for (const ObservedContact& contact : scene.interactions()) EXPECT_EQ(ages->at(k++), scene.age[contact]);
}

TEST(ContactColumns, refuseWhatCannotBe) {
    Ageing<Dry> scene;
    const auto refusal = [&](const std::string& name, double initial) {
        return support::refusal([&] { scene.addContactColumn(name, "K", initial); });
    };
    EXPECT_TRUE(contains(refusal("age", 0), "a column 'age' of the contacts already"));
    EXPECT_TRUE(contains(refusal("an age", 0), "letters, digits and _ only"));
    EXPECT_TRUE(contains(refusal("heat", infinity), "starts at inf K; it must be finite"));
    for (int k = 2; k < 24; ++k) scene.addContactColumn(fmt::format("c{}", k), "");
    EXPECT_TRUE(contains(refusal("c24", 0), "is one too many; there can be 24"));
    scene.initialise();
    scene.steps(600);
    EXPECT_TRUE(contains(refusal("late", 0), "before the run starts"));
    const std::vector<ObservedContact> before = scene.interactions();
    ASSERT_FALSE(before.empty());
    scene.steps(1);
    scene.particleHandler.getObject(0).setRadius(scene.particleHandler.getObject(0).getRadius());
    scene.steps(1);  // contacts are listed again
    EXPECT_TRUE(contains(support::refusal([&] { scene.age[before[0]] = 1; }),
                         "was observed before contacts were listed again"));
}

}  // namespace
}  // namespace pendular::contactColumnTest
