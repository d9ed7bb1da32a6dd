#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pendular {

/// A file of a series.
struct ParaViewEntry {
    double time;                 // s
    std::string kind;            // "particles"
    std::filesystem::path file;  // beside the series
};

/// The files of NAME.pvd, by time, with their folder. Throws InputError if it is no series of ours.
std::vector<ParaViewEntry> readParaViewSeries(const std::filesystem::path& path);

/// NAME.pvd, which ParaView opens as one thing: the files of a run by time.
class ParaViewSeries {
public:
    /// Of a run that goes on at `time` (s), the earlier entries of a series of this name are kept.
    ParaViewSeries(std::string name, double time);

    /// The path of the file of one kind ("particles") at a step, NAME-KIND-STEP.vtp, taken into the series.
    std::filesystem::path add(std::string_view kind, double time, std::size_t step);
    /// s, of the latest entry; -infinity if there is none.
    [[nodiscard]] double lastTime() const { return entries.empty() ? -INFINITY : entries.back().time; }
    /// Writes the series as it is now.
    void write() const;

private:
    std::filesystem::path file;
    std::string beginning;
    std::vector<ParaViewEntry> entries;
};

}  // namespace pendular
