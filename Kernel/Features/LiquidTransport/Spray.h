#pragma once

#include <cstdint>
#include <string>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Foundation/Math/CountedRandom.h"

namespace pendular {

/// A droplet as it leaves a spray.
struct NewDroplet {
    Vector<double> position, velocity;  // m, m/s
    double radius;                      // m
};

/// A nozzle, or rain: it emits droplets of a liquid. After a time t since its start, exactly floor(Q t / V_d)
/// droplets have come out, one after the other, for any time step. Where droplet k starts and how it flies
/// are counted random numbers of (seed, k): the same for any step, any threads, and across restarts.
class Spray {
public:
    /// Droplets start evenly in a parallelogram, and fly in one direction.
    /// @param middle m; @param edge1, edge2 its edges, m; @param direction of any length
    void setRain(const Vec3D& middle, const Vec3D& edge1, const Vec3D& edge2, const Vec3D& direction);
    /// Droplets start at a nozzle (m), with directions in a plane: the angle to the fan's direction is even
    /// in -angle/2 to angle/2 (rad), the speed the same for all.
    /// @param across a vector in the plane of the fan, across its direction at least in part
    void setFlatFan(const Vec3D& nozzle, const Vec3D& direction, const Vec3D& across, double angle);
    /// Droplets start at a nozzle (m), evenly in the solid angle of a cone with this angle (rad) at its tip.
    void setCone(const Vec3D& nozzle, const Vec3D& direction, double angle);
    /// Q, m^3/s
    void setFlow(double value);
    /// The radius (m) of a droplet: V_d is its volume.
    void setDropletRadius(double value);
    /// Volumes of droplets are even in V_d (1 - sqrt(3) s) to V_d (1 + sqrt(3) s): of mean V_d, and of the
    /// relative standard deviation s, at most 0.5.
    void setVolumeSpread(double value);
    /// The speed (m/s) of a droplet as it starts; in shear and strain against the flow at its place.
    void setSpeed(double value);
    /// s: droplets come out between these times; 0 and the end of the run, if this is not called.
    void setTimes(double first, double last);
    /// Droplets hand over their momentum: a grain that catches one gets (m v + m_d v_d)/(m + m_d), and does
    /// not turn by it. A rigid body gets momentum and angular momentum at the place of the droplet, so that
    /// this place and the droplet have one velocity. The mass of the film stays uncounted.
    /// @param liquidDensity kg/m^3
    void setMomentum(double liquidDensity);
    void setSeed(std::uint64_t value) { seed = value; }
    /// s: a droplet that flies longer is lost. 1 s, if this is not called.
    void setLongestFlight(double value);

    [[nodiscard]] double dropletRadius() const { return radius; }
    /// V_d, m^3
    [[nodiscard]] double dropletVolume() const;
    [[nodiscard]] double flow() const { return flowRate; }
    /// kg/m^3; 0: droplets hand over no momentum
    [[nodiscard]] double liquidDensity() const { return density; }
    [[nodiscard]] double longestFlight() const { return longest; }
    /// The volume of the largest droplet over V_d.
    [[nodiscard]] double largestShare() const { return 1 + spreadWidth(); }

    /// How many droplets have come out by a time (s).
    [[nodiscard]] std::uint64_t countAt(double time) const;
    /// s: when droplet k, counted from 0, comes out.
    [[nodiscard]] double timeOf(std::uint64_t k) const;
    /// The volume (m^3) that will have come out by a time (s), at most.
    [[nodiscard]] double volumeBy(double time) const;
    /// @param number of the spray in its scene
    [[nodiscard]] NewDroplet droplet(std::uint64_t k, std::size_t number) const;

    /// Throws InputError if something is not set. @param number of the spray in its scene
    void check(std::size_t number) const;
    void compareSetUp(StateArchive& archive) const;

private:
    enum class Shape { None, Rain, FlatFan, Cone };

    [[nodiscard]] double spreadWidth() const;

    Shape shape = Shape::None;
    Vector<double> middle{0, 0, 0};                          // m
    Vector<double> edge1{0, 0, 0}, edge2{0, 0, 0};           // m; of fan and cone: unit, across the direction
    Vector<double> direction{0, 0, 0};                       // unit
    double angle = 0;                                        // rad
    double flowRate = unset, radius = unset, speed = unset;  // m^3/s, m, m/s
    double spread = 0;
    double first = 0, last = infinity;  // s
    double density = 0;                 // kg/m^3
    double longest = 1;                 // s
    std::uint64_t seed = 1;
};

}  // namespace pendular
