#pragma once

#include <fmt/format.h>

#include <string>

#include "Kernel/Output/TimedTable.h"

namespace pendular {

/// NAME-energy.csv: the energy of a scene by mechanism over time. Given to Simulation::addOutput(), which
/// then keeps the ledger.
class EnergyFile {
public:
    /// @param time s, from one of the rows to the next; 0: whenever outputs are due
    explicit EnergyFile(double time = 0) : table("EnergyFile", "-energy.csv", time) {}

    [[nodiscard]] OutputInterval interval() const { return table.interval(); }
    template <class Scene>
    void prepare(Scene& scene) const {
        scene.keepEnergyLedger();
    }

    template <class Scene>
    void write(const Scene& scene) {
        const double time = scene.getTime();
        if (table.has(time)) return;
        const auto& ledger = scene.energyLedger();
        std::string row = fmt::format("{}", time);
        for (const auto& entry : ledger.entries()) row += fmt::format(",{}", ledger.*entry.member);
        table.of(scene, headerOf(ledger)).row(row);
        table.wroteAt(time);
    }
    template <class Scene>
    void complete(const Scene& scene) {
        table.of(scene, headerOf(scene.energyLedger())).close();
    }

    template <class Scene>
    void visitState(StateArchive& archive, const Scene& scene) {
        table.visitState(archive, scene, headerOf(scene.energyLedger()));
    }

private:
    template <class Ledger>
    static std::string headerOf(const Ledger& ledger) {
        std::string columns = "time_s";
        for (const auto& entry : ledger.entries()) columns += fmt::format(",{}_J", entry.name);
        return columns;
    }

    TimedTable table;
};

}  // namespace pendular
