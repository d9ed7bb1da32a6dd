#include "Kernel/Mercury/MercuryCurvedWalls.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/Splines>

#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {
namespace {

using Basis = Eigen::Spline<double, 1, Eigen::Dynamic>;

Basis::KnotVectorType toKnots(const std::vector<double>& knots) {
    return Eigen::Map<const Basis::KnotVectorType>(knots.data(), static_cast<Eigen::Index>(knots.size()));
}

/// A knot that is there too often leaves points without effect; between the ends it tears the surface.
void refuseTears(char direction, const std::vector<double>& knots, std::size_t degree) {
    for (const double knot : knots) {
        const auto times = static_cast<std::size_t>(std::ranges::count(knots, knot));
        const bool isWithin = knot > knots[degree] && knot < knots[knots.size() - degree - 1];
        const std::size_t most = isWithin ? degree : degree + 1;
        if (times > most)
            throw InputError(fmt::format(
                "NurbsSurface: the knot {} of {} is there {} times; of degree {} it may be "
                "there {} times {}.",
                knot, direction, times, degree, most, isWithin ? "between the ends" : "at an end"));
    }
}

/// The degree of a direction. Throws InputError unless knots and points fit.
std::size_t degreeOf(char direction, const std::vector<double>& knots, std::size_t points) {
    if (points < 2 || knots.size() < points + 2 || knots.size() > 2 * points)
        throw InputError(fmt::format(
            "NurbsSurface: {} knots of {} and {} points along it; of n points it must be n + 2 to 2 n knots.",
            knots.size(), direction, points));
    for (std::size_t k = 0; k < knots.size(); ++k)
        checkValue("NurbsSurface", fmt::format("knot {} of {}", k, direction), knots[k], "", anyFinite);
    for (std::size_t k = 1; k < knots.size(); ++k)
        if (!(knots[k] >= knots[k - 1]))
            throw InputError(
                fmt::format("NurbsSurface: knot {} of {} = {}; it must be at least {}, the one "
                            "before it.",
                            k, direction, knots[k], knots[k - 1]));
    const std::size_t degree = knots.size() - points - 1;
    if (!(knots[points] > knots[degree]))
        throw InputError(fmt::format("NurbsSurface: the knots of {} have no length.", direction));
    refuseTears(direction, knots, degree);
    return degree;
}

/// The different knots from the first to the last that count. By the parameter of a wall (from 0 on) the
/// surface has one span of 1 between each two.
class Spans {
public:
    Spans() = default;
    Spans(const std::vector<double>& ofKnots, std::size_t degree)
        : knots(ofKnots.begin() + static_cast<std::ptrdiff_t>(degree),
                ofKnots.end() - static_cast<std::ptrdiff_t>(degree)) {
        knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
    }
    [[nodiscard]] std::size_t number() const { return knots.size() - 1; }
    struct Place {
        double parameter, length;  // of the surface, and that of the span
    };
    /// Below the knot at which the next span begins, whose derivatives are others.
    [[nodiscard]] Place at(double along) const {
        const std::size_t k = std::min(static_cast<std::size_t>(std::max(along, 0.0)), number() - 1);
        const double length = knots[k + 1] - knots[k], share = along - static_cast<double>(k);
        const double end = k + 1 < number() ? std::nextafter(knots[k + 1], knots[k]) : knots[k + 1];
        return {std::clamp(knots[k] + share * length, knots[k], end), length};
    }

private:
    std::vector<double> knots;
};

/// The basis functions that are not 0 at a parameter, with two derivatives, and which points they belong to.
struct BasisAt {
    Basis::BasisDerivativeType values;
    std::size_t first;

    BasisAt(double parameter, std::size_t degree, const std::vector<double>& ofKnots) {
        const Basis::KnotVectorType knots = toKnots(ofKnots);
        const auto p = static_cast<Eigen::Index>(degree);
        values = Basis::BasisFunctionDerivatives(parameter, std::min<Eigen::Index>(2, p), p, knots);
        first = static_cast<std::size_t>(Basis::Span(parameter, p, knots) - p);
    }
    [[nodiscard]] double operator()(int derivative, std::size_t k) const {
        return derivative < values.rows() ? values(derivative, static_cast<Eigen::Index>(k)) : 0;
    }
};

}  // namespace

NurbsSurface::NurbsSurface(std::vector<double> knotsU, std::vector<double> knotsV,
                           std::vector<std::vector<Vec3D>> ofPoints,
                           std::vector<std::vector<double>> ofWeights)
    : knots{std::move(knotsU), std::move(knotsV)},
      points(std::move(ofPoints)),
      weights(std::move(ofWeights)) {
    if (points.empty()) throw InputError("NurbsSurface: there are no points.");
    degrees = {degreeOf('u', knots[0], points.size()), degreeOf('v', knots[1], points[0].size())};
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (weights.size() != points.size() || points[i].size() != points[0].size() ||
            weights[i].size() != points[0].size())
            throw InputError(fmt::format(
                "NurbsSurface: row {} has not {} points and weights, as the first one has points.", i,
                points[0].size()));
        for (const double weight : weights[i]) checkValue("NurbsSurface", "weight", weight, "", positive);
        for (std::size_t j = 0; j < points[i].size(); ++j)
            for (int axis = 0; axis < 3; ++axis)
                checkValue("NurbsSurface", fmt::format("{} of point ({}, {})", "xyz"[axis], i, j),
                           points[i][j][axis], "m", anyFinite);
    }
}

/// Of the four coordinates (w x, w y, w z, w), and then by the rule of quotients (Eq. 4.20 of that book).
SurfaceJet NurbsSurface::at(double u, double v) const {
    const BasisAt ofU(u, degrees[0], knots[0]), ofV(v, degrees[1], knots[1]);
    const auto sum = [&](int du, int dv) {
        Eigen::Vector4d result = Eigen::Vector4d::Zero();
        for (std::size_t i = 0; i <= degrees[0]; ++i)
            for (std::size_t j = 0; j <= degrees[1]; ++j) {
                const double weight = weights[ofU.first + i][ofV.first + j];
                const Vec3D& point = points[ofU.first + i][ofV.first + j];
                result +=
                    ofU(du, i) * ofV(dv, j) * weight * Eigen::Vector4d(point.x(), point.y(), point.z(), 1);
            }
        return result;
    };
    const Eigen::Vector4d s = sum(0, 0), su = sum(1, 0), sv = sum(0, 1), suu = sum(2, 0), suv = sum(1, 1),
                          svv = sum(0, 2);
    const double w = s.w();
    SurfaceJet jet;
    jet.point = s.head<3>() / w;
    jet.u = (su.head<3>() - su.w() * jet.point) / w;
    jet.v = (sv.head<3>() - sv.w() * jet.point) / w;
    jet.uu = (suu.head<3>() - 2 * su.w() * jet.u - suu.w() * jet.point) / w;
    jet.uv = (suv.head<3>() - su.w() * jet.v - sv.w() * jet.u - suv.w() * jet.point) / w;
    jet.vv = (svv.head<3>() - 2 * sv.w() * jet.v - svv.w() * jet.point) / w;
    return jet;
}

SurfaceFormula NurbsSurface::formula() const {
    SurfaceFormula formula;
    std::string numbers;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < points[i].size(); ++j)
            numbers += fmt::format(" ({}, {}, {}; {})", points[i][j].x(), points[i][j].y(), points[i][j].z(),
                                   weights[i][j]);
    formula.name = fmt::format("NurbsWall of knots {} and {} and points{}", fmt::join(knots[0], ", "),
                               fmt::join(knots[1], ", "), numbers);
    std::array<Spans, 2> spans;
    for (std::size_t k = 0; k < 2; ++k) {
        spans[k] = Spans(knots[k], degrees[k]);
        formula.pieces[k] = spans[k].number();
        formula.low[k] = 0;
        formula.high[k] = static_cast<double>(formula.pieces[k]);
        formula.cells[k] = formula.pieces[k] * (degrees[k] == 1 ? 2 : 8);
    }
    formula.at = [surface = *this, spans](double s, double t) {
        const auto [u, lengthU] = spans[0].at(s);
        const auto [v, lengthV] = spans[1].at(t);
        SurfaceJet jet = surface.at(u, v);
        jet.u *= lengthU, jet.uu *= lengthU * lengthU;
        jet.v *= lengthV, jet.vv *= lengthV * lengthV;
        jet.uv *= lengthU * lengthV;
        return jet;
    };
    return formula;
}

void MercuryCurvedWall::setPosition(const Vec3D& where) {
    position = where;
    if (own.at) place();
}

void MercuryCurvedWall::setOrientationViaNormal(const Vec3D& direction) {
    checkValue("Wall", "length of the normal", direction.norm(), "", positive);
    rotation = Eigen::Quaterniond::FromTwoVectors(Vec3D(1, 0, 0), direction).toRotationMatrix();
    if (own.at) place();
}

void MercuryCurvedWall::setShape(SurfaceFormula shape, double ofThickness) {
    own = std::move(shape);
    half = ofThickness;
    place();
}

void MercuryCurvedWall::place() {
    SurfaceFormula placed = own;
    placed.name += fmt::format(" at ({}, {}, {}), its axis x along ({}, {}, {})", position.x(), position.y(),
                               position.z(), rotation(0, 0), rotation(1, 0), rotation(2, 0));
    placed.at = [at = own.at, turn = rotation, shift = position](double u, double v) {
        const SurfaceJet jet = at(u, v);
        return SurfaceJet{turn * jet.point + shift,
                          turn * jet.u,
                          turn * jet.v,
                          turn * jet.uu,
                          turn * jet.uv,
                          turn * jet.vv};
    };
    CurvedSheet::set(std::move(placed), half);
}

/// Patches along a helix: 24 for each turn.
static std::size_t patchesOf(double turns) {
    return std::max<std::size_t>(8, static_cast<std::size_t>(std::ceil(24 * std::abs(turns))));
}

static void checkHelix(const char* name, double length, double radius, double turns, double turnsPerSecond) {
    checkValue(name, "length", length, "m", positive);
    checkValue(name, "radius", radius, "m", positive);
    checkValue(name, "turns", turns, "", {-1e4, 1e4});
    checkValue(name, "turns per second", turnsPerSecond, "1/s", anyFinite);
}

void Screw::set(const Vec3D& start, double length, double radius, double turns, double turnsPerSecond,
                double thickness, ScrewType type) {
    checkHelix("Screw", length, radius, turns, turnsPerSecond);
    const double rate = 2 * std::numbers::pi * turns, inner = type == ScrewType::singleHelix ? 0 : -radius;
    const auto at = [=](double q, double r) {
        const double c = std::cos(rate * q), s = std::sin(rate * q);
        return SurfaceJet{start + Vec3D(q * length, r * c, r * s),
                          {length, -rate * r * s, rate * r * c},
                          {0, c, s},
                          {0, -rate * rate * r * c, -rate * rate * r * s},
                          {0, -rate * s, rate * c},
                          Vec3D::Zero()};
    };
    setShape({fmt::format("Screw of length {}, radii {} to {}, {} turns, start ({}, {}, {})", length, inner,
                          radius, turns, start.x(), start.y(), start.z()),
              {0, inner},
              {1, radius},
              {patchesOf(turns), type == ScrewType::singleHelix ? 6u : 12u},
              at},
             thickness);
}

void Coil::set(const Vec3D& start, double length, double radius, double turns, double turnsPerSecond,
               double thickness) {
    checkHelix("Coil", length, radius, turns, turnsPerSecond);
    const double rate = 2 * std::numbers::pi * turns;
    const auto at = [=](double q, double) {
        const double c = radius * std::cos(rate * q), s = radius * std::sin(rate * q);
        return SurfaceJet{start + Vec3D(c, s, q * length),
                          {-rate * s, rate * c, length},
                          Vec3D::Zero(),
                          {-rate * rate * c, -rate * rate * s, 0},
                          Vec3D::Zero(),
                          Vec3D::Zero()};
    };
    setShape({fmt::format("Coil of length {}, radius {}, {} turns, start ({}, {}, {})", length, radius, turns,
                          start.x(), start.y(), start.z()),
              {0, 0},
              {1, 0},
              {patchesOf(turns), 1},
              at},
             thickness);
}

}  // namespace pendular
