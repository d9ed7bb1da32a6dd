#pragma once

#include <string_view>
#include <vector>

#include "Kernel/Foundation/Math/ElementaryFunctions.h"

namespace pendular {

enum class KernelShape { Gauss, Lucy, Heaviside };

/// Throws InputError for another name than gauss, lucy and heaviside.
KernelShape kernelShapeNamed(std::string_view name);

/// A function phi of the distance r from a point, in D dimensions, that is 0 beyond a cut-off c and has the
/// integral 1:
///   Gauss      e^(-r^2 / 2w^2) / ((sqrt(2 pi) w)^D V_D), where V_D is its weight within c
///   Lucy       1 - 6a^2 + 8a^3 - 3a^4 with a = r / c, times 5/(4c), 5/(pi c^2), 105/(16 pi c^3)
///   Heaviside  1/(2c), 1/(pi c^2), 3/(4 pi c^3)
/// In no dimensions it is 1. Sources: Goldhirsch, Granul. Matter 12 (2010) 239; Weinhart et al., Granul.
/// Matter 14 (2012) 289; Lucy, Astron. J. 82 (1977) 1013.
class SmoothingKernel {
public:
    /// @param width m, w of a Gauss function; others depend on the cut-off only
    /// @param cutOff m; 0: 3 w (Gauss), 2 w (Lucy), w (Heaviside)
    /// Throws InputError unless both are positive and finite, and the cut-off of a Gauss is w at least.
    SmoothingKernel(KernelShape shape, int dimensions, double width, double cutOff = 0);

    [[nodiscard]] KernelShape shape() const { return form; }
    [[nodiscard]] int dimensions() const { return size; }
    [[nodiscard]] double width() const { return w; }
    [[nodiscard]] double cutOff() const { return c; }

    /// phi, 1/m^D. @param square of the distance, m^2
    template <Number T>
    [[nodiscard]] T value(const T& square) const {
        if (size == 0) return T(1.0);
        return select(square <= c * c, norm * shapeOf(square), T(0.0));
    }

    /// The mean of phi over a straight line, the integral of phi(r - a - s b) ds over s from 0 to 1, 1/m^D,
    /// in closed form.
    /// @param along (r - a) b / L, m, with the length L = |b|; @param acrossSquare the square of the distance
    /// of r from the whole line, m^2
    /// @param length L, m, at least shortestLine()
    template <Number T>
    [[nodiscard]] T lineMean(const T& along, const T& acrossSquare, double length) const {
        const T reach = size == 1 ? T(c) : sqrt(max(c * c - acrossSquare, T(0.0)));
        const T from = max(-along, -reach), to = min(length - along, reach);
        const T integral = select(from < to, lineIntegral(from, to, acrossSquare), T(0.0));
        return (norm / length) * integral;
    }
    /// m; on a shorter line the closed form loses digits, and the mean of three points has them all.
    [[nodiscard]] double shortestLine() const { return 1e-3 * c; }

private:
    template <Number T>
    [[nodiscard]] T shapeOf(const T& square) const {
        switch (form) {
            case KernelShape::Gauss:
                return exponential2(square * gaussFactor);
            case KernelShape::Lucy: {
                const T a = sqrt(square) * (1 / c);
                return 1.0 + a * a * (-6.0 + a * (8.0 - 3.0 * a));
            }
            case KernelShape::Heaviside:
                break;
        }
        return T(1.0);
    }

    /// The integral (m) of the function without its norm, over p from one end to the other.
    template <Number T>
    [[nodiscard]] T lineIntegral(const T& from, const T& to, const T& t2) const {
        switch (form) {
            case KernelShape::Gauss:
                // e^(-t^2 / 2w^2) sqrt(pi/2) w [erf(p_1 / sqrt(2) w) - erf(p_0 / sqrt(2) w)]
                return size == 1 ? gaussDifference(from, to)
                                 : exponential2(t2 * gaussFactor) * gaussDifference(from, to);
            case KernelShape::Lucy:
                return lucyIntegral(to, t2) - lucyIntegral(from, t2);
            case KernelShape::Heaviside:
                break;
        }
        return to - from;
    }

    /// sqrt(pi/2) w [erf(p_1 / sqrt(2) w) - erf(p_0 / sqrt(2) w)] for both |p| <= c, m, to 1e-15 of its
    /// largest value (5e-15 where c is 20 w): p times a power series in y = 2 p^2 / c^2 - 1, even and odd
    /// powers by themselves, of both at a time.
    template <Number T>
    [[nodiscard]] T gaussDifference(const T& from, const T& to) const {
        const double scale = 2 / (c * c);
        const T y0 = from * from * scale - 1.0, y1 = to * to * scale - 1.0;
        const T square0 = y0 * y0, square1 = y1 * y1;
        T even0(0.0), odd0(0.0), even1(0.0), odd1(0.0);
        for (std::size_t k = series.size(); k > 0; k -= 2) {
            const T even(series[k - 2]), odd(series[k - 1]);
            even0 = fma(even0, square0, even), odd0 = fma(odd0, square0, odd);
            even1 = fma(even1, square1, even), odd1 = fma(odd1, square1, odd);
        }
        return to * fma(y1, odd1, even1) - from * fma(y0, odd0, even0);
    }

    /// p - 6 P_2 / c^2 + 8 P_3 / c^3 - 3 P_4 / c^4, where P_n is the integral of (p^2 + t^2)^(n/2) over p.
    template <Number T>
    [[nodiscard]] T lucyIntegral(const T& p, const T& t2) const {
        const T p2 = p * p, q2 = p2 + t2, q = sqrt(q2);
        // t^4 asinh(p / t), with a t that is 1e-12 of the cut-off at least: t^4 is then nothing.
        const T t = sqrt(max(t2, T(1e-24 * c * c)));
        const T logarithm = logarithm2((abs(p) + sqrt(p2 + t * t)) / t) * 0x1.62e42fefa39efp-1;
        const T asinh = select(p < 0.0, -logarithm, logarithm);
        const T third = (p * (2.0 * p2 + 5.0 * t2) * q + 3.0 * t2 * t2 * asinh) * 0.125;
        return p - (6 / (c * c)) * (p * (p2 * (1.0 / 3) + t2)) + (8 / (c * c * c)) * third -
               (3 / (c * c * c * c)) * (p * (p2 * p2 * 0.2 + t2 * p2 * (2.0 / 3) + t2 * t2));
    }

    KernelShape form;
    int size;
    double w, c;                 // m
    double norm = 1;             // 1/m^D
    double gaussFactor;          // -log2(e) / 2w^2, 1/m^2
    std::vector<double> series;  // of gaussDifference(), an even number
};

}  // namespace pendular
