#include "Kernel/Features/LiquidBridges/Shared/LiquidMigration.h"

#include <fmt/format.h>

namespace pendular {

std::optional<std::string> objectionToLargestVolume(std::string_view law, double volume,
                                                    const BridgeScales& scales) {
    if (scales.volume <= mostMigratingVolume) return std::nullopt;
    return fmt::format(
        "{}: liquidBridgeVolumeMax = {:.6g} m^3 is V* = V/R^3 = {:.6g} between two bodies of this scene (R = "
        "{:.6g} m); it must be at most V* = {:g}, which is {:.6g} m^3 there.",
        law, volume, scales.volume, scales.radius, mostMigratingVolume,
        mostMigratingVolume * scales.radius * scales.radius * scales.radius);
}

}  // namespace pendular
