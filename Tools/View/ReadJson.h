#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace pendular::view {

inline constexpr int deepestJson = 64;  // lists and objects in each other

/// Whether the brackets of a text of JSON are nested deeper than deepestJson. What is no JSON is refused by
/// the parser, before the first bracket that is counted wrongly here.
inline bool isTooDeep(std::string_view text) {
    int depth = 0;
    bool isString = false;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (isString && c == '\\') ++k;
        else if (c == '"') isString = !isString;
        else if (isString) continue;
        else if (c == '[' || c == '{') ++depth;
        else if (c == ']' || c == '}') --depth;
        if (depth > deepestJson) return true;
    }
    return false;
}

/// JSON that others have written; a discarded value where the text is none, or is nested too deep: copies and
/// texts of a value are made by recursion, for which 10^5 lists in each other need more than the stack.
inline nlohmann::ordered_json parseJson(std::string_view text) {
    using Json = nlohmann::ordered_json;
    return isTooDeep(text) ? Json(Json::value_t::discarded) : Json::parse(text, nullptr, false);
}

}  // namespace pendular::view
