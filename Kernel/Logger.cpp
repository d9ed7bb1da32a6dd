#include "Kernel/Logger.h"

#include <cstdio>

namespace pendular {

// Not by fmt::print, which throws where it cannot write.
void writeToLog(std::string_view text) noexcept {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
    std::clearerr(stderr);
}

}  // namespace pendular
