#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace pendular {

/// Records of 64 bytes that begin as zeros, each in a line of the cache. The system gives memory only to
/// those that are written.
template <class Record>
class ZeroedLines {
    static_assert(sizeof(Record) == 64 && std::is_trivially_copyable_v<Record>);

public:
    [[nodiscard]] std::size_t size() const { return count; }
    [[nodiscard]] Record* data() { return lines; }
    [[gnu::always_inline]] Record& operator[](std::size_t k) { return lines[k]; }
    [[nodiscard]] std::size_t bytes() const { return room * sizeof(Record); }

    /// All are zero before, and after. Throws bad_alloc.
    void resize(std::size_t records) {
        count = records;
        if (records <= room) return;
        room = records + records / 4;
        memory.reset();
        memory.reset(std::calloc(room + 1, sizeof(Record)));
        if (!memory) throw std::bad_alloc();
        void* begin = memory.get();
        std::size_t space = (room + 1) * sizeof(Record);
        lines = static_cast<Record*>(std::align(sizeof(Record), room * sizeof(Record), begin, space));
    }

private:
    struct Free {
        void operator()(void* block) const { std::free(block); }
    };

    std::size_t count = 0, room = 0;
    std::unique_ptr<void, Free> memory;
    Record* lines = nullptr;
};

}  // namespace pendular
