#include "Kernel/Foundation/Files/WrittenBeside.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/SilentRank.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/OwnFile.h"

namespace pendular {

void requireRegularIfThere(const std::filesystem::path& file) {
    std::error_code ignored;
    const auto kind = std::filesystem::status(file, ignored).type();
    if (kind != std::filesystem::file_type::not_found && kind != std::filesystem::file_type::none &&
        kind != std::filesystem::file_type::regular)
        throw InputError(fmt::format(
            "The file {} is not a regular file: remove it, or give another name or folder.", file.string()));
}

std::filesystem::path partOrWhole(const std::filesystem::path& file) {
    std::filesystem::path found = file.string() + ".part";
    std::error_code ignored;
    if (!std::filesystem::exists(found, ignored)) found = file;
    requireRegularIfThere(found);
    return found;
}

void requireBytes(const std::filesystem::path& file, std::uintmax_t bytes) {
    const std::uintmax_t there = sizeOf(file);
    if (there < bytes)
        throw InputError(
            fmt::format("The file {} has {} bytes and had {} when the restart file was written: bring it "
                        "back, or give another folder for the output.",
                        file.string(), there, bytes));
}

void cutBack(const std::filesystem::path& file, std::uintmax_t bytes) {
    std::error_code problem;
    requireOwnIfThere(file);
    if (!std::filesystem::exists(file, problem)) return;
    requireBytes(file, bytes);
    std::filesystem::resize_file(file, bytes, problem);
    if (problem)
        throw InputError(fmt::format("The file {} cannot be cut to its length at the restart: {}.",
                                     file.string(), problem.message()));
}

WrittenBeside::WrittenBeside(std::filesystem::path path)
    : target(std::move(path)), beside(target.string() + ".part") {
    file = createFile(beside);
    if (!file) fail("cannot be written");
}

WrittenBeside::WrittenBeside(std::filesystem::path path, std::uintmax_t bytes)
    : target(std::move(path)), beside(target.string() + ".part") {
    namespace fs = std::filesystem;
    std::error_code problem;
    if (isSilentRank()) {
        file = createFile(beside);
        return;
    }
    requireOwnIfThere(beside);
    if (!fs::exists(beside, problem) && fs::exists(target, problem)) {
        // Who has put the table elsewhere, with a link to it, keeps it: the run goes on with a copy.
        if (!fs::is_symlink(target, problem)) renameFile(target, beside);
        else if (!fs::copy_file(target, beside, problem))
            throw InputError(fmt::format("The file {} cannot be copied to {}: {}.", target.string(),
                                         beside.string(), problem.message()));
    }
    cutBack(beside, bytes);
    file = goOnWithFile(beside);
    if (!file) fail("cannot be written");
}

WrittenBeside::WrittenBeside(std::filesystem::path path, OfEachRank)
    : target(std::move(path)), beside(target.string() + ".part"), isOfRank(true) {
    file = createFileOfRank(beside);
    if (!file) fail("cannot be written");
}

std::uintmax_t WrittenBeside::flush() {
    if (isSilentRank()) return 0;
    if (!file) return sizeOf(target);
    if (std::fflush(file) != 0 || (fsync(fileno(file)) != 0 && errno != EINVAL)) fail("cannot be written");
    return sizeOf(beside);
}

WrittenBeside::~WrittenBeside() {
    if (file) std::fclose(file);
}

void WrittenBeside::write(std::string_view bytes) {
    if (!file)
        throw InputError(
            fmt::format("The file {} is complete; nothing can be added to it.", target.string()));
    if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) fail("cannot be written");
}

void WrittenBeside::finish() {
    std::FILE* open = std::exchange(file, nullptr);
    if (!open) return;
    if (std::fclose(open) != 0) fail("cannot be completed");
    isFinished = true;
}

void WrittenBeside::close() {
    finish();
    if (!std::exchange(isFinished, false) || (isSilentRank() && !isOfRank)) return;
    std::error_code problem;
    std::filesystem::rename(beside, target, problem);
    if (problem) fail("cannot be renamed to its final name");
}

void WrittenBeside::discard() noexcept {
    if (file) std::fclose(std::exchange(file, nullptr));
    if (isSilentRank() && !isOfRank) return;
    std::error_code ignored;
    for (const std::filesystem::path& one : {beside, target}) std::filesystem::remove(one, ignored);
}

void WrittenBeside::fail(std::string_view what) const {
    throw InputError(fmt::format("The file {} {}: {}.", target.string(), what, std::strerror(errno)));
}

}  // namespace pendular
