#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Ranks/AllRanks.h"
#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {

class StateArchive;

/// What has gone through a plane: grains, and rigid bodies, each as one. Velocities are those with which they
/// moved in the step in which they went through it: way over time.
struct FluxCount {
    std::uint64_t forwards = 0, backwards = 0;   // with the plane's normal and against it
    double massForwards = 0, massBackwards = 0;  // kg
    Vector<double> momentumForwards{0, 0, 0}, momentumBackwards{0, 0, 0};  // kg m/s
    // m^3, of films, half of each bridge between grains, and all of each one to a wall
    double liquidForwards = 0, liquidBackwards = 0;
    [[nodiscard]] std::int64_t net() const {
        return static_cast<std::int64_t>(forwards) - static_cast<std::int64_t>(backwards);
    }
    [[nodiscard]] double netMass() const { return massForwards - massBackwards; }
    [[nodiscard]] Vec3D netMomentum() const { return toEigen(momentumForwards - momentumBackwards); }
    [[nodiscard]] double netLiquid() const { return liquidForwards - liquidBackwards; }
};

/// A plane as a driver describes it, before it is added to a scene.
struct FluxPlane {
    Vec3D normal;  // of any length
    Vec3D point;   // m, on the plane
};

/// Planes that count the grains whose centres go through them, and the rigid bodies whose centres of mass do.
/// A grain or body counts +1 when its distance along the normal changes from below 0 to 0 or above in a step,
/// and -1 the other way; one that goes to and fro nets 0 or 1. In a scene that repeats itself along the
/// normal, the plane's images count, too; that a grain is brought back into the period is no crossing, nor is
/// that a hook puts it elsewhere.
/// In shear and strain the plane stays where it is in space, and what the flow carries through it counts. Of
/// the images of a grain that one counts which goes through the plane itself, at its velocity; of those
/// beside each other along the plane, that which is inside the periodic box then.
class FluxPlaneHandler {
public:
    /// At set-up only. Returns the plane's number.
    std::size_t copyAndAddObject(const FluxPlane& plane);
    [[nodiscard]] std::size_t getSize() const { return planes.size(); }
    [[nodiscard]] bool isEmpty() const { return planes.empty(); }
    /// Throws InputError if there is no such plane.
    [[nodiscard]] const FluxCount& countOf(std::size_t plane) const;

    // Called by the scene, not by drivers.

    /// The run begins. Throws InputError for a plane that is inclined to a direction in which the scene
    /// repeats itself: its images would be other planes.
    void begin(const PeriodicBox& periodic);
    /// beforeMotion() is called before the grains of a step and their images move, afterMotion() when they
    /// have.
    void beforeMotion(const ParticleStore& grains, const PeriodicBox& periodic);
    /// @param step s; @param liquidOf the grain at a place, m^3; @param ranks that share the grains
    void afterMotion(ParticleHandler& particles, const PeriodicBox& periodic, double step,
                     const std::function<double(std::uint32_t)>& liquidOf, const AllRanks& ranks = {});
    /// The step has failed: what it counted is taken back.
    void takeBack();
    void compareSetUp(StateArchive& archive) const;
    void visitState(StateArchive& archive);

private:
    struct Plane {
        Vector<double> normal{0, 0, 0};  // unit
        double offset = 0;               // m
        double period = 0;               // m; 0: the plane has no images
        int axis = -1;                   // along which it has them
        FluxCount count, before;         // and that before the motion
    };
    struct Crossing {
        std::uint32_t identity;  // of a rigid body, that of its first grain
        std::uint32_t place;     // of the grain
        std::uint32_t body;      // where the rigid body is, or RigidBodies::none
        double times;            // forwards
        Vector<double> way;      // m, in the step
    };
    /// Grains in no rigid body that have gone through a plane, and bodies.
    void findCrossings(const Plane& plane, const ParticleStore& grains, const PeriodicBox& periodic,
                       double step);
    void findCrossingsAtRest(const Plane& plane, const ParticleStore& grains);
    /// What goes through a plane one way in a step.
    struct OneWay {
        std::uint64_t number = 0;
        ExactSum mass, liquid;    // kg, m^3
        ExactVectorSum momentum;  // kg m/s

        void add(const Crossing& crossing, double mass, double liquid, double step);
        void addOfOthers(const AllRanks& ranks);
    };
    /// Adds the crossings that have been found to the count of a plane: sums of a step are exact, so that it
    /// does not matter which comes first.
    void count(Plane& plane, ParticleHandler& particles, double step,
               const std::function<double(std::uint32_t)>& liquidOf, const AllRanks& ranks) const;

    std::vector<Plane> planes;
    std::vector<Vector<double>> from,
        bodiesFrom;       // m, of the grain at each place and of each body, before the motion
    PeriodicBox boxFrom;  // before the motion
    std::vector<Crossing> crossings;
    bool hasBegun = false;
};

}  // namespace pendular
