#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "BuildFolders.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"
#include "Tools/Studies/AccuracyVersusCost/CollisionTheory.h"

// The tables of Tools/Studies/accuracy-versus-cost --contact-maps beside closed forms, law by law.

namespace pendular::contactMapsTest {
namespace {

using support::Row;

constexpr double pi = std::numbers::pi;

class HeavyContactMaps : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<support::TestFolder>();
        const auto result =
            support::run(folders::tools.string() +
                         "/Studies/accuracy-versus-cost --contact-maps --map-offsets 2 --output " +
                         folder->path().string());
        ASSERT_EQ(result.exitCode, 0) << result.output;
    }
    static void TearDownTestSuite() { folder.reset(); }

    static std::vector<Row> rows(const std::string& table) {
        return support::rowsOf(support::contentOf(folder->path() / table));
    }
    static double number(const Row& row, const std::string& column) { return std::stod(row.at(column)); }
    static bool isOfDefault(const Row& row) { return row.at("integrator") == "PredictedVelocityVerlet"; }

    static inline std::unique_ptr<support::TestFolder> folder;
};

// The dashpots go with the overlap to a power of at least 1/4, except for the linear one: the sum over
// samples errs with n^(-5/4) at both ends of the touch, in units of the dashpot's share of a contact of n
// steps. Of the linear one the start errs with 2 (L h)^2, L h = z pi/n, at most e^(-pi z / sqrt(1 - z^2)) of
// the speed: below n^(-5/4) too. What has no rebound has none at any step. The README of
// Kernel/Laws/Normal promises less, as it is seen.
TEST_F(HeavyContactMaps, restitutionConvergesToTheSetOne) {
    const std::map<std::string, double> readme{{"10", 0.012}, {"20", 0.003}, {"50", 0.0005}};
    int compared = 0, withoutRebound = 0;
    for (const Row& row : rows("restitution.csv")) {
        if (!isOfDefault(row)) continue;
        const double bound = std::pow(number(row, "steps_per_elastic_contact"), -1.25);
        const std::string which =
            row.at("law") + " " + row.at("set_restitution") + " " + row.at("steps_per_elastic_contact");
        if (row.at("set_restitution") == "0") {
            EXPECT_EQ(number(row, "restitution_error"), 0) << which;
            ++withoutRebound;
        } else {
            EXPECT_LT(std::abs(number(row, "restitution_error")), bound) << which;
            const auto said = readme.find(row.at("steps_per_elastic_contact"));
            if (said != readme.end()) {
                EXPECT_LT(std::abs(number(row, "restitution_error")), said->second) << which;
            }
            EXPECT_EQ(row.at("parted"), "1") << which;
            ++compared;
        }
    }
    EXPECT_EQ(compared, (3 * 15 + 2 * 13) * 10);  // laws, restitutions, steps
    EXPECT_EQ(withoutRebound, 2 * 2 * 10);
}

/// The damping of a row over the critical one.
double ratioOf(const Row& row) {
    return row.at("dashpot_over_critical").empty()
               ? collisionTheory::dampingRatio(std::stod(row.at("dashpot_restitution")))
               : std::stod(row.at("dashpot_over_critical"));
}

// Theory knows where the force of a linear contact turns, and what it would rebound with if it ended there:
// Schwager and Poeschel (2007). The contact of d^(3/2) and d^(1/4) has the same velocities, at other times
// (Antypov and Elliott 2011). The steps are 1/1000 of the contact, and the speed there has its maximum: its
// error is (pi/1000)^2 of the speed, or (1/1000)^(5/4) = 2e-4 of the dashpot's part.
TEST_F(HeavyContactMaps, pullBeginsWhereTheoryHasIt) {
    int compared = 0;
    for (const Row& row : rows("attraction.csv")) {
        const bool isLinear = row.at("law") == "LinearViscoelastic";
        if ((!isLinear && row.at("law") != "HertzianViscoelastic") || row.at("dashpot_restitution") == "1")
            continue;
        const double z = ratioOf(row);
        EXPECT_NEAR(number(row, "restitution_without_pull"), collisionTheory::restitutionWithoutPull(z), 2e-4)
            << row.at("law") << " " << z;
        EXPECT_GT(number(row, "largest_pull_over_largest_push"), 0);
        ++compared;
        if (!isLinear || z >= 1) continue;
        const double root = std::sqrt(1 - z * z);
        // The sample after the zero and the one before it are within a step of it.
        EXPECT_NEAR(number(row, "pull_begins_over_elastic_contact_time"),
                    std::atan2(2 * z * root, 2 * z * z - 1) / (pi * root), 1e-3);
        EXPECT_NEAR(number(row, "contact_time_over_elastic"), 1 / root, 1e-3);
    }
    EXPECT_EQ(compared, 2 * 16);
}

// Without a dashpot nothing pulls.
TEST_F(HeavyContactMaps, elasticContactsDoNotPull) {
    int compared = 0;
    for (const Row& row : rows("attraction.csv"))
        if (row.at("dashpot_restitution") == "1") {
            EXPECT_EQ(number(row, "largest_pull_over_largest_push"), 0) << row.at("law");
            ++compared;
        }
    EXPECT_GT(compared, 0);
}

// The push grows to 3/2 of that of the onset in 100 periods. Its start leaves an oscillation of the friction
// of 1.5 / (2 pi 100) of the limit, by which a contact may slide too soon; a step later than it should, the
// push is 1.5 / (100 x steps) larger, and so is it by a quarter of a period of the oscillation and the lag of
// the dashpot, z / pi of a period. The lever arm of the contact is half of the overlap shorter than the
// radius, by which the friction is 5/7 of 1/1000 more than 2/7 of the push.
TEST_F(HeavyContactMaps, slidingBeginsAtCoulombsLimit) {
    int compared = 0;
    for (const Row& row : rows("sliding-onset.csv")) {
        if (!isOfDefault(row)) continue;
        const double steps = number(row, "steps_per_tangential_period"),
                     damping = number(row, "damping_over_critical");
        const double early = 1.5 / (2 * pi * 100) + 5.0 / 7e3,
                     late = 0.015 * (1 / steps + 0.25 + damping / pi);
        const std::string which = row.at("law") + " " + row.at("damping_over_critical") + " " +
                                  row.at("steps_per_tangential_period");
        // 1e-9: the round-off of the overlap, 1e-16 of 1 mm against 1 um.
        EXPECT_LE(number(row, "largest_force_over_static_limit"), 1 + 1e-9) << which;
        EXPECT_GT(number(row, "largest_force_over_static_limit"), 1 - 1.5 / (100 * steps) - early) << which;
        EXPECT_GT(number(row, "push_at_onset_over_theory"), 1 - early - 1e-6) << which;
        EXPECT_LT(number(row, "push_at_onset_over_theory"), 1 + late + early) << which;
        EXPECT_NEAR(number(row, "sliding_force_over_dynamic_limit"), 1, 1e-9) << which;
        EXPECT_LT(number(row, "chatter_over_dynamic_limit"), 1e-9) << which;
        ++compared;
    }
    EXPECT_EQ(compared, 30 * (5 + 3));
}

// A step of 0.2 shortestContactTime() / pi is at most 1/15.7 of the elastic contact within the domain of each
// law: the sample nearest to the largest overlap misses at most (pi/n)^2 / 8 of it, and times err as much; 2
// (pi/n)^2 for all, n = 15.7. The restitution: see above.
TEST_F(HeavyContactMaps, overlapAndContactTimeAreThoseOfTheory) {
    const double n = 5 * pi, tolerance = 2 * std::pow(pi / n, 2);
    int compared = 0;
    for (const Row& row : rows("impact-speed.csv")) {
        if (row.at("region") != "0") continue;
        const std::string which = row.at("grain") + " " + row.at("law") + " " + row.at("speed_m_per_s");
        EXPECT_NEAR(number(row, "largest_overlap_over_radius") / number(row, "theory_overlap_over_radius"), 1,
                    tolerance)
            << which;
        EXPECT_NEAR(number(row, "restitution"), number(row, "theory_restitution"), std::pow(n, -1.25))
            << which;
        if (!row.at("theory_contact_time_s").empty()) {
            EXPECT_NEAR(number(row, "contact_time_s") / number(row, "theory_contact_time_s"), 1, tolerance)
                << which;
        }
        ++compared;
    }
    EXPECT_GT(compared, 250);
}

// Beyond its domain a collision has an end: within half the radius it is finite and gains nothing (here a
// contact has as few as 8.8 steps), and is counted; deeper it is refused, and so is what is faster.
TEST_F(HeavyContactMaps, eachSpeedIsSoundOrCountedOrRefused) {
    std::string last;
    int region = 0;
    std::map<int, int> seen;
    for (const Row& row : rows("impact-speed.csv")) {
        const std::string which = row.at("grain") + " " + row.at("law");
        if (which != last) last = which, region = 0;
        const int now = std::stoi(row.at("region"));
        const double overlap = number(row, "theory_overlap_over_radius");
        EXPECT_GE(now, region) << which << " " << row.at("speed_m_per_s");
        region = now, ++seen[now];
        if (now <= 1) {
            EXPECT_GE(number(row, "restitution"), 0) << which;
            EXPECT_LT(number(row, "restitution"), 1 + std::pow(8.8, -1.25)) << which;
            EXPECT_EQ(now == 1, number(row, "largest_overlap_over_radius") > 0.05) << which;
            EXPECT_LT(overlap, 0.7) << which;  // half, the skin of 0.15 radii, and what the steps err
        } else {
            EXPECT_GT(overlap, 0.45) << which;  // half, less what the steps err
            EXPECT_EQ(row.at("restitution"), "");
        }
    }
    for (int k = 0; k < 4; ++k) EXPECT_GT(seen[k], 0) << k;
}

// m* v^2 / 2 = 53.5 R*^3 Y^5 / E*^4 (Johnson 1985, equation 11.20: "about 53"); steel of 1 GPa.
TEST_F(HeavyContactMaps, steelYieldsAtJohnsonsSpeed) {
    const double modulus = 0.5 * 2.1e11 / (1 - 0.29 * 0.29), radius = 5e-4;
    const double mass = 0.5 * 4.0 / 3 * pi * 1e-9 * 7850;
    int compared = 0;
    for (const Row& row : rows("impact-speed.csv"))
        if (row.at("grain") == "steel") {
            ++compared;
            const double speed = number(row, "yield_speed_m_per_s");
            EXPECT_NEAR(
                0.5 * mass * speed * speed * std::pow(modulus, 4) / (std::pow(radius, 3) * std::pow(1e9, 5)),
                53, 0.6);
        }
    EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace pendular::contactMapsTest
