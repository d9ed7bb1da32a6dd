#pragma once

#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Walls/WallHandler.h"

namespace pendular {

/// Moves the planes that are moved by the forces on them (InfiniteWall::setPiston(), setTargetForce()), in
/// the two parts of a step around the forces. A piston is integrated like a grain, with the sum of the
/// contact forces that the wall keeps, which is exact: no bit depends on the order of contacts.
class PlaneMotion {
public:
    /// The step, and what moves planes in it besides contacts.
    struct Step {
        double time;             // s, at its start
        double length;           // s
        Vector<double> gravity;  // m/s^2
        const Integrator& scheme;
        double smallestRadius;  // m, of the grains
        bool bringsGrains;      // the scene has inlets
        int threads = 1;
    };

    /// Whether it is a plane; a wall of another shape that has a drive is left where it is.
    [[nodiscard]] static bool canMove(const Wall& wall);

    /// A step is about to begin: there is nothing to be taken back.
    void forget() { before.clear(); }
    /// Called before walls move. Throws RunError where a plane cannot go on.
    void begin(const WallHandler& walls, const ContactSystem& contacts, const ParticleStore& grains,
               const Step& step);
    /// Called when the forces are known.
    static void finish(const WallHandler& walls, const Step& step);
    /// Undoes begin.
    void takeBack(const WallHandler& walls) const;

private:
    struct Before {
        std::size_t wall;
        PlaneDrive drive;
        Pose pose;
        Vector<double> velocity;  // m/s
    };
    std::vector<Before> before;
};

/// The normal springs and dashpots of all contacts with a wall, exactly summed. The dashpots are those that
/// answer a speed of the wall: of contacts that overlap, and of bridges that resist motion.
[[nodiscard]] SpringAndDashpot wallStiffness(const ContactSystem& contacts, const ParticleStore& grains,
                                             int wall);

}  // namespace pendular
