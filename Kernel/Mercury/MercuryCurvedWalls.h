#pragma once

#include <vector>

#include "Kernel/Features/CurvedWalls/CurvedSheet.h"

// MercuryDPM's walls by a formula, as CurvedSheet has them: NURBS, screws, coils.

namespace pendular {

/// A surface of rational B-splines, over u and v from the first to the last knot that count (Piegl and
/// Tiller, The NURBS Book, 2nd ed. 1997, Eq. 4.11). Degrees follow from the numbers of knots and points.
class NurbsSurface {
public:
    /// @param points m, by u and then by v; @param weights one for each
    /// Throws InputError where their numbers do not fit.
    NurbsSurface(std::vector<double> knotsU, std::vector<double> knotsV,
                 std::vector<std::vector<Vec3D>> points, std::vector<std::vector<double>> weights);
    [[nodiscard]] Vec3D evaluate(double u, double v) const { return at(u, v).point; }
    [[nodiscard]] SurfaceJet at(double u, double v) const;
    /// The formula of a wall.
    [[nodiscard]] SurfaceFormula formula() const;

private:
    std::array<std::vector<double>, 2> knots;
    std::array<std::size_t, 2> degrees{};
    std::vector<std::vector<Vec3D>> points;
    std::vector<std::vector<double>> weights;
};

/// What these walls have: a place and a direction, which are set before the run.
class MercuryCurvedWall : public CurvedSheet {
public:
    /// m, where the origin of its frame is
    void setPosition(const Vec3D& place);
    /// Turns it so that its axis x has this direction (of any length), by the least angle.
    void setOrientationViaNormal(const Vec3D& direction);

protected:
    void setShape(SurfaceFormula shape, double ofThickness);

private:
    void place();

    SurfaceFormula own;
    double half = 0;  // m, the thickness
    Vec3D position = Vec3D::Zero();
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

/// A surface of no thickness, with grains on both sides.
class NurbsWall final : public MercuryCurvedWall {
public:
    NurbsWall() = default;
    explicit NurbsWall(const NurbsSurface& surface) { set(surface); }
    void set(const NurbsSurface& surface) { setShape(surface.formula(), 0); }
};

enum class ScrewType {
    singleHelix,  ///< from the axis to the radius
    doubleHelix   ///< also on the other side of the axis
};

/// A screw along x, in whose frame its blade is at start + (q length, r cos a, r sin a) with a = 2 pi turns
/// q, q from 0 to 1. All points within the thickness (m) of that are in it. It turns by setAngularVelocity();
/// in MercuryDPM also by its own number of turns a second, whenever a driver calls move_time().
class Screw final : public MercuryCurvedWall {
public:
    Screw() = default;
    Screw(const Vec3D& start, double length, double radius, double turns, double turnsPerSecond,
          double thickness, ScrewType type = ScrewType::doubleHelix) {
        set(start, length, radius, turns, turnsPerSecond, thickness, type);
    }
    void set(const Vec3D& start, double length, double radius, double turns, double turnsPerSecond,
             double thickness, ScrewType type = ScrewType::doubleHelix);
    void move_time(double) = delete;
};

/// A wire of this thickness (m, its radius) around z, through start + (r cos a, r sin a, q length). It turns
/// as a Screw does.
class Coil final : public MercuryCurvedWall {
public:
    Coil() = default;
    Coil(const Vec3D& start, double length, double radius, double turns, double turnsPerSecond,
         double thickness) {
        set(start, length, radius, turns, turnsPerSecond, thickness);
    }
    void set(const Vec3D& start, double length, double radius, double turns, double turnsPerSecond,
             double thickness);
    void move_time(double) = delete;
};

}  // namespace pendular
