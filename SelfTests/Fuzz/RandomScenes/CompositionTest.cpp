// Each two features of a scene go together, or are refused with a sentence of the table of conflicts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "SelfTests/Fuzz/RandomScenes/Composition.h"
#include "SelfTests/Support/Random.h"

namespace pendular::fuzz {
namespace {

/// Returns whether the scene came to its end.
bool judgeOne(std::span<const std::string_view> names, std::uint64_t seed) {
    const Recipe recipe = recipeWith(names, seed);
    const Verdict verdict = judgeComposition(recipe);
    if (!verdict.faults.empty())
        ADD_FAILURE() << fmt::format("{}:\n{}", fmt::join(names, " and "), report(recipe, verdict));
    return verdict.end == "ended";
}

class HeavyComposition : public testing::TestWithParam<std::size_t> {};

TEST_P(HeavyComposition, ofEachWithTheLaterOnes) {
    const std::span<const std::string_view> all = composedFeatures();
    int pairs = 0, ended = 0;
    for (std::size_t other = GetParam() + 1; other < all.size(); ++other) {
        if (!whyNoPair(all[GetParam()], all[other]).empty()) continue;
        ++pairs;
        ended += judgeOne(std::array{all[GetParam()], all[other]}, 1) ? 1 : 0;
    }
    // A feature that is refused with nearly all others is not tested.
    EXPECT_GE(4 * ended, pairs);
}

INSTANTIATE_TEST_SUITE_P(Pairs, HeavyComposition, testing::Range<std::size_t>(0, composedFeatures().size()),
                         [](const auto& feature) { return std::string(composedFeatures()[feature.param]); });

constexpr std::array<std::string_view, 5> lawsOfShapes{
    "HertzianViscoelasticMindlinJKR", "HertzianViscoelasticDMT", "HertzianViscoelasticReversibleAdhesive",
    "HertzianViscoelasticIrreversibleAdhesive", "HertzianViscoelasticMindlinLiquidBridgeWillett"};

/// Superquadrics that adhere with each of the others. @param lawOf (number of the scene) its laws
template <class Function>
void judgeShapesWithEach(Function&& lawOf) {
    int scenes = 0, ended = 0;
    for (const std::string_view other : composedFeatures()) {
        const std::array names{std::string_view(lawOf(scenes)), std::string_view("Superquadrics"), other};
        if (!whyNotTogether(names).empty()) continue;
        ++scenes;
        ended += judgeOne(names, 1) ? 1 : 0;
    }
    EXPECT_GE(4 * ended, 3 * scenes);
}

/// By one law of adhesion after the other.
TEST(LongCompositionOfShapesThatAdhere, withEach) {
    judgeShapesWithEach(
        [](int scene) { return lawsOfShapes[static_cast<std::size_t>(scene) % lawsOfShapes.size()]; });
}
TEST(LongCompositionOfShapesThatAdhere, eachLawWithEach) {
    for (const std::string_view law : lawsOfShapes) judgeShapesWithEach([&](int) { return law; });
}

/// Triples at random; each failure names its seed and its recipe.
void judgeTriples(std::uint64_t first, std::uint64_t count) {
    const std::span<const std::string_view> all = composedFeatures();
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        support::Random random(seed);
        std::array<std::string_view, 3> names;
        for (std::size_t k = 0; k < 3; ++k) do
                names[k] =
                    all[static_cast<std::size_t>(random.uniform(0, 1) * static_cast<double>(all.size()))];
            while (!whyNotTogether(std::span(names).first(k + 1)).empty());
        SCOPED_TRACE(fmt::format("triple of the seed {}", seed));
        judgeOne(names, seed);
    }
}

TEST(HeavyCompositionOfThree, atRandom) { judgeTriples(1, 100); }
TEST(LongCompositionOfThree, atRandom) { judgeTriples(1000, 3000); }

}  // namespace
}  // namespace pendular::fuzz
