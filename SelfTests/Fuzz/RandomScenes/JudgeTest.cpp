// What the judge of random scenes must find, it finds: each of these scenes is spoilt on purpose.
#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Fuzz/RandomScenes/Judge.h"
#include "SelfTests/Fuzz/RandomScenes/Making.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::fuzz {
namespace {

using support::contains;
using support::refusal;

/// Grains that collide in empty space, without and with a box.
const Recipe loose = recipeFrom("seed=3 features=HertzianViscoelasticMindlin,Ledger,Grains steps=60");
const Recipe boxed = recipeFrom("seed=3 features=HertzianViscoelasticMindlin,Ledger,Grains,Planes steps=60");

/// Something that is done before the step that follows so many.
Verdict spoilt(const Recipe& recipe, std::function<void(Making&)> act, int steps = 5) {
    return judge(recipe, {.seconds = 3, .sabotage = [act, steps](Making& making) {
                              making.before(steps, [&making, act] { act(making); });
                          }});
}
GrainReference first(Making& making) { return *making.someGrain(0); }

TEST(Judge, findsNothingInAGoodScene) {
    for (const Recipe& recipe : {loose, boxed}) {
        const Verdict verdict = judge(recipe);
        EXPECT_EQ(verdict.end, "ended") << verdict.sentence;
        EXPECT_TRUE(verdict.faults.empty()) << verdict.faults.front();
        EXPECT_TRUE(contains(verdict.record, "radius="));
    }
}

TEST(Judge, findsMomentum) {
    const auto pushed = [](double share) {
        return [share](Making& making) {
            GrainReference grain = first(making);
            grain.setVelocity((1 + share) * grain.getVelocity());
        };
    };
    EXPECT_EQ(spoilt(loose, pushed(1e-9)).kind(), "momentum");
    EXPECT_EQ(spoilt(loose, pushed(0)).kind(), "");
}

TEST(Judge, findsAngularMomentum) {
    EXPECT_EQ(
        spoilt(loose,
               [](Making& making) {
                   GrainReference grain = first(making);
                   grain.setAngularVelocity(grain.getAngularVelocity() +
                                            Vec3D(0, 0, 1e-3 * making.scales.speed / making.scales.radius));
               })
            .kind(),
        "angular momentum");
}

/// The box that is looked at is smaller than that of the planes.
TEST(Judge, findsAGrainOutOfTheBox) {
    const Verdict verdict =
        judge(boxed, {.seconds = 3, .sabotage = [](Making& making) { making.highest = making.lowest; }});
    EXPECT_EQ(verdict.kind(), "out of the box");
}

TEST(Judge, findsACrashAndASceneWithoutEnd) {
    EXPECT_EQ(spoilt(loose, [](Making&) { std::raise(SIGKILL); }).kind(), "no end");
    EXPECT_EQ(spoilt(loose, [](Making&) { std::raise(SIGSEGV); }).kind(), "crash");
    EXPECT_EQ(spoilt(loose,
                     [](Making&) {
                         for (volatile bool goesOn = true; goesOn;) {}
                     })
                  .kind(),
              "no end");
}

TEST(Judge, findsOtherExceptionsAndBadSentences) {
    const auto ended = [](const std::string& sentence) {
        return spoilt(loose, [sentence](Making&) { throw RunError(sentence); });
    };
    EXPECT_EQ(spoilt(loose, [](Making&) { throw std::out_of_range("place"); }).kind(), "exception");
    EXPECT_EQ(ended("Two. Sentences.").kind(), "sentence");
    EXPECT_EQ(ended("the speed is nan m/s.").kind(), "sentence with a number that was not given");
    EXPECT_EQ(ended("it must be finite.").kind(), "");
    Recipe given = loose;
    given.wrong = {{"Grains", 0, std::numeric_limits<double>::infinity()}};
    const Verdict refused = judge(given);
    EXPECT_EQ(refused.end, "refused");
    EXPECT_TRUE(contains(refused.sentence, "inf"));
    EXPECT_EQ(refused.kind(), "");
}

TEST(Judge, findsBitsThatDependOnThreadsAndRestarts) {
    const auto nudge = [](Making& making) {
        GrainReference grain = first(making);
        grain.setVelocity(grain.getVelocity() * (1 + 1e-15));
    };
    // With an even seed the part before the restart has three threads. (Velocity allows a change by a hook.)
    const Recipe recipe = recipeFrom("seed=4 features=HertzianViscoelasticMindlin,Grains,Velocity steps=60");
    const Verdict threads = spoilt(
        recipe,
        [&](Making& making) {
            if (making.scene.getNumberOfThreads() == 3) nudge(making);
        },
        0);
    EXPECT_EQ(threads.kind(), "three threads");
    const Verdict restart = spoilt(
        recipe,
        [&](Making& making) {
            if (making.scene.isRestarted()) nudge(making);
        },
        Scales(recipe).restartStep);
    EXPECT_EQ(restart.kind(), "restart");
}

TEST(Minimiser, keepsWhatTheFaultNeeds) {
    Recipe recipe =
        recipeFrom("seed=5 features=Grains,Planes,Gravity,Clumps,Mesh,ParaView wrong=Planes#3:nan,Mesh#1:-1");
    const Recipe smallest = minimise(recipe, [](const Recipe& smaller) {
        return smaller.has("Gravity") && smaller.has("Mesh") && smaller.steps >= 30 &&
               std::ranges::any_of(smaller.wrong, [](const WrongValue& w) { return w.feature == "Mesh"; });
    });
    EXPECT_EQ(smallest.text(), "seed=5 features=Gravity,Mesh wrong=Mesh#1:-1 steps=32 grains=1");
    EXPECT_EQ(recipeFrom(smallest.text()), smallest);
}

TEST(Recipes, areTextAndBack) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Recipe recipe = recipeOf(seed);
        EXPECT_EQ(recipeFrom(recipe.text()).text(), recipe.text());  // nan is not equal to nan
        EXPECT_EQ(knownFaultOf(recipe), nullptr);
    }
    EXPECT_TRUE(contains(refusal([] { recipeFrom("seed=1 features=Grain"); }), "no feature 'Grain'"));
    EXPECT_TRUE(contains(refusal([] { recipeFrom("seed=x"); }), "'x' is no number"));
}

/// Each feature comes in some scene, so none is in the table for nothing.
TEST(Recipes, haveEachFeature) {
    std::map<std::string, int> count;
    for (std::uint64_t seed = 0; seed < 1500; ++seed)
        for (const std::string& name : recipeOf(seed).features) ++count[name];
    for (const Feature& feature : allFeatures())
        EXPECT_EQ(count[feature.name] > 0, feature.share > 0 || feature.is("material")) << feature.name;
}

}  // namespace
}  // namespace pendular::fuzz
