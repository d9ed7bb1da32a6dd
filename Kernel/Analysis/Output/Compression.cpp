#include "Kernel/Analysis/Output/Compression.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Files/Deflate.h"

namespace pendular {

namespace {

constexpr std::size_t blockSize = 1 << 17;

/// Streams of zlib, one after another, made of parts that are packed or stored. Sources: RFC 1950 (zlib), RFC
/// 1951 (deflate).
class Packer {
public:
    /// @param strategy of zlib, for the parts that are packed
    explicit Packer(int strategy) {
        constexpr int rawDeflate = -15, memoryLevel = 8;
        if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, rawDeflate, memoryLevel, strategy) != Z_OK)
            throw std::runtime_error("zlib has no memory");
    }
    Packer(const Packer&) = delete;
    Packer& operator=(const Packer&) = delete;
    ~Packer() { deflateEnd(&stream); }

    void begin() {
        out.clear();
        for (const int byte : {0x78, 0x01}) out.push_back(static_cast<char>(byte));  // packed fast
        checksum = adler32(0, nullptr, 0);
    }
    /// Packed if that gains a quarter. The low bits of positions and velocities are random: to pack them
    /// takes twenty times as long as to store them, and gains a twentieth.
    void add(std::span<const std::byte> bytes) {
        checksum = adler32_z(checksum, dataOf(bytes), bytes.size());
        if (gainsAQuarter(bytes)) out += packed(bytes);
        else store(bytes);
    }
    std::string finish() {
        appendStoredBlock({}, true);
        for (const int shift : {24, 16, 8, 0}) out.push_back(static_cast<char>(checksum >> shift & 0xff));
        return out;
    }

private:
    static const Bytef* dataOf(std::span<const std::byte> bytes) {
        return reinterpret_cast<const Bytef*>(bytes.data());
    }
    /// Whether packing saves a quarter, as a sample from four places tells.
    bool gainsAQuarter(std::span<const std::byte> bytes) {
        constexpr std::size_t pieces = 4, pieceSize = 256;
        sample.clear();
        for (std::size_t k = 0; k < pieces; ++k) {
            const auto piece = bytes.subspan(k * bytes.size() / pieces / wordSize * wordSize);
            const auto begin = piece.begin();
            sample.insert(sample.end(), begin, begin + std::min(pieceSize, bytes.size() / pieces));
        }
        return static_cast<double>(packed(sample).size()) < 0.75 * static_cast<double>(sample.size());
    }
    /// The bytes as blocks of deflate that end with a whole byte, and do not refer to earlier parts.
    std::string_view packed(std::span<const std::byte> bytes) {
        constexpr std::size_t endOfFlush = 16;
        const std::size_t most = deflateBound(&stream, bytes.size()) + endOfFlush;
        if (room.size() < most) room.resize(most);
        stream.next_in = const_cast<Bytef*>(dataOf(bytes));
        stream.avail_in = static_cast<uInt>(bytes.size());
        stream.next_out = room.data();
        stream.avail_out = static_cast<uInt>(room.size());
        if (deflate(&stream, Z_SYNC_FLUSH) != Z_OK || stream.avail_in > 0 || stream.avail_out == 0)
            throw std::runtime_error("zlib failed");
        const std::size_t size = room.size() - stream.avail_out;
        deflateReset(&stream);
        return {reinterpret_cast<const char*>(room.data()), size};
    }
    void store(std::span<const std::byte> bytes) {
        constexpr std::size_t most = 0xffff;  // bytes in a stored block
        for (; !bytes.empty(); bytes = bytes.subspan(std::min(most, bytes.size())))
            appendStoredBlock(bytes.first(std::min(most, bytes.size())), false);
    }
    void appendStoredBlock(std::span<const std::byte> bytes, bool isLast) {
        const std::size_t size = bytes.size();
        out.push_back(isLast ? 1 : 0);
        for (const std::size_t word : {size, ~size})
            for (const int shift : {0, 8}) out.push_back(static_cast<char>(word >> shift & 0xff));
        out.append(reinterpret_cast<const char*>(bytes.data()), size);
    }

    static constexpr std::size_t wordSize = 8;
    z_stream stream{};
    uLong checksum = 0;
    std::vector<std::byte> sample;
    std::vector<Bytef> room;
    std::string out;
};

void append(std::string& text, std::uint64_t number) {
    text.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// @param chunk the numbers that are there, and zeros up to its size
std::vector<std::byte> shuffled(std::span<const std::byte> numbers, std::size_t size, std::size_t chunk) {
    std::vector<std::byte> out(chunk);
    const std::size_t count = chunk / size;
    for (std::size_t k = 0; k < numbers.size() / size; ++k)
        for (std::size_t byte = 0; byte < size; ++byte) out[byte * count + k] = numbers[k * size + byte];
    return out;
}

}  // namespace

std::vector<std::string> compressShuffled(std::span<const std::byte> bytes, std::size_t size,
                                          std::size_t chunk, int threads) {
    std::vector<std::string> chunks((bytes.size() + chunk - 1) / chunk);
    inParts(chunks.size(), threads, [&](int, std::size_t begin, std::size_t end) {
        // Runs of equal bytes are all that sorted bytes repeat: as small as by zlib's whole search, and much
        // faster.
        Packer packer(Z_RLE);
        for (std::size_t k = begin; k < end; ++k) {
            const auto part = bytes.subspan(k * chunk, std::min(chunk, bytes.size() - k * chunk));
            const std::vector<std::byte> sorted = shuffled(part, size, chunk);
            packer.begin();
            // The bytes of one place: those of the exponents pack well, the last ones of the digits do not.
            for (std::size_t byte = 0; byte < size; ++byte)
                packer.add(std::span(sorted).subspan(byte * (chunk / size), chunk / size));
            chunks[k] = packer.finish();
        }
    });
    return chunks;
}

std::string compressInBlocks(std::span<const std::byte> bytes, int threads) {
    const std::size_t count = (bytes.size() + blockSize - 1) / blockSize;
    std::vector<std::string> blocks(count);
    inParts(count, threads, [&](int, std::size_t begin, std::size_t end) {
        Packer packer(Z_DEFAULT_STRATEGY);
        for (std::size_t k = begin; k < end; ++k) {
            packer.begin();
            packer.add(bytes.subspan(k * blockSize, std::min(blockSize, bytes.size() - k * blockSize)));
            blocks[k] = packer.finish();
        }
    });
    std::string out;
    append(out, count);
    append(out, blockSize);
    append(out, bytes.size() % blockSize);
    std::size_t size = (3 + count) * sizeof(std::uint64_t);
    for (const std::string& block : blocks) size += block.size();
    out.reserve(size);
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
    // All of it is checked before memory is taken: a block must be there, and can hold what it is to.
    const auto partOf = [&](std::size_t k) { return k + 1 == count && last > 0 ? last : whole; };
    const std::size_t begin = (3 + count) * sizeof(std::uint64_t);
    for (std::size_t k = 0, from = begin; k < count; ++k) {
        const std::size_t length = numberAt(3 + k);
        if (from > data.size() || length > data.size() - from) throw std::runtime_error("ends too early");
        if (partOf(k) / largestDeflateRatio > length) throw std::runtime_error("has data of the wrong size");
        from += length;
    }
    std::string out(size, '\0');
    for (std::size_t k = 0, from = begin, to = 0; k < count; ++k) {
        const std::size_t length = numberAt(3 + k), expected = partOf(k);
        uLongf part = expected;
        const int result = uncompress(reinterpret_cast<Bytef*>(out.data() + to), &part,
                                      reinterpret_cast<const Bytef*>(data.data() + from), length);
        if (result != Z_OK || part != expected) throw std::runtime_error("has a damaged block of data");
        from += length;
        to += part;
    }
    return out;
}

}  // namespace pendular
