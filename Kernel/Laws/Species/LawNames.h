#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Laws/Concepts/TypeList.h"

namespace pendular {

/// The name with MercuryDPM's spelling Willet replaced by Willett.
std::string canonicalLawName(std::string_view name);

/// "a, b, c". (fmt::join makes g++ 12 warn of an overflow that cannot happen.)
std::string listOfNames(const std::vector<std::string_view>& names);

/// Known names that a third of the letters, changed, make of a name: the nearest first, and three at most.
std::vector<std::string_view> nearNames(std::string_view name, const std::vector<std::string_view>& known);

/// Throws InputError: what (for example "adhesion model") has no such name, with the nearest of the known
/// names.
[[noreturn]] void unknownName(std::string_view what, std::string_view name,
                              const std::vector<std::string_view>& known);

/// The names of all laws of a list; the law that does nothing has the name given.
template <class Laws>
std::vector<std::string_view> lawNames(std::string_view nothing = "none") {
    std::vector<std::string_view> names;
    Laws::forEach([&]<class Law>() { names.push_back(Law::name.empty() ? nothing : Law::name); });
    return names;
}

/// Calls `function.template operator()<Law>()` for the law of the list with this name ("none": the one that
/// does nothing). Throws InputError with the nearest names if there is none.
template <class Laws, class Function>
void withLawNamed(std::string_view what, std::string_view name, Function&& function) {
    const std::string wanted = canonicalLawName(name);
    bool found = false;
    Laws::forEach([&]<class Law>() {
        if (wanted != (Law::name.empty() ? std::string_view("none") : Law::name)) return;
        found = true;
        function.template operator()<Law>();
    });
    if (!found) unknownName(what, name, lawNames<Laws>());
}

}  // namespace pendular
