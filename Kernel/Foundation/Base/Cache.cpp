#include "Kernel/Foundation/Base/Cache.h"

#include <fstream>
#include <string>

namespace pendular {

std::size_t lastCacheBytes() {
    static const std::size_t bytes = [] {
        constexpr std::size_t usual = std::size_t{8} << 20;
        // "32768K"; sysconf() tells what all caches of this level have together.
        std::ifstream file("/sys/devices/system/cpu/cpu0/cache/index3/size");
        std::size_t size = 0;
        char unit = 0;
        if (!(file >> size >> unit) || size == 0) return usual;
        switch (unit) {
            case 'K':
                return size << 10;
            case 'M':
                return size << 20;
            default:
                return usual;
        }
    }();
    return bytes;
}

}  // namespace pendular
