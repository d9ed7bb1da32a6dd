#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pendular {

/// NAME.pvd, which ParaView opens as one thing: the files of a run by time.
class ParaViewSeries {
public:
    /// Of a run that goes on at `time` (s), the earlier entries of a series of this name are kept.
    ParaViewSeries(std::string name, double time);

    /// The path of the file of one kind ("particles") at a step, NAME-KIND-STEP.vtp, taken into the series.
    std::filesystem::path add(std::string_view kind, double time, std::size_t step);
    /// Writes the series as it is now.
    void write() const;

private:
    struct Entry {
        double time;  // s
        std::string line;
    };

    std::filesystem::path file;
    std::string beginning;
    std::vector<Entry> entries;
};

}  // namespace pendular
