#pragma once

#include <fmt/format.h>

#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace pendular {

/// How much a user has to read it; a level shows itself and those before it. Progress is of no logger: how
/// far a run is, a line that stands for the one before.
enum class LogLevel { None, Warn, Info, Verbose, Debug, Progress };

/// A function that takes each text of the log, without the end of its last line.
using LogSink = std::function<void(LogLevel, std::string_view)>;

/// From now on the log of the whole program (loggers, warnings, progress, summaries) goes to this function
/// instead of standard error, and to standard error again for an empty one. It is called by the thread that
/// runs the scene, by several at a time where several scenes run; what it throws is lost.
void setLogSink(LogSink sink);
[[nodiscard]] bool hasLogSink();

/// Writes a text to the log: standard error, or what setLogSink() was given. What cannot be written there (a
/// full disk, a closed pipe) is lost: a log never ends a run. Silent ranks (SilentRank.h) write nothing.
void writeToLog(std::string_view text, LogLevel level = LogLevel::Info) noexcept;

/// The text of a line, in the form of fmt, which the compiler checks against the values: a {} for each of
/// them. MercuryDPM's % does not compile.
template <class... Values>
struct LogText {
    template <class Text>
    requires std::is_convertible_v<const Text&, std::string_view>
    consteval LogText(const Text& given) : text(given) {  // NOLINT(google-explicit-constructor)
        if (sizeof...(Values) > 0 && std::string_view(given).find('{') == std::string_view::npos)
            throw "a log text has a {} for each value, where MercuryDPM has a %";
    }
    fmt::format_string<Values...> text;
};

/// Lines for the user of a run, in the log: logger(INFO, "{} grains", number).
class Logger {
public:
    template <class... Values>
    void operator()(LogLevel level, LogText<std::type_identity_t<const Values&>...> text,
                    const Values&... values) const {
        if (level != LogLevel::Warn && !shows(level)) return;
        try {
            std::string line = fmt::format(text.text, values...);
            if (level == LogLevel::Warn) remember(line);
            show(level, std::move(line));
        } catch (const std::exception&) {}  // no memory: the line is lost, not the run
    }
    /// Shows a line that is not remembered: a warning that the summary of a run words by itself.
    void show(LogLevel level, std::string line) const {
        if (shows(level)) write(level, std::move(line));
    }
    /// The warnings that it was given, also those that a quiet logger did not show, each once: the summary of
    /// a run has them. No more than the first hundred.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return given; }
    /// Shows lines up to this level. Info at first; None: none.
    void setLevel(LogLevel most) { shown = most; }
    [[nodiscard]] LogLevel getLevel() const { return shown; }
    /// Shows nothing, whatever the level.
    void setQuiet(bool beQuiet) { quiet = beQuiet; }
    [[nodiscard]] bool isQuiet() const { return quiet; }

private:
    [[nodiscard]] bool shows(LogLevel level) const {
        return !quiet && level <= shown && level != LogLevel::None;
    }
    void remember(std::string_view warning) const;
    static void write(LogLevel level, std::string line);

    LogLevel shown = LogLevel::Info;
    bool quiet = false;
    mutable std::vector<std::string> given;
};

}  // namespace pendular
