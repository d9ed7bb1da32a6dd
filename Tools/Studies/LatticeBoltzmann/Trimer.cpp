#include "Tools/Studies/LatticeBoltzmann/Trimer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Concepts/Field.h"

namespace pendular::lattice {

namespace {

/// Fluid around the spheres, nodes.
constexpr double margin = 8;

double sphereVolume(const TrimerCase& trimer) {
    return 4 * std::numbers::pi / 3 * trimer.radius * trimer.radius * trimer.radius;
}

Vector<double> firstCentre(const TrimerCase& trimer) { return {0, margin + trimer.radius, 0}; }

/// That of the third one is its image.
Vector<double> secondCentre(const TrimerCase& trimer) {
    const double side = (2 + trimer.gap) * trimer.radius;
    return firstCentre(trimer) + Vector<double>{0.5 * side, 0.5 * std::numbers::sqrt3 * side, 0};
}

Node nodeAt(const Vector<double>& place) {
    return {static_cast<int>(place.x), static_cast<int>(place.y), static_cast<int>(place.z)};
}

/// From the surface of a cylinder between two points; far off beyond its ends.
double distanceFrom(const Vector<double>& place, const Vector<double>& begin, const Vector<double>& end,
                    double radius) {
    const Vector<double> axis = end - begin, from = place - begin;
    const double along = dot(from, axis) / squaredNorm(axis);
    return along < 0 || along > 1 ? 10.0 : norm(from - along * axis) - radius;
}

Probes probesOf(const TwoFluids& fluids, const TrimerCase& trimer) {
    return {nodeAt(0.5 * (firstCentre(trimer) + secondCentre(trimer))), lastNode(fluids)};
}

}  // namespace

TwoFluids beginTrimer(const TrimerCase& trimer) {
    checkValue("trimer", "radius", trimer.radius, "nodes", {4, 200});
    checkValue("trimer", "gap", trimer.gap, "R", {0, 1});
    checkValue("trimer", "volume", trimer.volume, "of a sphere", {0.001, 1});
    checkValue("trimer", "wetting", trimer.wetting, "", {-0.3, 0.3});
    const double r = trimer.radius;
    const double width = cylinderBetween({r, r}, trimer.gap * r,
                                         trimer.volume / (trimer.isClosed ? 3 : 2) * sphereVolume(trimer));
    const Vector<double> first = firstCentre(trimer), second = secondCentre(trimer);
    const auto nodes = [&](double reach) { return static_cast<int>(std::ceil(reach + r + margin)); };
    const Contents contents = contentsAt(0.047 * trimer.pressure / r);
    return {
        {{nodes(second.x), nodes(second.y), nodes(0)}, {Sides::Mirrored, Sides::Mirrored, Sides::Mirrored}},
        {sphere(first, r, trimer.wetting), sphere(second, r, trimer.wetting)},
        trimer.fluid,
        [=](const Vector<double>& place) {
            const Vector<double> third{-second.x, second.y, second.z};
            double distance = distanceFrom(place, first, second, width);
            if (trimer.isClosed) distance = std::min(distance, distanceFrom(place, second, third, width));
            return phaseAt(distance, contents);
        }};
}

TrimerState measure(TwoFluids& fluids, const TrimerCase& trimer, const TensionLine& line) {
    const double r = trimer.radius;
    const Vector<double> mean = meanOver(fluids, 500, [&] {
        const std::vector<SolidForce> forces = fluids.solidForces();
        return Vector<double>{forces[0].sum().y, forces[1].sum().y, 0};
    });
    const Probes probes = probesOf(fluids, trimer);
    const double tension =
        line.at(0.5 * (fluids.densityAt(probes.liquid)[0] + fluids.densityAt(probes.other)[1]));
    const double level = midLevel(fluids, probes);
    TrimerState state{};
    forEachVolumeAbove(fluids, level, [&](const Node& node, double share) {
        state.volume += 4 * share / sphereVolume(trimer);
        if (node[0] == 0) state.section += 2 * share / (r * r);
    });
    const double unit = std::numbers::sqrt3 * tension * r;
    state.pairForce = 4 * mean.x / unit, state.otherPairForce = -4 * mean.y / unit;
    const Vector<double> first = firstCentre(trimer), between{0, secondCentre(trimer).y, 0};
    const auto isLiquid = [&](const Vector<double>& place) {
        return fluids.densityAt(nodeAt(place))[0] > level;
    };
    state.isPocketFull = isLiquid(first + 2.0 / 3 * (between - first));
    state.isThirdGapFull = isLiquid(between);
    return state;
}

std::size_t pour(TwoFluids& fluids, const TrimerCase& trimer, double volume, double tolerance,
                 std::size_t limit) {
    const auto force = [&] { return Vector<double>{0, fluids.solidForces()[0].sum().y, 0}; };
    return bringToRest(fluids, probesOf(fluids, trimer),
                       {0.25 * volume * sphereVolume(trimer), tolerance, trimer.radius, force}, limit);
}

}  // namespace pendular::lattice
