#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace pendular {

/// The concatenation of string constants, made by the compiler.
template <const std::string_view&... Parts>
class JoinedName {
    static constexpr std::size_t length = (Parts.size() + ... + 0);

    static constexpr std::array<char, length + 1> characters = [] {
        std::array<char, length + 1> all{};
        std::size_t end = 0;
        for (std::string_view part : {Parts...})
            for (char c : part) all[end++] = c;
        return all;
    }();

public:
    static constexpr std::string_view value{characters.data(), length};
};

}  // namespace pendular
