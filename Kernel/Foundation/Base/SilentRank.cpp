#include "Kernel/Foundation/Base/SilentRank.h"

#include <atomic>

namespace pendular {

namespace {

std::atomic<bool> programIsSilent{false};
thread_local bool threadIsSilent = false;

}  // namespace

bool isSilentRank() { return threadIsSilent || programIsSilent.load(std::memory_order_relaxed); }
void setSilentThread(bool silent) { threadIsSilent = silent; }
void setSilentProgram() { programIsSilent = true; }

}  // namespace pendular
