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
    /// @param ending of the file's name, after that of the scene
    /// @param time s, between two outputs at least, where they are due more often
    TimedTable(std::string_view owner, std::string_view ending, double time)
        : nameEnding(ending), interval(time) {
        checkValue(owner, "interval", time, "s", notNegative);
    }

    /// @param time s; times are products of rounded numbers
    [[nodiscard]] bool isDue(double time) const { return time >= last + interval * (1 - 1e-9); }
    void wroteAt(double time) { last = time; }
    template <class Scene>
    RunTable& of(const Scene& scene, const std::string& header) {
        if (!table) table = std::make_unique<RunTable>(pathOf(scene), header);
        return *table;
    }
    /// The table, and the time of its last rows, from which the next interval is counted.
    template <class Scene>
    void visitState(StateArchive& archive, const Scene& scene, const std::string& header) {
        RunTable& rows = of(scene, header);
        const std::string entry = pathOf(scene).filename().string() + "-last-time";
        if (archive.isReading() && !archive.holds(entry)) return rows.goOnFrom(scene.getTime());
        archive.value(entry, last);
        rows.visitState(archive);
    }

private:
    template <class Scene>
    [[nodiscard]] std::filesystem::path pathOf(const Scene& scene) const {
        return scene.getName() + nameEnding;
    }

    std::string nameEnding;
    std::unique_ptr<RunTable> table;
    double interval;          // s
    double last = -INFINITY;  // s, of the last rows
};

}  // namespace pendular
