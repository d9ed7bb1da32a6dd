#include "Kernel/Mercury/MercuryLogger.h"

#include "Kernel/Base/RunError.h"

namespace pendular {

std::string withValues(std::string_view text, const std::string* values, std::size_t count) {
    std::string all;
    std::size_t from = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t at = nextPercent(text, from);
        all += text.substr(from, at - from);
        all += values[k];
        from = std::min(at + 1, text.size());
    }
    all += text.substr(from);
    for (std::size_t at = 0; (at = all.find("\\%", at)) != std::string::npos; ++at) all.erase(at, 1);
    return all;
}

void MercuryLogger::end(const std::string& text) { throw RunError(text); }

}  // namespace pendular
