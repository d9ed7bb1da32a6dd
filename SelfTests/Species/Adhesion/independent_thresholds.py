#!/usr/bin/python3
"""Volumes V* in [1e-12, 10] at which the classical Willett and the Bagheri fit fail, for ten contact angles.

Each condition is a function of ln V*, scanned on a grid and bisected at 50 digits.
Usage: python3 independent_thresholds.py | clang-format > IndependentThresholds.h
"""
from mpmath import exp, inf, linspace, log, mpf, radians
from independent_bridge_forces import bagheri_coefficients, classical_coefficients

LOWEST, HIGHEST = mpf("1e-12"), mpf(10)
GRID = linspace(log(LOWEST), log(HIGHEST), 1001)


def intervals(condition):
    """Closed intervals of V* in which condition(V*) holds."""
    holds = [condition(exp(x)) for x in GRID]
    edges = [LOWEST] if holds[0] else []
    for left, right, before, after in zip(GRID, GRID[1:], holds, holds[1:]):
        if before == after:
            continue
        while right - left > mpf("1e-12"):
            middle = (left + right) / 2
            left, right = (middle, right) if condition(exp(middle)) == before else (left, middle)
        edges.append(exp(right))
    if holds[-1]:
        edges.append(HIGHEST)
    return list(zip(edges[::2], edges[1::2]))


def denominator_has_zero(v, theta):
    """1 + c a b S* + c b S*^2 with a, b > 0 throughout this range of V*: only c < 0 can make it zero; it is
    then decreasing, and its value at S* = 1 decides."""
    _, a, b, c = bagheri_coefficients(v, theta)
    assert a > 0 and b > 0
    return 1 + c * b * (a + 1) <= 0


def classical_unusable(v, theta):
    _, _, f3, f4 = classical_coefficients(v, theta)
    return f4 > 0 or f3 < 0


CONDITIONS = {
    "classicalUnusable": classical_unusable,
    "classicalF4Positive": lambda v, t: classical_coefficients(v, t)[3] > 0,
    "classicalF3Negative": lambda v, t: classical_coefficients(v, t)[2] < 0,
    "bagheriPole": denominator_has_zero,
    "bagheriCThetaNegative": lambda v, t: bagheri_coefficients(v, t)[3] < 0,
    "bagheriNoAttraction": lambda v, t: bagheri_coefficients(v, t)[0] <= 0,
}

HEADER = """#pragma once

// Written by independent_thresholds.py; not by hand, and not from the code it tests: bisection, at 50 digits,
// of the formulae printed in Bagheri, Roy, Poeschel (capillary bridge forces in MercuryDPM, Appendix A).
// Intervals of V* = V/R^3 within [1e-12, 10] in which a fit fails, for each contact angle; 1e-12 or 10 as an
// end means that the interval may go on. An angle that does not occur in an array has no such interval.

#include <array>
#include <limits>

namespace pendular::independent
{

struct VolumeInterval
{
    int contactAngle; // degrees
    double from, to;  // V*, rounded to 7 digits
};

// Bagheri: where each failure begins, going up in volume from the usable middle; infinity where not below 10.
struct BagheriFailure
{
    int contactAngle; // degrees
    double pole, negativeCTheta, noAttraction; // V*, rounded to 7 digits
};
"""

COMMENTS = {
    "classicalUnusable": "Classical Willett: f4 > 0 or f3 < 0 (the union of the next two).",
    "classicalF4Positive": "Classical Willett: f4 > 0; the force tends to 0 as S -> 0.",
    "classicalF3Negative": "Classical Willett: f3 < 0.",
    "bagheriPole": "Bagheri: the denominator has a zero in 0 <= S* <= 1.",
    "bagheriCThetaNegative": "Bagheri: c_theta < 0; the force grows with the separation.",
    "bagheriNoAttraction": "Bagheri: F0* <= 0.",
}

if __name__ == "__main__":
    print(HEADER)
    first = {}
    for name, condition in CONDITIONS.items():
        rows = [(degrees, *ends) for degrees in range(0, 91, 10)
                for ends in intervals(lambda v: condition(v, radians(mpf(degrees))))]
        print(f"// {COMMENTS[name]}\ninline constexpr std::array<VolumeInterval, {len(rows)}> {name} = {{{{")
        for degrees, start, end in rows:
            if start > LOWEST:
                first[name, degrees] = f"{float(start):.6e}"
            print(f"    {{{degrees}, {float(start):.6e}, {float(end):.6e}}},")
        print("}};\n")
    print("inline constexpr double never = std::numeric_limits<double>::infinity();\n")
    print("inline constexpr std::array<BagheriFailure, 10> bagheriFirstFailures = {{")
    for degrees in range(0, 91, 10):
        names = ("bagheriPole", "bagheriCThetaNegative", "bagheriNoAttraction")
        print(f"    {{{degrees}, " + ", ".join(first.get((name, degrees), "never") for name in names) + "},")
    print("}};\n\n} // namespace pendular::independent")
