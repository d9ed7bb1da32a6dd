#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "Kernel/Output/RunTable.h"
#include "Kernel/Species/Field.h"

namespace pendular {

/// A table of a scene over time, at an interval: what the outputs of Simulation::addOutput() share that write
/// one. A run that is restarted goes on with it, as RunTable says; where the restart file knows none, with
/// the rows of earlier times that are there.
class TimedTable {
public:
    /// @param time s, between two outputs at least, where they are due more often
    TimedTable(std::string_view owner, double time) : interval(time) {
        checkValue(owner, "interval", time, "s", notNegative);
    }

    /// @param time s; times are products of rounded numbers
    [[nodiscard]] bool isDue(double time) const { return time >= last + interval * (1 - 1e-9); }
    void wroteAt(double time) { last = time; }
    RunTable& at(const std::filesystem::path& path, const std::string& header) {
        if (!table) table = std::make_unique<RunTable>(path, header);
        return *table;
    }
    /// The table, and the time of its last rows, from which the next interval is counted.
    /// @param time s, of the scene
    void visitState(StateArchive& archive, const std::filesystem::path& path, const std::string& header,
                    double time) {
        RunTable& rows = at(path, header);
        const std::string entry = path.filename().string() + "-last-time";
        if (archive.isReading() && !archive.holds(entry)) return rows.goOnFrom(time);
        archive.value(entry, last);
        rows.visitState(archive);
    }

private:
    std::unique_ptr<RunTable> table;
    double interval;          // s
    double last = -INFINITY;  // s, of the last rows
};

}  // namespace pendular
