#pragma once

#include <algorithm>
#include <cstddef>

#include "Kernel/Motion/ContactBound.h"
#include "Kernel/Particles/ParticleStore.h"
#include "Kernel/State/StateArchive.h"

namespace pendular {

/// A time step that follows the contacts of the scene: a share of the step that ContactBounds gives, chosen
/// anew at fixed intervals of steps, and at once when grains, walls or species have changed or anything moves
/// faster than was supposed. Between two choices contacts form and press: the bound is that of all pairs
/// which can meet by then, at the overlaps that the fastest meeting now, or at the choice before, can bring.
///
/// Nothing here depends on how contacts are listed, so that a run that goes on from a restart file takes the
/// same steps.
class AdaptiveStep {
public:
    static constexpr std::size_t interval = 25;  // steps
    static constexpr double growth = 1.3;        // at most, from one choice to the next

    /// @param shareOfBound 0 to 1; @param largestStep s; 0: that which the scene gives
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
    [[nodiscard]] bool isDue() const {
        return isSet() && stepsSince > 0 && (surprised || stepsSince >= interval);
    }

    /// For the steps until the next choice.
    struct Outlook {
        ContactOutlook contacts;
        bool isFar;  // bodies may go so far that pairs are not looked at
    };
    /// @param step s, that was; @param most s, the largest unless one was given; @param gravity m/s^2
    [[nodiscard]] Outlook lookAhead(const ParticleStore& grains, double step, double most, double gravity,
                                    double smallestRadius);
    /// The step (s) until the next choice, where grains have come: at most what any contact of theirs stands.
    /// @param step s, that is; @param most, limit as below
    [[nodiscard]] double shorten(double step, double most, double limit) const {
        return std::min({step, share * limit, largest > 0 ? largest : most});
    }
    /// The step (s) from now on.
    /// @param limit s, that of the densest bed at the largest sound overlap
    [[nodiscard]] double choose(double step, double most, const Outlook& outlook, const ContactBound& bound,
                                double limit);

    [[nodiscard]] std::size_t choiceCount() const { return choices; }
    [[nodiscard]] double smallestStep() const { return smallestChosen; }  // s
    [[nodiscard]] double largestStep() const { return largestChosen; }    // s

    void visitState(StateArchive& archive);

private:
    /// s
    [[nodiscard]] double longest(double step, double most) const {
        return std::min(growth * step, largest > 0 ? largest : most);
    }

    double share = 0, largest = 0;  // s
    std::size_t stepsSince = 0;     // the last choice
    bool surprised = true;
    double wallSpeed = 0;                             // m/s, the largest since the last choice
    double supposedSpeed = 0, supposedWallSpeed = 0;  // m/s
    double approachBefore = 0;                        // m/s, the fastest at the last choice
    std::size_t choices = 0;
    double smallestChosen = infinity, largestChosen = 0;  // s
};

}  // namespace pendular
