#include "Kernel/Foundation/Files/SetAside.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/SilentRank.h"
#include "Kernel/Foundation/Files/WrittenBeside.h"

namespace pendular {

namespace {

namespace fs = std::filesystem;

fs::path asideOf(const fs::path& file) { return file.string() + ".before"; }

}  // namespace

SetAside::SetAside(std::vector<fs::path> paths) {
    if (isSilentRank()) return;
    for (const fs::path& file : paths) requireRegularIfThere(file);
    for (fs::path& file : paths) {
        std::error_code problem;
        if (!fs::exists(file, problem)) continue;
        fs::rename(file, asideOf(file), problem);
        if (!problem) {
            files.push_back(std::move(file));
            continue;
        }
        putBack();
        throw InputError(
            fmt::format("The file {} cannot be set aside: {}.", file.string(), problem.message()));
    }
}

void SetAside::putBack() noexcept {
    for (const fs::path& file : files) {
        std::error_code ignored;
        if (!fs::exists(file, ignored)) fs::rename(asideOf(file), file, ignored);
    }
}

void SetAside::remove() noexcept {
    std::error_code ignored;
    for (const fs::path& file : files) fs::remove(asideOf(file), ignored);
    areSet = false;
}

SetAside::~SetAside() {
    if (areSet) putBack();
}

}  // namespace pendular
