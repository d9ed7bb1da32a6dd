#!/usr/bin/env python3
"""Prints IndependentElementaryFunctions.h: 2^x and log2(x) to 100 bits, in sums of two doubles (mpmath)."""

import random

from mpmath import log, mp, mpf

mp.dps = 60
random.seed(1)


def table(name, function, arguments):
    print(f"inline constexpr ElementaryValue {name}[] = {{")
    for x in arguments:
        exact = function(mpf(x))
        value = float(exact)
        print(f"    {{{float(x).hex()}, {value.hex()}, {float(exact - mpf(value)).hex()}}},")
    print("};\n")


print("""#pragma once

// Made by independent_elementary_functions.py.

namespace pendular::independent
{

/// f(argument) = value + remainder, to 100 bits.
struct ElementaryValue
{
    double argument;
    double value;
    double remainder;
};
""")
table("exponential2", lambda x: mpf(2) ** x,
      [-1021.99, -745.5, -100.25, -1.0 / 3, -0.5, -1e-9, -2.0**-54, 0.0,
       1e-300, 1e-9, 0.1, 0.5, 2.0 / 3, 1.1, 100.7, 1023.999]
      + [random.uniform(-1000, 1000) for _ in range(24)]
      + [random.uniform(-1, 1) for _ in range(24)])
table("logarithm2", lambda x: log(x, 2),
      [2.0**-1074, 2.0**-1022, 1e-300, 1e-9, 0.1, 0.5**0.5, 2.0**0.5, 0.9, 1 - 2.0**-53, 1 - 1e-9,
       1 + 2.0**-52, 1 + 1e-9, 1.1, 2.0, 3.0, 1e300, float.fromhex("0x1.fffffffffffffp1023")]
      + [2.0 ** random.uniform(-1000, 1000) for _ in range(24)]
      + [random.uniform(0.6, 1.6) for _ in range(24)])
print("} // namespace pendular::independent")
