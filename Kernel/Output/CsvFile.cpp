#include "Kernel/Output/CsvFile.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include "Kernel/InputError.h"

namespace pendular {

CsvFile::CsvFile(std::filesystem::path path, std::string_view header)
    : target(std::move(path)), beside(target.string() + ".part") {
    std::error_code ignored;
    if (target.has_parent_path()) std::filesystem::create_directories(target.parent_path(), ignored);
    file = std::fopen(beside.c_str(), "w");
    if (!file) fail("cannot be written");
    write(fmt::format("{}\n", header));
}

CsvFile::~CsvFile() {
    if (!file) return;
    std::fclose(file);  // not completed: the part stays under its own name
}

void CsvFile::write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file) != text.size()) fail("cannot be written");
}

void CsvFile::close() {
    std::FILE* open = std::exchange(file, nullptr);
    if (!open) return;
    if (std::fclose(open) != 0) fail("cannot be completed");
    std::error_code problem;
    std::filesystem::rename(beside, target, problem);
    if (problem) fail("cannot be renamed to its final name");
}

void CsvFile::fail(std::string_view what) const {
    throw InputError(fmt::format("The file {} {}: {}.", target.string(), what, std::strerror(errno)));
}

}  // namespace pendular
