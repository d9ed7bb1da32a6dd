#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "Tools/Studies/ChungOoi/ImpactCase.h"

/// The eight benchmark tests of Chung and Ooi (2011), Granular Matter 13, 643.
/// Tools/Studies/ChungOoi/Tests/ChungOoiTest.cpp checks them, impact-figures.cpp writes the tables of their
/// charts.
namespace pendular::papers {

using Materials = std::vector<std::pair<std::string, scenes::ImpactMaterial>>;

/// Numbers a step apart, from first to last, with both.
inline std::vector<double> evenly(double first, double last, double step) {
    std::vector<double> values;
    for (int k = 0; k <= std::lround((last - first) / step); ++k) values.push_back(first + k * step);
    return values;
}
inline std::vector<double> joined(std::vector<double> values, const std::vector<double>& others) {
    values.insert(values.end(), others.begin(), others.end());
    return values;
}

/// One case for each material and value.
template <class MakeCase>
std::vector<ImpactCase> casesOf(const Materials& materials, const std::vector<double>& values,
                                MakeCase makeCase) {
    std::vector<ImpactCase> cases;
    for (const auto& [name, contact] : materials)
        for (const double value : values) {
            cases.push_back(makeCase(value, contact));
            cases.back().material = name;
        }
    return cases;
}

/// Elastic normal impact of two spheres.
inline std::vector<ImpactCase> chungOoi1() {
    const Materials materials{{"glass", scenes::ImpactMaterial::ofTwins(2800, 4.8e10, 0.20)},
                              {"limestone", scenes::ImpactMaterial::ofTwins(2500, 2.0e10, 0.25)}};
    return casesOf(materials, {10}, [](double speed, const auto& contact) {
        return ImpactCase{.contact = contact,
                          .upper = {.radius = 0.010, .velocity = {0, 0, -speed}},
                          .lower = ImpactCase::Sphere{.radius = 0.010, .velocity = {0, 0, speed}}};
    });
}

/// Elastic normal impact of a sphere on a rigid plane.
inline std::vector<ImpactCase> chungOoi2() {
    const Materials materials{{"aluminium alloy", scenes::ImpactMaterial::againstRigid(2699, 7.0e10, 0.30)},
                              {"magnesium alloy", scenes::ImpactMaterial::againstRigid(1800, 4.0e10, 0.35)}};
    return casesOf(materials, {0.2}, [](double speed, const auto& contact) {
        return ImpactCase{.contact = contact, .upper = {.radius = 0.1, .velocity = {0, 0, -speed}}};
    });
}

/// Normal impact on a rigid plane, over the restitution.
inline std::vector<ImpactCase> chungOoi3() {
    const Materials materials{{"aluminium oxide", scenes::ImpactMaterial::againstRigid(4000, 3.8e11, 0.23)},
                              {"cast iron", scenes::ImpactMaterial::againstRigid(7000, 1.0e11, 0.25)}};
    return casesOf(materials, evenly(0.1, 1, 0.05), [](double restitution, const auto& contact) {
        return ImpactCase{.contact = contact.with(restitution, 0),
                          .upper = {.radius = 2.5e-3, .velocity = {0, 0, -3.9}}};
    });
}

/// An impact of test 4, at an angle (degrees) from the normal.
inline ImpactCase obliqueImpact(double degrees, const scenes::ImpactMaterial& contact) {
    const double angle = degrees * std::numbers::pi / 180;
    return {.contact = contact,
            .upper = {.radius = 2.5e-3, .velocity = 3.9 * Vec3D(std::sin(angle), 0, -std::cos(angle))}};
}
/// The material of the spheres of Kharaz, Gorham and Salman (2001), Powder Technology 120, 281.
inline scenes::ImpactMaterial aluminiumOxideOfKharaz() {
    return scenes::ImpactMaterial::againstRigid(4000, 3.8e11, 0.23).with(0.98, 0.092);
}
/// Oblique impact on a rigid plane at one speed, over the angle.
inline std::vector<ImpactCase> chungOoi4() {
    const Materials materials{
        {"aluminium oxide", aluminiumOxideOfKharaz()},
        {"aluminium alloy", scenes::ImpactMaterial::againstRigid(2700, 7.0e10, 0.33).with(0.98, 0.092)}};
    return casesOf(materials, joined(joined(evenly(1, 12, 1), evenly(14, 30, 2)), evenly(34, 86, 4)),
                   obliqueImpact);
}

/// Oblique impact on a rigid plane at one normal speed, over the tangential speed (m/s).
inline std::vector<ImpactCase> chungOoi5() {
    const Materials materials{
        {"steel", scenes::ImpactMaterial::againstRigid(7850, 2.08e11, 0.3).with(1, 0.3)},
        {"polyethylene", scenes::ImpactMaterial::againstRigid(1400, 1.0e9, 0.4).with(1, 0.3)}};
    return casesOf(
        materials, joined(joined({0.1}, evenly(0.5, 15, 0.5)), joined(evenly(16, 25, 1), {30, 50})),
        [](double sideways, const auto& contact) {
            return ImpactCase{.contact = contact, .upper = {.radius = 1e-5, .velocity = {sideways, 0, -5}}};
        });
}

/// The spins (rad/s) of tests 6 to 8.
inline std::vector<double> spins() {
    return joined(joined({0.175}, evenly(0.25, 6, 0.25)), evenly(7, 24, 1));
}
inline ImpactCase::Sphere spinning(double spin) {
    return {.radius = 0.1, .velocity = {0, 0, -0.2}, .spin = {0, spin, 0}};
}
inline Materials alloyAndNylon() {
    return {{"aluminium alloy", scenes::ImpactMaterial::againstRigid(2700, 7.0e10, 0.33).with(0.5, 0.4)},
            {"nylon", scenes::ImpactMaterial::againstRigid(1000, 2.5e9, 0.40).with(0.5, 0.4)}};
}

/// A spinning sphere on a rigid plane.
inline std::vector<ImpactCase> chungOoi6() {
    return casesOf(alloyAndNylon(), spins(), [](double spin, const auto& contact) {
        return ImpactCase{.contact = contact, .upper = spinning(spin)};
    });
}

/// Two equal spheres with the same spin. With opposite spins, another reading of this test, nothing slips.
inline std::vector<ImpactCase> chungOoi7() {
    const Materials materials{
        {"aluminium alloy", scenes::ImpactMaterial::ofTwins(2700, 7.0e10, 0.33).with(0.5, 0.4)},
        {"copper", scenes::ImpactMaterial::ofTwins(8900, 1.2e11, 0.35).with(0.5, 0.4)}};
    return casesOf(materials, spins(), [](double spin, const auto& contact) {
        ImpactCase pair{.contact = contact, .upper = spinning(spin), .lower = spinning(spin)};
        pair.lower->velocity *= -1;
        return pair;
    });
}

/// A spinning sphere on one five times as large that is rigid and held.
inline std::vector<ImpactCase> chungOoi8() {
    return casesOf(alloyAndNylon(), spins(), [](double spin, const auto& contact) {
        return ImpactCase{.contact = contact,
                          .upper = spinning(spin),
                          .lower = ImpactCase::Sphere{.radius = 0.5, .fixed = true}};
    });
}

}  // namespace pendular::papers
