#pragma once

#include "Kernel/Features/Superquadrics/Superquadric.h"
#include "Kernel/Foundation/Math/ElementaryFunctions.h"
#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// A superquadric as its support function needs it: eight of them may have eight shapes.
template <Number T>
struct SuperquadricLanes {
    T a, b, c;             // m
    T n1, n2;              // exponents
    bool areEllipsoids{};  // all of them: roots are not needed then

    static SuperquadricLanes from(const Superquadric& s) {
        return {s.a, s.b, s.c, static_cast<double>(s.n1), static_cast<double>(s.n2), s.isEllipsoid()};
    }
};

/// The surface where its outward normal is given, in the body's axes.
template <Number T>
struct SupportPoint {
    T height;         // m, h(n): of the tangent plane above the centre
    Vector<T> point;  // m, the farthest along the normal; the gradient of h
    /// 1/m, the second derivatives of the inside-outside function over the length of its gradient: its part
    /// in the tangent plane is the curvature of the surface. (xz and yz are 0.)
    T xx, yy, zz, xy;
};

namespace superquadric {

/// x^k for an integer k from 0 to 7, which may differ from lane to lane.
template <Number T>
T power(const T& x, const T& k) {
    const T square = x * x;
    const MaskOf<T> four = k >= 4.0;
    const T low = k - select(four, T(4), T(0));
    const MaskOf<T> two = low >= 2.0;
    const MaskOf<T> one = (low - select(two, T(2), T(0))) >= 1.0;
    return select(one, x, T(1)) * select(two, square, T(1)) * select(four, square * square, T(1));
}

/// x^(1/k) for 0 <= x <= 2 and an integer k: the same bits on every machine, unlike pow().
template <Number T>
T root(const T& x, const T& k) {
    return select(k == 1.0, x, select(k == 2.0, sqrt(x), exponential2(logarithm2(x) / k)));
}

/// The point at which u X + v Y is largest on X^n + Y^n = 1, u and v not negative and not both 0 (Hoelder's
/// inequality): X^(n-1) = u / value. The ratio of the two is used, so that nothing leaves the range of a
/// double.
template <Number T>
struct Farthest {
    T value, x, y;
};
template <Number T>
Farthest<T> farthest(const T& u, const T& v, const T& n) {
    const MaskOf<T> first = u >= v;
    const T larger = select(first, u, v), smaller = select(first, v, u);
    const T ratio = smaller / max(larger, T(1e-300));
    const T other = root(ratio, n - 1.0);
    const T sum = fma(ratio, other, T(1));
    const T norm = root(sum, n);
    const T big = 1.0 / norm, small = other * big;
    return {larger * sum * big, select(first, big, small), select(first, small, big)};
}

inline constexpr double diagonal = 0x1.6a09e667f3bcdp-1;  // sqrt(1/2)
/// Unit, in a tangent plane: where searches without derivatives look.
inline constexpr double eightDirections[8][2] = {
    {1, 0},  {diagonal, diagonal},   {0, 1},  {-diagonal, diagonal},
    {-1, 0}, {-diagonal, -diagonal}, {0, -1}, {diagonal, -diagonal}};

template <Number T>
T withSign(const T& size, const T& sign) {
    return select(sign < 0.0, -size, size);
}

/// The support of an ellipsoid: h^2 = (a nx)^2 + (b ny)^2 + (c nz)^2, and the gradient of x^2/a^2 + ... is 2
/// n / h.
template <Number T>
SupportPoint<T> supportOfEllipsoid(const SuperquadricLanes<T>& s, const Vector<T>& n) {
    const Vector<T> stretched{s.a * s.a * n.x, s.b * s.b * n.y, s.c * s.c * n.z};
    const T height = sqrt(dot(stretched, n));
    const T scale = 1.0 / height;
    return {height, stretched * scale, height / (s.a * s.a), height / (s.b * s.b), height / (s.c * s.c),
            T(0)};
}

}  // namespace superquadric

/// The point of the surface with an outward normal.
///
/// h is the largest n . p on the surface. With the largest value X = xi of the section across z, it is the
/// largest of xi u + z w on xi^n1 + z^n1 = 1, so that it follows from two problems in the plane, each solved
/// by Hoelder's inequality; h is the dual norm, with the exponents n/(n-1). The derivatives of
/// f = xi^n1 + |z/c|^n1 are in terms of X/xi and Y/xi, so that none is 0 times infinity where xi = 0.
/// @param n unit
template <Number T>
SupportPoint<T> supportPoint(const SuperquadricLanes<T>& s, const Vector<T>& n) {
    using namespace superquadric;
    if (s.areEllipsoids) return supportOfEllipsoid(s, n);
    const Farthest<T> across = farthest(s.a * abs(n.x), s.b * abs(n.y), s.n2);
    const Farthest<T> whole = farthest(across.value, s.c * abs(n.z), s.n1);
    const T xi = whole.x, z = whole.y, x = across.x, y = across.y;

    const T xPower = power(x, s.n2 - 2.0), yPower = power(y, s.n2 - 2.0);
    const T xSlope = xPower * x, ySlope = yPower * y;  // x^(n2-1)
    const T xiPower = power(xi, s.n1 - 2.0), zPower = power(z, s.n1 - 2.0);
    // The gradient of f is n1 n / h by Euler's theorem, as p . grad f = n1 f: all below is over n1.
    const T scale = whole.value;
    const T slopes = xSlope * ySlope, outer = s.n1 - 1.0, inner = s.n2 - 1.0;
    const T sum = xiPower * scale;
    const T sx = withSign(T(1), n.x), sy = withSign(T(1), n.y);
    return {whole.value,
            {withSign(s.a * xi * x, n.x), withSign(s.b * xi * y, n.y), withSign(s.c * z, n.z)},
            sum * fma(outer, xSlope * xSlope, inner * xPower * (ySlope * y)) / (s.a * s.a),
            sum * fma(outer, ySlope * ySlope, inner * yPower * (xSlope * x)) / (s.b * s.b),
            outer * zPower * scale / (s.c * s.c),
            sum * (s.n1 - s.n2) * slopes * sx * sy / (s.a * s.b)};
}

/// The direction (unit) of the gradient of f at a point: the outward normal of the shape that is scaled to
/// go through it.
/// @param p m, in the body's axes; not 0
template <Number T>
Vector<T> outwardNormal(const SuperquadricLanes<T>& s, const Vector<T>& p) {
    using namespace superquadric;
    const T x = abs(p.x / s.a), y = abs(p.y / s.b), z = abs(p.z / s.c);
    const T xSlope = power(x, s.n2 - 1.0), ySlope = power(y, s.n2 - 1.0);
    const T xi = root(fma(xSlope, x, ySlope * y), s.n2);
    const T across = power(xi, s.n1 - 1.0) / max(power(xi, s.n2 - 1.0), T(1e-300));
    const Vector<T> gradient{withSign(across * xSlope / s.a, p.x), withSign(across * ySlope / s.b, p.y),
                             withSign(power(z, s.n1 - 1.0) / s.c, p.z)};
    return gradient * (1.0 / sqrt(squaredNorm(gradient)));
}

/// 1/m, the curvature of a surface in two directions of its tangent plane.
template <Number T>
struct Curvature {
    T uu, vv, uv;

    friend Curvature operator+(const Curvature& a, const Curvature& b) {
        return {a.uu + b.uu, a.vv + b.vv, a.uv + b.uv};
    }
    /// 1/m^2, Gauss' curvature: the product of the principal ones.
    [[nodiscard]] T determinant() const { return fma(uu, vv, -(uv * uv)); }
    /// m: the radii of curvature, as the second derivatives of the support function have them.
    [[nodiscard]] Curvature inverse() const {
        const T scale = 1.0 / determinant();
        return {vv * scale, uu * scale, -uv * scale};
    }
};

/// m, 1 / sqrt(det K): that of a sphere; infinite on what is flat in a direction.
template <Number T>
T gaussRadius(const Curvature<T>& k) {
    const T gauss = k.determinant();
    return select(gauss > 0.0, 1.0 / sqrt(max(gauss, T(1e-300))), T(infinity));
}

/// @param u, v unit, at right angles to each other and to the normal, in the body's axes
template <Number T>
Curvature<T> curvature(const SupportPoint<T>& at, const Vector<T>& u, const Vector<T>& v) {
    const auto form = [&](const Vector<T>& p, const Vector<T>& q) {
        return fma(at.xx * p.x, q.x, fma(at.yy * p.y, q.y, at.zz * p.z * q.z)) +
               at.xy * fma(p.x, q.y, p.y * q.x);
    };
    return {form(u, u), form(v, v), form(u, v)};
}

/// Two unit vectors at right angles to a unit vector and to each other, without a branch.
/// Source: Duff et al. (2017), J. Comput. Graphics Techniques 6, 1.
template <Number T>
struct TangentPlane {
    Vector<T> u, v;

    explicit TangentPlane(const Vector<T>& n) {
        const T sign = select(n.z < 0.0, T(-1), T(1));
        const T a = -1.0 / (sign + n.z), b = n.x * n.y * a;
        u = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        v = {b, sign + n.y * n.y * a, -n.y};
    }
};

}  // namespace pendular
