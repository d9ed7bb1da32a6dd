#pragma once

#include <string_view>

#include "Kernel/Features/RigidBodies/MassProperties.h"
#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// A box with rounded edges about its centre, in its own axes: all that is within a radius of a cuboid.
struct RoundedBox {
    Vector<double> half{0, 0, 0};  // m, half lengths of the cuboid
    double radius = 0;             // m

    static constexpr std::size_t corners = 8, edges = 12;

    /// @param outer m, half lengths of the box, from face to face; @param radius m, of its edges. Throws
    /// InputError for lengths that are not positive, and for a radius that is not below all half lengths.
    static RoundedBox fromOuter(std::string_view owner, const Vector<double>& outer, double radius);
    [[nodiscard]] Vector<double> outer() const { return {half.x + radius, half.y + radius, half.z + radius}; }

    /// The properties at density 1: volume, centre 0, and the diagonal inertia. Source: Steiner's formula,
    /// by which a convex body and what is within a radius of it are the sum of the body, slabs on its faces,
    /// sectors of cylinders along its edges and of balls at its corners.
    [[nodiscard]] MassProperties mass() const;
    /// m, of the smallest sphere about the centre that holds it.
    [[nodiscard]] double boundingRadius() const { return norm(half) + radius; }
    /// m, the farthest point along a normal (unit): the middle of a face across it.
    [[nodiscard]] Vector<double> support(const Vector<double>& normal) const;

    /// m, of a corner of the cuboid, from 0 to 7.
    [[nodiscard]] Vector<double> corner(std::size_t number) const;
    /// The axis along which an edge from 0 to 11 goes: 0, 1 or 2.
    static constexpr std::size_t axisOf(std::size_t edge) { return edge / 4; }
    /// Which way the two faces at an edge are: -1 or 1 along the axes across it, 0 along it.
    [[nodiscard]] static Vector<double> facesAt(std::size_t edge);
    /// m, half the length of an edge of the cuboid.
    [[nodiscard]] double halfLength(std::size_t edge) const;
    /// m, the middle of an edge of the cuboid.
    [[nodiscard]] Vector<double> middle(std::size_t edge) const;

    /// By how much its turning adds to 1/m at a contact, at most: (arm x n) I^-1 (arm x n) m.
    [[nodiscard]] double turning() const;
    /// m, of a free sphere of the mass m / (4 (1 + turning)), which is less than any contact moves: as such
    /// count its grains where sizes are compared (GrainSizes), and as large ones Hertz's law takes on its
    /// faces.
    [[nodiscard]] double radiusAtContacts() const;
    /// m, at most, of a sphere on one of its faces as Hertz's law takes it: larger ones have this one.
    [[nodiscard]] double largestContactRadius() const;
};

}  // namespace pendular
