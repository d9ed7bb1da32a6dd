#include "Kernel/Output/WrittenBeside.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "Kernel/InputError.h"

namespace pendular {

WrittenBeside::WrittenBeside(std::filesystem::path path)
    : target(std::move(path)), beside(target.string() + ".part") {
    std::error_code ignored;
    if (target.has_parent_path()) std::filesystem::create_directories(target.parent_path(), ignored);
    file = std::fopen(beside.c_str(), "wb");
    if (!file) fail("cannot be written");
}

WrittenBeside::~WrittenBeside() {
    if (file) std::fclose(file);
}

void WrittenBeside::write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) fail("cannot be written");
}

void WrittenBeside::close() {
    std::FILE* open = std::exchange(file, nullptr);
    if (!open) return;
    if (std::fclose(open) != 0) fail("cannot be completed");
    std::error_code problem;
    std::filesystem::rename(beside, target, problem);
    if (problem) fail("cannot be renamed to its final name");
}

void WrittenBeside::fail(std::string_view what) const {
    throw InputError(fmt::format("The file {} {}: {}.", target.string(), what, std::strerror(errno)));
}

}  // namespace pendular
