#pragma once

#include <type_traits>

#include "Kernel/Features/Superquadrics/SuperquadricSupport.h"
#include "Kernel/Foundation/Math/Quaternion.h"

namespace pendular {

/// Two superquadrics in space; eight pairs at a time.
template <Number T>
struct SuperquadricPair {
    SuperquadricLanes<T> shape1, shape2;
    Axes<T> axes1, axes2;
    Vector<T> shift;  // m, centre 2 - centre 1
};

/// The touch of two superquadrics.
template <Number T>
struct SuperquadricTouch {
    Vector<T> normal;  // unit, from body 1 to body 2
    T depth;           // m, how far they must be moved apart, along the normal; negative: a gap
    Vector<T> arm1;    // m, from centre 1 to the middle of the overlap
    T radius;          // m, Gauss' radius of the pair, 1 / sqrt(det(K1 + K2)); infinite if both are flat
    T own1, own2;      // m, of each body, 1 / sqrt(det K)
    MaskOf<T>
        isFound;  // false: Newton's method has not ended; the fallback has gone on from the best it had seen
};

/// F(n) = h1(n) + h2(-n) - n . d: what the slabs at right angles to n overlap by (m), and all that Newton's
/// method needs at that normal. The depth is the least of it.
template <Number T>
struct SlabOverlap {
    T value;                  // m
    Vector<T> point1, slope;  // m: of body 1 from its centre; the gradient of F
    Curvature<T> first, second;
    TangentPlane<T> plane;

    SlabOverlap(const SuperquadricPair<T>& pair, const Vector<T>& n) : plane(n) {
        const SupportPoint<T> own = supportPoint(pair.shape1, pair.axes1.turnBack(n));
        const SupportPoint<T> other = supportPoint(pair.shape2, pair.axes2.turnBack(-n));
        point1 = pair.axes1.turn(own.point);
        slope = point1 - pair.axes2.turn(other.point) - pair.shift;
        value = dot(n, slope);
        first = curvature(own, pair.axes1.turnBack(plane.u), pair.axes1.turnBack(plane.v));
        second = curvature(other, pair.axes2.turnBack(plane.u), pair.axes2.turnBack(plane.v));
    }

    /// The normal to which Newton's method goes from another one, and twice what F is to lose by that (m).
    struct Step {
        Vector<T> normal;
        T decrease;
    };
    [[nodiscard]] MaskOf<T> firstIsFlatter() const { return first.determinant() < second.determinant(); }

    /// A step of Newton's method in the tangent plane of the sphere of normals, (A - F) t = -g, with the
    /// radii of curvature A and the slope g along the plane; with A (1 + damping) for it, and without F where
    /// that would not lead downwards.
    ///
    /// On flat faces and edges the radii are infinite, F ~ |t|^(n/(n-1)), and steps along t overshoot. So
    /// each body's point goes along its surface by A_i t, and gives the normal of where it comes to: points
    /// are smooth functions of each other where normals are not. Of the two normals the mean is taken with
    /// the weights A_i, so that in each direction the flatter body leads.
    /// @param size m, of the pair
    [[nodiscard]] Step newtonStep(const SuperquadricPair<T>& pair, const Vector<T>& n, const T& damping,
                                  const T& size) const {
        const T flattest = 1e-6 / size;  // surfaces are taken as curved by at least this
        const Curvature<T> floor{flattest, flattest, T(0)};
        const Curvature<T> one = (first + floor).inverse(), two = (second + floor).inverse();
        const T grow = 1.0 + damping;
        const Curvature<T> radii{grow * (one.uu + two.uu), grow * (one.vv + two.vv),
                                 grow * (one.uv + two.uv)};
        const T uuFull = radii.uu - value, vvFull = radii.vv - value, uv2 = radii.uv * radii.uv;
        const MaskOf<T> convex =
            (uuFull > 0.0) & (fma(uuFull, vvFull, -uv2) > 0.25 * fma(radii.uu, radii.vv, -uv2));
        const T uu = select(convex, uuFull, radii.uu), vv = select(convex, vvFull, radii.vv);
        const T scale = -1.0 / fma(uu, vv, -uv2);
        const T gu = dot(slope, plane.u), gv = dot(slope, plane.v);
        const T tu = scale * fma(vv, gu, -(radii.uv * gv)), tv = scale * fma(uu, gv, -(radii.uv * gu));
        const T decrease = -fma(tu, gu, tv * gv);
        const auto turned = [&](const T& alongU, const T& alongV) {
            const T shorter =  // at most half a radian
                min(T(1), 0.5 / sqrt(max(fma(alongU, alongU, alongV * alongV), T(1e-300))));
            const Vector<T> to = n + (shorter * alongU) * plane.u + (shorter * alongV) * plane.v;
            return Step{to * (1.0 / sqrt(squaredNorm(to))), decrease};
        };
        if (pair.shape1.areEllipsoids && pair.shape2.areEllipsoids) return turned(tu, tv);

        const auto movedBy = [&](const Curvature<T>& a) {
            return fma(a.uu, tu, a.uv * tv) * plane.u + fma(a.uv, tu, a.vv * tv) * plane.v;
        };
        const Vector<T> point2 = point1 - slope - pair.shift;
        const Vector<T> normal1 =
            pair.axes1.turn(outwardNormal(pair.shape1, pair.axes1.turnBack(point1 + movedBy(one))));
        const Vector<T> normal2 =
            -pair.axes2.turn(outwardNormal(pair.shape2, pair.axes2.turnBack(point2 - movedBy(two))));
        // (A1 + A2)^-1 (A1 t1 + A2 t2), of the turns t1 and t2 to the two normals.
        T mu = 0.0, mv = 0.0;
        const auto add = [&](const Curvature<T>& a, const Vector<T>& normal) {
            const T ahead = 1.0 / max(dot(normal, n), T(0.1));
            const T u = ahead * dot(normal, plane.u), v = ahead * dot(normal, plane.v);
            mu = mu + fma(a.uu, u, a.uv * v), mv = mv + fma(a.uv, u, a.vv * v);
        };
        add(one, normal1), add(two, normal2);
        const Curvature<T> mean = (one + two).inverse();
        return turned(fma(mean.uu, mu, mean.uv * mv), fma(mean.uv, mu, mean.vv * mv));
    }

    void takeWhere(const MaskOf<T>& mask, const SlabOverlap& better) {
        const auto take = [&](T& to, const T& from) { to = select(mask, from, to); };
        take(value, better.value);
        point1 = select(mask, better.point1, point1), slope = select(mask, better.slope, slope);
        plane.u = select(mask, better.plane.u, plane.u), plane.v = select(mask, better.plane.v, plane.v);
        for (auto part : {&Curvature<T>::uu, &Curvature<T>::vv, &Curvature<T>::uv}) {
            take(first.*part, better.first.*part);
            take(second.*part, better.second.*part);
        }
    }
};

namespace superquadric {

template <Number T>
Vector<T> unit(const Vector<T>& v) {
    return v * (1.0 / sqrt(squaredNorm(v)));
}

}  // namespace superquadric

/// The normal with which Newton's method begins if none is known from an earlier step: S^-1 d, with the sum S
/// of the squared half lengths along the axes of both in space. It is exact for spheres and for ellipsoids of
/// the same shape and orientation.
template <Number T>
Vector<T> firstNormal(const SuperquadricPair<T>& pair) {
    T xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
    const auto add = [&](const Vector<T>& axis, const T& length) {
        const Vector<T> stretched = axis * (length * length);
        xx = fma(stretched.x, axis.x, xx), yy = fma(stretched.y, axis.y, yy);
        zz = fma(stretched.z, axis.z, zz), xy = fma(stretched.x, axis.y, xy);
        xz = fma(stretched.x, axis.z, xz), yz = fma(stretched.y, axis.z, yz);
    };
    add(pair.axes1.x, pair.shape1.a), add(pair.axes1.y, pair.shape1.b), add(pair.axes1.z, pair.shape1.c);
    add(pair.axes2.x, pair.shape2.a), add(pair.axes2.y, pair.shape2.b), add(pair.axes2.z, pair.shape2.c);
    // The adjugate of S; its determinant does not matter for the direction.
    const Vector<T>& d = pair.shift;
    const T a = yy * zz - yz * yz, b = xz * yz - xy * zz, c = xy * yz - xz * yy, e = xx * zz - xz * xz,
            f = xy * xz - xx * yz, g = xx * yy - xy * xy;
    const Vector<T> along{a * d.x + b * d.y + c * d.z, b * d.x + e * d.y + f * d.z,
                          c * d.x + f * d.y + g * d.z};
    const MaskOf<T> isKnown = squaredNorm(along) > 0.0;  // not where the centres are the same
    return superquadric::unit(select(isKnown, along, pair.axes1.x));
}

/// Whether a plane at right angles to an axis of one of the two lies between their oriented boxes: six of the
/// fifteen planes of Gottschalk, Lin and Manocha (1996), the others are left to the first normal.
/// @param gap m, by which they are apart at least
template <Number T>
MaskOf<T> boxesAreApart(const SuperquadricPair<T>& pair, const std::type_identity_t<T>& gap = T(0)) {
    const auto reach = [](const SuperquadricLanes<T>& s, const Axes<T>& axes, const Vector<T>& along) {
        return fma(s.a, abs(dot(axes.x, along)),
                   fma(s.b, abs(dot(axes.y, along)), s.c * abs(dot(axes.z, along))));
    };
    const auto &s = pair.shape1, &t = pair.shape2;
    MaskOf<T> areApart = pair.shift.x != pair.shift.x;  // none
    const auto look = [&](const Vector<T>& axis, const T& own, const SuperquadricLanes<T>& other,
                          const Axes<T>& axes) {
        const MaskOf<T> here = abs(dot(axis, pair.shift)) > own + reach(other, axes, axis) + gap;
        areApart = areApart | here;
    };
    look(pair.axes1.x, s.a, t, pair.axes2), look(pair.axes1.y, s.b, t, pair.axes2);
    look(pair.axes1.z, s.c, t, pair.axes2), look(pair.axes2.x, t.a, s, pair.axes1);
    look(pair.axes2.y, t.b, s, pair.axes1), look(pair.axes2.z, t.c, s, pair.axes1);
    return areApart;
}

/// The fallback where Newton's method has not ended: about the best normal so far, the best of eight
/// directions is taken, at steps that are halved where none is better. It uses no derivatives and always
/// ends, but creeps along narrow valleys.
/// @param wanted lanes that are looked at
template <Number T>
void searchAround(const SuperquadricPair<T>& pair, const MaskOf<T>& wanted, Vector<T>& normal,
                  SlabOverlap<T>& best) {
    constexpr int mostRounds = 80;
    T step = 1e-2;  // rad
    for (int round = 0; round < mostRounds; ++round) {
        MaskOf<T> moved = normal.x != normal.x;  // none
        const TangentPlane<T> plane = best.plane;
        const Vector<T> middle = normal;
        for (const auto& direction : superquadric::eightDirections) {
            const Vector<T> tried = superquadric::unit(middle + (step * direction[0]) * plane.u +
                                                       (step * direction[1]) * plane.v);
            const SlabOverlap<T> there(pair, tried);
            const MaskOf<T> better = wanted & (there.value < best.value);
            normal = select(better, tried, normal);
            best.takeWhere(better, there);
            moved = moved | better;
        }
        step = select(moved, step, 0.5 * step);
    }
}

/// The true depth of two superquadrics, the least of F(n) over all normals, by Newton's method on the sphere
/// of normals, damped as by Levenberg and Marquardt wherever a step does not lead downwards. Each F(n) < 0
/// proves that they are apart. F is convex in n (as of degree 1), so there is one least value while they are
/// apart; deeper in, the one near `start`, that is the one that the contact began with.
///
/// The point and the overlap of Podlozhnyuk et al. (2017), Comput. Part. Mech. 4, 101, which other codes
/// take, agree with it for light contacts; but they depend on how f is scaled, and part from it in deep ones.
/// @param start unit
/// @param gap m; lanes that are found to be apart by more are left as they are: no nearest points
template <Number T>
SuperquadricTouch<T> findTouch(const SuperquadricPair<T>& pair, const Vector<T>& start,
                               const std::type_identity_t<T>& gap) {
    constexpr int mostSteps = 60;
    const T size = norm(pair.shift) + pair.shape1.a + pair.shape2.a;
    const T roundOff = 4e-16 * size;
    Vector<T> normal = start;
    SlabOverlap<T> now(pair, normal);
    T damping = 0.0, idleSteps = 0.0;
    MaskOf<T> done = now.value < -gap;
    for (int k = 0; k < mostSteps && !all(done); ++k) {
        const auto step = now.newtonStep(pair, normal, damping, size);
        const SlabOverlap<T> there(pair, step.normal);
        // The step is still taken: the normal is then known to the square of its length, some 1e-8.
        const MaskOf<T> small = (1.0 + damping) * step.decrease < roundOff;
        // Where a flat face is met, slopes are known worse than F: three steps that do not change it end it
        // too.
        idleSteps = select(abs(there.value - now.value) <= roundOff, idleSteps + 1.0, T(0));
        const MaskOf<T> better = (!done) & (there.value <= now.value + roundOff);
        normal = select(better, step.normal, normal);
        now.takeWhere(better, there);
        damping = select(better, select(damping > 0.1, 0.25 * damping, T(0)), max(4.0 * damping, T(1)));
        done = done | small | (idleSteps >= 3.0) | (now.value < -gap);
    }
    if (!all(done)) searchAround(pair, !done, normal, now);
    // The point of a flat surface is badly known where its normal is known well; that of the other is not.
    const Vector<T> half = 0.5 * now.value * normal;
    return {normal,
            now.value,
            select(now.firstIsFlatter(), now.point1 - now.slope + half, now.point1 - half),
            gaussRadius(now.first + now.second),
            gaussRadius(now.first),
            gaussRadius(now.second),
            done};
}

}  // namespace pendular
