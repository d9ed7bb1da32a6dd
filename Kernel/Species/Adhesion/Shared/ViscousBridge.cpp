#include "Kernel/Species/Adhesion/Shared/ViscousBridge.h"

#include <fmt/format.h>

namespace pendular {

std::optional<std::string> objectionToOption(std::string_view law, std::string_view field, double value,
                                             int last) {
    for (int option = 0; option <= last; ++option)
        if (value == option) return std::nullopt;
    return fmt::format("{}: {} = {:g} is none of the whole numbers from 0 to {}.", law, field, value, last);
}

}  // namespace pendular
