#pragma once

#include <functional>
#include <string>
#include <vector>

#include "Tools/View/Request.h"
#include "Tools/View/RunFolder.h"

namespace pendular::view {

// What is in the files of runs is read in child processes (Kernel/Foundation/Files/ReadingProcess.h), which
// take no lock that another thread of the server may hold: not of the queue, of frames, or of sizes of
// folders. A file that ends the child, or needs too much memory, costs one answer; the memory of the server
// stays as it was.

/// The answer, or the sentence of what was thrown, but for want of memory.
Reply replyOf(const std::function<Reply()>& compute);

/// The same, computed in a child.
/// @param memory bytes that it may take
Reply readApart(std::size_t memory, const std::function<Reply()>& compute);

/// The overview (RunState.h) of each run, as JSON; empty for those that are gone. A run whose files cannot be
/// read says so in its own overview.
std::vector<std::string> overviewsApart(std::size_t memory, const RunFolder& runs,
                                        const std::vector<std::string>& ids);

}  // namespace pendular::view
