#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>

#include "Kernel/Base/Logger.h"

namespace pendular {

/// The levels that end a program in MercuryDPM: logger(ERROR, "text"), logger(FATAL, "text").
struct LevelThatEnds {};

/// Where the next % of a text is that stands for a value; \% is a sign of percent.
constexpr std::size_t nextPercent(std::string_view text, std::size_t from) {
    while (from < text.size() && text[from] != '%') from += text[from] == '\\' ? 2 : 1;
    return std::min(from, text.size());
}
constexpr std::size_t percentsIn(std::string_view text) {
    std::size_t count = 0;
    for (std::size_t at = nextPercent(text, 0); at < text.size(); at = nextPercent(text, at + 1)) ++count;
    return count;
}
/// The text with its values in place of the %.
[[nodiscard]] std::string withValues(std::string_view text, const std::string* values, std::size_t count);

/// A text in MercuryDPM's form: one % for each value, which the compiler checks.
template <class... Values>
struct PercentText {
    template <class Text>
    requires std::is_convertible_v<const Text&, std::string_view>
    consteval PercentText(const Text& given) : text(given) {  // NOLINT(google-explicit-constructor)
        if (sizeof...(Values) > 0 && percentsIn(text) != sizeof...(Values))
            throw "a text of MercuryScene's logger has one % for each value";
    }
    std::string_view text;
};

/// A value as MercuryDPM prints it: a Vec3D as its three numbers.
template <class Value>
std::string shownValue(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value>) return fmt::format("{}", value);
    else if constexpr (std::is_convertible_v<const Value&, std::string_view>)
        return std::string(std::string_view(value));
    else if constexpr (requires { value.x(), value.y(), value.z(); })
        return fmt::format("{} {} {}", value.x(), value.y(), value.z());
    else {
        std::ostringstream text;
        text << value;
        return text.str();
    }
}

/// MercuryDPM's logger, which writes through that of a scene or through one of its own:
/// logger(INFO, "t=%", getTime()). Its levels that end a program throw a RunError with the text.
class MercuryLogger {
public:
    MercuryLogger() = default;
    explicit MercuryLogger(Logger& of) : to(&of) {}

    template <class... Values>
    void operator()(LogLevel level, PercentText<std::type_identity_t<const Values&>...> text,
                    const Values&... values) const {
        shown()(level, "{}", textOf(text.text, values...));
    }
    template <class... Values>
    [[noreturn]] void operator()(LevelThatEnds, PercentText<std::type_identity_t<const Values&>...> text,
                                 const Values&... values) const {
        end(textOf(text.text, values...));
    }
    /// Throws a RunError with the text unless the condition holds.
    template <class... Values>
    void assert_always(bool holds, PercentText<std::type_identity_t<const Values&>...> text,
                       const Values&... values) const {
        if (!holds) end(textOf(text.text, values...));
    }
    /// The same, in every build.
    template <class... Values>
    void assert_debug(bool holds, PercentText<std::type_identity_t<const Values&>...> text,
                      const Values&... values) const {
        if (!holds) end(textOf(text.text, values...));
    }
    void setLevel(LogLevel most) { (to ? *to : own).setLevel(most); }
    [[nodiscard]] LogLevel getLevel() const { return shown().getLevel(); }

private:
    [[noreturn]] static void end(const std::string& text);
    [[nodiscard]] const Logger& shown() const { return to ? *to : own; }
    template <class... Values>
    static std::string textOf(std::string_view text, const Values&... values) {
        const std::array<std::string, sizeof...(Values)> all{shownValue(values)...};
        return withValues(text, all.data(), all.size());
    }

    Logger own;
    Logger* to = nullptr;  // none: its own
};

}  // namespace pendular
