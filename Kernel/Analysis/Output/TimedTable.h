#pragma once

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Core/Run/OutputInterval.h"

namespace pendular {

class Scene;

/// A table of a scene over time, at an interval: what the outputs of Simulation::addOutput() share that write
/// one. A run that is restarted goes on with it, as RunTable says; where the restart file knows none, with
/// the rows of earlier times that are there.
class TimedTable {
public:
    /// @param ending of the file's name, after that of the scene
    /// @param time s, from one output to the next; 0: whenever outputs are due
    TimedTable(std::string_view owner, std::string_view ending, double time);

    [[nodiscard]] OutputInterval interval() const { return times; }
    /// Whether it has the rows of this time (s).
    [[nodiscard]] bool has(double time) const { return time <= last; }
    void wroteAt(double time) { last = time; }
    RunTable& of(const Scene& scene, const std::string& header);
    /// The table, and the time of its last rows.
    void visitState(StateArchive& archive, const Scene& scene, const std::string& header);

private:
    [[nodiscard]] std::filesystem::path pathOf(const Scene& scene) const;

    std::string nameEnding;
    std::unique_ptr<RunTable> table;
    OutputInterval times;
    double last = -INFINITY;  // s, of the last rows
};

}  // namespace pendular
