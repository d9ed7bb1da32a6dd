#pragma once

#include <vector>

#include "Kernel/Features/MovingWalls/PlaneMotion.h"

namespace pendular {

/// Moves the walls that are bodies (RigidWall::setSlider(), setRotor(), setFreeBody()), in the two parts of a
/// step around the forces: as grains and rigid bodies are moved, with the sums of the contact forces and
/// torques that the wall keeps, which are exact. Dry friction of a guide or a bearing takes at most the speed
/// that there is, and so holds a wall at rest.
class WallBodyMotion {
public:
    using Step = PlaneMotion::Step;

    /// A step is about to begin: there is nothing to be taken back.
    void forget() { before.clear(); }
    /// Called before walls move. Throws RunError where a wall cannot go on.
    void begin(const WallHandler& walls, const Step& step);
    /// Called when the forces are known.
    static void finish(const WallHandler& walls, const Step& step);
    /// Undoes begin.
    void takeBack(const WallHandler& walls) const;

private:
    struct Before {
        std::size_t wall;
        WallBody body;
        Pose pose;
        RigidVelocity velocity;
    };
    std::vector<Before> before;
};

}  // namespace pendular
