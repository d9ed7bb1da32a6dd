#include "Kernel/Foundation/State/RestartFile.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "Kernel/Foundation/Base/FullStop.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/OwnFile.h"
#include "Kernel/Foundation/Files/WrittenBeside.h"

namespace pendular {

namespace {

namespace fs = std::filesystem;

/// A file by its descriptor.
class Descriptor {
public:
    Descriptor(const fs::path& file, int flags) : path(file), number(open(file.c_str(), flags)) {
        if (number < 0) fail("cannot be opened");
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { ::close(number); }

    /// Reads until so many bytes are there or the file ends; returns how many.
    std::size_t read(void* to, std::size_t bytes) {
        std::size_t done = 0;
        while (done < bytes) {
            const ssize_t n = ::read(number, static_cast<char*>(to) + done, bytes - done);
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) fail("cannot be read");
            if (n == 0) break;
            done += static_cast<std::size_t>(n);
        }
        return done;
    }
    void writeAtBegin(const void* from, std::size_t bytes) {
        if (pwrite(number, from, bytes, 0) != static_cast<ssize_t>(bytes)) fail("cannot be written");
    }
    /// Waits until the content is on the disk.
    void sync() {
        if (fsync(number) != 0 && errno != EINVAL) fail("cannot be completed");
    }

private:
    [[noreturn]] void fail(std::string_view what) const {
        throw InputError(fmt::format("The file {} {}: {}.", path.string(), what, std::strerror(errno)));
    }

    fs::path path;
    int number;
};

/// The content of the user block, before the HDF5 file.
struct Seal {
    int format = restartFormat;
    unsigned long long bytes = 0;     // of the whole file
    unsigned long long checksum = 0;  // of all after the user block

    using Block = std::array<char, Hdf5File::userBlock>;

    [[nodiscard]] Block block() const {
        Block result{};
        fmt::format_to_n(result.data(), result.size(),
                         "Pendular restart file\nformat {}\nbytes {}\nchecksum {:016x}\n", format, bytes,
                         checksum);
        return result;
    }
};

std::uint64_t lowestByteFirst(std::uint64_t word) {
    return std::endian::native == std::endian::little ? word : __builtin_bswap64(word);
}

/// FNV-1a over words of 64 bits instead of bytes: any one damaged word changes it, and it is as fast as
/// memory. (Each step is a bijection of the sum so far, and of the word.)
unsigned long long checksumOfRest(Descriptor& file) {
    std::uint64_t sum = 0xcbf29ce484222325u;
    std::vector<std::uint64_t> words(std::size_t{1} << 17);
    for (;;) {
        const std::size_t bytes = file.read(words.data(), words.size() * sizeof(words[0]));
        if (bytes == 0) return sum;
        std::memset(reinterpret_cast<char*>(words.data()) + bytes, 0,
                    (sizeof(words[0]) - bytes % sizeof(words[0])) % sizeof(words[0]));
        for (std::size_t k = 0; k < (bytes + sizeof(words[0]) - 1) / sizeof(words[0]); ++k)
            sum = (sum ^ lowestByteFirst(words[k])) * 0x100000001b3u;
    }
}

void syncFolderOf(const fs::path& path) {
    Descriptor(path.has_parent_path() ? path.parent_path() : fs::path("."), O_RDONLY | O_DIRECTORY).sync();
}

}  // namespace

void sealRestartFile(const fs::path& path) {
    Descriptor file(path, O_RDWR | O_NOFOLLOW);
    Seal::Block block;
    static_cast<void>(file.read(block.data(), block.size()));
    const Seal seal{restartFormat, sizeOf(path), checksumOfRest(file)};
    block = seal.block();
    file.writeAtBegin(block.data(), block.size());
    file.sync();
}

void requireRestartFiles() {
    if (!Hdf5File::isAvailable())
        throw InputError(
            "This build of Pendular has no HDF5 library and keeps no restart files: install the library "
            "(install-dependencies.sh of the source) and build again.");
}

void writeRestartFile(const fs::path& path, const std::function<void(StateArchive&)>& visit) {
    requireRestartFiles();
    const fs::path beside = path.string() + ".part";
    std::error_code ignored;
    requireRegularIfThere(path);
    requireOwnIfThere(beside);
    try {
        Hdf5File file(beside, Hdf5File::Access::Create);
        StateArchive archive(file, StateArchive::Direction::Write);
        visit(archive);
        file.close();
        sealRestartFile(beside);
        renameFile(beside, path);
        syncFolderOf(path);
    } catch (const std::exception& problem) {
        fs::remove(beside, ignored);
        throw InputError(
            fmt::format("{}{}.", withoutFullStop(sentenceOf(problem)),
                        fs::exists(path, ignored) ? "; the restart file of before is kept" : ""));
    }
}

void checkRestartFile(const fs::path& path) {
    const auto refuse = [&](std::string_view reason) {
        throw InputError(fmt::format("The restart file {} {}.", path.string(), reason));
    };
    std::error_code problem;
    if (!fs::is_regular_file(path, problem)) refuse("does not exist or is not a regular file");
    Descriptor file(path, O_RDONLY);
    Seal::Block block{};
    const std::size_t length = file.read(block.data(), block.size());
    std::array<char, block.size() + 1> text{};
    std::memcpy(text.data(), block.data(), length);
    Seal seal;
    const int found = std::sscanf(text.data(), "Pendular restart file\nformat %d\nbytes %llu\nchecksum %llx",
                                  &seal.format, &seal.bytes, &seal.checksum);
    const std::string_view start(text.data(), length);
    if (start.starts_with("MercuryDPM ") || start.starts_with("restart_version "))
        refuse(
            "is one of MercuryDPM's, in text: a scene of MercuryScene.h (Mercury3D) starts from it, by "
            "readRestartFile()");
    if (found < 1) refuse("is not a restart file of Pendular, or its start is damaged");
    if (seal.format >= 1 && seal.format != restartFormat)
        refuse(
            fmt::format("has the format {}, and this version of Pendular reads the format {}: take the "
                        "version that wrote it",
                        seal.format, restartFormat));
    constexpr std::string_view advice = "take another one, or start the run again";
    const std::uintmax_t size = sizeOf(path);
    if (found == 3 && size < seal.bytes)
        refuse(fmt::format("is truncated, {} of its {} bytes are there: {}", size, seal.bytes, advice));
    if (found < 3 || size != seal.bytes || seal.format < 1 || block != seal.block() ||
        checksumOfRest(file) != seal.checksum)
        refuse(fmt::format("is damaged, its content does not agree with its checksum: {}", advice));
}

void readRestartFile(const fs::path& path, const std::function<void(StateArchive&)>& visit) {
    requireRestartFiles();
    checkRestartFile(path);
    Hdf5File file(path, Hdf5File::Access::Read);
    StateArchive archive(file, StateArchive::Direction::Read);
    visit(archive);
}

}  // namespace pendular
