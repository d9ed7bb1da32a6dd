#include "Kernel/Analysis/Output/ParaViewSeries.h"

#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "Kernel/Analysis/Output/FrameIndex.h"
#include "Kernel/Analysis/Output/FrameParts.h"
#include "Kernel/Analysis/Output/XmlText.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/SilentRank.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/OwnFile.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Kernel/Foundation/Files/WrittenBeside.h"

namespace pendular {

namespace {

constexpr std::string_view lineBegin = "<DataSet timestep=\"", lastLine = "</VTKFile>";
constexpr std::string_view partedEnding = ".pvtp";

/// The value of an attribute of a line; empty where there is none.
std::string attributeOf(const std::string& line, std::string_view attribute) {
    const std::string mark = fmt::format(" {}=\"", attribute);
    const std::size_t begin = line.find(mark);
    if (begin == line.npos) return {};
    const std::size_t from = begin + mark.size();
    return unescaped(line.substr(from, line.find('"', from) - from));
}

}  // namespace

std::vector<ParaViewEntry> readParaViewSeries(const std::filesystem::path& path) {
    const InputFile file = loadTextFile("ParaView series", path);
    std::vector<ParaViewEntry> entries;
    std::istringstream lines(file.text);
    std::size_t number = 0;
    bool isWhole = false;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        isWhole = isWhole || line.starts_with(lastLine);
        if (!line.starts_with(lineBegin)) continue;
        ParaViewEntry entry{0, attributeOf(line, "name"), path.parent_path() / attributeOf(line, "file")};
        if (!parseNumber(attributeOf(line, "timestep"), entry.time) || entry.kind.empty() ||
            !entry.file.has_filename())
            file.refuse("line", number, "it has no timestep, name and file");
        entries.push_back(std::move(entry));
    }
    if (entries.empty()) file.refuse("has no files in it");
    if (!isWhole) file.refuse(fmt::format("is not whole: it has no line {}", lastLine));
    return entries;
}

ParaViewSeries::ParaViewSeries(std::string name, double keptUntil, std::string fileEnding)
    : file(name + ".pvd"), beginning(std::move(name)), ending(std::move(fileEnding)) {
    if (isSilentRank()) return;
    std::vector<std::filesystem::path> dropped;
    const std::vector<ParaViewEntry> former = formerEntries(keptUntil != -INFINITY);
    for (const ParaViewEntry& entry : former)
        if (entry.time <= keptUntil) entries.push_back(entry);
        else if (isOwn(entry)) dropped.push_back(entry.file);
    // In this order, so that a series never names a file that is not there.
    if (entries.empty()) removeFile(file);
    else if (entries.size() < former.size()) write();
    for (const std::filesystem::path& path : dropped) removeWithPieces(path);
}

std::vector<ParaViewEntry> ParaViewSeries::formerEntries(bool needed) const {
    if (!isThere(file)) return {};
    try {
        return readParaViewSeries(file);
    } catch (const InputError&) {
        if (needed) throw;
        return {};
    }
}

bool ParaViewSeries::isOwn(const ParaViewEntry& entry) const {
    // Both folders come from that of the series; its name as it was given may have "//" in it.
    if (entry.file.parent_path() != file.parent_path()) return false;
    const std::string name = entry.file.filename().string(),
                      begin = fmt::format("{}-{}-", std::filesystem::path(beginning).filename().string(),
                                          entry.kind);
    constexpr std::size_t fewestDigits = 9;
    const std::string_view last = name.ends_with(partedEnding) ? partedEnding : ending;
    if (!name.starts_with(begin) || !name.ends_with(last) ||
        name.size() < begin.size() + fewestDigits + last.size())
        return false;
    const std::string step = name.substr(begin.size(), name.size() - begin.size() - last.size());
    return step.find_first_not_of("0123456789") == step.npos;
}

void ParaViewSeries::check(const std::string& name) { checkFrameIndex(name + ".pvd", readParaViewSeries); }

std::filesystem::path ParaViewSeries::add(std::string_view kind, double time, std::size_t step) {
    return add(kind, time, step, ending);
}

std::filesystem::path ParaViewSeries::addParted(std::string_view kind, double time, std::size_t step) {
    return add(kind, time, step, partedEnding);
}

std::filesystem::path ParaViewSeries::add(std::string_view kind, double time, std::size_t step,
                                          std::string_view last) {
    std::filesystem::path path = fmt::format("{}-{}-{:09}{}", beginning, kind, step, last);
    std::erase_if(entries,
                  [&](const ParaViewEntry& entry) { return entry.time == time && entry.kind == kind; });
    entries.push_back({time, std::string(kind), path});
    return path;
}

void ParaViewSeries::write() const {
    WrittenBeside out(file);
    out.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n");
    int part = 0;
    for (std::size_t k = 0; k < entries.size(); ++k) {
        part = k > 0 && entries[k].time == entries[k - 1].time ? part + 1 : 0;
        out.write(fmt::format("{}{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", lineBegin, entries[k].time,
                              part, escaped(entries[k].kind), escaped(entries[k].file.filename().string())));
    }
    out.write("</Collection>\n");
    out.write(fmt::format("{}\n", lastLine));
    out.close();
}

}  // namespace pendular
