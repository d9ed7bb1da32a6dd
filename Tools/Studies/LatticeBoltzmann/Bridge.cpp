#include "Tools/Studies/LatticeBoltzmann/Bridge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Concepts/Field.h"

namespace pendular::lattice {

using std::numbers::pi;

namespace {

constexpr std::array allMirrored{Sides::Mirrored, Sides::Mirrored, Sides::Mirrored};

double sphereVolume(double radius) { return 4 * pi / 3 * radius * radius * radius; }

/// How many of the box make up the whole, and where the axis is along x.
double copies(const BridgeCase& bridge) { return bridge.start > 0 ? 4 : 8; }
double axisAt(const BridgeCase& bridge) { return bridge.start > 0 ? std::ceil(1.5 * bridge.radius) : 0; }

/// The centre of what is more of the first component than far away, along x in the row through the axis in
/// the mid plane, nodes.
double centreOfLiquid(const TwoFluids& fluids) {
    double sum = 0, moment = 0;
    const double outside = fluids.densityAt(lastNode(fluids))[0];
    for (int i = 0; i < fluids.grid().box().nodes[0]; ++i) {
        const double more = fluids.densityAt({i, 0, 0})[0] - outside;
        sum += more, moment += more * (i + 0.5);
    }
    return moment / sum;
}

Probes probesOf(const TwoFluids& fluids, const BridgeCase& bridge) {
    const int inside = bridge.start > 0 ? static_cast<int>(centreOfLiquid(fluids)) : 0;
    return {{inside, 0, 0}, lastNode(fluids)};
}

double degrees(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / pi; }

}  // namespace

TwoFluids beginBridge(const BridgeCase& bridge) {
    checkValue("bridge", "radius", bridge.radius, "nodes", {4, 200});
    checkValue("bridge", "gap", bridge.gap, "R", {0, 2});
    checkValue("bridge", "volume", bridge.volume, "of a sphere", {0.001, 1});
    checkValue("bridge", "wetting", bridge.wetting, "", {-0.3, 0.3});
    checkValue("bridge", "start", bridge.start, "R", {0, 1});
    const double r = bridge.radius, gap = bridge.gap * r, start = bridge.start * r, axis = axisAt(bridge);
    const double width = cylinderBetween({r, r}, gap, bridge.volume * sphereVolume(r));
    const int across = static_cast<int>(std::ceil(1.6 * r)),
              along = static_cast<int>(std::ceil(0.5 * gap + 2.8 * r));
    const Contents contents = contentsAt(0.047 * bridge.pressure / r);
    const int slip = start > 0 ? static_cast<int>(axis + std::ceil(2.2 * r)) : across;
    return {{{slip, across, along}, allMirrored},
            {sphere({axis, 0, 0.5 * gap + r}, r, bridge.wetting)},
            bridge.fluid,
            [=](const Vector<double>& place) {
                const double distance = std::hypot(place.x - axis - start, place.y);
                return phaseAt(place.z < 0.5 * gap + r ? distance - width : place.z, contents);
            }};
}

BridgeState measure(TwoFluids& fluids, const BridgeCase& bridge, const TensionLine& line) {
    const Probes probes = probesOf(fluids, bridge);
    BridgeState state{};
    state.liquid = fluids.densityAt(probes.liquid)[0], state.other = fluids.densityAt(probes.other)[1];
    state.tension = line.at(0.5 * (state.liquid + state.other));
    state.volume =
        copies(bridge) * volumeAbove(fluids, midLevel(fluids, probes)) / sphereVolume(bridge.radius);
    double area = 0;
    forEachVolumeAbove(fluids, midLevel(fluids, probes),
                       [&](const Node& node, double share) { area += node[2] == 0 ? share : 0; });
    state.waist = std::sqrt(0.5 * copies(bridge) * area / pi) / bridge.radius;
    state.offAxis = bridge.start > 0 ? (centreOfLiquid(fluids) - axisAt(bridge)) / bridge.radius : 0;
    const double unit = state.tension * bridge.radius, ofSphere = 0.5 * copies(bridge);
    state.speed = fluids.largestSpeed();
    const auto both = [&] {
        return Vector<double>{fluids.solidForces()[0].sum().z, fluids.thrustThroughSide(2, false),
                              fluids.thrustThroughSide(2, true)};
    };
    const Vector<double> mean = meanOver(fluids, 500, both);
    state.force = -ofSphere / unit * mean.x;
    state.thrust = -ofSphere / unit * (mean.y - mean.z);
    state.capillaryNumber = state.speed * state.liquid * viscosity / state.tension;
    return state;
}

std::size_t pour(TwoFluids& fluids, const BridgeCase& bridge, double tolerance, std::size_t limit) {
    const double wanted = bridge.volume * sphereVolume(bridge.radius) / copies(bridge);
    const auto force = [&] { return Vector<double>{0, 0, fluids.solidForces()[0].sum().z}; };
    return bringToRest(fluids, probesOf(fluids, bridge), {wanted, tolerance, bridge.radius, force}, limit);
}

double angleOnPlane(double wetting, double dropRadius, const FluidSettings& settings) {
    const int width = static_cast<int>(2.8 * dropRadius), height = static_cast<int>(4 * dropRadius);
    const Solid bottom = halfSpace({0, 1, 0}, {0, -1, 0}, wetting);
    const Solid top = halfSpace({0, height - 1.0, 0}, {0, 1, 0}, 0);
    TwoFluids fluids(
        {{width, height, 1}, {Sides::Mirrored, Sides::Periodic, Sides::Periodic}}, {bottom, top}, settings,
        [&](const Vector<double>& place) { return phaseAt(std::hypot(place.x, place.y - 1) - dropRadius); });
    const auto fit = [&] {
        const double level = midLevel(fluids, {{0, 1, 0}, {width - 1, height - 2, 0}});
        std::vector<Vector<double>> points = crossings(fluids, level);
        std::erase_if(points, [](const Vector<double>& point) { return point.y < 7; });
        const FittedCircle circle = fitOnLine(points, {0, 1, 0.5}, {0, 1, 0});
        return degrees(-circle.along / circle.radius);
    };
    settle(fluids, fit, 0.02, 1000, 60000);
    return fit();
}

DropOnSphere dropOnSphere(double wetting, double radius, double drop, const FluidSettings& settings) {
    const int across = static_cast<int>(1.6 * radius), along = static_cast<int>(3.6 * radius);
    // The pole lies half way between nodes: the surface is there, and not up to half a node off.
    const Vector<double> centre{0, 0, std::round(1.9 * radius) - radius};
    const Contents contents = contentsAt(0.047 * 2 / (drop * radius));
    TwoFluids fluids(
        {{across, across, along}, allMirrored}, {sphere(centre, radius, wetting)}, settings,
        [&](const Vector<double>& place) {
            return phaseAt(norm(place - centre - Vector<double>{0, 0, radius}) - drop * radius, contents);
        });
    const auto fit = [&] {
        const int pole = static_cast<int>(centre.z + radius) + 2;
        const double level = midLevel(fluids, {{0, 0, pole}, lastNode(fluids)});
        std::vector<Vector<double>> points = crossings(fluids, level);
        std::erase_if(points, [&](const Vector<double>& point) { return norm(point - centre) < radius + 6; });
        const FittedCircle circle = fitOnLine(points, centre, {0, 0, 1});
        const double square = radius * radius, gap = circle.along, other = circle.radius;
        return DropOnSphere{degrees((square + other * other - gap * gap) / (2 * radius * other)),
                            degrees((square + gap * gap - other * other) / (2 * radius * gap))};
    };
    settle(
        fluids, [&] { return fit().angle; }, 0.1, 1000, 20000);
    return fit();
}

}  // namespace pendular::lattice
