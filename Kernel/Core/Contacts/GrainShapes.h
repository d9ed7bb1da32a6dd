#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "Kernel/Features/Superquadrics/Superquadric.h"
#include "Kernel/Foundation/Math/Quaternion.h"
#include "Kernel/Laws/Concepts/Bodies.h"

namespace pendular {

class ParticleStore;
class SuperquadricGrain;
class Wall;
class WallHandler;
struct WallPoint;

/// How two grains that are no spheres touch, or a grain and a wall.
struct ShapedTouch {
    Vector<double> normal;  // unit, from body 1 to body 2
    double depth;           // m; negative: a gap
    Vector<double> arm1;    // m, from the centre of body 1 to the middle of the overlap
    double radius;          // m, the effective radius as the laws take it
    Bodies own{radius};     // m, Gauss' radius of each; infinite of what is flat
};

/// What the contacts of a grain can be at most, wherever on its surface they are.
struct ShapeExtremes {
    double radius;   // m, Gauss'; infinite on flat faces
    double around;   // m, which stands for it where that is more
    double turning;  // (arm x n) I^-1 (arm x n) m: by how much the turning adds to 1/m along the normal
    double sliding;  // the same along a tangent
    double lever;    // m, |arm x n|: times the spin, the speed by which the surface comes nearer
};

/// A grain's shape, and where its axes point to in space.
struct ShapeInSpace {
    Superquadric shape;  // three equal half lengths: a sphere
    Axes<double> axes;
    double edgeRadius = 0;  // m; of a box with rounded edges, which has these half lengths; else 0
};

/// The grains of a scene that may be no spheres: what is asked of them besides the forces of their contacts.
/// The radius of such a grain in the store is that of the sphere around it. A grain without a shape is a
/// sphere, which may be part of a clump.
class GrainShapes {
public:
    virtual ~GrainShapes() = default;

    /// Adds a grain with a shape, as a body of its own.
    virtual void add(const SuperquadricGrain& grain) = 0;
    /// Grains of this shape, of any size, are to come: limits count with it from now on.
    virtual void expect(const Superquadric& shape) = 0;
    /// The factor by which Gauss' radius at a contact may be larger than that of the spheres around, at most,
    /// of all shapes that are there or expected: for the stability limit.
    [[nodiscard]] virtual double largestRadiusRatio() const = 0;

    /// Whether the grain at a place of the store is no sphere.
    [[nodiscard]] virtual bool isShaped(const ParticleStore& grains, std::uint32_t place) const = 0;
    [[nodiscard]] virtual ShapeInSpace shapeAt(const ParticleStore& grains, std::uint32_t place) const = 0;
    /// m, from the centre of a grain to its farthest point along a normal (unit).
    [[nodiscard]] virtual Vector<double> farthest(const ParticleStore& grains, std::uint32_t place,
                                                  const Vector<double>& normal) const = 0;
    /// How the grains at two places of the store touch.
    /// @param shift m, centre 2 - centre 1
    [[nodiscard]] virtual ShapedTouch touch(const ParticleStore& grains, std::uint32_t first,
                                            std::uint32_t second, const Vector<double>& shift) const = 0;
    /// m, by which the solids of two grains go through each other where no contact tells of it; else 0.
    [[nodiscard]] virtual double hiddenOverlap(const ParticleStore& grains, std::uint32_t first,
                                               std::uint32_t second, const Vector<double>& shift) const = 0;
    /// How a grain touches a plane.
    /// @param normal unit, into the plane; @param distance m, of the centre
    [[nodiscard]] virtual ShapedTouch touchAtPlane(const ParticleStore& grains, std::uint32_t grain,
                                                   const Vector<double>& normal, double distance) const = 0;
    /// How a grain touches a part of a wall, or is apart from it by less than a range (m).
    [[nodiscard]] ShapedTouch touchAtWall(const ParticleStore& grains, std::uint32_t grain, const Wall& wall,
                                          std::uint32_t part, double range) const;
    /// What Wall::findPoints() is for spheres, for the grain at a place: of each listed part the normal at
    /// which they touch, and how far (m) the plane across it through the point of the wall is from the
    /// grain's centre. Of parts that are apart from a shape by more than the range, a plane that lies
    /// between.
    /// @param range m, beyond the surface of a grain, up to which parts are told apart
    virtual void findPoints(const ParticleStore& grains, std::uint32_t grain, const Wall& wall, double range,
                            std::span<const std::uint32_t> parts, std::span<WallPoint> points) const = 0;
    [[nodiscard]] virtual ShapeExtremes extremesAt(const ParticleStore& grains,
                                                   std::uint32_t place) const = 0;
    /// Why a wall cannot stand in the scene of these grains; empty if it can.
    [[nodiscard]] virtual std::string objectionTo(const Wall& wall) const = 0;
    /// m, the smallest half length of a grain.
    [[nodiscard]] virtual double thickness(const ParticleStore& grains, std::uint32_t grain) const = 0;
};

}  // namespace pendular
