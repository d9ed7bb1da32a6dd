#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "Kernel/Core/Step/SummaryRows.h"

namespace pendular {

/// The first rows of a summary: which program runs, and how far it is, or how it ended.
struct RunStatus {
    std::string state, reason;                   // one of the words below; why it has stopped
    double time = 0, endTime = 0, timeStep = 0;  // s
    std::size_t steps = 0;

    static constexpr const char *onItsWay = "on its way", *atItsEnd = "at its end",
                                *wasAskedToStop = "asked to stop", *hasFailed = "stopped by an error";

    void addTo(SummaryRows& rows) const;
};

/// NAME-summary.csv of a run that has no RunSummary: program, state, time, number of grains and warnings. It
/// is written at the start, at outputs, once a second at most, and at the end, so that every run says how it
/// ended. Where it cannot be written, the run goes on. RunSummary writes the same and more.
class RunStatusFile {
public:
    explicit RunStatusFile(const std::string& run);
    /// Whether an interim state is to be written.
    [[nodiscard]] bool isDue() const;
    /// Whether an interim state was written last.
    [[nodiscard]] bool isOpen() const { return open; }
    /// Throws InputError.
    void write(const SummaryRows& rows, bool isInterim);

private:
    using Clock = std::chrono::steady_clock;

    std::filesystem::path path;
    Clock::time_point next = Clock::now();
    bool open = false;
};

/// The program that wrote the summary of this run (its setName()); empty where nothing tells.
std::string programOfSummary(const std::string& run);

}  // namespace pendular
