#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "Kernel/Features/Membranes/HostWall.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

/// What a participant of preCICE calls its mesh and its data.
struct PreciceNames {
    std::string mesh;                           // ours, of the vertices of the wall
    std::string displacement = "Displacement";  // read, m, from where the vertices were at the start
    std::string force = "Force";                // written, N, means over a window of time
};

/// Couples a HostWall with another program by preCICE, version 3 (G. Chourdakis et al., Open Res. Europe 2
/// (2022) 51): in each window of time it reads displacements and writes forces. Map forces conservatively,
/// displacements consistently. Coupling is explicit (serial or parallel): for implicit coupling the grains
/// would have to go back in memory.
///
///     precice::Participant participant("Grains", "precice-config.xml", 0, 1);
///     PreciceWall coupling(participant, *wall, {.mesh = "Grains-Mesh"});
///     ... beforeStep(getTimeStep()) in actionsBeforeTimeStep(), afterStep() in actionsAfterTimeStep(), and
///     requestStop() once isOngoing() is false.
/// @tparam Participant precice::Participant, or what has its functions
template <class Participant>
class PreciceWall {
public:
    /// Tells preCICE the vertices and initialises it: once the wall is where it begins. Both must outlive
    /// this; displacements are those from the shape as it was set. Throws InputError where the mesh is not of
    /// three dimensions.
    PreciceWall(Participant& of, HostWall& moved, PreciceNames given)
        : participant(of), wall(moved), names(std::move(given)), begin(placesAsSet(wall)) {
        if (const int dimensions = participant.getMeshDimensions(names.mesh); dimensions != 3)
            throw InputError(fmt::format("preCICE: the mesh {} has {} dimensions; a HostWall needs 3.",
                                         names.mesh, dimensions));
        ids.resize(begin.size());
        participant.setMeshVertices(names.mesh, flat(begin), ids);
        if (participant.requiresInitialData())
            participant.writeData(names.mesh, names.force, ids, flat(wall.getForces()));
        participant.initialize();
    }

    [[nodiscard]] bool isOngoing() { return participant.isCouplingOngoing(); }

    /// Where a window begins, the wall gets its way in it. @param step s, of the grains; windows must be
    /// multiples of it. Throws InputError where they are not, where the step changes in a window and where
    /// coupling is implicit.
    void beforeStep(double step) {
        if (left > 0 && step != stepOfWindow)
            throw InputError(fmt::format(
                "preCICE: the time step has gone from {:.6g} to {:.6g} s in a window; take a fixed one.",
                stepOfWindow, step));
        if (left > 0) return;
        stepOfWindow = step;
        if (participant.requiresWritingCheckpoint())
            throw InputError(
                "preCICE: the coupling is implicit, for which the grains cannot go back; take "
                "serial-explicit or parallel-explicit.");
        window = participant.getMaxTimeStepSize();
        const double count = std::round(window / step);
        if (!(count >= 1 && std::abs(window / step - count) < 1e-6 * count))
            throw InputError(fmt::format(
                "preCICE: the time window = {:.6g} s; it must be a multiple of the time step of the "
                "grains, {:.6g} s.",
                window, step));
        left = static_cast<std::size_t>(count);
        std::vector<double> displacements(3 * ids.size());
        participant.readData(names.mesh, names.displacement, ids, window, displacements);
        std::vector<Vec3D> targets = begin;
        for (std::size_t k = 0; k < displacements.size(); ++k)
            targets[k / 3][static_cast<Eigen::Index>(k % 3)] += displacements[k];
        wall.setTargets(targets, window);
    }

    /// Where a window ends, the other program gets the forces.
    void afterStep() {
        if (left == 0 || --left > 0) return;
        std::vector<Vec3D> forces = wall.getImpulses();
        for (Vec3D& force : forces) force /= window;
        participant.writeData(names.mesh, names.force, ids, flat(forces));
        participant.advance(window);
    }

private:
    /// m: of a run that goes on the wall has moved from there.
    static std::vector<Vec3D> placesAsSet(const HostWall& wall) {
        std::vector<Vec3D> places;
        for (const Vector<double>& vertex : wall.getNet().vertices()) places.push_back(toEigen(vertex));
        return places;
    }
    static std::vector<double> flat(const std::vector<Vec3D>& vectors) {
        std::vector<double> numbers;
        for (const Vec3D& vector : vectors)
            numbers.insert(numbers.end(), {vector.x(), vector.y(), vector.z()});
        return numbers;
    }

    Participant& participant;
    HostWall& wall;
    PreciceNames names;
    std::vector<Vec3D> begin;  // m
    std::vector<int> ids;
    double window = 0, stepOfWindow = 0;  // s
    std::size_t left = 0;                 // steps of it
};

}  // namespace pendular
