#include "Tools/View/FrameLists.h"

namespace pendular::view {

namespace {

/// Names instead of paths beside the list, which has the name of a handle.
template <class Entry>
std::vector<Entry> named(std::vector<Entry> entries, const std::filesystem::path& list) {
    std::erase_if(entries, [&](Entry& entry) {
        const bool isBeside = entry.file.parent_path() == list.parent_path();
        entry.file = entry.file.filename();
        return !isBeside;
    });
    return entries;
}

}  // namespace

std::vector<ParaViewEntry> filesOf(const OpenFolder& folder, const std::string& series) {
    return folder.read(
        series, [](const std::filesystem::path& path) { return named(readParaViewSeries(path), path); });
}

std::vector<Hdf5Entry> framesIn(const OpenFolder& folder, const std::string& list) {
    return folder.read(list, [&](const std::filesystem::path& path) { return readHdf5Series(path, list); });
}

}  // namespace pendular::view
