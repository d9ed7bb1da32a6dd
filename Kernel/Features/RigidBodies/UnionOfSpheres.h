#pragma once

#include <span>
#include <vector>

#include "Kernel/Features/RigidBodies/MassProperties.h"

namespace pendular {

/// Volume, centre and inertia of the space that is in at least one of the spheres, each point counted once.
///
/// Planes across the longest side cut it to unions of discs, whose area and moments are line integrals over
/// the arcs that no other disc covers (Green's theorem), in closed form. Between the planes in which the
/// number of arcs can change (poles of the spheres, ends of the circles in which they cut each other) these
/// are smooth but for the corners at which three spheres meet; Gauss-Legendre rules of 8 and 16 nodes
/// integrate them, on halved intervals until the two agree. The sum of the absolute differences of the two
/// is given as the error: a bound, as the rule of 16 nodes is the better one. Spheres that do not hang
/// together are integrated group by group, each about its own middle, and added up; the work is bounded
/// (HalvedIntervals.h).
///
/// Throws InputError without spheres, or where a centre or a radius is not finite and positive.
/// @param tolerance relative, of the volume and of each moment
MassProperties unionOfSpheres(std::span<const Ball> spheres, double tolerance = 1e-10);
/// Enough for the volume of a body whose mass is known otherwise, and found sooner.
inline constexpr double toleranceOfVolume = 1e-6;

/// The area (m^2) of the surface of the union: what exposedShares() has of each sphere.
double surfaceOfUnion(std::span<const Ball> spheres, double tolerance = 1e-8);

/// The share of each sphere's own surface that is in no other one: 0 of a sphere within another one; of two
/// equal spheres the second counts as within the first. In closed form where the caps that the others cut off
/// are apart from each other, else to the tolerance.
std::vector<double> exposedShares(std::span<const Ball> spheres, double tolerance = 1e-8);

}  // namespace pendular
