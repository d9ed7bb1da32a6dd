#include "Kernel/Foundation/Base/Logger.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <mutex>
#include <utility>

#include "Kernel/Foundation/Base/SilentRank.h"

namespace pendular {

namespace {

std::mutex access;
std::shared_ptr<const LogSink> chosen;  // null: standard error

std::shared_ptr<const LogSink> chosenSink() {
    const std::scoped_lock lock(access);
    return chosen;
}

}  // namespace

void setLogSink(LogSink sink) {
    auto next = sink ? std::make_shared<const LogSink>(std::move(sink)) : nullptr;
    const std::scoped_lock lock(access);
    chosen.swap(next);
}

bool hasLogSink() { return chosenSink() != nullptr; }

// fmt::print would throw where it cannot write.
void writeToLog(std::string_view text, LogLevel level) noexcept {
    if (isSilentRank()) return;
    try {
        if (const auto sink = chosenSink()) {
            if (text.ends_with('\n')) text.remove_suffix(1);
            return (*sink)(level, text);
        }
    } catch (...) {
        return;
    }
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
    std::clearerr(stderr);
}

/// Without the full stop: a summary has a sentence without it. Several threads of a driver may warn at once.
void Logger::remember(std::string_view warning) const {
    constexpr std::size_t most = 100;
    static std::mutex access;
    const std::scoped_lock lock(access);
    if (warning.ends_with('.')) warning.remove_suffix(1);
    if (given.size() < most && std::ranges::find(given, warning) == given.end()) given.emplace_back(warning);
}

void Logger::write(LogLevel level, std::string line) {
    // A sink is told the level.
    if (level == LogLevel::Warn && !hasLogSink()) line.insert(0, "Warning: ");
    writeToLog(line += '\n', level);
}

}  // namespace pendular
