// Each feature of a scene on several ranks: the same bits as on one, or a sentence that says that ranks
// cannot share it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "Kernel/Base/RunError.h"
#include "SelfTests/Fuzz/RandomScenes/Composition.h"
#include "SelfTests/Fuzz/RandomScenes/RandomScene.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::fuzz {
namespace {

constexpr std::size_t steps = 80;

/// Makes the scene of a recipe, and calls use(scene).
template <class Use>
void withScene(const Recipe& recipe, const std::string& name, Use&& use) {
    const std::unique_ptr<RandomScene> made = sceneOf(recipe);
    Scene& scene = made->scene();
    scene.setQuiet();
    scene.setName(name);
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

/// Features whose hooks look at what one rank has: another scene on each number of ranks.
constexpr std::array<std::string_view, 2> ofOneRank{"JoinInRun", "BodyChange"};

bool isOfOneRank(std::string_view name) { return std::ranges::find(ofOneRank, name) != ofOneRank.end(); }

/// Returns whether the scene has the same bits on three ranks.
bool judgeOnRanks(std::span<const std::string_view> names, const RankOptions& options) {
    const support::TestFolder folder;
    const Recipe recipe = recipeWith(names, 1);
    std::uint64_t expected = 0;
    std::vector<double> told;
    const std::string ofOne = endOf([&] {
        withScene(recipe, folder.name(), [&](Scene& scene) {
            scene.initialise();
            scene.step(steps);
            told = ranks::toldBy(scene);
            expected = ranks::hashOf(scene.particleHandler.store());
        });
    });
    ranks::Outcome found;
    const std::string ofThree = endOf([&] {
        found =
            ranks::runOnRanks(3, options, steps, [&](auto&& use) { withScene(recipe, folder.name(), use); });
    });
    SCOPED_TRACE(
        fmt::format("{}, cuts {}", fmt::join(names, " and "), options.cutsWander ? "wander" : "stay"));
    if (!ofThree.empty()) {
        EXPECT_TRUE(support::contains(ofThree, "ranks") || support::contains(ofThree, "another rank") ||
                    ofThree == ofOne)
            << ofThree << "\n(on one rank: " << ofOne << ")";
        return false;
    }
    EXPECT_EQ(ofOne, "");
    EXPECT_EQ(found.hash, expected);
    EXPECT_EQ(found.told, told);
    EXPECT_TRUE(found.tellTheSame);
    EXPECT_EQ(found.counts.unequal, 0u);
    return true;
}

// What is refused today may be shared one day, but what is shared today stays so.
TEST(CompositionOnRanks, ofEachFeature) {
    std::vector<std::string_view> shared;
    for (const std::string_view name : composedFeatures())
        for (const RankOptions& options : {ranks::cutsStay, ranks::cutsWander})
            if (!isOfOneRank(name) && judgeOnRanks(std::array{name}, options) && options.cutsWander)
                shared.push_back(name);
    RecordProperty("shared", fmt::format("{}", fmt::join(shared, ", ")));
    EXPECT_GE(shared.size(), 56u);
}

TEST(LongCompositionOnRanks, ofEachTwoFeatures) {
    const std::span<const std::string_view> all = composedFeatures();
    for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = a + 1; b < all.size(); ++b)
            if (!isOfOneRank(all[a]) && !isOfOneRank(all[b]) && whyNoPair(all[a], all[b]).empty())
                judgeOnRanks(std::array{all[a], all[b]}, ranks::cutsWander);
}

}  // namespace
}  // namespace pendular::fuzz
