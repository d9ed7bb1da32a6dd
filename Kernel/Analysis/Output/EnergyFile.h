#pragma once

#include "Kernel/Analysis/Output/TimedTable.h"

namespace pendular {

/// NAME-energy.csv: the energy of a scene by mechanism over time. Given to Simulation::addOutput(), which
/// then keeps the ledger.
class EnergyFile {
public:
    /// @param time s, from one of the rows to the next; 0: whenever outputs are due
    explicit EnergyFile(double time = 0);

    [[nodiscard]] OutputInterval interval() const { return table.interval(); }
    void prepare(Scene& scene) const;
    void write(const Scene& scene);
    void complete(const Scene& scene);
    void visitState(StateArchive& archive, const Scene& scene);

private:
    TimedTable table;
};

}  // namespace pendular
