#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace pendular {

/// Bytes from one rank to another: what is added is taken in the same order.
class Message {
public:
    Message() = default;
    /// Of bytes that have come from another rank.
    explicit Message(std::string from) : bytes(std::move(from)) {}

    template <class Value>
    void add(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(Value));
    }
    template <class Value>
    void take(Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::memcpy(&value, bytes.data() + taken, sizeof(Value));
        taken += sizeof(Value);
    }
    template <class Value>
    [[nodiscard]] Value take() {
        Value value;
        take(value);
        return value;
    }
    /// So many values at once, make(k) each: faster than one by one.
    template <class Value, class Make>
    void addEach(std::size_t count, Make&& make) {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::size_t at = bytes.size();
        bytes.resize(at + count * sizeof(Value));
        for (std::size_t k = 0; k < count; ++k, at += sizeof(Value)) {
            const Value value = make(k);
            std::memcpy(bytes.data() + at, &value, sizeof(Value));
        }
    }
    [[nodiscard]] bool isTaken() const { return taken == bytes.size(); }
    [[nodiscard]] std::size_t size() const { return bytes.size(); }
    [[nodiscard]] std::string_view all() const { return bytes; }

private:
    std::string bytes;
    std::size_t taken = 0;
};

}  // namespace pendular
