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

namespace pendular::fieldTest {
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
    std::vector<Setter<L>> setters;
    [[maybe_unused]] const auto add = [&](std::string_view field, auto set, auto get) {
        setters.push_back({field, set, get});
    };
    if constexpr (requires(L l) { l.setStiffness(0.0); })
        add(
            "stiffness", [](L& l, double v) { l.setStiffness(v); },
            [](const L& l) { return l.getStiffness(); });
    if constexpr (requires(L l) { l.setDissipation(0.0); })
        add(
            "dissipation", [](L& l, double v) { l.setDissipation(v); },
            [](const L& l) { return l.getDissipation(); });
    if constexpr (requires(L l) { l.setEffectiveElasticModulus(0.0); })
        add(
            "effectiveElasticModulus", [](L& l, double v) { l.setEffectiveElasticModulus(v); },
            [](const L& l) { return l.getEffectiveElasticModulus(); });
    if constexpr (requires(L l) { l.setDissipativeTime(0.0); })
        add(
            "dissipativeTime", [](L& l, double v) { l.setDissipativeTime(v); },
            [](const L& l) { return l.getDissipativeTime(); });
    if constexpr (requires(L l) { l.setLoadingStiffness(0.0); })
        add(
            "loadingStiffness", [](L& l, double v) { l.setLoadingStiffness(v); },
            [](const L& l) { return l.getLoadingStiffness(); });
    if constexpr (requires(L l) { l.setUnloadingStiffnessMax(0.0); })
        add(
            "unloadingStiffnessMax", [](L& l, double v) { l.setUnloadingStiffnessMax(v); },
            [](const L& l) { return l.getUnloadingStiffnessMax(); });
    if constexpr (requires(L l) { l.setCohesionStiffness(0.0); })
        add(
            "cohesionStiffness", [](L& l, double v) { l.setCohesionStiffness(v); },
            [](const L& l) { return l.getCohesionStiffness(); });
    if constexpr (requires(L l) { l.setPenetrationDepthMax(0.0); })
        add(
            "penetrationDepthMax", [](L& l, double v) { l.setPenetrationDepthMax(v); },
            [](const L& l) { return l.getPenetrationDepthMax(); });
    if constexpr (requires(L l) { l.setLoadingModulus(0.0); }) {
        add(
            "loadingModulus", [](L& l, double v) { l.setLoadingModulus(v); },
            [](const L& l) { return l.getLoadingModulus(); });
        add(
            "unloadingModulusMax", [](L& l, double v) { l.setUnloadingModulusMax(v); },
            [](const L& l) { return l.getUnloadingModulusMax(); });
        add(
            "cohesionModulus", [](L& l, double v) { l.setCohesionModulus(v); },
            [](const L& l) { return l.getCohesionModulus(); });
    }
    if constexpr (requires(L l) { l.setSinterRate(0.0); })
        add(
            "sinterRate", [](L& l, double v) { l.setSinterRate(v); },
            [](const L& l) { return l.getSinterRate(); });
    if constexpr (requires(L l) { l.setSinterAdhesion(0.0); }) {
        add(
            "sinterAdhesion", [](L& l, double v) { l.setSinterAdhesion(v); },
            [](const L& l) { return l.getSinterAdhesion(); });
        add(
            "sinterType", [](L& l, double v) { setField(l, &L::sinterType, v); },
            [](const L& l) { return l.sinterType; });
    }
    if constexpr (requires(L l) { l.setPlasticity(0.0); })
        add(
            "plasticity", [](L& l, double v) { l.setPlasticity(v); },
            [](const L& l) { return l.getPlasticity(); });
    if constexpr (requires(L l) { l.setCohesionRatio(0.0); })
        add(
            "cohesionRatio", [](L& l, double v) { l.setCohesionRatio(v); },
            [](const L& l) { return l.getCohesionRatio(); });
    if constexpr (requires(L l) { l.setEffectiveShearModulus(0.0); })
        add(
            "effectiveShearModulus", [](L& l, double v) { l.setEffectiveShearModulus(v); },
            [](const L& l) { return l.getEffectiveShearModulus(); });
    if constexpr (requires(L l) { l.setSlidingDissipation(0.0); })
        add(
            "slidingDissipation", [](L& l, double v) { l.setSlidingDissipation(v); },
            [](const L& l) { return l.getSlidingDissipation(); });
    if constexpr (requires(L l) { l.setSlidingFrictionCoefficient(0.0); })
        add(
            "slidingFrictionCoefficient", [](L& l, double v) { l.setSlidingFrictionCoefficient(v); },
            [](const L& l) { return l.getSlidingFrictionCoefficient(); });
    if constexpr (requires(L l) { l.setSpringFactor(0.0); })
        add(
            "springFactor", [](L& l, double v) { l.setSpringFactor(v); },
            [](const L& l) { return l.getSpringFactor(); });
    if constexpr (requires(L l) { l.setSlidingStiffness(0.0); })
        add(
            "slidingStiffness", [](L& l, double v) { l.setSlidingStiffness(v); },
            [](const L& l) { return l.getSlidingStiffness(); });
    if constexpr (requires(L l) { l.setStaticFrictionRatio(0.0); })
        add(
            "staticFrictionRatio", [](L& l, double v) { l.setStaticFrictionRatio(v); },
            [](const L& l) { return l.getStaticFrictionRatio(); });
    if constexpr (requires(L l) { l.setRollingStiffness(0.0); })
        add(
            "rollingStiffness", [](L& l, double v) { l.setRollingStiffness(v); },
            [](const L& l) { return l.getRollingStiffness(); });
    if constexpr (requires(L l) { l.setRollingDissipation(0.0); })
        add(
            "rollingDissipation", [](L& l, double v) { l.setRollingDissipation(v); },
            [](const L& l) { return l.getRollingDissipation(); });
    if constexpr (requires(L l) { l.setRollingFrictionCoefficient(0.0); })
        add(
            "rollingFrictionCoefficient", [](L& l, double v) { l.setRollingFrictionCoefficient(v); },
            [](const L& l) { return l.getRollingFrictionCoefficient(); });
    if constexpr (requires(L l) { l.setTorsionStiffness(0.0); })
        add(
            "torsionStiffness", [](L& l, double v) { l.setTorsionStiffness(v); },
            [](const L& l) { return l.getTorsionStiffness(); });
    if constexpr (requires(L l) { l.setTorsionDissipation(0.0); })
        add(
            "torsionDissipation", [](L& l, double v) { l.setTorsionDissipation(v); },
            [](const L& l) { return l.getTorsionDissipation(); });
    if constexpr (requires(L l) { l.setTorsionFrictionCoefficient(0.0); })
        add(
            "torsionFrictionCoefficient", [](L& l, double v) { l.setTorsionFrictionCoefficient(v); },
            [](const L& l) { return l.getTorsionFrictionCoefficient(); });
    if constexpr (requires(L l) { l.setLiquidBridgeVolume(0.0); })
        add(
            "liquidBridgeVolume", [](L& l, double v) { l.setLiquidBridgeVolume(v); },
            [](const L& l) { return l.getLiquidBridgeVolume(); });
    if constexpr (requires(L l) { l.setLiquidBridgeVolumeMax(0.0); }) {
        add(
            "liquidBridgeVolumeMax", [](L& l, double v) { l.setLiquidBridgeVolumeMax(v); },
            [](const L& l) { return l.getLiquidBridgeVolumeMax(); });
        add(
            "liquidBridgeVolumeMin", [](L& l, double v) { l.setLiquidBridgeVolumeMin(v); },
            [](const L& l) { return l.getLiquidBridgeVolumeMin(); });
        add(
            "distributionCoefficient", [](L& l, double v) { l.setDistributionCoefficient(v); },
            [](const L& l) { return l.getDistributionCoefficient(); });
    }
    if constexpr (requires(L l) { l.setViscosity(0.0); }) {
        add(
            "viscosity", [](L& l, double v) { l.setViscosity(v); },
            [](const L& l) { return l.getViscosity(); });
        add(
            "roughness", [](L& l, double v) { l.setRoughness(v); },
            [](const L& l) { return l.getRoughness(); });
    }
    if constexpr (requires(L l) { l.setContactAngle(0.0); })
        add(
            "contactAngle", [](L& l, double v) { l.setContactAngle(v); },
            [](const L& l) { return l.getContactAngle(); });
    if constexpr (requires(L l) { l.setSurfaceTension(0.0); })
        add(
            "surfaceTension", [](L& l, double v) { l.setSurfaceTension(v); },
            [](const L& l) { return l.getSurfaceTension(); });
    if constexpr (requires(L l) { l.setLiquidLayerThickness(0.0); })
        add(
            "liquidLayerThickness", [](L& l, double v) { l.setLiquidLayerThickness(v); },
            [](const L& l) { return l.getLiquidLayerThickness(); });
    if constexpr (requires(L l) { l.setHalfFillingAngle(0.0); })
        add(
            "halfFillingAngle", [](L& l, double v) { l.setHalfFillingAngle(v); },
            [](const L& l) { return l.getHalfFillingAngle(); });
    if constexpr (requires(L l) { l.setLiquidDensity(0.0); })
        add(
            "liquidDensity", [](L& l, double v) { l.setLiquidDensity(v); },
            [](const L& l) { return l.getLiquidDensity(); });
    if constexpr (requires(L l) { l.setFilmContactGap(0.0); })
        add(
            "filmContactGap", [](L& l, double v) { l.setFilmContactGap(v); },
            [](const L& l) { return l.filmContactGap; });
    if constexpr (requires(L l) { l.setFilmThickness(0.0); })
        add(
            "filmThickness", [](L& l, double v) { l.setFilmThickness(v); },
            [](const L& l) { return l.getFilmThickness(); });
    if constexpr (requires(L l) { l.setViscosity(0.0); })
        add(
            "viscosity", [](L& l, double v) { l.setViscosity(v); },
            [](const L& l) { return l.getViscosity(); });
    if constexpr (requires(L l) { l.setRoughness(0.0); })
        add(
            "roughness", [](L& l, double v) { l.setRoughness(v); },
            [](const L& l) { return l.getRoughness(); });
    if constexpr (requires(L l) { l.setAdhesionForceMax(0.0); })
        add(
            "adhesionForceMax", [](L& l, double v) { l.setAdhesionForceMax(v); },
            [](const L& l) { return l.getAdhesionForceMax(); });
    if constexpr (requires(L l) { l.setAdhesionStiffness(0.0); })
        add(
            "adhesionStiffness", [](L& l, double v) { l.setAdhesionStiffness(v); },
            [](const L& l) { return l.getAdhesionStiffness(); });
    if constexpr (requires(L l) { l.setBondForceMax(0.0); }) {
        add(
            "bondForceMax", [](L& l, double v) { l.setBondForceMax(v); },
            [](const L& l) { return l.getBondForceMax(); });
        add(
            "bondDissipation", [](L& l, double v) { l.setBondDissipation(v); },
            [](const L& l) { return l.getBondDissipation(); });
    }
    if constexpr (requires(L l) { l.setAdhesionCoefficient(0.0); }) {
        add(
            "adhesionCoefficient", [](L& l, double v) { l.setAdhesionCoefficient(v); },
            [](const L& l) { return l.getAdhesionCoefficient(); });
        add(
            "viscosityCoefficient", [](L& l, double v) { l.setViscosityCoefficient(v); },
            [](const L& l) { return l.getViscosityCoefficient(); });
        add(
            "slidingViscosityCoefficient", [](L& l, double v) { l.setSlidingViscosityCoefficient(v); },
            [](const L& l) { return l.getSlidingViscosityCoefficient(); });
    }
    if constexpr (requires(L l) { l.setWorkOfAdhesion(0.0); })
        add(
            "workOfAdhesion", [](L& l, double v) { l.setWorkOfAdhesion(v); },
            [](const L& l) { return l.getWorkOfAdhesion(); });
    if constexpr (requires(L l) { l.setSurfaceDistance(0.0); })
        add(
            "surfaceDistance", [](L& l, double v) { l.setSurfaceDistance(v); },
            [](const L& l) { return l.getSurfaceDistance(); });
    if constexpr (requires(L l) { l.setAdhesionModulus(0.0); })
        add(
            "adhesionModulus", [](L& l, double v) { l.setAdhesionModulus(v); },
            [](const L& l) { return l.getAdhesionModulus(); });
    return setters;
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
}  // namespace pendular::fieldTest
