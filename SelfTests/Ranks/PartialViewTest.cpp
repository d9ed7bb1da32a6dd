// What a hook finds of a scene on several ranks is all of it, or it is refused: no part looks like the whole.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <mutex>
#include <optional>
#include <set>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "Tools/Reference/VirtualRanks.h"

namespace pendular::partialViewTest {
namespace {

using ranks::cutsWander;
using support::contains;
using support::refusal;
using Wet = HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies;
constexpr std::size_t grainCount = 64, hookStep = 900;

/// A bed with a hook.
class HookedBox : public scenes::SettlingBox<Wet> {
public:
    using Hook = std::function<void(HookedBox&)>;
    explicit HookedBox(Hook function) : SettlingBox(4), hook(std::move(function)) {
        setQuiet();
        listenToContacts();
    }
    std::vector<ContactEvent> heard;

private:
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() == hookStep) hook(*this);
    }
    void actionsOnContactEvent(const ContactEvent& event) override { heard.push_back(event); }

    Hook hook;
};

/// Calls look(scene) in a hook of the last step of a scene on so many ranks, on each of them; 1: without.
void inHookOn(std::size_t count, const HookedBox::Hook& look) {
    std::size_t looked = 0;
    std::mutex mutex;
    const auto run = [&](Exchange* exchange) {
        HookedBox scene([&](HookedBox& of) {
            look(of);
            const std::lock_guard lock(mutex);
            ++looked;
        });
        if (exchange) scene.setRanks(*exchange, cutsWander);
        scene.initialise();
        scene.step(hookStep);
    };
    if (count == 1) run(nullptr);
    else VirtualRanks(count).run([&](Exchange& exchange) { run(&exchange); });
    EXPECT_EQ(looked, count);
}

struct Call {
    std::string name;
    std::function<void(HookedBox&)> call;
};
const std::vector<Call>& callsThatNeedAll() {
    static const std::vector<Call> calls{
        {"a loop over particleHandler",
         [](HookedBox& s) {
             for (const GrainReference grain : s.particleHandler) static_cast<void>(grain.getMass());
         }},
        {"getLastObject()", [](HookedBox& s) { static_cast<void>(s.particleHandler.getLastObject()); }},
        {"getSmallestParticle()",
         [](HookedBox& s) { static_cast<void>(s.particleHandler.getSmallestParticle()); }},
        {"getLargestParticle()",
         [](HookedBox& s) { static_cast<void>(s.particleHandler.getLargestParticle()); }},
        {"interactions()", [](HookedBox& s) { static_cast<void>(s.interactions()); }},
        {"bodyHandler.getSize()", [](HookedBox& s) { static_cast<void>(s.bodyHandler.getSize()); }},
    };
    return calls;
}

TEST(PartialView, isRefusedInAHook) {
    for (const std::size_t count : {2u, 3u})
        inHookOn(count, [](HookedBox& scene) {
            for (const auto& [name, call] : callsThatNeedAll()) {
                const std::string told = refusal([&] { call(scene); });
                EXPECT_TRUE(contains(told, name + " needs all grains")) << name << ": " << told;
                EXPECT_TRUE(contains(told, "gather()")) << told;
                EXPECT_TRUE(support::isOneSentence(told)) << told;
            }
        });
}

TEST(PartialView, isWholeOnOneRankAndAfterGather) {
    for (const std::size_t count : {1u, 3u})
        inHookOn(count, [](HookedBox& scene) {
            scene.gather();
            for (const auto& [name, call] : callsThatNeedAll())
                EXPECT_EQ(refusal([&] { call(scene); }), "") << name;
            std::size_t seen = 0;
            for (const GrainReference grain : scene.particleHandler) seen += grain.getRadius() > 0;
            EXPECT_EQ(seen, grainCount);
            EXPECT_EQ(scene.particleHandler.ownGrains().size(), grainCount);
        });
}

/// The grains of a rank are those of no other one, and together they are all.
TEST(PartialView, ownGrainsAreEachOnOneRank) {
    std::multiset<std::uint32_t> found;
    std::mutex mutex;
    inHookOn(3, [&](HookedBox& scene) {
        const std::lock_guard lock(mutex);
        EXPECT_LT(scene.particleHandler.ownGrains().size(), grainCount);
        for (const GrainReference grain : scene.particleHandler.ownGrains()) found.insert(grain.getId());
    });
    EXPECT_EQ(found.size(), grainCount);
    EXPECT_EQ(std::set(found.begin(), found.end()).size(), grainCount);
}

/// What a hook can ask of the scene as a whole.
struct Told {
    std::size_t size, acting, touching;
    Vec3D moment, force;                  // sums over grains
    std::array<double, 2> contacts;       // sums over contacts: of forces between grains, and how many
    std::array<std::uint64_t, 4> counts;  // of events
    std::vector<ContactEvent> events, heard;
    double stableStep;

    friend bool operator==(const Told&, const Told&) = default;
};
Told toldBy(HookedBox& scene) {
    const ContactCounts contacts = scene.contacts().counts();
    const ContactEventCounts counts = scene.contactEventCounts();
    return {
        .size = scene.particleHandler.getSize(),
        .acting = contacts.acting,
        .touching = contacts.touching,
        .moment = sumOverGrains(
            scene, [](const GrainReference& g) -> Vec3D { return g.getMass() * g.getPosition(); }),
        .force =
            sumOverGrains(scene, [&](const GrainReference& g) { return scene.contactForceOn(g.getId()); }),
        .contacts = sumOverInteractions(scene,
                                        [](const ObservedContact& c) {
                                            return std::array{c.wall < 0 ? c.normalForce : 0.0, 1.0};
                                        }),
        .counts = {counts.touchesBegun, counts.touchesEnded, counts.bridgesFormed, counts.bridgesRuptured},
        .events = scene.contactEvents(),
        .heard = scene.heard,
        .stableStep = scene.stableStepOfContacts()};
}

TEST(PartialView, sumsCountsAndEventsHaveTheBitsOfOneRank) {
    std::optional<Told> alone;
    inHookOn(1, [&](HookedBox& scene) {
        alone = toldBy(scene);
        // By brute force: the exact sums, rounded once, are those of loops up to the rounding of these.
        double moment = 0;
        for (const GrainReference grain : scene.particleHandler)
            moment += grain.getMass() * grain.getPosition().z();
        EXPECT_NEAR(alone->moment.z(), moment, 1e-13 * moment);  // 64 roundings, 7e-15 at most
        const std::size_t contacts = scene.interactions().size();
        EXPECT_EQ(alone->contacts[1], static_cast<double>(contacts));
        EXPECT_EQ(alone->acting, contacts);
    });
    EXPECT_EQ(alone->size, grainCount);
    EXPECT_GT(alone->contacts[0], 0);
    EXPECT_GT(alone->heard.size(), 50u);
    for (const std::size_t count : {2u, 3u, 7u})
        inHookOn(count, [&](HookedBox& scene) {
            const Told told = toldBy(scene);
            EXPECT_TRUE(told == *alone) << count << " ranks";
            EXPECT_EQ(told.heard.size(), alone->heard.size());
            EXPECT_EQ(told.acting, alone->acting);
        });
}

/// A loop that changes each grain by itself needs no others.
TEST(PartialView, aHookMayChangeEachOfItsGrains) {
    const auto hashOn = [](std::size_t count) {
        std::uint64_t hash = 0;
        std::mutex mutex;
        const auto run = [&](Exchange* exchange) {
            HookedBox scene([](HookedBox& s) {
                for (GrainReference grain : s.particleHandler.ownGrains())
                    grain.setVelocity(0.9 * grain.getVelocity());
            });
            if (exchange) scene.setRanks(*exchange, cutsWander);
            scene.initialise();
            scene.step(hookStep + 100);
            scene.gather();
            const std::lock_guard lock(mutex);
            hash = stateHash(scene.particleHandler.store());
        };
        if (count == 1) run(nullptr);
        else VirtualRanks(count).run([&](Exchange& exchange) { run(&exchange); });
        return hash;
    };
    EXPECT_EQ(hashOn(2), hashOn(1));
    EXPECT_EQ(hashOn(3), hashOn(1));
}

}  // namespace
}  // namespace pendular::partialViewTest
