#include "Kernel/Features/LiquidBridges/YoungLaplace/WettedBody.h"

namespace pendular {

Cap BodyContact::cap(const ArcEnd& end, int side) const {
    const double u = end.point.squaredRadius, inverse = 1 / std::sqrt(u);
    const double cosine = cosineOfFilling(end.point, side) * inverse;
    // Two forms of (1 - cos beta)/curvature: the first keeps a plane's 0 exact, the second holds beyond 90
    // degrees.
    const bool shallow = cosine > 0;
    const double share = 1 / (1 + cosine);
    const double height = shallow ? curvature * u * share : (1 - cosine) / curvature;
    const double byU = shallow ? curvature * share : 0;
    const double byCosine = shallow ? -curvature * u * share * share : -1 / curvature;
    const double square = height * height;
    Cap cap{.height = height,
            .volumeOverPi = height * (3 * u + square) / 6,
            .areaOverPi = u + square,
            .heightGradient = {},
            .volumeGradient = {}};
    for (int j = 0; j < 4; ++j) {
        const double cosineSlope =
            inverse * (sineOfAngle * end.axialPart[j] + side * cosineOfAngle * end.radialPart[j] -
                       0.5 * cosine * inverse * end.squaredRadius[j]);
        cap.heightGradient[j] = byU * end.squaredRadius[j] + byCosine * cosineSlope;
        cap.volumeGradient[j] = 0.5 * ((u + square) * cap.heightGradient[j] + height * end.squaredRadius[j]);
    }
    return cap;
}

}  // namespace pendular
