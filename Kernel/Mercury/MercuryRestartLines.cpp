#include "Kernel/Mercury/MercuryRestartLines.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pendular {

std::string shownName(std::string_view word) {
    const bool isName =
        word.size() <= 80 && std::ranges::all_of(word, [](char c) {
            return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
        });
    return isName ? std::string(word) : shown(word);
}

/// Of a line: those of a wall of many planes have some thousands.
static constexpr std::size_t mostWords = 1'000'000;

bool MercuryRestartLines::next() {
    words.clear();
    while (words.empty() && at < file->text.size()) {
        const std::size_t end = std::min(file->text.find('\n', at), file->text.size());
        Words row(std::string_view(file->text).substr(at, end - at));
        at = end + 1;
        ++line;
        for (std::string_view word = row.next(); !word.empty(); word = row.next()) {
            if (words.size() == mostWords)
                refuse(fmt::format("it has more than {} words, which no line has", mostWords));
            words.push_back(word);
        }
    }
    return !words.empty();
}

void MercuryRestartLines::require() {
    if (!next()) refuse("the file ends here");
}

void MercuryRestartLines::refuse(std::string_view reason) const { file->refuse("line", line, reason); }

std::optional<std::size_t> MercuryRestartLines::behind(std::string_view word) const {
    const auto found = std::ranges::find(words, word);
    if (found == words.end()) return std::nullopt;
    return static_cast<std::size_t>(found - words.begin()) + 1;
}

std::optional<std::size_t> MercuryRestartLines::behindLast(std::string_view word) const {
    for (std::size_t k = words.size(); k > 0; --k)
        if (words[k - 1] == word) return k;
    return std::nullopt;
}

std::size_t MercuryRestartLines::countAt(std::size_t place) const {
    std::size_t count = 0;
    for (double unused = 0; place + count < words.size() && parseNumber(words[place + count], unused);)
        ++count;
    return count;
}

double MercuryRestartLines::parameterAt(std::size_t place) const {
    double value = 0;
    if (place >= words.size()) refuse("a number is missing at its end");
    if (!parseNumber(words[place], value)) refuse(whyNoNumber(words[place]));
    return value;
}

std::string MercuryRestartLines::keywordOf(std::size_t place) const {
    for (double unused = 0; place > 0 && parseNumber(words[place - 1], unused);) --place;
    return place > 0 ? shownName(words[place - 1]) : std::string("a number");
}

double MercuryRestartLines::numberAt(std::size_t place) const {
    const double value = parameterAt(place);
    if (!std::isfinite(value)) refuse(fmt::format("{} is {}; it must be finite", keywordOf(place), value));
    return value;
}

std::uint64_t MercuryRestartLines::wholeAt(std::size_t place) const {
    const double found = numberAt(place);
    if (!(found >= 0 && found < 1e9 && found == std::floor(found)))
        refuse(fmt::format("{} is {}; it must be a whole number from 0 to 1e9", keywordOf(place), found));
    return static_cast<std::uint64_t>(found);
}

Vec3D MercuryRestartLines::vectorAt(std::size_t place) const {
    return {numberAt(place), numberAt(place + 1), numberAt(place + 2)};
}

double MercuryRestartLines::value(std::string_view word, std::optional<double> standard) const {
    if (const auto place = behind(word)) return numberAt(*place);
    if (!standard) refuse(fmt::format("'{}' is missing", word));
    return *standard;
}

std::uint64_t MercuryRestartLines::count(std::string_view word, std::optional<std::uint64_t> standard) const {
    if (const auto place = behind(word)) return wholeAt(*place);
    if (!standard) refuse(fmt::format("'{}' is missing", word));
    return *standard;
}

Vec3D MercuryRestartLines::vector(std::string_view word, std::optional<Vec3D> standard) const {
    const auto place = behind(word);
    if (place) return vectorAt(*place);
    if (!standard) refuse(fmt::format("'{}' is missing", word));
    return *standard;
}

Vec3D MercuryRestartLines::spin(std::string_view word) const {
    const auto place = behind(word);
    if (!place) return Vec3D::Zero();
    const Vec3D found = vectorAt(*place);
    if (countAt(*place) > 3 && (found != Vec3D::Zero() || numberAt(*place + 3) != 0))
        refuse(fmt::format("{} has {} numbers; it must have 3, in rad/s", word, countAt(*place)));
    return found;
}

Vec3D MercuryRestartLines::turnedAt(std::size_t place, const Vec3D& vector) const {
    if (countAt(place) != 4)
        refuse(fmt::format("an orientation has {} numbers; it must have 4, those of a quaternion",
                           countAt(place)));
    const Eigen::Quaterniond turn(numberAt(place), numberAt(place + 1), numberAt(place + 2),
                                  numberAt(place + 3));
    if (!(turn.norm() > 0)) refuse("an orientation is 0 0 0 0, which is no turn");
    Vec3D turned = turn.normalized() * vector;
    // 15 digits of four numbers: what is less than a few units of the last one is a direction along an axis.
    for (double& part : turned)
        if (std::abs(part) < 4e-15 * vector.norm()) part = 0;
    return turned;
}

Vec3D MercuryRestartLines::directionAt(std::size_t place) const {
    return turnedAt(place, Vec3D::UnitX()).normalized();
}

void MercuryRestartLines::refuseOthers(std::string_view what,
                                       std::initializer_list<std::string_view> known) const {
    for (std::size_t k = 1; k < words.size(); ++k) {
        double value = 0;
        if (parseNumber(words[k], value) || std::ranges::count(known, words[k]) > 0) continue;
        const std::size_t count = countAt(k + 1);
        for (std::size_t n = 0; n < count && value == 0; ++n) value = parameterAt(k + 1 + n);
        if (value == 0 && count > 0) continue;
        refuse(fmt::format("{} has '{}'{}, which is not taken over", what, shownName(words[k]),
                           count > 0 ? fmt::format(" = {}", value) : std::string()));
    }
}

}  // namespace pendular
