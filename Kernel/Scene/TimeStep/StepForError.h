#pragma once

#include <optional>
#include <string>

namespace pendular {

class Scene;

/// A time step by the error that it makes, between one that is proved stable (stabilityLimit()) and one that
/// is only accepted.
struct StepForError {
    double step = 0;          // s
    double asked = 0;         // 1, the error
    double speed = 0;         // m/s, at which grains meet
    double largest = 0;       // 1, error of the motion after a collision, over the speed, found at the step
    double mean = 0;          // 1, of the mean motion over when a touch begins in a step
    double byCollisions = 0;  // s, up to which that error is below the one asked for; at most:
    double byBeds = 0;        // s, up to which figures of beds and flows keep to it
    double limit = 0;         // s, stabilityLimit()
    std::size_t species1 = 0, species2 = 0;  // of the collision with the largest error
    bool atWall = false;                     // with a wall of species 2
    bool together = true;  // all bodies stay together at this speed: their error is not known
    /// Bodies that neither part nor are drawn back: overdamped, or they sinter.
    struct Pair {
        std::size_t species1, species2;
        bool atWall;
    };
    std::optional<Pair> creeping{};
    std::size_t steps = 0;  // that all collisions took
    bool known = false;     // whether an error is: not where all stay together, or collisions last too long

    /// What was found and what is lost, in a few sentences.
    [[nodiscard]] std::string text() const;
};

/// The step for an error (1; 0.0001 to 0.1) of velocities and rim speeds after a collision, as shares of its
/// speed (m/s; that of estimateOverlaps() if it is not given), at set-up, when species, walls and grains are
/// there.
///
/// Two grains meet in a scene of their own with the laws and the integrator of this one, head-on and at 15,
/// 45 and 75 degrees, for each two species and each species with each wall: those sizes that part soonest.
/// Each is computed with 16 beginnings of the touch within a step and four lengths of the step (at whole
/// numbers of steps a contact ends in a step as it begins), and once with 2000 steps a contact, which stands
/// for the exact one. Liquid that moves is not there: these collisions are dry. Grains of rigid bodies meet
/// as single ones, which part sooner: a body of solid spheres is no lighter at any contact than one of them
/// alone.
///
/// Where bodies stay together no error is known, and the step is at most stabilityLimit(). A collision ends
/// as creeping when the bodies have moved towards or from each other at less than 1e-5 of the speed for four
/// contact times, or touch for a hundred, or are drawn apart for two thousand.
///
/// A bed has more: at most 0.9 over the highest frequency of two grains, up to which figures of poured beds
/// and drums were right to 1 % with the default integrator (Kernel/Core/Motion/README.md), half of that with
/// velocityVerlet, whose beds have 5 % too many contacts there; and at most stabilityLimit() for errors below
/// 1 %, which no bulk resolved, and for other integrators.
///
/// Scene::stepForError() calls it, and sees to it that the scene has not begun: it shares its laws.
/// Throws InputError where the scene has no grains, a number is out of its range, grains are
/// superquadrics or discs, a rigid body was given less mass than that, or no step of a fifth to a thousandth
/// of a contact is as exact as asked.
[[nodiscard]] StepForError findStepForError(Scene& scene, double error, std::optional<double> speed);

}  // namespace pendular
