#include "Tools/Studies/LatticeBoltzmann/Bridge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Species/Field.h"

namespace pendular::lattice {

using std::numbers::pi;

namespace {

/// In units of R: half of the gap's height at a distance from the axis.
double halfHeight(double gap, double distance) {
    return 0.5 * gap + 1 - std::sqrt(std::max(0.0, 1 - distance * distance));
}

/// The radius of the cylinder that has the volume between the spheres, in R: by halving.
double cylinderRadius(const BridgeCase& bridge) {
    const auto volumeWithin = [&](double radius) {
        constexpr int rings = 400;
        double sum = 0;
        for (int k = 0; k < rings; ++k) {
            const double middle = (k + 0.5) * radius / rings;
            sum += 4 * pi * middle * halfHeight(bridge.gap, middle) * radius / rings;
        }
        return sum;
    };
    double low = 0, high = 2;
    for (int k = 0; k < 50; ++k) {
        const double middle = 0.5 * (low + high);
        (volumeWithin(middle) < 4 * pi / 3 * bridge.volume ? low : high) = middle;
    }
    return low;
}

constexpr std::array allMirrored{Sides::Mirrored, Sides::Mirrored, Sides::Mirrored};

double sphereVolume(double radius) { return 4 * pi / 3 * radius * radius * radius; }

double midLevel(const Densities& liquid, const Densities& other) { return 0.5 * (liquid[0] + other[0]); }

Node lastNode(const TwoFluids& fluids) {
    const Node& nodes = fluids.grid().box().nodes;
    return {nodes[0] - 1, nodes[1] - 1, nodes[2] - 1};
}

double degrees(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / pi; }

}  // namespace

TwoFluids beginBridge(const BridgeCase& bridge) {
    checkValue("bridge", "radius", bridge.radius, "nodes", {4, 200});
    checkValue("bridge", "gap", bridge.gap, "R", {0, 2});
    checkValue("bridge", "volume", bridge.volume, "of a sphere", {0.001, 1});
    checkValue("bridge", "wetting", bridge.wetting, "", {-0.3, 0.3});
    const double r = bridge.radius, width = cylinderRadius(bridge) * r;
    const int across = static_cast<int>(std::ceil(1.6 * r)),
              along = static_cast<int>(std::ceil((0.5 * bridge.gap + 2.8) * r));
    return {{{across, across, along}, allMirrored},
            {sphere({0, 0, (0.5 * bridge.gap + 1) * r}, r, bridge.wetting)},
            bridge.fluid,
            [=](const Vector<double>& place) {
                const double distance = std::hypot(place.x, place.y);
                const bool isBesideSphere = place.z < (0.5 * bridge.gap + 1) * r;
                return phaseAt(isBesideSphere ? distance - width : place.z);
            }};
}

BridgeState measure(TwoFluids& fluids, const BridgeCase& bridge, const TensionLine& line) {
    const Densities liquid = fluids.densityAt({0, 0, 0}), other = fluids.densityAt(lastNode(fluids));
    BridgeState state{};
    state.liquid = liquid[0], state.other = other[1];
    state.tension = line.at(0.5 * (liquid[0] + other[1]));
    state.volume = 8 * volumeAbove(fluids, midLevel(liquid, other)) / sphereVolume(bridge.radius);
    const double unit = state.tension * bridge.radius;
    state.speed = fluids.largestSpeed();
    for (const bool isSecond : {false, true}) {
        if (isSecond) fluids.step();
        state.force -= 2 * fluids.solidForces()[0].sum().z / unit;
        state.thrust -= 2 * (fluids.thrustThroughSide(2, false) - fluids.thrustThroughSide(2, true)) / unit;
    }
    state.capillaryNumber =
        state.speed * (state.liquid * (2 * fluids.settings().relaxation - 1) / 6) / state.tension;
    return state;
}

namespace {

/// Multiplies the first component in the liquid, and takes as much of the second one outside.
void addLiquid(TwoFluids& fluids, double level, double share, double volume) {
    double rest = -volume;
    fluids.grid().forEachNode([&](const Node& node) { rest += fluids.solidAt(node) < 0 ? 1 : 0; });
    fluids.scale([&](const Node& node) -> Densities {
        return fluids.densityAt(node)[0] > level ? Densities{1 + share, 1}
                                                 : Densities{1, 1 - share * volume / rest};
    });
}

}  // namespace

std::size_t pour(TwoFluids& fluids, const BridgeCase& bridge, double tolerance, std::size_t limit) {
    const double wanted = bridge.volume * sphereVolume(bridge.radius) / 8;
    constexpr std::size_t window = 500;
    std::size_t done = 0;
    for (int within = 0; within < 4 && done < limit / 2; done += window) {
        fluids.steps(window);
        const double level = midLevel(fluids.densityAt({0, 0, 0}), fluids.densityAt(lastNode(fluids)));
        const double volume = volumeAbove(fluids, level), lack = wanted / volume - 1;
        within = std::abs(lack) < tolerance ? within + 1 : 0;
        if (within == 0) addLiquid(fluids, level, lack, volume);
    }
    const auto force = [&] { return fluids.solidForces()[0].sum().z; };
    return done + settle(fluids, force, 1e-5 * std::abs(force()), window, limit - done);
}

double angleOnPlane(double wetting, double dropRadius, const FluidSettings& settings) {
    const int width = static_cast<int>(2.8 * dropRadius), height = static_cast<int>(4 * dropRadius);
    const Solid bottom = halfSpace({0, 1, 0}, {0, -1, 0}, wetting);
    const Solid top = halfSpace({0, height - 1.0, 0}, {0, 1, 0}, 0);
    TwoFluids fluids(
        {{width, height, 1}, {Sides::Mirrored, Sides::Periodic, Sides::Periodic}}, {bottom, top}, settings,
        [&](const Vector<double>& place) { return phaseAt(std::hypot(place.x, place.y - 1) - dropRadius); });
    const auto fit = [&] {
        const double level =
            midLevel(fluids.densityAt({0, 1, 0}), fluids.densityAt({width - 1, height - 2, 0}));
        std::vector<Vector<double>> points = crossings(fluids, level);
        std::erase_if(points, [](const Vector<double>& point) { return point.y < 7; });
        const FittedCircle circle = fitOnLine(points, {0, 1, 0.5}, {0, 1, 0});
        return degrees(-circle.along / circle.radius);
    };
    settle(fluids, fit, 0.02, 1000, 60000);
    return fit();
}

double angleOnSphere(double wetting, double radius, const FluidSettings& settings) {
    const int across = static_cast<int>(1.6 * radius), along = static_cast<int>(3.6 * radius);
    const Vector<double> centre{0, 0, 0.9 * radius};
    const double drop = 0.9 * radius;
    // A drop whose centre is above the pole.
    TwoFluids fluids({{across, across, along}, allMirrored}, {sphere(centre, radius, wetting)}, settings,
                     [&](const Vector<double>& place) {
                         return phaseAt(norm(place - centre - Vector<double>{0, 0, radius}) - drop);
                     });
    const auto fit = [&] {
        const int pole = static_cast<int>(centre.z + radius) + 2;
        const double level = midLevel(fluids.densityAt({0, 0, pole}), fluids.densityAt(lastNode(fluids)));
        std::vector<Vector<double>> points = crossings(fluids, level);
        std::erase_if(points, [&](const Vector<double>& point) { return norm(point - centre) < radius + 6; });
        const FittedCircle circle = fitOnLine(points, centre, {0, 0, 1});
        return degrees((radius * radius + circle.radius * circle.radius - circle.along * circle.along) /
                       (2 * radius * circle.radius));
    };
    settle(fluids, fit, 0.1, 1000, 20000);
    return fit();
}

}  // namespace pendular::lattice
