#include "Kernel/Core/Run/Progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <limits>
#include <string>
#include <utility>

#include "Kernel/Foundation/Base/Logger.h"

namespace pendular {

namespace {

/// Characters in a line of the terminal; 80 where it does not say.
std::size_t terminalWidth() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

Progress::Progress(std::string ofWhat, double endTime, double time, std::size_t step)
    : name(std::move(ofWhat)),
      end(endTime),
      firstTime(time),
      firstStep(step),
      nextLook(step),
      sunk(hasLogSink()),
      terminal(!sunk && isatty(STDERR_FILENO) == 1),
      interval(terminal || sunk ? std::chrono::milliseconds(250) : std::chrono::minutes(1)),
      nextShown(started + interval) {}

Progress::~Progress() { endLine(); }

void Progress::endLine() {
    if (terminal && shown) writeToLog("\n");
    shown = false;
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
    const double left = part > 0 ? std::max(elapsed * (1 - part) / part, 0.0) : 0;
    const double rate = static_cast<double>(step - firstStep) / elapsed;
    // The most important part comes first: on the terminal the rest is left out, as a line that wraps cannot
    // be renewed.
    const std::size_t width = terminal ? terminalWidth() - 1 : std::numeric_limits<std::size_t>::max();
    std::string line = fmt::format("{:5.1f} %", end > 0 ? 100 * time / end : 100);
    if (!name.empty() && name.size() + 2 + line.size() <= width) line = name + "  " + line;
    for (const std::string& part :
         {fmt::format("{:.4g} of {:.4g} s", time, end), fmt::format("{:.0f} s left", left),
          fmt::format("{:.3g} steps/s", rate),
          fmt::format("{:.3g} million particle steps/s", 1e-6 * rate * static_cast<double>(numbers.grains)),
          fmt::format("{} contacts", numbers.contacts), fmt::format("{:.3g} J", numbers.kineticEnergy)}) {
        if (line.size() + 2 + part.size() > width) break;
        line += "  " + part;
    }
    if (terminal) line.resize(width, ' ');
    writeToLog(terminal ? "\r" + line : line + "\n", LogLevel::Progress);
    shown = true;
}

}  // namespace pendular
