#pragma once

#include <functional>
#include <numbers>
#include <string_view>
#include <vector>

#include "Kernel/Foundation/Math/CountedRandom.h"
#include "Tools/Reference/ElasticImpact.h"

// Paths of overlap and slip on which friction laws are compared with the exact contact.

namespace pendular::friction {

/// One contact for all paths that are given: only the slip times stiffness ratio / friction over the overlap
/// counts (PartialSlipConditions), so these values are not special.
inline constexpr PartialSlipConditions contact{1e-3, 1e9, 0.2e9, 0.3};
inline constexpr double deepest = 1e-6;  // m

/// The slip (m) at which all slips under the load of an overlap: 3 mu P / (16 G* a).
inline double fullSlip(double overlap = deepest) {
    return 3 * contact.friction * contact.normalForce(overlap) /
           (16 * contact.shearModulus * contact.contactRadius(overlap));
}

/// The place of a contact at a time between 0 and 1: overlap (m) and slip since the start (m).
struct Place {
    double overlap;
    Vector<double> slip;
};
using Path = std::function<Place(double)>;
inline constexpr int movesOfPath = 4000;

/// Calls each(overlap, slip of the move) along a path.
template <class Each>
void follow(const Path& path, Each&& each) {
    Place before = path(0);
    each(before.overlap, Vector<double>{0, 0, 0});
    for (int k = 1; k <= movesOfPath; ++k) {
        const Place now = path(static_cast<double>(k) / movesOfPath);
        each(now.overlap, now.slip - before.slip);
        before = now;
    }
}

inline double wave(double turns) { return std::sin(2 * std::numbers::pi * turns); }

/// A slip that swings four times, of an amplitude (over the full slip), under an overlap that swings by a
/// part of its mean.
inline Path oscillation(double amplitude, double variation, double turnsOfLoad, double phase) {
    return [=](double time) {
        const double mean = 1 / (1 + variation);
        return Place{deepest * mean * (1 + variation * wave(turnsOfLoad * time + phase)),
                     {amplitude * fullSlip() * wave(4 * time), 0, 0}};
    };
}
/// A slip that swings four times, under an overlap that grows from nothing.
inline Path oscillationWhileLoaded(double amplitude) {
    return [=](double time) {
        return Place{deepest * time, {amplitude * fullSlip() * wave(4 * time), 0, 0}};
    };
}
/// A sphere with a slip that friction stops: it rolls from then on, and swings in its contact.
inline Path rollingStart(double way, double swing) {
    return [=](double time) {
        const double slides = std::min(time / 0.5, 1.0), rolls = std::max(time - 0.5, 0.0);
        return Place{deepest, {fullSlip() * (way * slides * (2 - slides) + swing * wave(6 * rolls)), 0, 0}};
    };
}
/// Straight lines between random loads and slips in the plane, twenty of them.
inline Path randomWalk(double amplitude, double variation, const CountedRandom& random,
                       std::uint64_t identity) {
    constexpr int lines = 20;
    std::vector<Place> corners;
    for (std::uint32_t k = 0; k <= lines; ++k) {
        const double depth = 1 - variation * random.uniform(identity, 1, k);
        corners.push_back({deepest * depth,
                           {amplitude * fullSlip() * random.uniform(-1, 1, identity, 2, k),
                            amplitude * fullSlip() * random.uniform(-1, 1, identity, 3, k), 0}});
    }
    return [corners](double time) {
        const int line = std::min(static_cast<int>(time * lines), lines - 1);
        const double part = time * lines - line;
        const auto k = static_cast<std::size_t>(line);
        return Place{corners[k].overlap + part * (corners[k + 1].overlap - corners[k].overlap),
                     corners[k].slip + part * (corners[k + 1].slip - corners[k].slip)};
    };
}

struct PathPopulation {
    std::string_view name, text;
    std::function<Path(const CountedRandom&, std::uint64_t)> draw;
};

/// Amplitudes are over the full slip, from a tenth of it to twice, evenly in their logarithm.
inline std::vector<PathPopulation> pathPopulations() {
    const auto amplitude = [](const CountedRandom& random, std::uint64_t identity) {
        return 0.1 * std::pow(20, random.uniform(identity, 0));
    };
    return {{"constant load", "slip swings under constant load",
             [=](const auto& random, auto identity) {
                 return oscillation(amplitude(random, identity), 0, 0, 0);
             }},
            {"growing load", "slip swings while the overlap grows from nothing",
             [=](const auto& random, auto identity) {
                 return oscillationWhileLoaded(amplitude(random, identity));
             }},
            {"swinging load", "slip and load swing, the overlap by up to 0.9 of its mean, up to 16 times",
             [=](const auto& random, auto identity) {
                 return oscillation(amplitude(random, identity), random.uniform(0, 0.9, identity, 1),
                                    random.uniform(1, 16, identity, 2), random.uniform(identity, 3));
             }},
            {"rolling start", "a sliding sphere begins to roll, and swings in its contact",
             [=](const auto& random, auto identity) {
                 return rollingStart(random.uniform(2, 10, identity, 1), amplitude(random, identity));
             }},
            {"random walk", "load and slip go along random lines in the plane",
             [=](const auto& random, auto identity) {
                 return randomWalk(amplitude(random, identity), random.uniform(0, 0.95, identity, 4), random,
                                   identity);
             }}};
}

/// The elastic impact of a sphere with a slip psi mu / kappa times the speed of approach (Maw, Barber and
/// Fawcett (1976), Wear 38, 101); it slides throughout from psi = 7 kappa - 1 on.
struct ImpactOfSlip {
    double stiffnessRatio;  // kappa
    double psi;

    [[nodiscard]] ElasticImpact impact() const {
        PartialSlipConditions conditions = contact;
        conditions.shearModulus = 0.25 * stiffnessRatio * conditions.elasticModulus;
        return {.conditions = conditions, .mass = 1e-5, .approach = 0.1};
    }
    [[nodiscard]] double slip() const {  // m/s
        return psi * contact.friction / stiffnessRatio * impact().approach;
    }
    /// What friction takes of the slip at most, m/s: see papers::ImpactCase.
    [[nodiscard]] double slipTaken() const {
        return std::min(slip(), 7 * contact.friction * impact().approach);
    }
};
inline constexpr int stepsOfImpact = 2000;

/// kappa of two bodies of one material, nu from 0.5 to 0, and psi evenly up to where all slide.
inline ImpactOfSlip drawImpact(const CountedRandom& random, std::uint64_t identity) {
    const double ratio = random.uniform(2.0 / 3.0, 1, identity, 0);
    return {ratio, random.uniform(0.02, 7 * ratio, identity, 1)};
}

}  // namespace pendular::friction
