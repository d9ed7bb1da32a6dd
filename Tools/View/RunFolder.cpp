#include "Tools/View/RunFolder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <utility>

#include "Kernel/Base/InputError.h"

namespace pendular::view {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 5> endings{"-summary.csv", ".pvd", "-restart.h5", ".pendular-lock",
                                                  hdf5Frames};
constexpr std::size_t mostEntries = 200000;  // that a listing looks at

/// What a file of a run says is the name of the run; empty for other files.
std::string runOf(const std::string& file) {
    if (file == startFile) return "run";
    for (const std::string_view ending : endings)
        if (file.size() > ending.size() && file.ends_with(ending) && file[0] != '.') {
            const std::string name = file.substr(0, file.size() - ending.size());
            return name == "preparation" ? "run" : name;
        }
    return {};
}

bool isOwnFolder(const fs::path& path) {
    std::error_code ignored;
    return fs::symlink_status(path, ignored).type() == fs::file_type::directory;
}

/// "a/b/run": its parts; empty where one of them could lead elsewhere.
std::vector<std::string> partsOf(const std::string& id) {
    std::vector<std::string> parts;
    if (id.empty() || id.size() > 1000 || id.find('\0') != id.npos) return parts;
    for (std::size_t begin = 0; begin <= id.size();) {
        const std::size_t end = std::min(id.find('/', begin), id.size());
        const std::string part = id.substr(begin, end - begin);
        if (part.empty() || part[0] == '.') return {};
        parts.push_back(part);
        begin = end + 1;
    }
    if (parts.size() > RunFolder::deepest + 1) return {};
    return parts;
}

}  // namespace

bool isOwnFile(const fs::path& path) {
    std::error_code ignored;
    return fs::symlink_status(path, ignored).type() == fs::file_type::regular;
}

bool isOfFields(const fs::path& series) {
    std::string begin(1000, '\0');
    std::ifstream(series).read(begin.data(), static_cast<std::streamsize>(begin.size()));
    const std::size_t first = begin.find("<DataSet "), end = std::min(begin.find('>', first), begin.size());
    return first < end && begin.substr(first, end - first).find(" name=\"fields\"") != begin.npos;
}

RunFolder::RunFolder(const fs::path& root) {
    std::error_code problem;
    top = fs::canonical(root, problem);
    if (problem || !fs::is_directory(top))
        throw InputError(
            fmt::format("view: there is no folder {}; give one with the folders of runs.", root.string()));
}

std::vector<RunFiles> RunFolder::list() const {
    std::map<std::string, RunFiles> found;
    std::error_code problem;
    fs::recursive_directory_iterator entry(top, fs::directory_options::skip_permission_denied, problem), end;
    for (std::size_t seen = 0; !problem && entry != end && seen < mostEntries;
         entry.increment(problem), ++seen) {
        const std::string name = entry->path().filename().string();
        if (name[0] == '.' || entry.depth() >= deepest || entry->is_symlink(problem)) {
            entry.disable_recursion_pending();
            continue;
        }
        const std::string run = runOf(name);
        if (run.empty() || !isOwnFile(entry->path())) continue;
        if (name.ends_with(".pvd") && isOfFields(entry->path())) continue;
        const fs::path folder = entry->path().parent_path();
        const std::string id = (folder.lexically_relative(top) / run).lexically_normal().string();
        found.try_emplace(id, RunFiles{id, folder, run});
        if (found.size() >= mostRuns) break;
    }
    std::vector<RunFiles> runs;
    for (auto& [id, run] : found) runs.push_back(std::move(run));
    return runs;
}

std::optional<RunFiles> RunFolder::find(const std::string& id) const {
    const std::vector<std::string> parts = partsOf(id);
    if (parts.empty()) return {};
    fs::path folder = top;
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
        folder /= parts[k];
        if (!isOwnFolder(folder)) return {};
    }
    const RunFiles run{id, folder, parts.back()};
    if (run.name == "run" && isOwnFile(folder / startFile)) return run;
    for (const std::string_view ending : endings)
        if (isOwnFile(run.file(ending)) || (run.name == "run" && isOwnFile(run.preparationFile(ending))))
            return run;
    return {};
}

Locks::Locks() {
    // Lines as "1: FLOCK  ADVISORY  WRITE 1234 08:01:5678 0 EOF" (proc(5)).
    std::ifstream locks("/proc/locks");
    for (std::string line; std::getline(locks, line);) {
        Lock lock;
        if (std::sscanf(line.c_str(), "%*d: FLOCK %*s %*s %d %x:%x:%llu", &lock.process, &lock.major,
                        &lock.minor, &lock.inode) == 4)
            all.push_back(lock);
    }
}

pid_t Locks::holderOf(const fs::path& lock) const {
    struct stat file {};
    if (lstat(lock.c_str(), &file) != 0 || !S_ISREG(file.st_mode)) return 0;
    for (const Lock& held : all)
        if (held.inode == file.st_ino && held.major == gnu_dev_major(file.st_dev) &&
            held.minor == gnu_dev_minor(file.st_dev))
            return held.process;
    return 0;
}

}  // namespace pendular::view
