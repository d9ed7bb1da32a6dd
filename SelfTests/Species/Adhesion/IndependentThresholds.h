#pragma once

// Written by independent_thresholds.py; not by hand, and not from the code it tests: bisection, at 50 digits,
// of the formulae printed in Bagheri, Roy, Poeschel (capillary bridge forces in MercuryDPM, Appendix A).
// Intervals of V* = V/R^3 within [1e-12, 10] in which a fit fails, for each contact angle; 1e-12 or 10 as an
// end means that the interval may go on. An angle that does not occur in an array has no such interval.

#include <array>
#include <limits>

namespace pendular::independent {

struct VolumeInterval {
    int contactAngle;  // degrees
    double from, to;   // V*, rounded to 7 digits
};

// Bagheri: where each failure begins, going up in volume from the usable middle; infinity where not below 10.
struct BagheriFailure {
    int contactAngle;                           // degrees
    double pole, negativeCTheta, noAttraction;  // V*, rounded to 7 digits
};

// Classical Willett: f4 > 0 or f3 < 0 (the union of the next two).
inline constexpr std::array<VolumeInterval, 14> classicalUnusable = {{
    {0, 1.000000e-12, 2.099955e-08},
    {0, 1.369545e+00, 1.000000e+01},
    {10, 1.000000e-12, 1.110144e-07},
    {10, 1.239652e+00, 1.000000e+01},
    {20, 1.000000e-12, 2.709856e-07},
    {20, 1.975329e+00, 1.000000e+01},
    {30, 1.000000e-12, 3.323062e-07},
    {30, 6.192306e+00, 1.000000e+01},
    {40, 1.000000e-12, 3.001134e-07},
    {50, 1.000000e-12, 3.720206e-07},
    {60, 1.000000e-12, 4.281083e-07},
    {70, 1.000000e-12, 4.632014e-07},
    {80, 1.000000e-12, 4.734835e-07},
    {90, 1.000000e-12, 4.564584e-07},
}};

// Classical Willett: f4 > 0; the force tends to 0 as S -> 0.
inline constexpr std::array<VolumeInterval, 10> classicalF4Positive = {{
    {0, 1.000000e-12, 1.102034e-08},
    {0, 1.369545e+00, 1.000000e+01},
    {10, 1.000000e-12, 1.110144e-07},
    {10, 1.239652e+00, 1.000000e+01},
    {20, 1.000000e-12, 2.709856e-07},
    {20, 1.975329e+00, 1.000000e+01},
    {30, 1.000000e-12, 3.323062e-07},
    {30, 6.192306e+00, 1.000000e+01},
    {40, 1.000000e-12, 2.200342e-07},
    {50, 1.000000e-12, 4.496940e-08},
}};

// Classical Willett: f3 < 0.
inline constexpr std::array<VolumeInterval, 10> classicalF3Negative = {{
    {0, 1.000000e-12, 2.099955e-08},
    {10, 1.000000e-12, 6.833779e-08},
    {20, 1.000000e-12, 1.382825e-07},
    {30, 1.000000e-12, 2.192283e-07},
    {40, 1.000000e-12, 3.001134e-07},
    {50, 1.000000e-12, 3.720206e-07},
    {60, 1.000000e-12, 4.281083e-07},
    {70, 1.000000e-12, 4.632014e-07},
    {80, 1.000000e-12, 4.734835e-07},
    {90, 1.000000e-12, 4.564584e-07},
}};

// Bagheri: the denominator has a zero in 0 <= S* <= 1.
inline constexpr std::array<VolumeInterval, 11> bagheriPole = {{
    {20, 3.880158e+00, 1.000000e+01},
    {30, 2.048817e+00, 1.000000e+01},
    {40, 1.180971e+00, 1.000000e+01},
    {50, 6.352798e-01, 1.000000e+01},
    {60, 2.769204e-01, 1.000000e+01},
    {70, 1.000000e-12, 6.559021e-12},
    {70, 8.567456e-02, 1.000000e+01},
    {80, 1.000000e-12, 4.587246e-11},
    {80, 2.147307e-02, 1.000000e+01},
    {90, 1.000000e-12, 1.940398e-10},
    {90, 6.160351e-03, 1.000000e+01},
}};

// Bagheri: c_theta < 0; the force grows with the separation.
inline constexpr std::array<VolumeInterval, 12> bagheriCThetaNegative = {{
    {10, 4.567563e+00, 1.000000e+01},
    {20, 2.118022e+00, 1.000000e+01},
    {30, 1.267607e+00, 1.000000e+01},
    {40, 7.713564e-01, 1.000000e+01},
    {50, 4.233262e-01, 1.000000e+01},
    {60, 1.863036e-01, 1.000000e+01},
    {70, 1.000000e-12, 6.560523e-12},
    {70, 6.080058e-02, 1.000000e+01},
    {80, 1.000000e-12, 4.588767e-11},
    {80, 1.708979e-02, 1.000000e+01},
    {90, 1.000000e-12, 1.941227e-10},
    {90, 5.379523e-03, 1.000000e+01},
}};

// Bagheri: F0* <= 0.
inline constexpr std::array<VolumeInterval, 4> bagheriNoAttraction = {{
    {60, 5.371807e+00, 1.000000e+01},
    {70, 1.739009e+00, 1.000000e+01},
    {80, 7.614232e-01, 1.000000e+01},
    {90, 5.590299e-01, 1.000000e+01},
}};

inline constexpr double never = std::numeric_limits<double>::infinity();

inline constexpr std::array<BagheriFailure, 10> bagheriFirstFailures = {{
    {0, never, never, never},
    {10, never, 4.567563e+00, never},
    {20, 3.880158e+00, 2.118022e+00, never},
    {30, 2.048817e+00, 1.267607e+00, never},
    {40, 1.180971e+00, 7.713564e-01, never},
    {50, 6.352798e-01, 4.233262e-01, never},
    {60, 2.769204e-01, 1.863036e-01, 5.371807e+00},
    {70, 8.567456e-02, 6.080058e-02, 1.739009e+00},
    {80, 2.147307e-02, 1.708979e-02, 7.614232e-01},
    {90, 6.160351e-03, 5.379523e-03, 5.590299e-01},
}};

}  // namespace pendular::independent
