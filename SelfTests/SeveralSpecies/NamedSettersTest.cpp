// Every setter of a species by its name, with the values that it says it takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Features/Laws.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::namedSettersTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

/// A value within a range.
double within(const Range& range) {
    if (std::isinf(range.lowest)) return 0.1;
    if (std::isinf(range.highest)) return range.lowest + 0.1;
    return range.lowest + 0.6 * (range.highest - range.lowest);
}

/// The table of setters says what the setters themselves refuse: in each value, one at a time.
TEST(NamedSetter, refusesWhatItsTableSays) {
    Simulation<> scene;
    std::size_t several = 0;
    for (const std::string_view type : instantiatedSpecies()) {
        AnySpecies* const species = scene.speciesHandler.addByName(type);
        const std::vector<NamedSetter> setters = species->setters();
        EXPECT_EQ(setters.front().name, "density");
        for (const NamedSetter& setter : setters) {
            SCOPED_TRACE(std::string(type) + " " + std::string(setter.name));
            several += setter.values.size() > 1 ? 1 : 0;
            std::vector<double> good;
            for (const SetterValue& value : setter.values) good.push_back(within(value.range));
            EXPECT_EQ(refusal([&] { species->set(setter.name, good); }), "");
            if (setter.gives.empty()) {
                EXPECT_EQ(species->get(setter.name), good.front());
            }
            for (std::size_t k = 0; k < good.size(); ++k) {
                const Range& range = setter.values[k].range;
                std::vector<double> wrong{std::nan(""), infinity};
                if (range.lowest > -infinity) wrong.push_back(range.lowest - 1);
                if (!range.lowestIncluded && range.lowest > -infinity) wrong.push_back(range.lowest);
                if (range.highest < infinity) wrong.push_back(range.highest + 1);
                for (const double value : wrong) {
                    std::vector<double> bad = good;
                    bad[k] = value;
                    EXPECT_TRUE(isOneSentence(refusal([&] { species->set(setter.name, bad); }))) << value;
                }
            }
            good.push_back(1);
            EXPECT_TRUE(contains(refusal([&] { species->set(setter.name, good); }), "and was given"));
        }
    }
    EXPECT_GE(several, 20u);
}

/// The spring and the dashpot of the damped oscillator: a collision of time t with restitution e of two
/// grains of mass m, m* = m / 2, has k = m* (pi^2 + ln^2 e) / t^2 and g = -2 m* ln(e) / t.
TEST(NamedSetter, takesSeveralValues) {
    Simulation<> scene;
    AnySpecies* const species = scene.speciesHandler.addByName("LinearViscoelasticSpecies");
    constexpr double t = 1e-3, e = 0.7, m = 2e-5;
    species->set("collisionTimeAndRestitutionCoefficient", {t, e, m});
    const double k = 0.5 * m * (M_PI * M_PI + std::log(e) * std::log(e)) / (t * t);
    EXPECT_NEAR(species->get("stiffness"), k, 1e-12 * k);
    EXPECT_NEAR(species->get("dissipation"), -m * std::log(e) / t, 1e-12 * m / t);
    species->set("stiffnessAndRestitutionCoefficient", {k, e, m});
    EXPECT_NEAR(species->get("dissipation"), -m * std::log(e) / t, 1e-12 * m / t);
    // The unit of each value is in the table.
    for (const NamedSetter& setter : species->setters())
        if (setter.name == "collisionTimeAndRestitutionCoefficient") {
            EXPECT_EQ(setter.values[0].unit, "s");
            EXPECT_EQ(setter.values[1].unit, "");
            EXPECT_EQ(setter.values[2].unit, "kg");
        }
}

/// The restitution of a Hertzian contact needs no mass, and can be read again.
TEST(NamedSetter, givesARestitution) {
    Simulation<> scene;
    AnySpecies* const species = scene.speciesHandler.addByName("HertzianViscoelasticSpecies");
    species->set("restitutionCoefficient", 0.5);
    // beta = -sqrt(5) ln e / sqrt(ln^2 e + pi^2), Thornton et al. (2023), equation 4.4
    const double beta = std::sqrt(5.0) * std::log(2.0) / std::hypot(std::log(2.0), M_PI);
    EXPECT_NEAR(species->get("dissipation"), beta, 1e-14);
    EXPECT_NEAR(species->get("restitutionCoefficient"), 0.5, 1e-14);
    // Nothing is set of a pair at first.
    AnyLaws* const pair = scene.speciesHandler.setPairTypeByName(0, 0, "HertzianViscoelasticSpecies");
    EXPECT_TRUE(std::isnan(pair->get("restitutionCoefficient")));
    pair->set("restitutionCoefficient", 0.8);
    EXPECT_NEAR(pair->get("restitutionCoefficient"), 0.8, 1e-14);
    species->set("density", 1000);
    species->set("elasticModulusAndPoissonRatio", {1e7, 0.3});
    EXPECT_NEAR(species->get("effectiveElasticModulus"), 0.5e7 / (1 - 0.09), 1e-3);
    scene.laws().mixAll();
    EXPECT_NEAR(scene.laws().fields(0, 0)[0].value, 0.5e7 / (1 - 0.09), 1e-3);
    EXPECT_FALSE(scene.laws().hasChanges());
    species->set("elasticModulusAndPoissonRatio", {2e7, 0.3});
    EXPECT_TRUE(scene.laws().hasChanges());
}

TEST(NamedSetter, thatThereIsNotIsRefusedWithTheNearest) {
    Simulation<> scene;
    AnySpecies* const species = scene.speciesHandler.addByName("LinearViscoelasticSpecies");
    const auto expect = [](const std::string& text, const std::vector<std::string>& words) {
        EXPECT_TRUE(isOneSentence(text));
        for (const std::string& word : words) EXPECT_TRUE(contains(text, word));
    };
    expect(refusal([&] { species->set("restitutionCoefficient", 0.5); }),
           {"There is no field of LinearViscoelasticSpecies \"restitutionCoefficient\"",
            "stiffnessAndRestitutionCoefficient"});
    expect(
        refusal([&] { species->set("stiffnessAndRestitutionCoefficient", 0.5); }),
        {"LinearViscoelastic: stiffnessAndRestitutionCoefficient takes 3 values and was given 1: stiffness "
         "greater than 0 N/m",
         "restitution greater than 0", "mass greater than 0 kg and finite"});
    expect(refusal([&] { static_cast<void>(species->get("stiffnessAndRestitutionCoefficient")); }),
           {"can be set and not read; read stiffness and dissipation"});
}

}  // namespace
}  // namespace pendular::namedSettersTest
