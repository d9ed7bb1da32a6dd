#pragma once

#include <algorithm>

#include "Tools/Studies/AccuracyVersusCost/StudiedCollision.h"

namespace pendular {

/// What is seen of a head-on collision of two grains.
struct SeenCollision {
    bool parted = false;
    double restitution = 0;     // 0 if they did not part
    double contactTime = 0;     // s
    double largestOverlap = 0;  // m, of those at the steps: below the largest by at most a dt^2 / 8
};

/// A moment of it.
struct CollisionMoment {
    double time;     // s, since the first touch
    double overlap;  // m
    double force;    // N, on either grain; negative where it pulls them together
    double parting;  // m/s, negative while they approach
};

/// Steps until the grains have parted, or for the longest time (s) since the first touch, and calls
/// visit(CollisionMoment) after each step in which they touch. The motion outside of the touch is straight,
/// so that its start and its end are known between steps.
template <class S, class Visit>
SeenCollision watchCollision(StudiedCollision<S>& collision, const Encounter& encounter, double longestTime,
                             Visit&& visit) {
    const double begin = encounter.gap / encounter.speed;
    SeenCollision seen;
    collision.initialise();
    for (bool touched = false; collision.getTime() - begin < longestTime;) {
        collision.step();
        const auto grain = collision.particleHandler.getObject(1);
        const CollisionMoment now{collision.getTime() - begin, -collision.separation(), grain.getForce().x(),
                                  2 * grain.getVelocity().x()};
        if (now.overlap > 0) {
            touched = true;
            seen.largestOverlap = std::max(seen.largestOverlap, now.overlap);
            visit(now);
        } else if (touched) {
            seen.parted = true;
            seen.restitution = now.parting / encounter.speed;
            seen.contactTime = now.time + now.overlap / now.parting;
            break;
        }
    }
    return seen;
}

}  // namespace pendular
