#include "Kernel/Features/LiquidBridges/Shared/ViscousBridge.h"

#include <fmt/format.h>

namespace pendular {

std::optional<std::string> objectionToOption(std::string_view law, std::string_view field, double value,
                                             int last) {
    for (int option = 0; option <= last; ++option)
        if (value == option) return std::nullopt;
    return fmt::format("{}: {} = {:g} is none of the whole numbers from 0 to {}.", law, field, value, last);
}

std::string refusalOfFilmContactGap(std::string_view law, double gap, double ruptureDistance) {
    return fmt::format(
        "{}: filmContactGap = {:.6g} m is not below the rupture distance of a bridge between two bodies of "
        "this scene, {:.6g} m, so that it would rupture as soon as it forms; take a smaller gap or more "
        "liquid.",
        law, gap, ruptureDistance);
}

}  // namespace pendular
