#!/usr/bin/env python3
"""Coefficients of the polynomials in ElementaryFunctions.h and the bounds of their errors (needs mpmath).

Both are interpolations in Chebyshev nodes, computed with 60 digits, then rounded to double; the error printed
is that of the rounded polynomial. Near-minimax: rounding to double costs more than Remez exchange would gain.
"""

from mpmath import atanh, chebyfit, expm1, log, mp, mpf, polyval, sqrt

mp.dps = 60


def fit(name, function, interval, degree, contribution):
    """Prints the polynomial for function and the greatest contribution(x) * |error(x)|."""
    coefficients = [mpf(float(c)) for c in chebyfit(function, interval, degree + 1)]
    low, high = (mpf(end) for end in interval)
    points = (low + (high - low) * (k + mpf(1) / 2) / 4000 for k in range(4000))
    error = max(contribution(x) * abs(polyval(coefficients, x) - function(x)) for x in points)
    print(f"{name}: error {float(error):.2e} = 2^{float(log(error, 2)):.1f}")
    for power, coefficient in enumerate(reversed(coefficients)):
        print(f"    {float(coefficient).hex()}, // {power}")


# 2^r = 1 + r Q(r), |r| <= 1/2.
fit("exponential2, Q(r)", lambda r: expm1(r * log(2)) / r if r else log(2), [-0.5, 0.5], 10,
    lambda r: abs(r) / mpf(2) ** r)

# log(1 + f) = 2 artanh(s) = 2 s + s z P(z), z = s^2, s = f / (2 + f), for 1 + f from sqrt(1/2) to sqrt(2).
largest = ((sqrt(2) - 1) / (sqrt(2) + 1)) ** 2
fit("logarithm2, P(z)", lambda z: (2 * atanh(sqrt(z)) / sqrt(z) - 2) / z, [mpf("1e-30"), largest], 6,
    lambda z: z / 2)

high = mpf(int(2**20 / log(2))) / 2**20  # 1 / log(2) in 21 bits, and the rest of it
print(f"1 / log(2): {float(high).hex()} + {float(1 / log(2) - high).hex()}")
