#include "Kernel/Base/Host.h"

#include <atomic>
#include <utility>

namespace pendular {

namespace {

std::atomic<bool> hosted{false};
std::function<void()> interruption;

}  // namespace

bool isHosted() { return hosted; }
void markAsHosted() { hosted = true; }

void setInterruption(std::function<void()> question) { interruption = std::move(question); }
void askForInterruption() {
    if (interruption) interruption();
}

}  // namespace pendular
