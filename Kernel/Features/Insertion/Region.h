#pragma once

#include <array>
#include <memory>

#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Foundation/Math/BoxTree.h"
#include "Kernel/Foundation/Math/CountedRandom.h"

namespace pendular {

class WallHandler;

/// A part of space: where grains come, or where they go. A sphere is in it if no point of the sphere is
/// outside.
class Region {
public:
    virtual ~Region() = default;

    /// Whether a sphere of radius `margin` (m) around a point (m) is in the region; with 0: whether the point
    /// is. Round-off of 1e-12 of the margin is let pass.
    [[nodiscard]] virtual bool contains(const Vector<double>& point, double margin) const = 0;
    [[nodiscard]] bool contains(const Vec3D& point, double margin = 0) const {
        return contains(toVector(point), margin);
    }
    /// m^3
    [[nodiscard]] virtual double volume() const = 0;
    [[nodiscard]] virtual Box bounds() const = 0;
    /// m^2, the area that it covers for one who looks along a unit vector.
    [[nodiscard]] virtual double areaAcross(const Vector<double>& direction) const = 0;
    /// m: no sphere in the region has a larger radius.
    [[nodiscard]] virtual double largestSphere() const = 0;
    /// The shift that moves a sphere into the region: for each piece of the surface that it goes through, the
    /// part (m) of the radius that is outside, inwards.
    [[nodiscard]] virtual Vector<double> inwards(const Vector<double>& centre, double radius) const = 0;
    /// A point for three numbers even in [0, 1): even among the centres of spheres that are in the region,
    /// or, where this has no closed form, in a box around it; contains() tells.
    [[nodiscard]] virtual Vector<double> candidate(const std::array<double, 3>& even, double margin) const;
    /// A random point, the same for the same seed, identity and purpose: even among the centres of spheres of
    /// radius `margin` (m) that are in the region. It takes the numbers of three purposes. Throws InputError
    /// if none of a million candidates is in the region.
    [[nodiscard]] Vector<double> point(const CountedRandom& random, std::uint64_t identity,
                                       std::uint32_t purpose, double margin = 0) const;
    /// The region of a scene that repeats itself: where it reaches from a face of the period to the other
    /// one, that is no border. Throws InputError if it is longer than the period.
    [[nodiscard]] virtual std::shared_ptr<const Region> in(const PeriodicBox& periodic) const = 0;
    /// The axes along which it has no border, after in().
    [[nodiscard]] virtual std::array<bool, 3> openAxes() const { return {}; }
    /// Visits the numbers of the region by StateArchive::same().
    virtual void visitState(StateArchive& archive) const = 0;

protected:
    static double withRoundOff(double margin) { return margin * (1 - 1e-12); }
    /// Whether bounds go all the way round a scene that repeats itself, for each axis. Throws InputError if
    /// they are longer than the period.
    static std::array<bool, 3> goesRound(std::string_view owner, const Box& bounds,
                                         const PeriodicBox& periodic);
};

/// The candidate number `attempt` for a random point.
Vector<double> candidateOf(const Region& region, const CountedRandom& random, std::uint64_t identity,
                           std::uint32_t purpose, std::uint32_t attempt, double margin);

/// A box with edges along the axes.
class BoxRegion final : public Region {
public:
    /// m, its corners; throws InputError unless each of the highest is above the lowest.
    BoxRegion(const Vec3D& lowest, const Vec3D& highest);

    using Region::contains;
    [[nodiscard]] bool contains(const Vector<double>& point, double margin) const override;
    [[nodiscard]] double volume() const override;
    [[nodiscard]] Box bounds() const override { return box; }
    [[nodiscard]] double areaAcross(const Vector<double>& direction) const override;
    [[nodiscard]] double largestSphere() const override;
    [[nodiscard]] Vector<double> inwards(const Vector<double>& centre, double radius) const override;
    [[nodiscard]] Vector<double> candidate(const std::array<double, 3>& even, double margin) const override;
    [[nodiscard]] std::shared_ptr<const Region> in(const PeriodicBox& periodic) const override;
    [[nodiscard]] std::array<bool, 3> openAxes() const override { return open; }
    void visitState(StateArchive& archive) const override;

private:
    Box box;
    std::array<bool, 3> open{};  // no border along this axis
};

/// A solid cylinder of any direction.
class CylinderRegion final : public Region {
public:
    /// @param from m, @param to m: the middles of its ends; @param radius m
    CylinderRegion(const Vec3D& from, const Vec3D& to, double radius);

    using Region::contains;
    [[nodiscard]] bool contains(const Vector<double>& point, double margin) const override;
    [[nodiscard]] double volume() const override;
    [[nodiscard]] Box bounds() const override;
    [[nodiscard]] double areaAcross(const Vector<double>& direction) const override;
    [[nodiscard]] double largestSphere() const override;
    [[nodiscard]] Vector<double> inwards(const Vector<double>& centre, double radius) const override;
    [[nodiscard]] Vector<double> candidate(const std::array<double, 3>& even, double margin) const override;
    [[nodiscard]] std::shared_ptr<const Region> in(const PeriodicBox& periodic) const override;
    [[nodiscard]] std::array<bool, 3> openAxes() const override;
    void visitState(StateArchive& archive) const override;

private:
    Vector<double> begin, axis;  // m; unit
    double length = 0, radius;   // m
    bool open = false;           // without ends
};

class SphereRegion final : public Region {
public:
    /// @param centre m; @param radius m
    SphereRegion(const Vec3D& centre, double radius);

    using Region::contains;
    [[nodiscard]] bool contains(const Vector<double>& point, double margin) const override;
    [[nodiscard]] double volume() const override;
    [[nodiscard]] Box bounds() const override;
    [[nodiscard]] double areaAcross(const Vector<double>& direction) const override;
    [[nodiscard]] double largestSphere() const override { return radius; }
    [[nodiscard]] Vector<double> inwards(const Vector<double>& centre, double radius) const override;
    [[nodiscard]] Vector<double> candidate(const std::array<double, 3>& even, double margin) const override;
    [[nodiscard]] std::shared_ptr<const Region> in(const PeriodicBox& periodic) const override;
    void visitState(StateArchive& archive) const override;

private:
    Vector<double> middle;  // m
    double radius;          // m
};

/// The part of a box that the walls of a scene leave: in front of planes, inside or outside of cylinders, and
/// not within a radius of meshes (of which a region does not know the sides; MeshRegion does). The walls are
/// asked each time, so it follows walls that move; its volume is measured by 2^16 points, once, and again
/// where it sticks out of a periodic box.
class BetweenWalls final : public Region {
public:
    /// @param walls of the scene, which must be there as long as the region
    BetweenWalls(const WallHandler& walls, const Vec3D& lowest, const Vec3D& highest);

    using Region::contains;
    [[nodiscard]] bool contains(const Vector<double>& point, double margin) const override;
    [[nodiscard]] double volume() const override { return size; }
    [[nodiscard]] Box bounds() const override { return box->bounds(); }
    [[nodiscard]] double areaAcross(const Vector<double>& direction) const override;
    [[nodiscard]] double largestSphere() const override;
    [[nodiscard]] Vector<double> inwards(const Vector<double>& centre, double radius) const override;
    [[nodiscard]] Vector<double> candidate(const std::array<double, 3>& even, double margin) const override;
    [[nodiscard]] std::shared_ptr<const Region> in(const PeriodicBox& periodic) const override;
    [[nodiscard]] std::array<bool, 3> openAxes() const override { return box->openAxes(); }
    void visitState(StateArchive& archive) const override;

private:
    [[nodiscard]] double measured() const;

    std::shared_ptr<const Region> box;
    const WallHandler* walls;
    PeriodicBox periodic;  // of the scene; none before in()
    double size = 0;       // m^3
};

}  // namespace pendular
