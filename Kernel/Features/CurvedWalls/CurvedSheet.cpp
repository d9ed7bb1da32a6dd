#include "Kernel/Features/CurvedWalls/CurvedSheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

void CurvedSheet::set(SurfaceFormula surface, double ofThickness) {
    const std::string_view name = surface.name;
    checkValue(name, "thickness", ofThickness, "m", notNegative);
    const bool isOfNoWidth = surface.low[1] == surface.high[1];
    if (isOfNoWidth && !(ofThickness > 0))
        throw InputError(fmt::format("{}: thickness = 0 m; a curve needs one above 0.", name));
    formula = std::move(surface);
    thickness = ofThickness;
    if (isOfNoWidth) formula.cells[1] = 1;
    boxes.clear();
    Box all;
    for (std::size_t cell = 0; cell < formula.cells[0] * formula.cells[1]; ++cell) {
        boxes.push_back(boxOf(cell));
        all.include(boxes.back());
    }
    tree = BoxTree(boxes);
    middle = toEigen(all.middle());
    size = 0.5 * norm(all.highest - all.lowest);
    if (!std::isfinite(size)) throw InputError(fmt::format("{}: a point of it is not finite.", formula.name));
    takePlace();
}

/// @param alongU, alongV from 0 to 1 in the cell
CurvedSheet::Parameters CurvedSheet::parametersOf(std::size_t cell, double alongU, double alongV) const {
    const std::array<double, 2> place{static_cast<double>(cell / formula.cells[1]) + alongU,
                                      static_cast<double>(cell % formula.cells[1]) + alongV};
    Parameters result{};
    for (std::size_t k = 0; k < 2; ++k)
        result[k] = formula.low[k] +
                    (formula.high[k] - formula.low[k]) * place[k] / static_cast<double>(formula.cells[k]);
    return result;
}

/// A box around a patch: of nine of its points, and twice the way by which the surface can leave the chords
/// between them (h^2 / 8 times the second derivative, h half a side).
Box CurvedSheet::boxOf(std::size_t cell) const {
    Box box;
    const Piece piece = pieceOf(cell);
    double bend = 0;
    std::array<double, 2> h{};
    for (std::size_t k = 0; k < 2; ++k)
        h[k] = 0.5 * (formula.high[k] - formula.low[k]) / static_cast<double>(formula.cells[k]);
    for (const double a : {0.0, 0.5, 1.0})
        for (const double b : {0.0, 0.5, 1.0}) {
            const Parameters at = piece.inside(parametersOf(cell, a, b));
            const SurfaceJet jet = formula.at(at[0], at[1]);
            if (!jet.point.allFinite())
                throw InputError(fmt::format("{}: its point of the parameters {} and {} is not finite.",
                                             formula.name, at[0], at[1]));
            box.include(toVector(jet.point));
            bend = std::max(bend, jet.uu.norm() * h[0] * h[0] + 2 * jet.uv.norm() * h[0] * h[1] +
                                      jet.vv.norm() * h[1] * h[1]);
        }
    const Vector<double> margin = 0.25 * bend * Vector<double>{1, 1, 1};
    return {box.lowest - margin, box.highest + margin};
}

CurvedSheet::Parameters CurvedSheet::Piece::inside(Parameters parameters) const {
    for (std::size_t k = 0; k < 2; ++k) parameters[k] = std::clamp(parameters[k], low[k], high[k]);
    return parameters;
}

/// It ends one bit before the next one begins, so that it has its own derivatives there.
CurvedSheet::Piece CurvedSheet::pieceOf(std::size_t cell) const {
    const std::array<std::size_t, 2> places{cell / formula.cells[1], cell % formula.cells[1]};
    Piece piece;
    for (std::size_t k = 0; k < 2; ++k) {
        const std::size_t number = places[k] * formula.pieces[k] / formula.cells[k];
        const auto bound = [&](std::size_t n) {
            return formula.low[k] + (formula.high[k] - formula.low[k]) * static_cast<double>(n) /
                                        static_cast<double>(formula.pieces[k]);
        };
        piece.low[k] = bound(number);
        piece.high[k] = number + 1 == formula.pieces[k] ? formula.high[k]
                                                        : std::nextafter(bound(number + 1), piece.low[k]);
    }
    return piece;
}

/// The change of the parameters by which Newton's method goes to where the way from the centre is across the
/// surface; a parameter that is at a bound of the piece and would leave stays. Where the distance is no
/// minimum there, the second derivatives are left out (Gauss and Newton's method).
CurvedSheet::Parameters CurvedSheet::newtonStep(const Piece& piece, const Nearest& now, const Vec3D& way) {
    const SurfaceJet& jet = now.jet;
    const std::array<double, 2> slope{way.dot(jet.u), way.dot(jet.v)};
    std::array<bool, 2> isFree{};
    for (std::size_t k = 0; k < 2; ++k)
        isFree[k] = slope[k] > 0 ? now.at[k] > piece.low[k] : now.at[k] < piece.high[k];
    double a = jet.u.squaredNorm() + way.dot(jet.uu), b = jet.u.dot(jet.v) + way.dot(jet.uv),
           c = jet.v.squaredNorm() + way.dot(jet.vv);
    const auto isMinimum = [&] {
        if (isFree[0] && isFree[1]) return a > 0 && a * c - b * b > 1e-12 * std::abs(a * c);
        return isFree[0] ? a > 0 : c > 0;
    };
    if (!isMinimum()) a = jet.u.squaredNorm(), b = jet.u.dot(jet.v), c = jet.v.squaredNorm();
    if (isFree[0] && isFree[1] && a * c - b * b > 1e-12 * a * c) {
        const double determinant = a * c - b * b;
        return {(b * slope[1] - c * slope[0]) / determinant, (b * slope[0] - a * slope[1]) / determinant};
    }
    return {isFree[0] && a > 0 ? -slope[0] / a : 0, isFree[1] && c > 0 ? -slope[1] / c : 0};
}

/// Goes downhill from the middle of a patch, in its piece, to the point that is nearest to the centre of all
/// around it.
CurvedSheet::Nearest CurvedSheet::descend(const Vec3D& centre, std::size_t cell) const {
    const Piece piece = pieceOf(cell);
    const Parameters from = parametersOf(cell, 0.5, 0.5);
    Nearest now{.at = from, .jet = formula.at(from[0], from[1])};
    now.distance = (now.jet.point - centre).norm();
    for (int turn = 0; turn < 60; ++turn) {
        Parameters step = newtonStep(piece, now, now.jet.point - centre);
        bool isBetter = false;
        for (int half = 0; half < 40 && !isBetter; ++half) {
            const Parameters at = piece.inside({now.at[0] + step[0], now.at[1] + step[1]});
            const SurfaceJet jet = formula.at(at[0], at[1]);
            const double distance = (jet.point - centre).norm();
            isBetter = distance < now.distance;
            if (isBetter) now = {distance, at, jet};
            else step[0] *= 0.5, step[1] *= 0.5;
            if ((jet.point - now.jet.point).norm() < 1e-15 * size && !isBetter) return now;
        }
        if (!isBetter) return now;
    }
    return now;
}

/// Of all patches within reach, from the one whose middle is nearest on; a patch whose box is farther away
/// than what is found cannot have the nearest point. The order of their numbers decides between equal ones.
CurvedSheet::Nearest CurvedSheet::nearestTo(const Vec3D& centre, double reach) const {
    const Vector<double> point = toVector(centre);
    struct Candidate {
        double distance;  // m, of its middle
        std::uint32_t cell;
    };
    std::vector<Candidate> candidates;
    tree.forEachNear(point, reach, [&](std::uint32_t cell) {
        candidates.push_back({norm(boxes[cell].middle() - point), cell});
    });
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
        return a.distance < b.distance || (a.distance == b.distance && a.cell < b.cell);
    });
    Nearest best;
    for (const Candidate& one : candidates) {
        if (!(std::sqrt(boxes[one.cell].squaredDistance(point)) < best.distance)) continue;
        const Nearest found = descend(centre, one.cell);
        if (found.distance < best.distance) best = found;
    }
    return best;
}

void CurvedSheet::listInBody(const Vector<double>& centre, double reach,
                             std::vector<std::uint32_t>& parts) const {
    bool isNear = false;
    tree.forEachNear(centre, reach + thickness, [&](std::uint32_t) { isNear = true; });
    if (isNear) parts.push_back(0);
}

void CurvedSheet::findInBody(const Vector<double>& centre, double reach, std::span<const std::uint32_t>,
                             std::span<WallPoint> points) const {
    const Nearest nearest = nearestTo(toEigen(centre), reach + thickness);
    if (!std::isfinite(nearest.distance)) {  // farther away than is asked for
        points[0] = {{1, 0, 0}, 2 * reach + size, {0, 0, 0}};
        return;
    }
    const Vec3D way = nearest.jet.point - toEigen(centre);
    const Vec3D normal = nearest.distance > 0 ? way / nearest.distance
                         : isCurve()          ? toEigen(anyAcross(toVector(nearest.jet.u.normalized())))
                                              : Vec3D(nearest.normal().normalized());
    points[0] = {toVector(normal), nearest.distance - thickness, {0, 0, 0}};
}

/// Whether the surface ends there: the way to the nearest point is not across it. At a bend between two
/// pieces it is not, either, but there the surface goes on.
bool CurvedSheet::isBeside(const Nearest& nearest, const Vector<double>& centre) const {
    const Vec3D way = nearest.jet.point - toEigen(centre);
    const auto isAtEnd = [&](std::size_t k, const Vec3D& along) {
        const bool isBound = nearest.at[k] == formula.low[k] || nearest.at[k] == formula.high[k];
        return isBound && std::abs(way.dot(along.normalized())) > 1e-6 * way.norm();
    };
    return isAtEnd(0, nearest.jet.u) || isAtEnd(1, nearest.jet.v);
}

/// Into the body, or to the other side of a surface.
bool CurvedSheet::isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const {
    const double reach = norm(to - from) + thickness + 1e-9 * size;
    const Nearest before = nearestTo(toEigen(from), reach), after = nearestTo(toEigen(to), reach);
    if (thickness > 0) return !(before.distance < thickness) && after.distance < thickness;
    if (!std::isfinite(before.distance) || !std::isfinite(after.distance)) return false;
    if (isBeside(before, from) || isBeside(after, to)) return false;
    const auto side = [](const Nearest& nearest, const Vector<double>& centre) {
        return nearest.normal().dot(toEigen(centre) - nearest.jet.point);
    };
    return side(before, from) * side(after, to) < 0;
}

SurfaceExtent CurvedSheet::extent() const {
    return {SurfaceExtent::Symmetry::None, toVector(middle), size + thickness};
}

/// The surface itself without its thickness, two triangles for each patch; of a curve a tube around it.
WallSurface CurvedSheet::surfaceInBody(const SceneSphere& /*around*/) const {
    WallSurface surface;
    if (isCurve()) {
        addTube(surface.polygons);
        return surface;
    }
    for (std::size_t cell = 0; cell < boxes.size(); ++cell) {
        const auto corner = [&](double a, double b) {
            const Parameters at = parametersOf(cell, a, b);
            return toVector(formula.at(at[0], at[1]).point);
        };
        surface.polygons.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
        surface.polygons.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
    }
    return surface;
}

void CurvedSheet::addTube(std::vector<Polygon>& polygons) const {
    constexpr int sides = 8;
    const auto ring = [&](std::size_t cell, double along) {
        const Parameters at = parametersOf(cell, along, 0);
        const SurfaceJet jet = formula.at(at[0], at[1]);
        const Vec3D tangent = jet.u.normalized(),
                    a = (jet.uu - jet.uu.dot(tangent) * tangent).norm() > 0
                            ? Vec3D((jet.uu - jet.uu.dot(tangent) * tangent).normalized())
                            : toEigen(anyAcross(toVector(tangent))),
                    b = tangent.cross(a);
        Polygon points;
        for (int k = 0; k < sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / sides;
            points.push_back(toVector(jet.point + thickness * (std::cos(angle) * a + std::sin(angle) * b)));
        }
        return points;
    };
    for (std::size_t cell = 0; cell < boxes.size(); ++cell) {
        const Polygon begin = ring(cell, 0), end = ring(cell, 1);
        for (std::size_t k = 0; k < sides; ++k)
            polygons.push_back({begin[k], begin[(k + 1) % sides], end[(k + 1) % sides], end[k]});
    }
}

void CurvedSheet::visitShape(StateArchive& archive) const {
    archive.same("shape", formula.name);
    archive.same("thickness", thickness, "m");
}

}  // namespace pendular
