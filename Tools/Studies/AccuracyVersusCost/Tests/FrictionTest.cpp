/// Friction laws against the exact contact with partial slip.

#include <gtest/gtest.h>

#include <map>

#include "BuildFolders.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"
#include "Tools/Studies/AccuracyVersusCost/FrictionErrors.h"

namespace pendular::friction::frictionTest {
namespace {

/// The rms error of the force over some paths of a population.
template <class Law>
double errorOver(const PathPopulation& population, std::string_view name) {
    const CountedRandom random(7);
    double squares = 0;
    constexpr std::uint64_t paths = 10;
    for (std::uint64_t k = 0; k < paths; ++k) {
        const Path path = population.draw(random, k);
        squares += std::pow(forceError(courseOfLaw(path, NamedLaw<Law>{name}), exactCourse(path)), 2);
    }
    return std::sqrt(squares / paths);
}

// More springs are nearer to the exact contact, on all paths: the error is of the first order in their width,
// the widest of which is 1, 1/2 and 1/8. A single spring of another kind is farther off than that of the
// increments.
TEST(HeavyFrictionErrors, fallWithTheNumberOfSprings) {
    for (const PathPopulation& population : pathPopulations()) {
        const double one = errorOver<MindlinIncremental>(population, "one");
        const double three = errorOver<MindlinPartialSlip>(population, "three");
        const double eight = errorOver<EightSprings>(population, "eight");
        EXPECT_LT(three, 0.5 * one) << population.name;
        EXPECT_LT(eight, 0.6 * three) << population.name;
        EXPECT_LT(one, errorOver<Mindlin>(population, "Mindlin")) << population.name;
    }
}

// A cycle of a small slip loses 1/2 of its cube, in mu N and full slips
// (PartialSlip.lossOfASmallCycleIsCubic), but nothing in a spring that does not slip. Of four cycles from
// rest at least three are closed loops.
template <class Law>
double lossOfSmallCycles() {
    return courseOfLaw(oscillation(0.1, 0, 0, 0), NamedLaw<Law>{"law"}).loss /
           (contact.friction * contact.normalForce(deepest) * fullSlip());
}
TEST(HeavyFrictionErrors, aFewSpringsLoseNothingInSmallCycles) {
    const double unit = contact.friction * contact.normalForce(deepest) * fullSlip();
    EXPECT_GT(exactCourse(oscillation(0.1, 0, 0, 0)).loss / unit, 3 * 0.5 * std::pow(0.1, 3));
    EXPECT_NEAR(lossOfSmallCycles<Mindlin>(), 0, 1e-12);
    EXPECT_NEAR(lossOfSmallCycles<MindlinSecant>(), 0, 1e-12);
    EXPECT_NEAR(lossOfSmallCycles<MindlinIncremental>(), 0, 1e-12);
    EXPECT_NEAR(lossOfSmallCycles<MindlinPartialSlip>(), 0, 1e-12);
}

// The secant spring with 2/3 is exact where slip and overlap grow together and nothing slips.
TEST(HeavyFrictionErrors, ofMindlinVanishForSlipInProportionToTheOverlap) {
    const Path path = [](double time) { return Place{deepest * time, {0.3 * fullSlip() * time, 0, 0}}; };
    EXPECT_LT(forceError(courseOfLaw(path, NamedLaw<Mindlin>{"Mindlin"}), exactCourse(path)),
              1e-4);  // what the sum over 300 springs errs at the start, where few of them touch
}

TEST(HeavyFrictionChart, hasEveryLawForEveryPopulation) {
    const support::TestFolder folder;
    const auto result =
        support::run(folders::tools.string() +
                     "/Studies/accuracy-versus-cost --friction --paths 1 --friction-runs 1 --output " +
                     folder.path().string());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    std::map<std::string, int> rows;
    for (auto& row : support::rowsOf(support::contentOf(folder.path() / "laws.csv"))) {
        ++rows[row["law"]];
        EXPECT_GT(std::stod(row["force_ns_per_contact"]), 0);
    }
    forEachLaw([&](const auto& law) {
        EXPECT_EQ(rows[std::string(law.name)], static_cast<int>(pathPopulations().size() + 1)) << law.name;
    });
    support::expectOneSentence(
        support::run(folders::tools.string() + "/Studies/accuracy-versus-cost --friction --paths 0"),
        "paths = 0");
}

}  // namespace
}  // namespace pendular::friction::frictionTest
