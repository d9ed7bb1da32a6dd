#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pendular {

/// Bytes in the form of vtkZLibDataCompressor: the number of blocks, the size of a block, that of the last
/// one if it is smaller (else 0), the compressed size of each (unsigned integers of 64 bits), and the blocks,
/// each a stream of zlib. Source: the VTK file formats, "Compressed data".
/// @param threads the bytes do not depend on it
std::string compressInBlocks(std::span<const std::byte> bytes, int threads = 1);

/// Numbers in chunks, each in the form of the filters "shuffle" and "deflate" of the HDF5 library: the first
/// bytes of all its numbers, then the second ones, and so on, as a stream of zlib. The last chunk is filled
/// up with zeros. Source: The HDF Group, "HDF5 file format specification", filter pipeline.
/// @param size of a number, bytes; @param chunk bytes, a multiple of size
/// @param threads the bytes do not depend on it
std::vector<std::string> compressShuffled(std::span<const std::byte> bytes, std::size_t size,
                                          std::size_t chunk, int threads = 1);

/// The bytes again. Throws std::runtime_error, with the reason, unless the data begins with blocks that hold
/// exactly `size` bytes. No memory is taken before the sizes that it claims are found possible.
std::string decompressBlocks(std::string_view data, std::size_t size);

}  // namespace pendular
