#include "Kernel/Foundation/Base/Host.h"

#include <errno.h>

#include <atomic>
#include <mutex>
#include <utility>

namespace pendular {

namespace {

std::atomic<bool> hosted{false};
std::function<void()> interruption;
std::mutex accessToName;
std::string nameOfHost;  // empty: not given

}  // namespace

bool isHosted() { return hosted; }
void markAsHosted() { hosted = true; }

std::string programName() {
    const std::scoped_lock lock(accessToName);
    return nameOfHost.empty() ? program_invocation_short_name : nameOfHost;
}
void setProgramName(std::string name) {
    const std::scoped_lock lock(accessToName);
    nameOfHost = std::move(name);
}

void setInterruption(std::function<void()> question) { interruption = std::move(question); }
void askForInterruption() {
    if (interruption) interruption();
}

}  // namespace pendular
