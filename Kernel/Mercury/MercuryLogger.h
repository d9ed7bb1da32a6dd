#pragma once

#include <algorithm>
#include <concepts>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>

#include "Kernel/Foundation/Base/Logger.h"

namespace pendular {

/// The levels that end a program in MercuryDPM: logger(ERROR, "text"), logger(FATAL, "text").
struct LevelThatEnds {};
/// Whether a line is written at once, as each is here: a value of a text that stands for none of its %.
enum class Flusher { FLUSH, NO_FLUSH };

/// Where a % of a text stands for a value, and how that is printed: %P with P digits, %P.W in a field of W
/// characters, %.W in such a field; behind P any sign of punctuation will do, as there.
struct PercentPlace {
    std::size_t begin, end;
    int precision = 0, width = 0;  // 0: not given
};

/// The next % of a text; at its end where there is none. \% is a sign of percent.
constexpr PercentPlace nextPercent(std::string_view text, std::size_t from) {
    while (from < text.size() && text[from] != '%') from += text[from] == '\\' ? 2 : 1;
    PercentPlace place{std::min(from, text.size()), std::min(from + 1, text.size())};
    const auto isDigit = [&](std::size_t at) {
        return at < text.size() && text[at] >= '0' && text[at] <= '9';
    };
    const auto number = [&](int& to) {
        for (; isDigit(place.end); ++place.end)
            if (to < 1000) to = 10 * to + (text[place.end] - '0');
    };
    number(place.precision);
    const auto isPunctuation = [&](std::size_t at) {
        return at < text.size() && std::string_view("!\"#$%&'()*+,-./:;<=>?@[\\]^_`{|}~").find(text[at]) !=
                                       std::string_view::npos;
    };
    if (isPunctuation(place.end) && isDigit(place.end + 1)) {
        ++place.end;
        number(place.width);
    }
    return place;
}
constexpr std::size_t percentsIn(std::string_view text) {
    std::size_t count = 0;
    for (PercentPlace at = nextPercent(text, 0); at.begin < text.size(); at = nextPercent(text, at.end))
        ++count;
    return count;
}
/// Adds a part of a text, in which \% is a sign of percent.
void addPlain(std::string& to, std::string_view part);

template <class Value>
inline constexpr bool isFlusher = std::is_same_v<std::remove_cvref_t<Value>, Flusher>;

/// A text in MercuryDPM's form: one % for each value, which the compiler checks.
template <class... Values>
struct PercentText {
    template <class Text>
    requires std::is_convertible_v<const Text&, std::string_view>
    consteval PercentText(const Text& given) : text(given) {  // NOLINT(google-explicit-constructor)
        constexpr std::size_t count = (std::size_t{0} + ... + (isFlusher<Values> ? 0 : 1));
        if (count > 0 && percentsIn(text) != count)
            throw "a text of MercuryScene's logger has one % for each value";
    }
    std::string_view text;
};

/// A value as MercuryDPM prints it, a Vec3D as its three numbers; all digits that it has, unless so many are
/// asked for.
template <class Value>
std::string shownValue(const Value& value, int precision = 0) {
    if constexpr (std::is_floating_point_v<Value>)
        return precision > 0 ? fmt::format("{:.{}g}", value, precision) : fmt::format("{}", value);
    else if constexpr (std::is_arithmetic_v<Value>) return fmt::format("{}", value);
    else if constexpr (std::is_convertible_v<const Value&, std::string_view>)
        return std::string(std::string_view(value));
    else if constexpr (requires { value.x(), value.y(), value.z(); })
        return fmt::format("{} {} {}", shownValue(value.x(), precision), shownValue(value.y(), precision),
                           shownValue(value.z(), precision));
    else {
        std::ostringstream text;
        if (precision > 0) text.precision(precision);
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
        std::string all;
        std::size_t from = 0;
        (addValue(all, text, from, values), ...);
        addPlain(all, text.substr(from));
        return all;
    }
    /// Adds the text up to its next %, and the value in its place.
    template <class Value>
    static void addValue(std::string& all, std::string_view text, std::size_t& from, const Value& value) {
        if constexpr (!isFlusher<Value>) {
            const PercentPlace place = nextPercent(text, from);
            addPlain(all, text.substr(from, place.begin - from));
            all += fmt::format("{:<{}}", shownValue(value, place.precision), place.width);
            from = place.end;
        }
    }

    Logger own;
    Logger* to = nullptr;  // none: its own
};

}  // namespace pendular
