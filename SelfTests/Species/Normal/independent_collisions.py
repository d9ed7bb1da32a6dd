#!/usr/bin/python3
"""Head-on collisions of two spheres under the damped Hertz law, integrated at 30 digits.

m d'' = -k d^(3/2) - beta sqrt(m k) d^(1/4) d' + A, with d the overlap, m and R the reduced mass and radius,
k = 4/3 E* sqrt(R), E* = E/(2 (1 - nu^2)), beta = sqrt(5) |ln e|/sqrt(ln^2 e + pi^2) and A a constant
attraction (0 here), kept until d = 0. Source: Thornton et al., Recent advances in MercuryDPM, where E* lacks
the square of nu.

With d = s^4 and dt = 4 s^3 dz the right-hand sides become polynomials, also at first and last contact, where
the law itself has fractional powers: a Taylor series of order 30 then gives every digit. Checked below by
another way: u = d^(5/4) with dt = d^(-1/4) dp turns the law without attraction into a linear oscillator.
Usage: python3 independent_collisions.py > IndependentCollisions.h   (Debian: python3-mpmath)
"""
import sys
from collections import namedtuple
from mpmath import atan2, exp, gamma, log, mp, mpf, pi, polyval, quad, sin, sqrt

mp.dps = 30
ORDER = 30
Material = namedtuple("Material", "radius1 radius2 young poisson density speed")
Contact = namedtuple("Contact", "rebound time overlap dissipated")  # m/s, s, m, J


def exact(numbers):
    return [mpf(str(number)) for number in numbers]


def reduced_mass(r1, r2, density):
    m1, m2 = (4 * pi / 3 * r**3 * density for r in (r1, r2))
    return m1 * m2 / (m1 + m2)


def hertz_stiffness(r1, r2, young, poisson):
    return mpf(4) / 3 * young / (2 * (1 - poisson**2)) * sqrt(r1 * r2 / (r1 + r2))


def damping_ratio(e):
    return sqrt(mpf(5)) * abs(log(e)) / sqrt(log(e)**2 + pi**2)


def taylor(s0, v0, k, c, a):
    """Series in z of s, v = d', t and w = the integral of c d^(1/4) v^2 dt; k, c, a are per unit mass."""
    s, v, t, w = [s0], [v0], [mpf(0)], [mpf(0)]
    s2, s3, s4, s7, s9, s4v, s4vv = ([] for _ in range(7))
    for n in range(ORDER):
        for product, x, y in ((s2, s, s), (s3, s2, s), (s4, s2, s2), (s7, s4, s3), (s9, s7, s2), (s4v, s4, v),
                              (s4vv, s4v, v)):
            product.append(sum(x[i] * y[n - i] for i in range(n + 1)))
        s.append(v[n] / (n + 1))
        v.append(4 * (-k * s9[n] - c * s4v[n] + a * s3[n]) / (n + 1))
        t.append(4 * s3[n] / (n + 1))
        w.append(4 * c * s4vv[n] / (n + 1))
    return s, v, t, w


def value(series, z):
    return polyval(series[::-1], z)


def root(series, high):
    """The sign change in (0, high], the series being positive before it."""
    low = mpf(0)
    while high - low > mpf("1e-28") * high:
        middle = (low + high) / 2
        low, high = (middle, high) if value(series, middle) > 0 else (low, middle)
    return high


def collide(speed, mass, stiffness, e, attraction=mpf(0)):
    k, c, a = stiffness / mass, damping_ratio(e) * sqrt(stiffness / mass), attraction / mass
    s, v, time, work, overlap = mpf(0), speed, mpf(0), mpf(0), None
    while True:
        series = taylor(s, v, k, c, a)
        # Up to eleven successive terms vanish at s = 0, hence a window of twelve.
        step = min((mpf("1e-28") * scale / abs(x[n]))**(mpf(1) / n)
                   for x, scale in zip(series, (mpf("0.01"), speed))
                   for n in range(ORDER - 11, ORDER + 1) if x[n])
        if v > 0 and value(series[1], step) <= 0:
            overlap = value(series[0], root(series[1], step))**4
        ended = s > 0 and value(series[0], step) <= 0
        if ended:
            step = root(series[0], step)
        s, v, elapsed, loss = (value(x, step) for x in series)
        time, work = time + elapsed, work + loss
        if ended:
            return Contact(-v, time, overlap, mass * work)


def oscillator(speed, mass, stiffness, e):
    """Rebound speed, contact time and largest overlap from the linear oscillator."""
    k, c = stiffness / mass, damping_ratio(e) * sqrt(stiffness / mass)
    omega = sqrt(5 * k / 4 - c**2 / 4)
    u = lambda phase: mpf(5) / 4 * speed / omega * exp(-c * phase / (2 * omega)) * sin(phase)
    time = quad(lambda phase: u(phase)**(-mpf(1) / 5), [0, pi / 2, pi]) / omega
    return speed * exp(-c * pi / (2 * omega)), time, u(atan2(2 * omega, c))**(mpf(4) / 5)


MATERIALS = {"soft": Material(*exact(("0.0005", "0.0008", 5e6, "0.35", 2000, "0.1"))),
             "glass": Material(*exact(("0.0025", "0.0025", 70e9, "0.25", 2500, 1)))}
RESTITUTIONS = [f"0.{digits}" for digits in "1 2 3 4 5 6 7 8 9 95 99".split()]

HEADER = """#pragma once

// Written by independent_collisions.py; not by hand, and not from the code it tests. Head-on collision of two
// spheres of one material under the damped Hertz law (Thornton et al., Recent advances in MercuryDPM), with
// E* = E/(2 (1 - nu^2)), damping kept until the overlap is zero, no gravity. Integrated at 30 digits, rounded
// to 12. The restitution measured from the integrated velocities is the one put in, to better than 1e-25.

#include <array>

namespace pendular::independent
{

struct Collision
{
    double radius1, radius2; // m
    double youngModulus;     // Pa
    double poissonRatio;
    double density;          // kg/m^3
    double speed;            // m/s, relative, before
    double restitution;      // put in
    double rebound;          // m/s, relative, after
    double contactTime;      // s
    double largestOverlap;   // m
};
"""


def print_rows(name, comment, rows):
    print(f"// {comment}\ninline constexpr std::array<Collision, {len(rows)}> {name} = {{{{")
    for inputs, results in rows:
        print("    {" + ", ".join(f"{float(x):g}" for x in inputs) + ",\n     "
              + ", ".join(f"{float(x):.11e}" for x in results) + "},")
    print("}};\n")


if __name__ == "__main__":
    damped, elastic, deviation, disagreement = [], [], mpf(0), mpf(0)
    for material in MATERIALS.values():
        r1, r2, young, poisson, density, speed = material
        mass, stiffness = reduced_mass(r1, r2, density), hertz_stiffness(r1, r2, young, poisson)
        for e in exact(RESTITUTIONS):
            contact = collide(speed, mass, stiffness, e)
            deviation = max(deviation, abs(contact.rebound / (e * speed) - 1))
            other = oscillator(speed, mass, stiffness, e)
            disagreement = max(disagreement, *(abs(x / y - 1) for x, y in zip(contact, other)))
            lost = mass / 2 * (speed**2 - contact.rebound**2)
            disagreement = max(disagreement, abs(contact.dissipated / lost - 1))
            damped.append(((*material, e), contact[:3]))
        overlap = (5 * mass * speed**2 / (4 * stiffness))**(mpf(2) / 5)
        time = 4 * sqrt(pi) * gamma(mpf(2) / 5) / (5 * gamma(mpf(9) / 10)) * overlap / speed
        contact = collide(speed, mass, stiffness, mpf(1))
        disagreement = max(disagreement, *(abs(x / y - 1) for x, y in zip(contact, (speed, time, overlap))))
        elastic.append(((*material, mpf(1)), (speed, time, overlap)))
    print(f"restitution - 1: {float(deviation):.1e}; series against closed forms: {float(disagreement):.1e}",
          file=sys.stderr)
    assert max(deviation, disagreement) < mpf("1e-25")
    print(HEADER)
    print_rows("dampedCollisions", "Damped.", damped)
    print_rows("elasticCollisions",
               "Elastic, from the closed forms: d_max = (15 m v^2/(16 E* sqrt(R)))^(2/5)\n"
               "// and t = 4 sqrt(pi) Gamma(2/5)/(5 Gamma(9/10)) d_max/v = 2.94... d_max/v.", elastic)
    print("} // namespace pendular::independent")
