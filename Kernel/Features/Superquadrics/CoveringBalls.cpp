#include "Kernel/Features/Superquadrics/CoveringBalls.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pendular {

namespace {

constexpr int mostPieces = 48, mostAcross = 7;
/// Points of a piece are taken on columns, so many across a piece; between them the surface may be farther
/// from the middle of the ball by up to half a percent, at sharp edges.
constexpr int columns = 9;
constexpr double betweenColumns = 1.01;

using Cut = std::array<int, 3>;  // pieces along each axis

/// m, from the middle to the surface along an axis, above the point (u, v) of the other two in their order;
/// negative beside the superquadric.
double heightAbove(const Superquadric& s, int axis, double u, double v) {
    const auto power = [](double base, double exponent) { return std::pow(std::abs(base), exponent); };
    const double n1 = s.n1, n2 = s.n2;
    if (axis == 2) {
        const double rest = 1 - std::pow(power(u / s.a, n2) + power(v / s.b, n2), n1 / n2);
        return rest < 0 ? -1 : s.c * std::pow(rest, 1 / n1);
    }
    const double other = axis == 0 ? s.b : s.a;
    const double layer = 1 - power(v / s.c, n1);
    const double rest = layer < 0 ? -1 : std::pow(layer, n2 / n1) - power(u / other, n2);
    return rest < 0 ? -1 : (axis == 0 ? s.a : s.b) * std::pow(rest, 1 / n2);
}

/// The part of a superquadric in the octant x, y, z >= 0 that is in one piece of a cut.
struct SurfacePiece {
    std::array<double, 3> low, high;      // m
    std::array<bool, 3> isInMiddle;       // the piece goes on as far at the other side of 0
    std::vector<Eigen::Vector3d> points;  // m, of its border
};

SurfacePiece pieceAt(const Superquadric& s, const Cut& cut, const Cut& at) {
    const std::array<double, 3> half{s.a, s.b, s.c};
    SurfacePiece piece;
    for (std::size_t d = 0; d < 3; ++d) {
        const double edge = 2 * half[d] / cut[d];
        piece.isInMiddle[d] = cut[d] % 2 == 1 && at[d] == 0;
        piece.low[d] = piece.isInMiddle[d] ? 0 : (at[d] - (cut[d] % 2 == 1 ? 0.5 : 0)) * edge;
        piece.high[d] = std::min(half[d], piece.isInMiddle[d] ? 0.5 * edge : piece.low[d] + edge);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const auto d = static_cast<std::size_t>(axis), first = d == 0 ? 1ul : 0ul,
                   second = d == 2 ? 1ul : 2ul;
        for (int i = 0; i < columns; ++i)
            for (int j = 0; j < columns; ++j) {
                const double u = std::lerp(piece.low[first], piece.high[first], i / (columns - 1.0)),
                             v = std::lerp(piece.low[second], piece.high[second], j / (columns - 1.0));
                const double top = heightAbove(s, axis, u, v);
                if (top < piece.low[d]) continue;
                for (const double w : {piece.low[d], std::min(top, piece.high[d])}) {
                    Eigen::Vector3d point;
                    point[axis] = w, point[static_cast<int>(first)] = u, point[static_cast<int>(second)] = v;
                    piece.points.push_back(point);
                }
            }
    }
    return piece;
}

/// The smallest ball around points, nearly: its middle goes to the farthest one by smaller and smaller steps.
/// Source: Badoiu and Clarkson (2003), Proc. 14th ACM-SIAM Symp. Discrete Algorithms, 801.
Ball ballAround(const SurfacePiece& piece) {
    const auto farthestFrom = [&](const Eigen::Vector3d& centre) {
        return *std::ranges::max_element(
            piece.points, {}, [&](const Eigen::Vector3d& p) { return (p - centre).squaredNorm(); });
    };
    Ball ball{Eigen::Vector3d::Zero(), 0};
    for (int d = 0; d < 3; ++d)
        if (const auto k = static_cast<std::size_t>(d); !piece.isInMiddle[k])
            ball.centre[d] = 0.5 * (piece.low[k] + piece.high[k]);
    for (int k = 1; k <= 100; ++k) {
        Eigen::Vector3d way = farthestFrom(ball.centre) - ball.centre;
        for (int d = 0; d < 3; ++d)
            if (piece.isInMiddle[static_cast<std::size_t>(d)]) way[d] = 0;
        ball.centre += way / (k + 1.0);
    }
    ball.radius = betweenColumns * (farthestFrom(ball.centre) - ball.centre).norm();
    return ball;
}

/// The balls of a cut with their middles at x, y, z >= 0.
std::vector<Ball> ballsOfOctant(const Superquadric& shape, const Cut& cut) {
    std::vector<Ball> balls;
    const auto layers = [&](std::size_t d) { return (cut[d] + 1) / 2; };
    for (int i = 0; i < layers(0); ++i)
        for (int j = 0; j < layers(1); ++j)
            for (int k = 0; k < layers(2); ++k)
                if (const SurfacePiece piece = pieceAt(shape, cut, {i, j, k}); !piece.points.empty())
                    balls.push_back(ballAround(piece));
    return balls;
}

/// m^3, of what the balls fill of the octant x, y, z >= 0, to some percent.
double filled(const std::vector<Ball>& balls) {
    constexpr int steps = 20;
    Eigen::Vector3d reach = Eigen::Vector3d::Zero();
    for (const Ball& ball : balls)
        reach = reach.cwiseMax(ball.centre + Eigen::Vector3d::Constant(ball.radius));
    int inside = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j)
            for (int k = 0; k < steps; ++k) {
                const Eigen::Vector3d point =
                    reach.cwiseProduct(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5)) / steps;
                inside += std::ranges::any_of(balls, [&](const Ball& ball) {
                    return (point - ball.centre).squaredNorm() < ball.radius * ball.radius;
                });
            }
    return inside * reach.prod() / (steps * steps * steps);
}

std::vector<Ball> mirrored(const std::vector<Ball>& octant) {
    std::vector<Ball> all;
    for (const Ball& ball : octant)
        for (int sides = 0; sides < 8; ++sides) {
            Ball image = ball;
            bool isOther = true;
            for (int d = 0; d < 3; ++d)
                if (sides >> d & 1) isOther &= ball.centre[d] > 0, image.centre[d] = -ball.centre[d];
            if (isOther) all.push_back(image);
        }
    return all;
}

}  // namespace

std::vector<Ball> coveringBalls(const Superquadric& shape) {
    const std::array<double, 3> half{shape.a, shape.b, shape.c};
    const auto areInOrder = [&](const Cut& cut) {  // the longer an axis, the more pieces
        for (std::size_t d = 0; d < 3; ++d)
            for (std::size_t e = 0; e < 3; ++e)
                if (half[d] >= half[e] && cut[d] < cut[e]) return false;
        return true;
    };
    std::vector<Ball> best{{Eigen::Vector3d::Zero(), shape.boundingRadius()}};
    double least = filled(best);
    std::size_t number = 1;
    for (int i = 1; i <= mostAcross; ++i)
        for (int j = 1; j <= mostAcross; ++j)
            for (int k = 1; k <= mostAcross; ++k) {
                const int pieces = i * j * k;
                if (pieces == 1 || pieces > mostPieces || !areInOrder({i, j, k})) continue;
                const std::vector<Ball> balls = ballsOfOctant(shape, {i, j, k});
                const double volume = filled(balls);
                const auto more = static_cast<double>(pieces) - static_cast<double>(number);
                if (!(volume < least * std::pow(0.99, more))) continue;
                best = balls, least = volume, number = static_cast<std::size_t>(pieces);
            }
    return mirrored(best);
}

}  // namespace pendular
