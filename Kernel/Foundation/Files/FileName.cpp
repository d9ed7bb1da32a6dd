#include "Kernel/Foundation/Files/FileName.h"

#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

bool isControl(char c) { return (c >= 0 && c < ' ') || c == 127; }

}  // namespace

void requireFileName(std::string_view owner, std::string_view name) {
    const auto refuse = [&](std::string_view reason) {
        throw InputError(fmt::format("{}: name = '{}' {}.", owner, printable(name), reason));
    };
    const std::string_view last = name.substr(name.rfind('/') + 1);  // all of it where there is no /
    if (std::ranges::any_of(name, isControl)) refuse("has a character that cannot be printed");
    if (last.empty() || last == "." || last == "..")
        refuse("is that of a folder; it must end with a name, which files of the run begin with");
}

bool isWord(std::string_view text) {
    return std::ranges::all_of(text, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    });
}

std::string printable(std::string_view text) {
    std::string shown(text);
    std::ranges::replace_if(shown, isControl, '?');
    return shown;
}

}  // namespace pendular
