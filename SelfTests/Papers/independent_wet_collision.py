#!/usr/bin/python3
"""Head-on wet collision of the paper's smaller pair, integrated at 30 digits.

Scene: Bagheri, Roy, Poeschel (capillary bridge forces in MercuryDPM), Table 1 and Figure 3a. The bridge forms
at first contact, pulls with F(0) while the spheres overlap and with F(S) beyond, up to the rupture distance.
Contact: the series of independent_collisions.py with F(0) as constant attraction. Beyond: energy is
conserved, so speeds follow from the work of the bridge, and times from one more quadrature.
Usage: python3 independent_wet_collision.py | clang-format > IndependentWetCollision.h   (Debian: python3-mpmath)
"""
import sys
from pathlib import Path
from mpmath import findroot, inf, mp, mpf, pi, quad, sqrt

SPECIES = Path(__file__).resolve().parent.parent / "Species"
sys.path += [str(SPECIES / "Adhesion"), str(SPECIES / "Normal")]
from independent_bridge_forces import bagheri_coefficients, effective_radius, forces, rupture_distance
from independent_collisions import collide, exact, hertz_stiffness, reduced_mass

mp.dps = 30
R1, R2, VOLUME, ANGLE, TENSION = SCENE = exact(("0.0005", "0.0008", "1e-11", 0, "0.079"))
YOUNG, POISSON, DENSITY, RESTITUTION = exact((5e6, "0.35", 2000, "0.86"))
MASS = reduced_mass(R1, R2, DENSITY)
STIFFNESS = hertz_stiffness(R1, R2, YOUNG, POISSON)
RUPTURE = rupture_distance(R1, R2, VOLUME, ANGLE)
F0, A, B, C = bagheri_coefficients(VOLUME / effective_radius(R1, R2)**3, ANGLE)
CONTACT_FORCE = 2 * pi * effective_radius(R1, R2) * TENSION * F0


def force(separation):
    x = separation / RUPTURE
    return CONTACT_FORCE * (1 + A * x) / (1 + C * A * B * x + C * B * x**2)


def work(start, end):
    return quad(force, [start, (start + end) / 2, end])


def first_contact(speed):
    return collide(speed, MASS, STIFFNESS, RESTITUTION, CONTACT_FORCE)


def after_contact(speed):
    """Farthest separation; time from the end of contact, work and remaining speed until then."""
    energy = MASS / 2 * speed**2
    if energy > work(0, RUPTURE):
        speed_at = lambda separation: sqrt(2 / MASS * (energy - work(0, separation)))
        time = quad(lambda separation: 1 / speed_at(separation), [0, RUPTURE / 4, RUPTURE])
        return RUPTURE, time, work(0, RUPTURE), speed_at(RUPTURE)
    turn = findroot(lambda end: work(0, end) / energy - 1, (0, RUPTURE), solver="anderson", tol=mpf("1e-40"))
    # S = turn (1 - u^2) takes the inverse square root at the turning point out of the integrand.
    mean_force = lambda u: quad(lambda part: force(turn * (1 - u**2 * part)), [0, 1])
    return turn, quad(lambda u: sqrt(2 * MASS * turn / mean_force(u)), [0, 1]), energy, mpf(0)


def collision(speed):
    contact = first_contact(speed)
    separation, flight, taken, left = after_contact(contact.rebound)
    balance = MASS / 2 * (speed**2 - left**2) - taken - contact.dissipated
    assert abs(balance) < mpf("1e-20") * taken
    return [contact.time, contact.overlap, contact.rebound, contact.dissipated, separation,
            contact.time + flight, taken, left, inf if left else contact.time + 2 * flight]


HEADER = """#pragma once

// Written by independent_wet_collision.py; not by hand, and not from the code it tests. Head-on collision of
// two spheres with damped Hertz contact and Bagheri's bridge (Bagheri, Roy, Poeschel, capillary bridge forces
// in MercuryDPM, Table 1 and Figure 3a), no gravity. The bridge forms at first contact, pulls with F(0) while
// the spheres overlap and with F(S) beyond, up to the rupture distance. Integrated at 30 digits, rounded to
// 12. At 0.1 m/s each, the pair stays bound: rupture would take more work than the whole kinetic energy. The
// faster collisions are there to see a rupture.

#include <array>
#include <limits>

namespace pendular::independent
{

struct WetCollision
{
    double speed;              // m/s, relative, before
    double contactTime;        // s, from first contact to the end of the first overlap
    double largestOverlap;     // m
    double speedAfterContact;  // m/s, relative, at the end of the first overlap
    double dissipated;         // J, in the first overlap
    double farthestSeparation; // m: where the bridge ruptures, or where the pair turns back
    double farthestTime;       // s, from first contact until then
    double bridgeWork;         // J, taken from the motion until then; during the overlap it is zero in total
    double speedLeft;          // m/s, relative, at that moment; zero where the pair turns back
    double secondContactTime;  // s, from first contact; infinite if the bridge ruptures
};
"""

if __name__ == "__main__":
    for separation in (mpf(0), RUPTURE / 3, RUPTURE):
        assert abs(forces(*SCENE, separation)[2] / force(separation) - 1) < mpf("1e-25")
    total = work(0, RUPTURE)
    slowest = findroot(lambda speed: MASS / 2 * first_contact(speed).rebound**2 / total - 1,
                       (mpf("0.25"), mpf("0.32")), solver="anderson", tol=mpf("1e-30"))
    constants = [
        ("radius1", R1, "m"), ("radius2", R2, "m"), ("youngModulus", YOUNG, "Pa"),
        ("poissonRatio", POISSON, ""), ("density", DENSITY, "kg/m^3"),
        ("restitution", RESTITUTION, "of the dry contact"), ("volume", VOLUME, "m^3"),
        ("contactAngle", ANGLE, "rad"), ("surfaceTension", TENSION, "N/m"),
        ("reducedMass", MASS, "kg"), ("contactForce", CONTACT_FORCE, "N, of the bridge at S = 0"),
        ("ruptureDistance", RUPTURE, "m"), ("ruptureWork", total, "J, the integral of F(S) up to rupture"),
        ("restingOverlap", (CONTACT_FORCE / STIFFNESS)**(mpf(2) / 3), "m, where a bound pair comes to rest"),
        ("slowestRupture", slowest, "m/s, relative: the bridge ruptures above it")]
    print(HEADER + "\nnamespace wetCollisionScene\n{")
    for name, number, unit in constants:
        print(f"inline constexpr double {name} = {float(number):.12g};" + (f" // {unit}" if unit else ""))
    print("} // namespace wetCollisionScene\n")
    print("inline constexpr double neverAgain = std::numeric_limits<double>::infinity();\n")
    print("inline constexpr std::array<WetCollision, 4> wetCollisions = {{")
    for speed in exact(("0.2", "0.3", "0.4", "1")):
        numbers = ["neverAgain" if x == inf else f"{float(x):.11e}" for x in collision(speed)]
        print(f"    {{{float(speed):g}, {', '.join(numbers[:4])},\n     {', '.join(numbers[4:])}}},")
    print("}};\n\n} // namespace pendular::independent")
