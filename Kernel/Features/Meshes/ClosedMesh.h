#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// Why welded triangles are no closed surface with an inside, behind the name of what they were given to;
/// none where each edge belongs to two triangles which go along it in opposite directions.
/// @param vertices m; @param corners of each triangle: places in `vertices`
[[nodiscard]] std::optional<std::string> objectionToClosed(
    std::span<const Vector<double>> vertices, std::span<const std::array<std::uint32_t, 3>> corners);

}  // namespace pendular
