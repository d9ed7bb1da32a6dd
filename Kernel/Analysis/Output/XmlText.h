#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace pendular {

// Texts in attributes of XML.

inline std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') result += "&amp;";
        else if (c == '<') result += "&lt;";
        else if (c == '"') result += "&quot;";
        else result += c;
    }
    return result;
}

inline std::string unescaped(std::string text) {
    for (const auto& [code, sign] : {std::pair{"&lt;", "<"}, {"&quot;", "\""}, {"&amp;", "&"}})
        for (std::size_t at = text.find(code); at != text.npos; at = text.find(code, at + 1))
            text.replace(at, std::string_view(code).size(), sign);
    return text;
}

}  // namespace pendular
