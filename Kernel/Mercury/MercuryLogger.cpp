#include "Kernel/Mercury/MercuryLogger.h"

#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {

void addPlain(std::string& to, std::string_view part) {
    for (std::size_t at = 0; at < part.size(); ++at)
        if (!part.substr(at).starts_with("\\%")) to += part[at];
}

void MercuryLogger::end(const std::string& text) { throw RunError(text); }

}  // namespace pendular
