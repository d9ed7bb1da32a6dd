#pragma once

#include <cstddef>

namespace pendular {

/// The most bytes that deflate packs into one. Source: J. Gailly, M. Adler, "zlib technical details".
inline constexpr std::size_t largestDeflateRatio = 1032;

}  // namespace pendular
