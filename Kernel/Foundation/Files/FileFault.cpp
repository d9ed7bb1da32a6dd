#include "Kernel/Foundation/Files/FileFault.h"

#include <fmt/format.h>

#include <new>
#include <stdexcept>
#include <system_error>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace fs = std::filesystem;

std::string sentenceOf(const std::exception& problem) {
    if (dynamic_cast<const std::bad_alloc*>(&problem) || dynamic_cast<const std::length_error*>(&problem))
        return "There is not enough memory for this; take fewer grains, or a larger machine.";
    const auto* const fault = dynamic_cast<const fs::filesystem_error*>(&problem);
    if (!fault) return problem.what();
    const std::string reason = fault->code().message(), file = fault->path1().string(),
                      other = fault->path2().string();
    if (file.empty()) return fmt::format("A file or folder cannot be used: {}.", reason);
    if (other.empty()) return fmt::format("The file {} cannot be used: {}.", file, reason);
    return fmt::format("The file {} cannot be renamed or copied to {}: {}.", file, other, reason);
}

void renameFile(const fs::path& from, const fs::path& to) {
    std::error_code problem;
    fs::rename(from, to, problem);
    if (problem)
        throw InputError(fmt::format("The file {} cannot be renamed to {}: {}.", from.string(), to.string(),
                                     problem.message()));
}

bool isThere(const fs::path& file) noexcept {
    std::error_code ignored;
    return fs::exists(file, ignored);
}

std::uintmax_t sizeOf(const fs::path& file) {
    std::error_code problem;
    const std::uintmax_t bytes = fs::file_size(file, problem);
    if (problem)
        throw InputError(fmt::format("The file {} cannot be read: {}.", file.string(), problem.message()));
    return bytes;
}

void makeFolder(const fs::path& folder) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem)
        throw InputError(
            fmt::format("The folder {} cannot be made: {}.", folder.string(), problem.message()));
}

}  // namespace pendular
