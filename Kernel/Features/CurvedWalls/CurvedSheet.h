#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Foundation/Math/BoxTree.h"

namespace pendular {

/// A point of a surface by two parameters, and its derivatives by them (m over their units).
struct SurfaceJet {
    Vec3D point, u, v, uu, uv, vv;
};

/// A surface by a formula, over a rectangle of its two parameters; with one parameter it is a curve. It is
/// smooth, or of smooth pieces with bends between them, each as long by the parameter.
struct SurfaceFormula {
    std::string name;                  // of the shape with its numbers: restart files compare it
    std::array<double, 2> low, high;   // of u and v; a curve has low = high of v
    std::array<std::size_t, 2> cells;  // so many patches along u and v, each nearly flat
    std::function<SurfaceJet(double u, double v)> at;
    std::array<std::size_t, 2> pieces{1, 1};  // along u and v, each of a whole number of patches; where one
                                              // ends, derivatives are those of the next one
};

/// A surface by a formula, with grains on both sides, or a body of all points that are nearer to it than a
/// thickness: screws, coils, NURBS. A grain has one contact with it, at the point of the whole surface that
/// is nearest to its centre (to 1e-12 of its size): between two windings it touches the nearer one only.
class CurvedSheet : public RigidWall {
public:
    /// @param ofThickness m, of half the body; 0: a surface of no thickness
    void set(SurfaceFormula surface, double ofThickness);

protected:
    void listInBody(const Vector<double>& centre, double reach,
                    std::vector<std::uint32_t>& parts) const override;
    void findInBody(const Vector<double>& centre, double reach, std::span<const std::uint32_t>,
                    std::span<WallPoint> points) const override;
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override;
    [[nodiscard]] SurfaceExtent extent() const override;
    [[nodiscard]] WallSurface surfaceInBody(const SceneSphere& around) const override;
    void visitShape(StateArchive& archive) const override;

private:
    using Parameters = std::array<double, 2>;
    /// The nearest point of the surface to a centre.
    struct Nearest {
        double distance = infinity;  // m, from the centre to the surface without its thickness
        Parameters at{};
        SurfaceJet jet;
        [[nodiscard]] Vec3D normal() const { return jet.u.cross(jet.v); }
    };
    [[nodiscard]] Parameters parametersOf(std::size_t cell, double alongU, double alongV) const;
    [[nodiscard]] Box boxOf(std::size_t cell) const;
    /// The bounds of a smooth piece.
    struct Piece {
        Parameters low{}, high{};
        [[nodiscard]] Parameters inside(Parameters parameters) const;
    };
    [[nodiscard]] Piece pieceOf(std::size_t cell) const;
    [[nodiscard]] bool isCurve() const { return formula.low[1] == formula.high[1]; }
    [[nodiscard]] Nearest nearestTo(const Vec3D& centre, double reach) const;
    [[nodiscard]] Nearest descend(const Vec3D& centre, std::size_t cell) const;
    [[nodiscard]] static Parameters newtonStep(const Piece& piece, const Nearest& now, const Vec3D& way);
    [[nodiscard]] bool isBeside(const Nearest& nearest, const Vector<double>& centre) const;
    void addTube(std::vector<Polygon>& polygons) const;

    SurfaceFormula formula;
    double thickness = 0;  // m
    std::vector<Box> boxes;
    BoxTree tree;
    Vec3D middle = Vec3D::Zero();  // m
    double size = 0;               // m, the radius around the middle
};

}  // namespace pendular
