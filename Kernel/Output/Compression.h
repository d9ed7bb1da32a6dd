#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace pendular {

/// Bytes in the form of vtkZLibDataCompressor: the number of blocks, the size of a block, that of the last
/// one if it is smaller (else 0), the compressed size of each (unsigned integers of 64 bits), and the blocks,
/// each a stream of zlib. Source: the VTK file formats, "Compressed data".
/// @param threads the bytes do not depend on it
std::string compressInBlocks(std::span<const std::byte> bytes, int threads = 1);

/// The bytes again. Throws std::runtime_error, with the reason, unless the data begins with blocks that hold
/// exactly `size` bytes.
std::string decompressBlocks(std::string_view data, std::size_t size);

}  // namespace pendular
