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
    /// Entries of a series of this name up to a time (s) are kept, and the files of later ones removed, if
    /// they are called as add() calls them. -infinity: a new series, whatever is in the old one.
    /// A silent rank looks at no files. @param ending of the files' names
    ParaViewSeries(std::string name, double keptUntil, std::string ending = ".vtp");
    /// Throws InputError if there is a series of this name and it cannot be read.
    static void check(const std::string& name);

    /// The path of the file of one kind ("particles") at a step, NAME-KIND-STEP.vtp (or the other ending),
    /// taken into the series.
    std::filesystem::path add(std::string_view kind, double time, std::size_t step);
    /// The same of a file whose parts are in others: NAME-KIND-STEP.pvtp.
    std::filesystem::path addParted(std::string_view kind, double time, std::size_t step);
    /// Writes the series as it is now.
    void write() const;

private:
    /// The entries of a series that is there; none for one that cannot be read, if none of them are needed.
    [[nodiscard]] std::vector<ParaViewEntry> formerEntries(bool needed) const;
    [[nodiscard]] bool isOwn(const ParaViewEntry& entry) const;
    std::filesystem::path add(std::string_view kind, double time, std::size_t step, std::string_view ending);

    std::filesystem::path file;
    std::string beginning, ending;
    std::vector<ParaViewEntry> entries;
};

}  // namespace pendular
