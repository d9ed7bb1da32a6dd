#include "Kernel/Foundation/Files/OwnFile.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/SilentRank.h"

namespace pendular {

namespace fs = std::filesystem;

namespace {

void makeFolderOf(const fs::path& file) {
    std::error_code ignored;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
}

}  // namespace

void requireOwnIfThere(const fs::path& file) {
    std::error_code ignored;
    const fs::file_type kind = fs::symlink_status(file, ignored).type();
    if (kind == fs::file_type::symlink)
        throw InputError(fmt::format("The file {} is a symbolic link; remove it.", file.string()));
    if (kind != fs::file_type::not_found && kind != fs::file_type::none && kind != fs::file_type::regular)
        throw InputError(fmt::format(
            "The file {} is not a regular file: remove it, or give another name or folder.", file.string()));
}

void makeRoomFor(const fs::path& file) {
    makeFolderOf(file);
    requireOwnIfThere(file);
    // A new one: under the old one's other names (hard links) nothing changes.
    std::error_code ignored;
    fs::remove(file, ignored);
}

std::FILE* createFile(const fs::path& file) {
    if (isSilentRank()) return std::fopen("/dev/null", "wbe");
    return createFileOfRank(file);
}

std::FILE* createFileOfRank(const fs::path& file) {
    makeRoomFor(file);
    return std::fopen(file.c_str(), "wbxe");  // x: fails where a link has come meanwhile
}

void removeFile(const fs::path& file) noexcept {
    std::error_code ignored;
    if (!isSilentRank()) fs::remove(file, ignored);
}

std::FILE* goOnWithFile(const fs::path& file) {
    if (isSilentRank()) return createFile(file);
    makeFolderOf(file);
    requireOwnIfThere(file);
    const int descriptor = open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0) return nullptr;
    std::FILE* const opened = fdopen(descriptor, "ab");
    if (!opened) close(descriptor);
    return opened;
}

}  // namespace pendular
