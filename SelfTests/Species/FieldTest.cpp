#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <type_traits>
#include <vector>

#include "SelfTests/Support/EveryLaw.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular {
namespace {

using support::contains;
using support::forEveryLaw;
using support::isOneSentence;
using support::refusal;

std::vector<double> valuesOutside(const Range& range) {
    std::vector<double> values{unset, infinity, -infinity};
    if (std::isfinite(range.lowest)) {
        values.push_back(range.lowestIncluded ? std::nextafter(range.lowest, -infinity) : range.lowest);
        values.push_back(range.lowest - 1);
    }
    if (std::isfinite(range.highest)) {
        values.push_back(range.highestIncluded ? std::nextafter(range.highest, infinity) : range.highest);
        values.push_back(range.highest + 1);
    }
    return values;
}

/// The ends of the range and numbers between.
std::vector<double> valuesInside(const Range& range) {
    const double low = range.lowestIncluded ? range.lowest : std::nextafter(range.lowest, infinity);
    const double high = range.highestIncluded ? range.highest : std::nextafter(range.highest, -infinity);
    return {low, high, low + std::min(0.3, 0.3 * (high - low))};
}

/// That a message is one sentence with the owner, the field, the value, the unit and both ends of the range.
void expectFullRefusal(const std::string& message, std::string_view owner, std::string_view field,
                       double value, std::string_view unit, const Range& range) {
    const std::string space = unit.empty() ? "" : " ";
    EXPECT_TRUE(isOneSentence(message));
    EXPECT_TRUE(contains(message, owner));
    EXPECT_TRUE(contains(message, field));
    EXPECT_TRUE(contains(message, unit));
    EXPECT_TRUE(
        contains(message, std::isnan(value) ? "not a number" : fmt::format("= {}{}{} ", value, space, unit)));
    EXPECT_TRUE(contains(message, fmt::format(" {}{}{}", range.lowest, space, unit)));
    if (std::isfinite(range.highest))
        EXPECT_TRUE(contains(message, fmt::format(" {}{}{}.", range.highest, space, unit)));
    else EXPECT_TRUE(contains(message, "finite"));
}

TEST(Field, tablesAreComplete) {
    forEveryLaw([]<class Law>() {
        std::set<std::string_view> names;
        for (const auto& field : Law::fields()) {
            EXPECT_TRUE(names.insert(field.name).second) << Law::name << " has two fields " << field.name;
            EXPECT_FALSE(field.name.empty() || field.meaning.empty() || field.source.empty())
                << Law::name << " " << field.name;
            EXPECT_LT(field.range.lowest, field.range.highest) << Law::name << " " << field.name;
            EXPECT_FALSE(formula(field.mixing).empty());
        }
        EXPECT_FALSE(Law::summary.empty() || Law::domain.empty());
    });
}

// Every number that a law has is in its table: none can escape check, restart and mixing.
TEST(Field, tablesHoldEveryMember) {
    forEveryLaw([]<class Law>() {
        const std::size_t members = std::is_empty_v<Law> ? 0 : sizeof(Law) / sizeof(double);
        EXPECT_EQ(Law::fields().size(), members) << Law::name;
    });
}

TEST(Field, valuesOutOfRangeAreRefusedInOneSentence) {
    forEveryLaw([]<class Law>() {
        for (const auto& field : Law::fields())
            for (const double value : valuesOutside(field.range)) {
                Law law;
                const double before = law.*field.member;
                const std::string message = refusal([&] { setField(law, field.member, value); });
                SCOPED_TRACE(fmt::format("{}, {} = {}", Law::name, field.name, value));
                expectFullRefusal(message, Law::name, field.name, value, field.unit, field.range);
                EXPECT_TRUE(law.*field.member == before || (!isSet(before) && !isSet(law.*field.member)));
            }
    });
}

TEST(Field, valuesWrittenPastTheSettersAreFoundByTheCheckOfTheLaw) {
    forEveryLaw([]<class Law>() {
        for (const auto& field : Law::fields())
            for (const double value : valuesOutside(field.range)) {
                Law law;
                for (const auto& other : Law::fields()) law.*other.member = valuesInside(other.range).back();
                EXPECT_EQ(refusal([&] { checkFields(law); }), "");
                law.*field.member = value;
                expectFullRefusal(refusal([&] { checkFields(law); }), Law::name, field.name, value,
                                  field.unit, field.range);
            }
    });
}

TEST(Field, valuesInRangeAreTaken) {
    forEveryLaw([]<class Law>() {
        for (const auto& field : Law::fields())
            for (const double value : valuesInside(field.range)) {
                Law law;
                EXPECT_EQ(refusal([&] { setField(law, field.member, value); }), "");
                EXPECT_EQ(law.*field.member, value);
            }
    });
}

/// A setter under the name that users call it by, its getter, and the field that it sets.
template <class Law>
struct Setter {
    std::string_view field;
    void (*set)(Law&, double);
    double (*get)(const Law&);
};

template <class Law>
std::vector<Setter<Law>> settersOf() {
    using L = Law;
    using V = double;
    if constexpr (std::is_same_v<L, LinearViscoelastic>)
        return {
            {"stiffness", [](L& l, V v) { l.setStiffness(v); }, [](const L& l) { return l.getStiffness(); }},
            {"dissipation", [](L& l, V v) { l.setDissipation(v); },
             [](const L& l) { return l.getDissipation(); }}};
    else if constexpr (std::is_same_v<L, HertzianViscoelastic>)
        return {{"effectiveElasticModulus", [](L& l, V v) { l.setEffectiveElasticModulus(v); },
                 [](const L& l) { return l.getEffectiveElasticModulus(); }},
                {"dissipation", [](L& l, V v) { l.setDissipation(v); },
                 [](const L& l) { return l.getDissipation(); }}};
    else if constexpr (std::is_same_v<L, HertzianBSHPViscoelastic>)
        return {{"effectiveElasticModulus", [](L& l, V v) { l.setEffectiveElasticModulus(v); },
                 [](const L& l) { return l.getEffectiveElasticModulus(); }},
                {"dissipativeTime", [](L& l, V v) { l.setDissipativeTime(v); },
                 [](const L& l) { return l.getDissipativeTime(); }}};
    else if constexpr (requires(L l) { l.setAdhesionForceMax(0.0); })
        return {{"adhesionForceMax", [](L& l, V v) { l.setAdhesionForceMax(v); },
                 [](const L& l) { return l.getAdhesionForceMax(); }},
                {"adhesionStiffness", [](L& l, V v) { l.setAdhesionStiffness(v); },
                 [](const L& l) { return l.getAdhesionStiffness(); }}};
    else if constexpr (std::is_same_v<L, DMT>)
        return {{"workOfAdhesion", [](L& l, V v) { l.setWorkOfAdhesion(v); },
                 [](const L& l) { return l.getWorkOfAdhesion(); }},
                {"surfaceDistance", [](L& l, V v) { l.setSurfaceDistance(v); },
                 [](const L& l) { return l.getSurfaceDistance(); }}};
    else if constexpr (std::is_same_v<L, JKR>)
        return {{"workOfAdhesion", [](L& l, V v) { l.setWorkOfAdhesion(v); },
                 [](const L& l) { return l.getWorkOfAdhesion(); }},
                {"adhesionModulus", [](L& l, V v) { l.setAdhesionModulus(v); },
                 [](const L& l) { return l.getAdhesionModulus(); }}};
    else if constexpr (std::is_same_v<L, Mindlin>)
        return {{"effectiveShearModulus", [](L& l, V v) { l.setEffectiveShearModulus(v); },
                 [](const L& l) { return l.getEffectiveShearModulus(); }},
                {"slidingDissipation", [](L& l, V v) { l.setSlidingDissipation(v); },
                 [](const L& l) { return l.getSlidingDissipation(); }},
                {"slidingFrictionCoefficient", [](L& l, V v) { l.setSlidingFrictionCoefficient(v); },
                 [](const L& l) { return l.getSlidingFrictionCoefficient(); }},
                {"springFactor", [](L& l, V v) { l.setSpringFactor(v); },
                 [](const L& l) { return l.getSpringFactor(); }}};
    else if constexpr (requires(L l) { l.setLiquidBridgeVolume(0.0); })
        return {{"liquidBridgeVolume", [](L& l, V v) { l.setLiquidBridgeVolume(v); },
                 [](const L& l) { return l.getLiquidBridgeVolume(); }},
                {"contactAngle", [](L& l, V v) { l.setContactAngle(v); },
                 [](const L& l) { return l.getContactAngle(); }},
                {"surfaceTension", [](L& l, V v) { l.setSurfaceTension(v); },
                 [](const L& l) { return l.getSurfaceTension(); }}};
    else return {};
}

TEST(Field, everySetterChecksItsFieldAndItsGetterReturnsIt) {
    forEveryLaw([]<class Law>() {
        for (const auto& field : Law::fields()) {
            if (field.mixing == Mixing::Largest) continue;  // an option: its setter takes a bool
            bool found = false;
            for (const Setter<Law>& setter : settersOf<Law>()) {
                if (setter.field != field.name) continue;
                found = true;
                for (const double value : valuesOutside(field.range)) {
                    Law law;
                    const std::string message = refusal([&] { setter.set(law, value); });
                    expectFullRefusal(message, Law::name, field.name, value, field.unit, field.range);
                }
                for (const double value : valuesInside(field.range)) {
                    Law law;
                    setter.set(law, value);
                    EXPECT_EQ(law.*field.member, value);
                    EXPECT_EQ(setter.get(law), value);
                }
            }
            EXPECT_TRUE(found) << "settersOf() in this test has no setter of " << Law::name << "'s "
                               << field.name;
        }
    });
    LiquidBridgeBagheri law;
    law.setRawFit(true);
    EXPECT_EQ(law.rawFit, 1);
    law.setRawFit(false);
    EXPECT_EQ(law.rawFit, 0);
}

TEST(Field, densityIsCheckedBySetterAndByCheck) {
    support::forSpeciesWithEveryLaw([]<class S>() {
        for (const double value : valuesOutside(positive)) {
            S species;
            const std::string message = refusal([&] { species.setDensity(value); });
            expectFullRefusal(message, S::name, "density", value, "kg/m^3", positive);
        }
        S species;
        expectFullRefusal(refusal([&] { species.check(); }), S::name, "density", unset, "kg/m^3", positive);
        species.setDensity(2500);
        EXPECT_EQ(species.getDensity(), 2500);
    });
}

/// A check of a value that is no field, but that a field is computed from.
template <class Action>
void expectHelperRefuses(std::string_view law, std::string_view what, std::string_view unit,
                         const Range& range, Action&& set) {
    for (const double value : valuesOutside(range))
        expectFullRefusal(refusal([&] { set(value); }), law, what, value, unit, range);
}

TEST(Field, hertzHelpersCheckWhatTheyAreGiven) {
    HertzianViscoelastic law;
    const auto expect = [](std::string_view what, std::string_view unit, const Range& range, auto&& set) {
        expectHelperRefuses("HertzianViscoelastic", what, unit, range, set);
    };
    expect("restitution coefficient", "", {0, 1}, [&](double e) { law.setRestitutionCoefficient(e); });
    expect("restitution coefficient", "", {0, 1},
           [&](double e) { law.setEffectiveElasticModulusAndRestitutionCoefficient(1e6, e); });
    expect("effectiveElasticModulus", "Pa", positive,
           [&](double modulus) { law.setEffectiveElasticModulusAndRestitutionCoefficient(modulus, 0.5); });
    expect("Tsuji damping factor", "", notNegative, [&](double a) { law.setTsujiDampingFactor(a); });
    expect("elastic modulus", "Pa", positive,
           [&](double modulus) { law.setElasticModulusAndPoissonRatio(modulus, 0.3); });
    expect("Poisson's ratio", "", {-1, 0.5, false, true},
           [&](double ratio) { law.setElasticModulusAndPoissonRatio(1e6, ratio); });
}

TEST(Field, linearHelpersCheckWhatTheyAreGiven) {
    LinearViscoelastic law;
    const auto expect = [](std::string_view what, std::string_view unit, const Range& range, auto&& set) {
        expectHelperRefuses("LinearViscoelastic", what, unit, range, set);
    };
    const Range restitution{0, 1, false, true};
    expect("collision time", "s", positive,
           [&](double time) { law.setCollisionTimeAndRestitutionCoefficient(time, 0.5, 1e-6); });
    expect("restitution coefficient", "", restitution,
           [&](double e) { law.setCollisionTimeAndRestitutionCoefficient(1e-4, e, 1e-6); });
    expect("mass", "kg", positive,
           [&](double mass) { law.setCollisionTimeAndRestitutionCoefficient(1e-4, 0.5, mass); });
    expect("stiffness", "N/m", positive,
           [&](double stiffness) { law.setStiffnessAndRestitutionCoefficient(stiffness, 0.5, 1e-6); });
    expect("restitution coefficient", "", restitution,
           [&](double e) { law.setStiffnessAndRestitutionCoefficient(1e3, e, 1e-6); });
    expect("mass", "kg", positive,
           [&](double mass) { law.setStiffnessAndRestitutionCoefficient(1e3, 0.5, mass); });
}

}  // namespace
}  // namespace pendular
