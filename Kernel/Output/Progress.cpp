#include "Kernel/Output/Progress.h"

#include <fmt/format.h>
#include <unistd.h>

namespace pendular {

Progress::Progress(double endTime) : end(endTime), terminal(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (shown) fmt::print(stderr, "\n");
}

void Progress::update(double time, std::size_t step) {
    if (!terminal || step < nextLook) return;
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - started).count();
    // Look at the clock some twenty times a second.
    nextLook = step + 1 + static_cast<std::size_t>(0.05 * static_cast<double>(step) / (elapsed + 1e-3));
    if (now - lastShown < std::chrono::milliseconds(250)) return;
    lastShown = now;
    shown = true;
    const double part = end > 0 ? time / end : 1;
    const double left = part > 0 ? elapsed * (1 - part) / part : 0;
    fmt::print(stderr, "\r{:5.1f} %  time {:.4g} of {:.4g} s  {:.3g} steps/s  {:.0f} s left   ", 100 * part,
               time, end, static_cast<double>(step) / elapsed, left);
}

}  // namespace pendular
