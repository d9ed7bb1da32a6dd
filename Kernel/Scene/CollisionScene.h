#pragma once

#include <cstddef>
#include <optional>

#include "Kernel/Laws/Concepts/Bodies.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

struct PairLaws;

/// Two bodies that collide; body 2 of infinite radius is a wall.
struct CollidingBodies {
    std::size_t species1, species2;
    Bodies bodies;
    double touchTime;  // s, about, of a touch without dashpots: at least half a period

    [[nodiscard]] bool isAtWall() const { return !(bodies.radius2 < infinity); }
};

/// s, the touch time of two bodies along the normal alone: friction may be stiffer.
[[nodiscard]] double touchTime(const PairLaws& pair, const Bodies& bodies, double effectiveMass);

/// How they meet: the velocities of body 1 relative to body 2.
struct CollisionApproach {
    double normal, slip;          // m/s
    double gap;                   // m
    double spin1 = 0, spin2 = 0;  // rad/s
    double offset = 0;            // m, of body 2 from body 1 along y at the start
};

/// How a collision ends.
enum class CollisionEnd {
    Parted,
    DrawnBack,  // by what holds the bodies together: their energy is below the work of parting
    Creeps      // they neither part nor are drawn back in a bounded time: overdamped, or they sinter
};

/// A scene of a collision: body 1 comes along x, body 2 is in front of it, the slip is along y, and spins are
/// about z. It shares the laws of another scene, or of none.
class CollisionScene : public Scene {
public:
    CollisionScene(ContactLaws& of, const CollidingBodies& pair, const CollisionApproach& given, double step,
                   const Integrator& integrator);
    ~CollisionScene() override;

    /// Until the bodies have parted, and no bridge or neck holds them, or are drawn back to each other: they
    /// have less energy than parting takes then, as nothing gives them any. Overdamped bodies, and those that
    /// sinter, do neither: see creeps().
    /// @param afterStep is called after each step
    template <class AfterStep>
    CollisionEnd finish(const AfterStep& afterStep) {
        initialise();
        std::optional<CollisionEnd> end;
        while (!end) {
            step();
            afterStep();
            end = look();
        }
        return *end;
    }

    /// m, from the first body to the second, or to the wall. It turns while bodies slide past each other.
    [[nodiscard]] Vec3D shift();
    /// Unit, along the shift.
    [[nodiscard]] Vec3D normal() { return pair().isAtWall() ? Vec3D(1, 0, 0) : shift().normalized(); }
    [[nodiscard]] double overlap();  // m; negative where the bodies are apart
    [[nodiscard]] Vec3D velocityOf(std::size_t body);
    /// rad/s, about z; of a wall 0.
    [[nodiscard]] double spinOf(std::size_t body);
    /// m/s, of body 2 relative to body 1.
    [[nodiscard]] Vec3D relativeVelocity() { return velocityOf(1) - velocityOf(0); }
    /// s, of the first touch, at the steps; 0 while it has not ended.
    [[nodiscard]] double contactTime() const { return timeOfTouch; }
    [[nodiscard]] const CollidingBodies& pair() const { return meeting; }

private:
    void addGrain(std::size_t species, double radius, double side, double share);
    [[nodiscard]] std::optional<CollisionEnd> look();
    [[nodiscard]] bool creeps(bool touches, double parting);

    CollidingBodies meeting;
    CollisionApproach approach;
    std::optional<double> begin;  // s, of the touch
    double timeOfTouch = 0;       // s
    double lastMoved = 0;         // s, when they were not still
    bool leaves = false;
};

}  // namespace pendular
