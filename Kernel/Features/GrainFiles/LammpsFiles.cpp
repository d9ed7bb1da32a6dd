#include "Kernel/Features/GrainFiles/LammpsFiles.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pendular {

WordLines::WordLines(const InputFile& of, std::size_t offset) : file(&of), rest(of.text) {
    rest.remove_prefix(offset);
    number = static_cast<std::size_t>(
        std::count(of.text.begin(), of.text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

bool WordLines::next() {
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        std::string_view text = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        ++number;
        const std::size_t hash = std::min(text.find('#'), text.size());
        behindHash = text.substr(std::min(hash + 1, text.size()));
        Words words(text.substr(0, hash));
        all.clear();
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) all.push_back(word);
        if (!all.empty()) return true;
    }
    all.clear();
    return false;
}

bool WordLines::beginsWithLetter() const {
    const char first = all.front().front();
    return (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
}

std::int64_t WordLines::whole(std::size_t word) const {
    if (word >= all.size()) refuse("a whole number is missing");
    std::int64_t value = 0;
    const auto [end, problem] = std::from_chars(all[word].data(), all[word].data() + all[word].size(), value);
    if (problem != std::errc{} || end != all[word].data() + all[word].size())
        refuse(fmt::format("'{}' is not a whole number", shown(all[word])));
    return value;
}

double WordLines::finite(std::size_t word) const {
    if (word >= all.size()) refuse("a number is missing");
    double value = unset;
    if (!parseNumber(all[word], value)) refuse(whyNoNumber(all[word]));
    if (!std::isfinite(value)) refuse(fmt::format("the number {} is not finite", shown(all[word])));
    return value;
}

double WordLines::length(std::size_t word) const {
    if (word >= all.size()) refuse("a number is missing");
    double value = unset;
    if (const std::string reason = parseLength(all[word], 1, value); !reason.empty()) refuse(reason);
    return value;
}

Vec3D WordLines::vector(std::size_t first) const {
    return {finite(first), finite(first + 1), finite(first + 2)};
}

void NumberedGrains::add(const WordLines& where, std::int64_t number, const GrainRow& grain) {
    if (!radiusRange.contains(grain.radius))
        where.refuse(fmt::format("the radius {} m must be {}", grain.radius, radiusRange.text("m")));
    if (isSet(grain.density) && !positive.contains(grain.density))
        where.refuse(fmt::format("the density {} kg/m^3 must be {}", grain.density, positive.text("kg/m^3")));
    grains.push_back({number, grain});
}

void NumberedGrains::sort(const InputFile& file) {
    std::stable_sort(grains.begin(), grains.end(),
                     [](const Numbered& a, const Numbered& b) { return a.number < b.number; });
    const auto twice =
        std::adjacent_find(grains.begin(), grains.end(),
                           [](const Numbered& a, const Numbered& b) { return a.number == b.number; });
    if (twice != grains.end()) file.refuse(fmt::format("has grain {} twice", twice->number));
}

std::vector<GrainRow> NumberedGrains::rows() const {
    std::vector<GrainRow> all;
    for (const Numbered& each : grains) all.push_back(each.grain);
    return all;
}

GrainRow* NumberedGrains::find(std::int64_t number) {
    const auto found = std::lower_bound(grains.begin(), grains.end(), number,
                                        [](const Numbered& a, std::int64_t b) { return a.number < b; });
    return found != grains.end() && found->number == number ? &found->grain : nullptr;
}

void refuseOtherUnits(const InputFile& file, std::string_view units) {
    if (units == "si") return;
    file.refuse(
        fmt::format("is in the units '{}' of LAMMPS; only 'units si' is read (m, kg, s)", shown(units)));
}

}  // namespace pendular
