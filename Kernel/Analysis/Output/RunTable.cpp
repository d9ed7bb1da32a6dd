#include "Kernel/Analysis/Output/RunTable.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileFault.h"

namespace pendular {

namespace {

/// CRC-32 of the first bytes of a table; 0 where there is none. Throws InputError where it has less.
std::uint32_t checksumOf(const std::filesystem::path& table, std::uintmax_t bytes) {
    const std::filesystem::path file = partOrWhole(table);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return 0;
    requireBytes(file, bytes);
    std::array<char, 1 << 16> buffer;
    uLong checksum = crc32(0, nullptr, 0);
    while (bytes > 0 && stream) {
        stream.read(buffer.data(),
                    static_cast<std::streamsize>(std::min<std::uintmax_t>(bytes, buffer.size())));
        const auto count = static_cast<std::size_t>(stream.gcount());
        checksum = crc32(checksum, reinterpret_cast<const Bytef*>(buffer.data()), static_cast<uInt>(count));
        bytes -= count;
    }
    return static_cast<std::uint32_t>(checksum);
}

}  // namespace

std::uintmax_t bytesBefore(const std::filesystem::path& table, std::string_view header, double time) {
    std::ifstream stream(partOrWhole(table), std::ios::binary);
    std::string line;
    if (!std::getline(stream, line) || line != header || stream.eof()) return 0;
    std::uintmax_t bytes = line.size() + 1;
    // A last line without an end was cut off.
    while (std::getline(stream, line) && !stream.eof() && std::strtod(line.c_str(), nullptr) < time)
        bytes += line.size() + 1;
    return bytes;
}

void RunTable::visitState(StateArchive& archive) {
    const std::string name = place.filename().string();
    std::uint64_t bytes = archive.isReading() ? 0 : file ? file->flush() : kept;
    std::uint32_t checksum = archive.isReading() ? 0 : checksumOf(place, bytes);
    archive.value(name + "-bytes", bytes);
    archive.value(name + "-checksum", checksum);
    if (!archive.isReading()) return;
    if (isThere(partOrWhole(place)) && checksumOf(place, bytes) != checksum)
        throw InputError(
            fmt::format("The table {} is not the one that the run wrote which the restart file is of: bring "
                        "that back, or give another folder for the output.",
                        partOrWhole(place).string()));
    goOnAfter(bytes);
}

void RunTable::goOnFrom(double time) { goOnAfter(bytesBefore(place, columns, time)); }

}  // namespace pendular
