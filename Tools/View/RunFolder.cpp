#include "Tools/View/RunFolder.h"

#include <fmt/format.h>
#include <sys/sysmacros.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <set>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/View/NameText.h"

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

/// "a/b/run": its parts; empty where one of them could lead elsewhere.
std::vector<std::string> partsOf(const std::string& path) {
    std::vector<std::string> parts;
    if (path.empty() || path.size() > 1000 || path.find('\0') != path.npos) return parts;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        const std::string part = path.substr(begin, end - begin);
        if (part.empty() || part[0] == '.') return {};
        parts.push_back(part);
        begin = end + 1;
    }
    if (parts.size() > RunFolder::deepest + 1) return {};
    return parts;
}

/// Goes through a folder and those in it.
class Listing {
public:
    void add(const OpenFolder& folder, const std::string& path, int depth) {
        folder.forEach([&](const std::string& name, OpenFolder::Kind kind) {
            if (++seen > mostEntries || found.size() >= RunFolder::mostRuns) return false;
            if (name[0] == '.' || depth >= RunFolder::deepest) return true;
            if (kind == OpenFolder::Kind::File) {
                addFile(folder, path, name);
            } else if (const auto inner = folder.folder(name)) {
                add(*inner, path + name + "/", depth + 1);
            }
            return true;
        });
    }
    std::set<std::string> found;

private:
    void addFile(const OpenFolder& folder, const std::string& path, const std::string& name) {
        const std::string run = runOf(name);
        if (run.empty() || (name.ends_with(".pvd") && isOfFields(folder, name))) return;
        found.insert(textOfName(path + run));
    }

    std::size_t seen = 0;
};

}  // namespace

bool isOfFields(const OpenFolder& folder, const std::string& series) {
    const auto file = folder.file(series);
    const std::string begin = file ? file->bytes(0, 1000) : "";
    const std::size_t first = begin.find("<DataSet "), end = std::min(begin.find('>', first), begin.size());
    return first < end && begin.substr(first, end - first).find(" name=\"fields\"") != begin.npos;
}

RunFolder::RunFolder(const fs::path& root) {
    std::error_code problem;
    const fs::path path = fs::canonical(root, problem);
    if (problem || !fs::is_directory(path, problem))
        throw InputError(
            fmt::format("view: there is no folder {}; give one with the folders of runs.", root.string()));
    top = std::make_shared<const OpenFolder>(path);
}

std::vector<std::string> RunFolder::list() const {
    Listing listing;
    listing.add(*top, "", 0);
    return {listing.found.begin(), listing.found.end()};
}

std::optional<RunFiles> RunFolder::find(const std::string& id) const {
    const std::vector<std::string> parts = partsOf(nameOfText(id).value_or(""));
    if (parts.empty()) return {};
    RunFiles run{id, top, parts.back()};
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
        auto inner = run.folder->folder(parts[k]);
        if (!inner) return {};
        run.folder = std::make_shared<const OpenFolder>(std::move(*inner));
    }
    const OpenFolder& folder = *run.folder;
    if (run.name == "run" && folder.hasFile(startFile)) return run;
    for (const std::string_view ending : endings)
        if (folder.hasFile(run.file(ending)) ||
            (run.name == "run" && folder.hasFile(RunFiles::preparationFile(ending))))
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

pid_t Locks::holderOf(const OpenFolder& folder, const std::string& file) const {
    const auto status = folder.status(file);
    if (!status || !S_ISREG(status->st_mode)) return 0;
    for (const Lock& held : all)
        if (held.inode == status->st_ino && held.major == gnu_dev_major(status->st_dev) &&
            held.minor == gnu_dev_minor(status->st_dev))
            return held.process;
    return 0;
}

}  // namespace pendular::view
