#include "Kernel/Output/ParaViewSeries.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "Kernel/Input/TextFile.h"
#include "Kernel/Output/WrittenBeside.h"

namespace pendular {

namespace {

constexpr std::string_view entryBegin = "<DataSet timestep=\"";

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

}  // namespace

ParaViewSeries::ParaViewSeries(std::string name, double time)
    : file(name + ".pvd"), beginning(std::move(name)) {
    if (!(time > 0)) return;
    std::ifstream before(file);
    for (std::string line; std::getline(before, line);) {
        if (!line.starts_with(entryBegin)) continue;
        const std::size_t end = line.find('"', entryBegin.size());
        double at = 0;
        if (end != line.npos &&
            parseNumber(std::string_view(line).substr(entryBegin.size(), end - entryBegin.size()), at) &&
            at < time)
            entries.push_back({at, line});
    }
}

std::filesystem::path ParaViewSeries::add(std::string_view kind, double time, std::size_t step) {
    const std::filesystem::path path = fmt::format("{}-{}-{:09}.vtp", beginning, kind, step);
    std::erase_if(entries, [&](const Entry& entry) { return entry.time > time; });
    const auto part =
        std::count_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.time == time; });
    const std::string line = fmt::format("{}{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>", entryBegin, time,
                                         part, kind, escaped(path.filename().string()));
    entries.push_back({time, line});
    return path;
}

void ParaViewSeries::write() const {
    WrittenBeside out(file);
    out.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n");
    for (const Entry& entry : entries) out.write(entry.line + "\n");
    out.write("</Collection>\n</VTKFile>\n");
    out.close();
}

}  // namespace pendular
