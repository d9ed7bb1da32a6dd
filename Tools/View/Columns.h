#pragma once

#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Analysis/Output/FieldName.h"

namespace pendular::view {

/// How the page is told of a field: its name, and the quantity and the unit in it.
inline nlohmann::ordered_json fieldName(const std::string& name) {
    const FieldName parts = splitFieldName(name);
    return {{"name", name}, {"quantity", parts.quantity}, {"unit", parts.unit}};
}

static_assert(std::endian::native == std::endian::little);

/// Numbers as the page takes them: the length of a text (4 bytes, little-endian), the text, JSON, filled up
/// with blanks to a multiple of four, and behind it columns of 32 bits. The text tells for each column its
/// name, where it begins (in bytes, behind the text) and how many numbers it has.
class Columns {
public:
    using Json = nlohmann::ordered_json;

    void add(const std::string& name, const std::vector<float>& numbers) {
        list.push_back({{"name", name}, {"begin", bytes.size()}, {"count", numbers.size()}});
        bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
    }
    /// @param head what the text tells besides
    std::string behind(Json head) && {
        head["columns"] = std::move(list);
        std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const auto length = static_cast<std::uint32_t>(text.size());
        std::string all(reinterpret_cast<const char*>(&length), sizeof length);
        all.reserve(sizeof length + text.size() + bytes.size());
        return all.append(text).append(bytes);
    }

private:
    Json list = Json::array();
    std::string bytes;
};

}  // namespace pendular::view
