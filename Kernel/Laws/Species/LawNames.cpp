#include "Kernel/Laws/Species/LawNames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

std::string lowerCase(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

/// The least number of changes (Levenshtein) that turn the wanted text into some part of the name, both in
/// lower case; 0 where the name contains it.
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1, 0);  // a part of the name may begin anywhere
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
        }
    }
    return *std::min_element(row.begin(), row.end());  // and end anywhere
}

std::vector<std::string_view> nearestFirst(std::string_view name,
                                           const std::vector<std::string_view>& known) {
    std::vector<std::string_view> nearest = known;
    std::ranges::stable_sort(nearest, {}, [wanted = lowerCase(name)](std::string_view other) {
        return distance(wanted, lowerCase(other));
    });
    nearest.resize(std::min<std::size_t>(nearest.size(), 3));
    return nearest;
}

}  // namespace

std::string canonicalLawName(std::string_view name) {
    std::string result(name);
    const std::string_view spelling = "Willet";
    const std::size_t at = result.find(spelling);
    if (at != std::string::npos && result.compare(at, spelling.size() + 1, "Willett") != 0)
        result.replace(at, spelling.size(), "Willett");
    return result;
}

std::string listOfNames(const std::vector<std::string_view>& names) {
    std::string list;
    for (const std::string_view name : names) list.append(list.empty() ? "" : ", ").append(name);
    return list;
}

std::vector<std::string_view> nearNames(std::string_view name, const std::vector<std::string_view>& known) {
    std::vector<std::string_view> near = nearestFirst(name, known);
    std::erase_if(near, [&](std::string_view other) {
        return 3 * distance(lowerCase(name), lowerCase(other)) > name.size();
    });
    return near;
}

void unknownName(std::string_view what, std::string_view name, const std::vector<std::string_view>& known) {
    throw InputError(fmt::format("There is no {} \"{}\"; the nearest names are {}.", what, name,
                                 listOfNames(nearestFirst(name, known))));
}

}  // namespace pendular
