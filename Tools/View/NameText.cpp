#include "Tools/View/NameText.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>

namespace pendular::view {

namespace {

std::uint8_t byteAt(std::string_view text, std::size_t at) { return static_cast<std::uint8_t>(text[at]); }

/// Bytes of the first character, 1 to 4; 0: it is no UTF-8 (RFC 3629, section 4).
std::size_t lengthOfFirst(std::string_view text) {
    const std::uint8_t first = byteAt(text, 0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
    for (std::size_t k = 1; k < length; ++k)
        if ((byteAt(text, k) & 0xC0) != 0x80) return 0;
    const std::uint8_t second = byteAt(text, 1);
    const bool isLongForm = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
    const bool isSurrogate = first == 0xED && second > 0x9F, isBeyond = first == 0xF4 && second > 0x8F;
    return isLongForm || isSurrogate || isBeyond ? 0 : length;
}

}  // namespace

std::string textOfName(std::string_view name) {
    std::string text;
    while (!name.empty()) {
        const std::size_t length = lengthOfFirst(name);
        if (length == 0 || name[0] == '%') text += fmt::format("%{:02X}", byteAt(name, 0));
        else text += name.substr(0, length);
        name.remove_prefix(length == 0 ? 1 : length);
    }
    return text;
}

std::optional<std::string> nameOfText(std::string_view text) {
    std::string name;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] != '%') {
            name += text[at];
            continue;
        }
        unsigned byte = 0;
        const std::string_view digits = text.substr(at + 1, 2);
        const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
        if (digits.size() != 2 || problem != std::errc() || end != digits.data() + digits.size()) return {};
        name += static_cast<char>(byte);
        at += 2;
    }
    if (textOfName(name) != text) return {};  // each name has one text only
    return name;
}

}  // namespace pendular::view
