#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "Tools/View/RunFolder.h"

namespace pendular::view {

/// How a run is, in a few words for the list of runs, from its summary and its locks: id, state ("preparing",
/// "running", "waiting" in the queue of another server, "ended", "stopped", "failed", "silent"), reason, time
/// and endTime (s), healthy (null: nothing is known of it yet), grains, bytes of its folder (null: addSize()
/// sets them), changed (s since 1970, of the summary), driver.
nlohmann::ordered_json overview(const RunFiles& run, const Locks& locks);

/// Sets the bytes of the folder in an overview or in details. The server keeps sizes of folders; what is in
/// the files is read in child processes (ReadApart.h).
void addSize(nlohmann::ordered_json& overview, const RunFiles& run);

/// All that the page of a run needs but frames and tables themselves: the overview, the rows of the summary,
/// what is wrong, times of the frames, when the restart file was written (s since 1970; 0: there is none),
/// names of the tables, the maps (name, times), the end of the log, the options of its start.
nlohmann::ordered_json details(const RunFiles& run);

/// Rows of a table of the run from a place in the file (bytes) on: columns, rows (null: no number), next (the
/// place behind the last whole row), begins (whether they are the first rows: the table may have begun
/// again). Throws InputError where there is no such table.
std::string tableRows(const RunFiles& run, const std::string& table, std::uintmax_t from);

/// What a run was started with from the page; null where it was started otherwise.
nlohmann::ordered_json startOf(const RunFiles& run);
/// The last error in what a run has printed that was started from the page, as runProgram() and the command
/// line print it: of a run that could not begin, why.
std::string errorOf(const RunFiles& run);

}  // namespace pendular::view
