#include "Kernel/Foundation/State/StateDigest.h"

#include <fmt/format.h>

namespace pendular {

namespace {

/// Calls function(Number()) with a number of the kind.
template <class Function>
auto ofKind(NumberKind kind, Function&& function) {
    switch (kind) {
        case NumberKind::Float64:
            return function(double{});
        case NumberKind::Float32:
            return function(float{});
        case NumberKind::UInt64:
            return function(std::uint64_t{});
        case NumberKind::UInt32:
            return function(std::uint32_t{});
        case NumberKind::Int32:
            return function(std::int32_t{});
        case NumberKind::UInt16:
            return function(std::uint16_t{});
        case NumberKind::UInt8:
            break;
    }
    return function(std::uint8_t{});
}

std::size_t bytesOfTable(const TableShape& shape) {
    const std::size_t each = ofKind(shape.kind, [](auto number) { return sizeof number; });
    return shape.rows * shape.columns * each;
}

/// An empty table or text may have no address.
void addBytes(WordHash& hash, const void* bytes, std::size_t count) {
    hash.add(count > 0 ? bytes : "", count);
}

template <class Number>
std::string shownNumber(Number number) {
    if constexpr (std::is_floating_point_v<Number>)
        if (number != number) return "not set";
    return fmt::format("{}", +number);
}

}  // namespace

std::string shownNumbers(const TableShape& shape, const void* numbers, std::string_view unit) {
    constexpr std::size_t most = 9;
    const std::size_t count = shape.rows * shape.columns;
    if (count > most) return fmt::format("{} numbers", count);
    std::string list;
    ofKind(shape.kind, [&](auto number) {
        for (std::size_t k = 0; k < count; ++k) {
            std::memcpy(&number, static_cast<const char*>(numbers) + k * sizeof number, sizeof number);
            list += (k > 0 ? ", " : "") + shownNumber(number);
        }
    });
    if (count != 1) list = '(' + list + ')';
    return unit.empty() ? list : fmt::format("{} {}", list, unit);
}

void StateDigest::add(std::string_view group, std::string_view name, std::string_view unit,
                      const TableShape& shape, const void* numbers) {
    const std::size_t bytes = bytesOfTable(shape);
    if (bytes > largest) return;
    if (keep == Keep::HashOnly) return addBytes(all, numbers, bytes);
    WordHash own;
    addBytes(own, numbers, bytes);
    all.add(own.value());
    kept.push_back({std::string(group) + std::string(name), shownNumbers(shape, numbers, unit), own.value()});
}

void StateDigest::add(std::string_view group, std::string_view name, std::string_view text) {
    if (keep == Keep::HashOnly) return addBytes(all, text.data(), text.size());
    WordHash own;
    addBytes(own, text.data(), text.size());
    all.add(own.value());
    kept.push_back({std::string(group) + std::string(name), std::string(text), own.value()});
}

}  // namespace pendular
