// Random scenes hold what must hold. The README of SelfTests/Fuzz says how to run one again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>

#include "Kernel/Foundation/Base/InputError.h"
#include "SelfTests/Fuzz/RandomScenes/Composition.h"
#include "SelfTests/Fuzz/RandomScenes/Feature.h"
#include "SelfTests/Fuzz/RandomScenes/Judge.h"

namespace pendular::fuzz {
namespace {

/// Some seeds, as one test, so that tests run beside each other and each of them ends in some seconds.
struct Seeds {
    std::uint64_t first, count;
};
std::string nameOf(const testing::TestParamInfo<Seeds>& seeds) {
    return fmt::format("from{}", seeds.param.first);
}
std::vector<Seeds> seeds(std::uint64_t first, std::uint64_t last, std::uint64_t each) {
    std::vector<Seeds> all;
    for (std::uint64_t seed = first; seed < last; seed += each) all.push_back({seed, each});
    return all;
}

void judgeAll(const Seeds& asked) {
    std::uint64_t ended = 0, right = 0;
    for (std::uint64_t seed = asked.first; seed < asked.first + asked.count; ++seed) {
        const Recipe recipe = recipeOf(seed);
        const Verdict verdict = judge(recipe);
        if (!verdict.faults.empty()) ADD_FAILURE() << report(recipe, verdict);
        if (!recipe.wrong.empty()) continue;
        ++right;
        ended += verdict.end == "ended" ? 1u : 0u;
    }
    // Else the features are such as are refused, and nothing is tested.
    EXPECT_GE(3 * ended, right) << ended << " of " << right << " scenes came to their end";
}

class RandomScenes : public testing::TestWithParam<Seeds> {};
TEST_P(RandomScenes, holdWhatMustHold) { judgeAll(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Seeds, RandomScenes, testing::ValuesIn(seeds(0, 300, 25)), nameOf);

class LongRandomScenes : public testing::TestWithParam<Seeds> {};
TEST_P(LongRandomScenes, holdWhatMustHold) { judgeAll(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Seeds, LongRandomScenes, testing::ValuesIn(seeds(1000, 11000, 1000)), nameOf);

}  // namespace

/// One recipe, with what its features gave and what came of it. Returns the exit code.
int show(const Recipe& recipe) {
    const Verdict verdict = judge(recipe);
    fmt::print("{}\n{}It {}. {}\n", recipe.text(), verdict.record, verdict.end, verdict.sentence);
    if (!verdict.faults.empty()) fmt::print("{}\n", report(recipe, verdict));
    return verdict.faults.empty() ? 0 : 1;
}

/// How scenes end, over many seeds, and which are at fault.
int survey(std::uint64_t first, std::uint64_t count) {
    std::map<std::string, int> ends;
    int faults = 0;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const Recipe recipe = recipeOf(seed);
        const Verdict verdict = judge(recipe);
        ++ends[fmt::format("{}{}", recipe.wrong.empty() ? "" : "with wrong values: ", verdict.end)];
        if (verdict.end != "ended" && recipe.wrong.empty())
            fmt::print("{} {}: {}\n", seed, verdict.end, verdict.sentence);
        for (const std::string& fault : verdict.faults) fmt::print("{} FAULT {}\n", seed, fault);
        faults += verdict.faults.empty() ? 0 : 1;
        if (verdict.seconds > 1) fmt::print("{} took {:.3g} s of processor time\n", seed, verdict.seconds);
        std::fflush(stdout);
    }
    for (const auto& [end, number] : ends) fmt::print("{}: {}\n", end, number);
    fmt::print("at fault: {}\n", faults);
    return faults == 0 ? 0 : 1;
}

/// What comes of each two features, and which pairs are at fault.
/// @param asked of pairs with one of these; empty: of all
int surveyPairs(const std::set<std::string_view>& asked) {
    int faults = 0;
    const std::span<const std::string_view> all = composedFeatures();
    for (const std::string_view name : asked) featureNamed(name);
    for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = a + 1; b < all.size(); ++b) {
            if (!asked.empty() && !asked.contains(all[a]) && !asked.contains(all[b])) continue;
            if (!whyNoPair(all[a], all[b]).empty()) continue;
            const Recipe recipe = recipeWith(std::array{all[a], all[b]}, 1);
            const Verdict verdict = judgeComposition(recipe);
            fmt::print("{},{},{},{:.3g} s,{}\n", all[a], all[b], verdict.end, verdict.seconds,
                       verdict.sentence);
            for (const std::string& fault : verdict.faults)
                fmt::print("FAULT {}\n  --scene '{}'\n", fault, recipe.text());
            faults += verdict.faults.empty() ? 0 : 1;
            std::fflush(stdout);
        }
    fmt::print("at fault: {}\n", faults);
    return faults == 0 ? 0 : 1;
}

}  // namespace pendular::fuzz

/// SelfTestFuzzRandomScenes [--seed N | --scene RECIPE | --survey FIRST COUNT | --survey-pairs [FEATURE ...]
/// | options of GoogleTest]
int main(int count, char** words) {
    using namespace pendular::fuzz;
    // Threads share also what is not worth a thread: the scenes are small.
    setenv("PENDULAR_SHARE_SMALL_WORK", "1", 1);
    const std::string_view option = count > 1 ? words[1] : "";
    try {
        if (option == "--survey-pairs") return surveyPairs({words + 2, words + count});
        if (option == "--seed" && count > 2) return show(recipeOf(std::strtoull(words[2], nullptr, 10)));
        if (option == "--scene" && count > 2) return show(recipeFrom(words[2]));
        if (option == "--survey" && count > 3)
            return survey(std::strtoull(words[2], nullptr, 10), std::strtoull(words[3], nullptr, 10));
    } catch (const pendular::InputError& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
    testing::InitGoogleTest(&count, words);
    return RUN_ALL_TESTS();
}
