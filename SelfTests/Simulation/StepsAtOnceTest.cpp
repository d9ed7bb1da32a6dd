#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <thread>
#include <vector>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/SettlingBox.h"

// The end of a step may be done together with the start of the next. No bit may show it, whoever looks when.

namespace pendular::stepsAtOnceTest {
namespace {

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
using Smooth = Species<LinearViscoelastic>;

constexpr int layers = 10;  // 160 grains
constexpr std::size_t count = 400;

/// A hook that looks at the scene, or changes it, after each step.
template <class S>
struct Watched : scenes::SettlingBox<S> {
    Watched() : scenes::SettlingBox<S>(layers) { this->setQuiet(); }
    void actionsAfterTimeStep() override {
        if (hook) hook(*this);
    }
    std::function<void(Watched&)> hook;
    std::vector<double> seen;
};

template <class S>
std::uint64_t hashAtOnce(Watched<S>& scene) {
    scene.initialise();
    scene.step(count);
    return stateHash(scene.particleHandler.store());
}
template <class S>
std::uint64_t hashOneByOne(Watched<S>& scene) {
    scene.initialise();
    for (std::size_t k = 0; k < count; ++k) scene.step();
    return stateHash(scene.particleHandler.store());
}

template <class S>
class StepsAtOnce : public testing::Test {};
using Laws = testing::Types<Wet, Smooth>;
TYPED_TEST_SUITE(StepsAtOnce, Laws);

TYPED_TEST(StepsAtOnce, haveTheBitsOfThoseOneByOne) {
    Watched<TypeParam> oneByOne;
    const std::uint64_t expected = hashOneByOne(oneByOne);
    for (const int threads : {1, 2, 3}) {
        Watched<TypeParam> atOnce;
        atOnce.setNumberOfThreads(threads);
        EXPECT_EQ(hashAtOnce(atOnce), expected) << threads;
    }
}

TYPED_TEST(StepsAtOnce, haveTheBitsOfThoseOneByOneWithEveryIntegrator) {
    for (const Integrator& scheme : {integrators::velocityVerlet, integrators::adamsMoulton}) {
        Watched<TypeParam> oneByOne, atOnce;
        for (auto* scene : {&oneByOne, &atOnce}) scene->setIntegrator(scheme);
        EXPECT_EQ(hashAtOnce(atOnce), hashOneByOne(oneByOne)) << scheme.name;
    }
}

TYPED_TEST(StepsAtOnce, areFinishedWhereAHookLooks) {
    Watched<TypeParam> oneByOne, atOnce;
    for (auto* scene : {&oneByOne, &atOnce})
        scene->hook = [](auto& own) {
            if (own.getNumberOfTimeSteps() % 7 != 0) return;
            const auto grain = own.particleHandler.getObject(5);
            for (const Vec3D& v : {grain.getPosition(), grain.getVelocity(), grain.getForce(),
                                   grain.getAngularVelocity(), own.getTotalMomentum()})
                own.seen.insert(own.seen.end(), {v.x(), v.y(), v.z()});
        };
    EXPECT_EQ(hashAtOnce(atOnce), hashOneByOne(oneByOne));
    EXPECT_EQ(oneByOne.seen.size(), 15 * (count / 7));
    EXPECT_EQ(atOnce.seen, oneByOne.seen);
}

TYPED_TEST(StepsAtOnce, areFinishedBeforeAHookChangesWhatTheyDependOn) {
    using Scene = Watched<TypeParam>;
    const std::pair<const char*, std::function<void(Scene&)>> changes[] = {
        {"gravity",
         [](Scene& own) {
             own.setGravity({1, 0, -5});
         }},
        {"time step", [](Scene& own) { own.setTimeStep(0x1p-18); }},
        {"velocity",
         [](Scene& own) {
             own.particleHandler.getObject(3).setVelocity({0.1, 0, 0});
         }},
        {"held grain", [](Scene& own) { own.particleHandler.getObject(3).fixParticle(); }},
        {"removed grain", [](Scene& own) { own.particleHandler.removeObject(3); }},
        {"removed wall", [](Scene& own) { own.wallHandler.removeObject(1); }},
        {"density", [](Scene& own) { own.speciesHandler.getObject(0)->setDensity(3000); }},
        {"threads", [](Scene& own) { own.setNumberOfThreads(2); }},
    };
    for (const auto& [name, change] : changes) {
        Scene oneByOne, atOnce;
        for (Scene* scene : {&oneByOne, &atOnce})
            scene->hook = [&change = change](Scene& own) {
                if (own.getNumberOfTimeSteps() == count / 2) change(own);
            };
        EXPECT_EQ(hashAtOnce(atOnce), hashOneByOne(oneByOne)) << name;
    }
}

// Several threads of a hook that look at once see the same: one of them finishes the step, the others wait.
TYPED_TEST(StepsAtOnce, areFinishedForAllThreadsOfAHook) {
    Watched<TypeParam> scene;
    scene.hook = [](auto& own) {
        std::array<double, 4> sums{};
        const auto add = [&own](double& sum) {
            for (const TranslationRecord& grain : own.particleHandler.store().translation)
                sum += grain.velocity.z;
        };
        {
            std::vector<std::jthread> threads;
            for (double& sum : sums) threads.emplace_back([&add, &sum] { add(sum); });
        }
        for (const double sum : sums) EXPECT_EQ(sum, sums[0]);
    };
    scene.initialise();
    scene.step(count);
}

TYPED_TEST(StepsAtOnce, endWithWholeOnes) {
    Watched<TypeParam> scene;
    scene.initialise();
    const ParticleStore& kept = scene.particleHandler.store();  // as it is, without asking
    scene.step(count);
    const std::uint64_t hash = stateHash(kept);
    EXPECT_EQ(hash, stateHash(scene.particleHandler.store()));
}

}  // namespace
}  // namespace pendular::stepsAtOnceTest
