#pragma once

#include "Kernel/Analysis/Output/TimedTable.h"

namespace pendular {

/// The base of the tables below: a table over time, given to Simulation::addOutput(). Rows is a class with
/// the ending of the file's name, the header, and what writes the rows of one time; GrainFlowFiles.cpp has
/// them.
template <class Rows>
class GrainFlowFile {
public:
    /// @param time s, from one of the outputs to the next; 0: whenever outputs are due
    explicit GrainFlowFile(double time = 0);

    [[nodiscard]] OutputInterval interval() const { return table.interval(); }
    void write(const Scene& scene);
    void complete(const Scene& scene);
    void visitState(StateArchive& archive, const Scene& scene);

private:
    TimedTable table;
};

/// NAME-inlets.csv: what has come, and what was lost for want of room, in the unit of the inlet's flow.
struct InletRows;
using InletFile = GrainFlowFile<InletRows>;

/// NAME-outlets.csv: what has gone through each outlet since the start, by species and class of size.
struct OutletRows;
using OutletFile = GrainFlowFile<OutletRows>;

/// NAME-flux.csv: what has gone through each flux plane since the start, both ways; the momentum is that
/// forwards less that backwards.
struct FluxRows;
using FluxFile = GrainFlowFile<FluxRows>;

}  // namespace pendular
