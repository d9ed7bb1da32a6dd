#pragma once

/// 2^x and log2(x) for both number types, with the same bits, of + - * / select and bit operations only: no
/// table, no branch, no fused multiplication. The functions of `<cmath>` cannot serve here: their last bits
/// differ between versions of the C library, and they take one number at a time. Measured errors: README.md.
///
/// The coefficients come from generate_polynomials.py (interpolation in Chebyshev nodes, rounded to double),
/// which also prints the error bounds stated below.

#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

/// 2^x with less than 1.5 ulp of error for x in [-1022, 1024).
/// Below -1022 the result is 0: no subnormal numbers arise, a jump of 2e-308. From 1024 on it is infinity;
/// NaN gives NaN.
template <Number T>
[[gnu::always_inline]] inline T exponential2(const T& x) {
    // 2^x = 2^n 2^r with |r| <= 1/2, and 2^r = 1 + r Q(r). The error of the polynomial is at most 2^-55.5 of
    // the result. Q(r) = log(2) + r W(r): the larger part of r Q(r) then suffers a single rounding.
    const T n = nearestInteger(x);
    const T r = x - n;
    const T r2 = r * r;
    const T r4 = r2 * r2;
    const T w0 = (0x1.ebfbdff82c598p-3 + 0x1.c6b08d704a0c2p-5 * r) +
                 (0x1.3b2ab6fba1ddap-7 + 0x1.5d87fe78a5276p-10 * r) * r2;
    const T w4 = (0x1.430913096fd9fp-13 + 0x1.ffcbfc670dcd4p-17 * r) +
                 (0x1.62bfd47773353p-20 + 0x1.b524fae627834p-24 * r) * r2;
    const T w8 = 0x1.e6063f7217bc6p-28 + 0x1.e9d3fe3952179p-32 * r;
    const T w = w0 + r4 * (w4 + r4 * w8);
    const T result = scaleByPowerOfTwo(1.0 + (0x1.62e42fefa39efp-1 * r + r2 * w), n);

    return select(x < 1024.0, select(x >= -1022.0, result, T(0.0)), x + infinity);
}

/// The logarithm of x to base 2 with less than 1 ulp of error, also near x = 1 and for subnormal x.
/// log2(0) is minus infinity, log2(infinity) infinity; negative numbers and NaN give NaN.
template <Number T>
[[gnu::always_inline]] inline T logarithm2(const T& x) {
    // x = 2^e (1 + f), with 1 + f between sqrt(1/2) and sqrt(2).
    const MaskOf<T> subnormal = x < 0x1p-1022;
    const T normal = select(subnormal, x * 0x1p54, x);
    const T significand = significandOf(normal);
    const MaskOf<T> large = significand > 0x1.6a09e667f3bcdp0;
    const T f = select(large, 0.5 * significand, significand) - 1.0;
    const T e = exponentOf(normal) + select(large, T(1.0), T(0.0)) - select(subnormal, T(54.0), T(0.0));

    // With s = f / (2 + f), z = s^2 and h = f^2 / 2:
    //     log(1 + f) = 2 artanh(s) = 2 s + s z P(z) = f - (h - s (h + z P(z))),
    // where the last form begins with f, which is exact. The error of P is at most 2^-57.6 of the result.
    const T s = f / (2.0 + f);
    const T z = s * s;
    const T z2 = z * z;
    const T p0 = 0x1.5555555555558p-1 + 0x1.99999999952e2p-2 * z;
    const T p2 = 0x1.2492492df148dp-2 + 0x1.c71c62e5800a1p-3 * z;
    const T p4 = 0x1.7462b4ab2ef6bp-3 + 0x1.39fe606542ddep-3 * z;
    const T p = p0 + z2 * (p2 + z2 * (p4 + z2 * 0x1.2b584aae78a57p-3));
    const T h = 0.5 * f * f;
    const T correction = s * (h + z * p);

    // log(1 + f) = leading + rest, of which the 21 leading bits times those of 1 / log(2) are exact.
    const T leading = leadingBitsOf(f - h);
    const T rest = ((f - leading) - h) + correction;
    constexpr double inverseLog2 = 0x1.71547p0;
    constexpr double inverseLog2Rest = 0x1.94ae0bf85ddf4p-22;
    const T product = leading * inverseLog2;
    const T sum = e + product;  // |e| > |product| unless e = 0: the rounding error below is exact
    const T error = (e - sum) + product;
    const T result = sum + (error + ((leading + rest) * inverseLog2Rest + rest * inverseLog2));

    constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
    const T special = select(x == 0.0, T(-infinity), T(notANumber));
    return select(x > 0.0, select(x < infinity, result, x), special);
}

}  // namespace pendular
