#pragma once

#include <utility>
#include <vector>

#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Features/MovingWalls/PlaneMotion.h"

namespace pendular {

/// Moves the vertices of membranes as grains are moved, in the two parts of a step around the forces. The
/// forces of contacts are handed to the corners of their triangles in the order of grains and triangles, so
/// that no bit depends on the list or the threads.
class MembraneMotion {
public:
    using Step = PlaneMotion::Step;

    /// A step is about to begin: there is nothing to be taken back.
    void forget() { before.clear(); }
    /// Finds the forces on a membrane that is new, or whose contacts have ended since the last step, at the
    /// places where grains and vertices are, before they move and before a restart file is written.
    static void renewForces(const WallHandler& walls, const ContactSystem& contacts,
                            const ParticleStore& grains, const Vector<double>& gravity, int threads);
    /// Begins a step, before walls move. Throws RunError where a vertex moves too far, a triangle collapses,
    /// or a membrane goes through itself.
    void begin(const WallHandler& walls, const Step& step);
    /// Called when the forces of contacts are known. A step of no length: at the start of a run.
    /// @param keepsWork for the energy ledger
    void finish(const WallHandler& walls, const ContactSystem& contacts, const ParticleStore& grains,
                const Step& step, bool keepsWork) const;
    /// Undoes begin.
    void takeBack(const WallHandler& walls) const;

private:
    std::vector<std::pair<std::size_t, MembraneState>> before;  // of the wall of this number
};

/// The force (N) of the grains on each vertex, by the contacts as they were last computed. The force of each
/// contact acts at the triangle's nearest point, with the couple that it has about it: force and torque are
/// kept to round-off.
[[nodiscard]] MembraneState::Column forcesOfGrains(const Membrane& membrane, int wall,
                                                   const ContactSystem& contacts, const ParticleStore& grains,
                                                   int threads = 1);

}  // namespace pendular
