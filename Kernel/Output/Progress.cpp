#include "Kernel/Output/Progress.h"

#include <fmt/format.h>
#include <unistd.h>

namespace pendular {

Progress::Progress(double endTime, double time, std::size_t step)
    : end(endTime),
      firstTime(time),
      firstStep(step),
      nextLook(step),
      terminal(isatty(STDERR_FILENO) == 1),
      interval(terminal ? std::chrono::milliseconds(250) : std::chrono::minutes(1)),
      nextShown(started + interval) {}

Progress::~Progress() {
    if (terminal && shown) fmt::print(stderr, "\n");
}

bool Progress::isDue(std::size_t step) {
    if (step < nextLook) return false;
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - started).count();
    nextLook =
        step + 1 + static_cast<std::size_t>(0.05 * static_cast<double>(step - firstStep) / (elapsed + 1e-3));
    return now >= nextShown;
}

void Progress::print(double time, std::size_t step, const RunNumbers& numbers) {
    const double elapsed = std::chrono::duration<double>(Clock::now() - started).count();
    const double part = end > firstTime ? (time - firstTime) / (end - firstTime) : 1;
    const double left = part > 0 ? elapsed * (1 - part) / part : 0;
    const double rate = static_cast<double>(step - firstStep) / elapsed;
    fmt::print(
        stderr,
        "{}{:5.1f} %  {:.4g} of {:.4g} s  {:.3g} steps/s  {:.3g} million particle steps/s  {} contacts  "
        "{:.3g} J  {:.0f} s left{}",
        terminal ? "\r" : "", end > 0 ? 100 * time / end : 100, time, end, rate,
        1e-6 * rate * static_cast<double>(numbers.grains), numbers.contacts, numbers.kineticEnergy, left,
        terminal ? "   " : "\n");
    shown = true;
}

}  // namespace pendular
