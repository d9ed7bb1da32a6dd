#include "Kernel/Foundation/Base/LargePages.h"

#ifdef __linux__
    #include <sys/mman.h>

    #include <cstdint>
#endif

namespace pendular {

void preferLargePages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    constexpr std::uintptr_t large = std::uintptr_t{1} << 21;  // 2 MiB, on x86-64 and on 64-bit ARM
    const auto first = (reinterpret_cast<std::uintptr_t>(begin) + large - 1) / large * large;
    const auto end = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / large * large;
    // It is a wish: a system that does not know it goes on as before.
    if (first < end) static_cast<void>(madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE));
#endif
}

}  // namespace pendular
