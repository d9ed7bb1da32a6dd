#pragma once

#include <cstddef>

namespace pendular {

/// Bytes of the last cache before the memory, which several processors share; 8 MiB where the system does not
/// tell.
std::size_t lastCacheBytes();

}  // namespace pendular
