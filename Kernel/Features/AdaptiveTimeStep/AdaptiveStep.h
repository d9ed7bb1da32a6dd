#pragma once

#include <algorithm>
#include <cstddef>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Features/AdaptiveTimeStep/ContactBound.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// A time step that follows the contacts of the scene: a share of the step that ContactBounds gives, chosen
/// anew at fixed intervals of steps. The bound is that of all pairs which touch or are near to it, at the
/// overlaps that they can reach by then by themselves, half as much again; pairs that others press are
/// supposed to have the mean. It is chosen at once when grains, walls or species have changed, when anything
/// moves faster than was supposed, and when a contact is pressed deeper than any was supposed to be: a step
/// that is too long is taken once, in which nothing can grow.
///
/// Nothing here depends on how contacts are listed, so that a run that goes on from a restart file takes the
/// same steps.
class AdaptiveStep {
public:
    static constexpr std::size_t interval = 50;  // steps
    static constexpr double growth = 1.3;        // at most, from one choice to the next
    static constexpr double margin = 1.5;        // on overlaps that are supposed: 10 % of Hertz's frequency
    static constexpr double memory = 0.9;  // the largest is supposed to be at least this of the last one
    /// Pairs up to so far apart may come to touch until the next choice, and bodies move at most so far in a
    /// step, in smallest radii. Faster ones meet unseen, in one step of which they overlap by no more.
    static constexpr double nearness = 0.05;

    /// @param shareOfBound 0 to 1; @param largestStep s, besides that which the scene gives; 0: no other
    void set(double shareOfBound, double largestStep) {
        share = shareOfBound;
        largest = largestStep;
    }
    [[nodiscard]] bool isSet() const { return share > 0; }
    [[nodiscard]] bool hasChosen() const { return choices > 0; }

    /// Bodies or laws have changed: a step is chosen before the next one.
    void chooseAnew() { surprised = true; }
    /// How far (m) the farthest grain and wall moved in a step of this length (s).
    void moved(double grainShift, double wallShift, double length) {
        if (!isSet() || !(length > 0)) return;
        ++stepsSince;
        const double wall = wallShift / length;
        wallSpeed = std::max(wallSpeed, wall);
        surprised |= grainShift > supposedSpeed * length || wall > supposedWallSpeed;
    }
    /// A contact is pressed deeper than was supposed.
    void noteDeeperOverlap() { surprised = true; }
    [[nodiscard]] bool isDue() const {
        return isSet() && stepsSince > 0 && (surprised || stepsSince >= interval);
    }

    /// What is expected of the steps until the next choice.
    struct Outlook {
        ContactOutlook contacts;
        double longest;  // s, in which bodies move as far as they may in a step
        [[nodiscard]] bool isKnown() const { return longest > 0; }  // not of an endless wall that tilts
    };
    /// @param step s, that was; @param most s, the largest; @param gravity m/s^2; @param reach m, at which
    /// two grains act on each other at most; @param smallestRadius m; @param shapes null of spheres; @param
    /// ranks that share the grains
    [[nodiscard]] Outlook lookAhead(const ParticleStore& grains, const PeriodicBox& box, double step,
                                    double most, double gravity, double reach, double smallestRadius,
                                    const GrainShapes* shapes, const AllRanks& ranks = {});
    /// The step (s) until the next choice, where grains have come: at most what any contact of theirs stands.
    /// @param step s, that is; @param most, limit as below
    [[nodiscard]] double shorten(double step, double most, double limit) const {
        return std::min({step, share * limit, longest(step, most)});
    }
    /// The step (s) from now on.
    /// @param limit s, that of the densest bed at the largest sound overlap, for what is not known
    [[nodiscard]] double choose(double step, double most, const Outlook& outlook, const ContactBound& bound,
                                double limit);
    /// The overlap, over the effective radius, above which one is a surprise. Infinite before the first
    /// choice.
    [[nodiscard]] double supposedOverlap() const { return overlap; }

    [[nodiscard]] std::size_t choiceCount() const { return choices; }
    [[nodiscard]] double smallestStep() const { return smallestChosen; }  // s
    [[nodiscard]] double largestStep() const { return largestChosen; }    // s

    void visitState(StateArchive& archive);

private:
    /// s
    [[nodiscard]] double longest(double step, double most) const {
        return std::min({growth * step, most, largest > 0 ? largest : infinity});
    }

    double share = 0, largest = 0;  // s
    std::size_t stepsSince = 0;     // the last choice
    bool surprised = true;
    double wallSpeed = 0;                             // m/s, the largest since the last choice
    double supposedSpeed = 0, supposedWallSpeed = 0;  // m/s
    double overlap = infinity;                        // of the effective radius, supposed for all contacts
    std::size_t choices = 0;
    double smallestChosen = infinity, largestChosen = 0;  // s
};

}  // namespace pendular
