#include "Kernel/Output/Compression.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "Kernel/Parallel.h"

namespace pendular {

namespace {

constexpr std::size_t blockSize = 1 << 17;
constexpr std::size_t sampleSize = 1 << 12;

std::string deflated(std::span<const std::byte> bytes, int strategy) {
    z_stream stream{};
    if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, 15, 8, strategy) != Z_OK)
        throw std::runtime_error("zlib has no memory");
    std::string out(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    const int result = deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    if (result != Z_STREAM_END) throw std::runtime_error("zlib failed");
    return out;
}

/// Positions and velocities have random low bits, in which a search for repeated strings finds nothing: it
/// would take four times as long and gain a hundredth. A sample tells whether it gains a quarter.
std::string compressedBlock(std::span<const std::byte> block) {
    const auto sample = block.first(std::min(block.size(), sampleSize));
    const bool repeats =
        deflated(sample, Z_DEFAULT_STRATEGY).size() < 0.75 * static_cast<double>(sample.size());
    return deflated(block, repeats ? Z_DEFAULT_STRATEGY : Z_HUFFMAN_ONLY);
}

void append(std::string& text, std::uint64_t number) {
    text.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

std::string compressInBlocks(std::span<const std::byte> bytes, int threads) {
    const std::size_t count = (bytes.size() + blockSize - 1) / blockSize;
    std::vector<std::string> blocks(count);
    inParts(count, threads, [&](int, std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            blocks[k] = compressedBlock(
                bytes.subspan(k * blockSize, std::min(blockSize, bytes.size() - k * blockSize)));
    });
    std::string out;
    append(out, count);
    append(out, blockSize);
    append(out, bytes.size() % blockSize);
    for (const std::string& block : blocks) append(out, block.size());
    for (const std::string& block : blocks) out += block;
    return out;
}

std::string decompressBlocks(std::string_view data, std::size_t size) {
    const auto numberAt = [&](std::size_t k) {
        std::uint64_t number = 0;
        if (k >= data.size() / sizeof number) throw std::runtime_error("ends too early");
        std::memcpy(&number, data.data() + k * sizeof number, sizeof number);
        return number;
    };
    const std::uint64_t count = numberAt(0), whole = numberAt(1), last = numberAt(2);
    const std::uint64_t most = data.size() / sizeof(std::uint64_t);
    if (count > most || (count > 0 && (whole == 0 || whole > size + blockSize || last >= whole)) ||
        count * whole - (last > 0 ? whole - last : 0) != size)
        throw std::runtime_error("has data of the wrong size");
    std::string out(size, '\0');
    std::size_t from = (3 + count) * sizeof(std::uint64_t), to = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t length = numberAt(3 + k);
        uLongf part = k + 1 == count && last > 0 ? last : whole;
        const std::size_t expected = part;
        if (from > data.size() || length > data.size() - from) throw std::runtime_error("ends too early");
        const int result = uncompress(reinterpret_cast<Bytef*>(out.data() + to), &part,
                                      reinterpret_cast<const Bytef*>(data.data() + from), length);
        if (result != Z_OK || part != expected) throw std::runtime_error("has a damaged block of data");
        from += length;
        to += part;
    }
    return out;
}

}  // namespace pendular
