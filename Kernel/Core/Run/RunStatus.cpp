#include "Kernel/Core/Run/RunStatus.h"

#include <system_error>

#include "Kernel/Core/Run/SummaryFile.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

void RunStatus::addTo(SummaryRows& rows) const {
    rows.add("program", programName());
    rows.add("state", state);
    if (!reason.empty()) rows.add("reason", reason);
    rows.addNumber("time", time, "s");
    rows.addNumber("end time", endTime, "s");
    rows.add("steps", steps);
    rows.addNumber("time step", timeStep, "s");
}

RunStatusFile::RunStatusFile(const std::string& run) : path(SummaryFile::pathOf(run)) {}

bool RunStatusFile::isDue() const { return Clock::now() >= next; }

void RunStatusFile::write(const SummaryRows& rows, bool isInterim) {
    next = Clock::now() + std::chrono::seconds(1);
    CsvFile file(path, "quantity,value,unit");
    rows.write(file);
    file.close();
    open = isInterim;
}

std::string programOfSummary(const std::string& run) {
    const std::filesystem::path path = SummaryFile::pathOf(run);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return {};
    try {
        const SummaryFile summary(path);
        for (const SummaryFile::Row& row : summary.rows())
            if (row.quantity == "program") return row.value;
    } catch (const InputError&) {}  // it is no summary
    return {};
}

}  // namespace pendular
