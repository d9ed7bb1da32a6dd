#pragma once

#include <chrono>
#include <optional>

#include "Kernel/Scene/OutputForm.h"

namespace pendular {

class Scene;

/// NAME-summary.csv, rewritten at outputs, once a second at most, and at the end: what runs, with which
/// species and values, how far it is, where its time went, and what tells whether it is healthy.
/// The program summary shows it. At the end of a run, whatever ended it, it is printed on standard error as
/// well, except for the species, and with it what the laws were not made for; a quiet scene prints nothing.
/// Given to Simulation::addOutput(); the time by part of the step is measured from then on.
///
/// Times are those of this program; all else is of the scene since it began, also before a restart.
class RunSummary : public RemembersNothing {
public:
    /// Only the file: nothing is printed at the end.
    [[nodiscard]] RunSummary withoutPrinting() const {
        RunSummary other = *this;
        other.prints = false;
        return other;
    }
    void prepare(Scene& scene);
    void write(const Scene& scene);
    void complete(const Scene& scene);

private:
    using Clock = std::chrono::steady_clock;

    bool prints = true;
    Clock::time_point next = Clock::now();
    std::optional<Clock::time_point> written;  // the last one
};

}  // namespace pendular
