#pragma once

// Written by independent_wet_collision.py; not by hand, and not from the code it tests. Head-on collision of
// two spheres with damped Hertz contact and Bagheri's bridge (Bagheri, Roy, Poeschel, capillary bridge forces
// in MercuryDPM, Table 1 and Figure 3a), no gravity. The bridge forms at first contact, pulls with F(0) while
// the spheres overlap and with F(S) beyond, up to the rupture distance. Integrated at 30 digits, rounded to
// 12. At 0.1 m/s each, the pair stays bound: rupture would take more work than the whole kinetic energy. The
// faster collisions are there to see a rupture.

#include <array>
#include <limits>

namespace pendular::independent {

struct WetCollision {
    double speed;               // m/s, relative, before
    double contactTime;         // s, from first contact to the end of the first overlap
    double largestOverlap;      // m
    double speedAfterContact;   // m/s, relative, at the end of the first overlap
    double dissipated;          // J, in the first overlap
    double farthestSeparation;  // m: where the bridge ruptures, or where the pair turns back
    double farthestTime;        // s, from first contact until then
    double bridgeWork;          // J, taken from the motion until then; during the overlap it is zero in total
    double speedLeft;           // m/s, relative, at that moment; zero where the pair turns back
    double secondContactTime;   // s, from first contact; infinite if the bridge ruptures
};

namespace wetCollisionScene {
inline constexpr double radius1 = 0.0005;        // m
inline constexpr double radius2 = 0.0008;        // m
inline constexpr double youngModulus = 5000000;  // Pa
inline constexpr double poissonRatio = 0.35;
inline constexpr double density = 2000;                       // kg/m^3
inline constexpr double restitution = 0.86;                   // of the dry contact
inline constexpr double volume = 1e-11;                       // m^3
inline constexpr double contactAngle = 0;                     // rad
inline constexpr double surfaceTension = 0.079;               // N/m
inline constexpr double reducedMass = 8.41703526237e-07;      // kg
inline constexpr double contactForce = 0.000253730011712;     // N, of the bridge at S = 0
inline constexpr double ruptureDistance = 0.000222986050858;  // m
inline constexpr double ruptureWork = 2.50269716092e-08;      // J, the integral of F(S) up to rupture
inline constexpr double restingOverlap = 2.43849161504e-06;   // m, where a bound pair comes to rest
inline constexpr double slowestRupture = 0.287909438806;      // m/s, relative: the bridge ruptures above it
}  // namespace wetCollisionScene

inline constexpr double neverAgain = std::numeric_limits<double>::infinity();

inline constexpr std::array<WetCollision, 4> wetCollisions = {{
    {0.2, 2.05387625876e-04, 1.34353171525e-05, 1.67870464178e-01, 4.97426046817e-09, 5.84473492518e-05,
     9.70835148604e-04, 1.18598100566e-08, 0.00000000000e+00, 1.73628267133e-03},
    {0.3, 1.86560613640e-04, 1.80461428132e-05, 2.54296296056e-01, 1.06616034516e-08, 2.22986050858e-04,
     1.83965599545e-03, 2.50269716092e-08, 7.21053321943e-02, neverAgain},
    {0.4, 1.74855393388e-04, 2.24043761741e-05, 3.40548282203e-01, 1.85287848070e-08, 2.22986050858e-04,
     9.90910093930e-04, 2.50269716092e-08, 2.37709287271e-01, neverAgain},
    {1, 1.43827485249e-04, 4.55915811340e-05, 8.57185735461e-01, 1.11623613627e-07, 2.22986050858e-04,
     4.11187715766e-04, 2.50269716092e-08, 8.21766364498e-01, neverAgain},
}};

}  // namespace pendular::independent
