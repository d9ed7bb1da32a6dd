#include "Kernel/Base/Host.h"

#include <atomic>

namespace pendular {

namespace {

std::atomic<bool> hosted{false};

}  // namespace

bool isHosted() { return hosted; }
void markAsHosted() { hosted = true; }

}  // namespace pendular
