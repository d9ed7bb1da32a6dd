#pragma once

#include <cstdint>
#include <span>

#include "Kernel/Core/Walls/Wall.h"
#include "Kernel/Features/Superquadrics/SuperquadricSupport.h"
#include "Kernel/Foundation/Math/Quaternion.h"

namespace pendular {

/// Where a superquadric touches a wall of any kind that knows its nearest points to spheres.
///
/// The superquadric is its core and all that is within a small radius of it: the core is where the centre of
/// a ball goes that rolls inside. With the ball no larger than the smallest radius of curvature this is
/// exact, and where the core is nearest to the wall, the ball touches it first. So the normal n is sought at
/// which the ball that touches the surface from inside sees the wall along n. For a convex part of a wall
/// (a face with its edges and corners, a rod) this is the least of F(n) = h(n) - min over the part of
/// (w - c).n, as between two grains (SuperquadricPair.h): depth = radius of the ball - distance of the core.
///
/// At first the nearest points of segments in the core are followed (Gilbert 1966, SIAM J. Control 4, 61),
/// which comes near from anywhere and tells at once what is apart; then Newton's method goes on, with the
/// curvatures of both surfaces, as far as round-off allows.
class ShapeAtWall {
public:
    /// @param place m, of the centre; @param ball m, radius of the ball
    ShapeAtWall(const SuperquadricLanes<double>& superquadric, const Axes<double>& inSpace,
                const Vector<double>& place, double ball)
        : shape(superquadric), axes(inSpace), centre(place), ballRadius(ball) {}

    /// As Wall::findPoints(), but the distance is that of the plane across the normal through the point of
    /// the wall; of parts that are apart by more than the range, of a plane that lies between.
    /// @param range m
    void findPoints(const Wall& wall, double range, std::span<const std::uint32_t> parts,
                    std::span<WallPoint> points) const;

private:
    /// What the ball at a point of the core sees of a part.
    struct Look {
        Vector<double> normal;  // unit, outwards from the grain; the core's point is that with this normal
        SupportPoint<double> support;
        Vector<double> point;     // m, of the core
        Vector<double> towards;   // unit, to the wall
        double distance;          // m, of the core; negative beyond a face
        Vector<double> velocity;  // m/s, of the wall there
    };

    [[nodiscard]] SupportPoint<double> supportAt(const Vector<double>& normal) const {
        return supportPoint(shape, axes.turnBack(normal));
    }
    [[nodiscard]] Vector<double> coreAt(const SupportPoint<double>& support,
                                        const Vector<double>& normal) const {
        return centre + axes.turn(support.point) - ballRadius * normal;
    }
    /// @param ownNormal unit, in the grain's axes: on a face that is nearly flat its small components tell
    /// the point, and a turn to the scene's axes and back would round them away (1e-16 of a normal is 0.005
    /// of a half length at an exponent of 8)
    [[nodiscard]] Look lookAlong(const Wall& wall, std::uint32_t part, const Vector<double>& ownNormal) const;
    /// A normal that is near the wanted one. @param gap m, above 0 if a plane across it parts grain and wall
    [[nodiscard]] Vector<double> nearNormal(const Wall& wall, std::uint32_t part, const WallPoint& first,
                                            double range, double& gap) const;
    [[nodiscard]] Look newton(const Wall& wall, std::uint32_t part, const Vector<double>& start) const;
    [[nodiscard]] Look searchAround(const Wall& wall, std::uint32_t part, Look best) const;
    [[nodiscard]] Look settle(const Wall& wall, std::uint32_t part, double range,
                              const Vector<double>& start) const;
    [[nodiscard]] Vector<double> newtonShift(const Wall& wall, std::uint32_t part, const Look& now) const;
    [[nodiscard]] bool isSettled(const Wall& wall, std::uint32_t part, const Look& found) const;
    [[nodiscard]] WallPoint pointOf(const Wall& wall, std::uint32_t part, double range) const;
    void leaveOutCovered(const Wall& wall, double range, std::span<const std::uint32_t> parts,
                         std::span<WallPoint> points) const;

    SuperquadricLanes<double> shape;
    Axes<double> axes;
    Vector<double> centre;
    double ballRadius;
};

}  // namespace pendular
