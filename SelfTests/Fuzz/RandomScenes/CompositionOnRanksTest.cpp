// Each feature of a scene on several ranks: the same bits as on one, or a sentence that says that ranks
// cannot share it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Fuzz/RandomScenes/Composition.h"
#include "SelfTests/Fuzz/RandomScenes/RandomScene.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::fuzz {
namespace {

/// How a scene is run on ranks.
struct Manner {
    std::size_t count = 3;  // of ranks
    int threads = 1;
    RankOptions options = ranks::cutsWander;
    bool gathers = false;  // before hooks that change something
};

/// Makes the scene of a recipe, and calls use(scene).
template <class Use>
void withScene(const Recipe& recipe, const std::string& name, const Manner& manner, Use&& use) {
    const std::unique_ptr<RandomScene> made = sceneOf(recipe);
    made->gathers = manner.gathers;
    Scene& scene = made->scene();
    scene.setQuiet();
    scene.setName(name);
    scene.setNumberOfThreads(manner.threads);
    Making making(scene, made->species(), made->actions, recipe, 0);
    making.shapes = made->shapes();
    making.addAll();
    use(scene);
}

/// The sentence with which it ends; empty if it goes to its end.
template <class Function>
std::string endOf(Function&& run) {
    try {
        run();
    } catch (const InputError& refusal) {
        return refusal.what();
    } catch (const RunError& end) {
        return end.what();
    }
    return {};
}

/// Hooks that choose among the grains or bodies that they find: those of all ranks, after gather().
bool chooses(const Recipe& recipe) {
    return std::ranges::any_of(recipe.features, [](const std::string& name) {
        return name == "JoinInRun" || name == "BodyChange" || name == "Remove";
    });
}

/// A scene on one rank, with which others are compared.
struct Alone {
    explicit Alone(const Recipe& of) : recipe(of) {
        end = endOf([&] {
            withScene(recipe, folder.name(), {}, [&](Scene& scene) {
                scene.initialise();
                scene.step(steps());
                told = ranks::toldBy(scene);
                hash = ranks::hashOf(scene.particleHandler.store());
            });
        });
    }
    [[nodiscard]] std::size_t steps() const { return static_cast<std::size_t>(recipe.steps); }

    support::TestFolder folder;
    Recipe recipe;
    std::string end;  // the sentence; empty: it went to its end
    std::vector<double> told;
    std::uint64_t hash = 0;
};

/// What becomes of a scene on several ranks: it has the same bits, also because its hooks call gather(); it
/// is refused for them; or it ends as it does on one rank.
enum class Fate { Shared, SharedIfGathered, Refused, EndsAlike };

Fate judgeOnRanks(const Alone& alone, Manner manner) {
    manner.gathers |= chooses(alone.recipe);
    ranks::Outcome found;
    const std::string end = endOf([&] {
        found = ranks::runOnRanks(manner.count, manner.options, alone.steps(), [&](auto&& use) {
            withScene(alone.recipe, alone.folder.name(), manner, use);
        });
    });
    SCOPED_TRACE(fmt::format("{}: {} ranks of {} threads, cuts {}{}", fmt::join(alone.recipe.features, ", "),
                             manner.count, manner.threads, manner.options.cutsWander ? "wander" : "stay",
                             manner.gathers ? ", gathered" : ""));
    if (!end.empty() && end == alone.end) return Fate::EndsAlike;
    if (!manner.gathers && support::contains(end, "after gather() only")) {
        manner.gathers = true;
        return judgeOnRanks(alone, manner);
    }
    if (!end.empty()) {
        EXPECT_TRUE(support::contains(end, "ranks") || support::contains(end, "another rank"))
            << end << "\n(on one rank: " << alone.end << ")";
        return Fate::Refused;
    }
    EXPECT_EQ(alone.end, "");
    EXPECT_EQ(found.hash, alone.hash);
    EXPECT_EQ(found.told, alone.told);
    EXPECT_TRUE(found.tellTheSame);
    EXPECT_EQ(found.counts.unequal, 0u);
    return manner.gathers ? Fate::SharedIfGathered : Fate::Shared;
}

Recipe recipeFor(std::span<const std::string_view> names, int steps = 80) {
    Recipe recipe = recipeWith(names, 1);
    recipe.steps = steps;
    return recipe;
}

// What is refused today may be shared one day, but what is shared today stays so.
TEST(CompositionOnRanks, ofEachFeature) {
    std::array<std::vector<std::string_view>, 4> names;
    for (const std::string_view name : composedFeatures()) {
        const Alone alone(recipeFor(std::array{name}));
        const Fate fates[]{judgeOnRanks(alone, {.options = ranks::cutsStay}), judgeOnRanks(alone, {})};
        names[static_cast<std::size_t>(std::max(fates[0], fates[1]))].push_back(name);
    }
    fmt::print("shared: {}; after gather(): {}; refused: {}; ended as on one rank: {}\n", names[0].size(),
               fmt::join(names[1], ", "), fmt::join(names[2], ", "), fmt::join(names[3], ", "));
    EXPECT_GE(names[0].size(), 60u);
    EXPECT_GE(names[0].size() + names[1].size(), 68u);
}

/// Of all numbers of ranks and threads, over so many steps that contacts are listed again.
TEST(LongCompositionOnRanks, ofEachFeatureOnAnyNumber) {
    for (const std::string_view name : composedFeatures()) {
        const Alone alone(recipeFor(std::array{name}, 1000));
        for (const std::size_t count : {1u, 2u, 3u, 4u, 7u})
            for (const int threads : {1, 2}) judgeOnRanks(alone, {.count = count, .threads = threads});
    }
}

TEST(LongCompositionOnRanks, ofEachTwoFeatures) {
    const std::span<const std::string_view> all = composedFeatures();
    std::array<int, 4> counts{};
    for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = a + 1; b < all.size(); ++b)
            if (whyNoPair(all[a], all[b]).empty())
                ++counts[static_cast<std::size_t>(
                    judgeOnRanks(Alone(recipeFor(std::array{all[a], all[b]})), {}))];
    fmt::print("pairs: {} are shared, {} after gather(), {} are refused on several ranks, {} end as on one\n",
               counts[0], counts[1], counts[2], counts[3]);
    EXPECT_GT(counts[0] + counts[1], 1500);
    EXPECT_EQ(counts[2], 0);
}

}  // namespace
}  // namespace pendular::fuzz
