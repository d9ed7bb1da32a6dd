#include "Kernel/Output/ParaViewSeries.h"

#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "Kernel/Input/TextFile.h"
#include "Kernel/Output/WrittenBeside.h"

namespace pendular {

namespace {

constexpr std::string_view lineBegin = "<DataSet timestep=\"";

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') result += "&amp;";
        else if (c == '<') result += "&lt;";
        else if (c == '"') result += "&quot;";
        else result += c;
    }
    return result;
}

std::string unescaped(std::string text) {
    for (const auto& [code, sign] : {std::pair{"&lt;", "<"}, {"&quot;", "\""}, {"&amp;", "&"}})
        for (std::size_t at = text.find(code); at != text.npos; at = text.find(code, at + 1))
            text.replace(at, std::string_view(code).size(), sign);
    return text;
}

/// The value of an attribute of a line; empty where there is none.
std::string valueOf(const std::string& line, std::string_view attribute) {
    const std::string mark = fmt::format(" {}=\"", attribute);
    const std::size_t begin = line.find(mark);
    if (begin == line.npos) return {};
    const std::size_t from = begin + mark.size();
    return unescaped(line.substr(from, line.find('"', from) - from));
}

}  // namespace

std::vector<ParaViewEntry> readParaViewSeries(const std::filesystem::path& path) {
    const InputFile file = loadInputFile("ParaView series", path);
    std::vector<ParaViewEntry> entries;
    std::istringstream lines(file.text);
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (!line.starts_with(lineBegin)) continue;
        ParaViewEntry entry{0, valueOf(line, "name"), path.parent_path() / valueOf(line, "file")};
        if (!parseNumber(valueOf(line, "timestep"), entry.time) || entry.kind.empty() ||
            !entry.file.has_filename())
            file.refuse("line", number, "it has no timestep, name and file");
        entries.push_back(std::move(entry));
    }
    if (entries.empty()) file.refuse("has no files in it");
    return entries;
}

ParaViewSeries::ParaViewSeries(std::string name, double time)
    : file(name + ".pvd"), beginning(std::move(name)) {
    if (!(time > 0) || !std::filesystem::exists(file)) return;
    entries = readParaViewSeries(file);
    std::erase_if(entries, [&](const ParaViewEntry& entry) { return entry.time >= time; });
}

std::filesystem::path ParaViewSeries::add(std::string_view kind, double time, std::size_t step) {
    std::filesystem::path path = fmt::format("{}-{}-{:09}.vtp", beginning, kind, step);
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
    out.write("</Collection>\n</VTKFile>\n");
    out.close();
}

}  // namespace pendular
