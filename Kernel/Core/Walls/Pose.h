#pragma once

#include <Eigen/Geometry>

#include "Kernel/Foundation/Math/EigenConversion.h"

namespace pendular {

/// A rigid placement: x = rotation X + shift, with X in the body's own frame.
struct Pose {
    Vector<double> column[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // of the rotation
    Vector<double> shift{0, 0, 0};                                 // m

    Pose() = default;
    explicit Pose(const Eigen::Isometry3d& pose);

    /// A turn about an axis (unit) through a point (m) by an angle (rad).
    [[nodiscard]] static Pose turnedAbout(const Vector<double>& axis, const Vector<double>& point,
                                          double angle);

    // Of one vector, or of eight (T = Pack).
    template <Number T = double>
    [[nodiscard]] Vector<T> turn(const Vector<T>& v) const {
        return v.x * inAllLanes<T>(column[0]) + v.y * inAllLanes<T>(column[1]) +
               v.z * inAllLanes<T>(column[2]);
    }
    template <Number T = double>
    [[nodiscard]] Vector<T> turnBack(const Vector<T>& v) const {
        return {dot(inAllLanes<T>(column[0]), v), dot(inAllLanes<T>(column[1]), v),
                dot(inAllLanes<T>(column[2]), v)};
    }
    [[nodiscard]] Vector<double> place(const Vector<double>& point) const { return turn(point) + shift; }
    template <Number T = double>
    [[nodiscard]] Vector<T> placeBack(const Vector<T>& point) const {
        return turnBack(point - inAllLanes<T>(shift));
    }
    /// First the other placement, then this one.
    [[nodiscard]] Pose after(const Pose& first) const {
        Pose both;
        for (int k = 0; k < 3; ++k) both.column[k] = turn(first.column[k]);
        both.shift = place(first.shift);
        return both;
    }
    [[nodiscard]] Pose inverse() const {
        Pose back;
        back.column[0] = {column[0].x, column[1].x, column[2].x};
        back.column[1] = {column[0].y, column[1].y, column[2].y};
        back.column[2] = {column[0].z, column[1].z, column[2].z};
        back.shift = turnBack(Vector<double>{0, 0, 0} - shift);
        return back;
    }
};

/// How a rigid body moves: the velocity of a point x is linear + spin x (x - point).
struct RigidVelocity {
    Vector<double> linear{0, 0, 0};  // m/s
    Vector<double> spin{0, 0, 0};    // rad/s
    Vector<double> point{0, 0, 0};   // m

    template <Number T = double>
    [[nodiscard]] Vector<T> at(const Vector<T>& x) const {
        return inAllLanes<T>(linear) + cross(inAllLanes<T>(spin), x - inAllLanes<T>(point));
    }
};

/// Which points of a surface there are, and which motions carry it into itself: from these follows how far a
/// motion can bring any of its points towards a grain.
struct SurfaceExtent {
    enum class Symmetry { None, Axis, Cylinder, Plane };

    Symmetry symmetry = Symmetry::None;
    Vector<double> centre{0, 0, 0};  // m
    double radius = 0;               // m, of all points around the centre; may be infinite
    Vector<double> axis{0, 0, 0};    // unit; of a plane its normal
    Vector<double> half{0, 0, 0};    // m, half the lengths of a box along the axes; of a mesh

    /// The farthest (m) that the surface as a set of points moves between two poses.
    [[nodiscard]] double displacement(const Pose& from, const Pose& to) const;
};

}  // namespace pendular
