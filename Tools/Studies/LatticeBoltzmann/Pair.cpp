#include "Tools/Studies/LatticeBoltzmann/Pair.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Laws/Concepts/Field.h"

namespace pendular::lattice {

namespace {

/// Fluid below, above and beside the spheres, nodes.
constexpr double margin = 9;

/// Where the centres are, when the spheres have parted by so much.
std::array<double, 2> centres(const PairCase& pair, double parted = 0) {
    const double lower = margin + 0.5 * pair.room + pair.radius[0];
    return {lower - 0.5 * parted, lower + pair.radius[0] + pair.gap + pair.radius[1] + 0.5 * parted};
}

/// @param speed nodes a step, of one sphere against the other
std::vector<Solid> spheres(const PairCase& pair, double parted = 0, double speed = 0) {
    std::vector<Solid> solids;
    for (std::size_t k = 0; k < 2; ++k) {
        solids.push_back(sphere({0, 0, centres(pair, parted)[k]}, pair.radius[k], pair.wetting[k]));
        solids.back().velocity = {0, 0, (k == 0 ? -0.5 : 0.5) * speed};
    }
    return solids;
}

/// Half way between the spheres: the middle of the gap stays where it is.
double middle(const PairCase& pair) { return centres(pair)[0] + pair.radius[0] + 0.5 * pair.gap; }

Probes probesOf(const TwoFluids& fluids, const PairCase& pair) {
    return {{0, 0, static_cast<int>(middle(pair))}, lastNode(fluids)};
}

/// nodes^2: what is denser than the level in the plane of each height, with the corners of the liquid's
/// surface counted as volumeAbove() does.
std::vector<double> areas(const TwoFluids& fluids, double level) {
    std::vector<double> found(static_cast<std::size_t>(fluids.grid().box().nodes[2]), 0);
    forEachVolumeAbove(fluids, level, [&](const Node& node, double volume) {
        found[static_cast<std::size_t>(node[2])] += volume;
    });
    return found;
}

}  // namespace

TwoFluids beginPair(const PairCase& pair) {
    for (const double radius : pair.radius) checkValue("pair", "radius", radius, "nodes", {4, 200});
    for (const double wetting : pair.wetting) checkValue("pair", "wetting", wetting, "", {-0.3, 0.3});
    checkValue("pair", "gap", pair.gap, "nodes", {0, 400});
    checkValue("pair", "volume", pair.volume, "nodes^3", {10, 1e8});
    const double width = cylinderBetween(pair.radius, pair.gap, pair.volume);
    const auto [low, high] = centres(pair);
    const double mean = 0.5 * (pair.radius[0] + pair.radius[1]);
    const Contents contents = contentsAt(0.047 * pair.pressure / mean);
    const int across = static_cast<int>(std::ceil(std::max(pair.radius[0], pair.radius[1]) + margin)),
              along = static_cast<int>(std::ceil(high + pair.radius[1] + 0.5 * pair.room + margin));
    return {{{across, across, along}, {Sides::Mirrored, Sides::Mirrored, Sides::Mirrored}},
            spheres(pair),
            pair.fluid,
            [=](const Vector<double>& place) {
                const bool isBetween = place.z > low && place.z < high;
                return phaseAt(isBetween ? std::hypot(place.x, place.y) - width : 10, contents);
            }};
}

std::size_t pour(TwoFluids& fluids, const PairCase& pair, double tolerance, std::size_t limit) {
    const auto force = [&] { return Vector<double>{0, 0, fluids.solidForces()[0].sum().z}; };
    return bringToRest(fluids, probesOf(fluids, pair), {0.25 * pair.volume, tolerance, pair.radius[0], force},
                       limit);
}

PairState measure(TwoFluids& fluids, const PairCase& pair, const TensionLine& line) {
    const Probes probes = probesOf(fluids, pair);
    PairState state{};
    state.liquid = fluids.densityAt(probes.liquid)[0], state.other = fluids.densityAt(probes.other)[1];
    state.tension = line.at(0.5 * (state.liquid + state.other));
    state.volume = 4 * volumeAbove(fluids, midLevel(fluids, probes));
    const Vector<double> mean = meanOver(fluids, 500, [&] {
        const std::vector<SolidForce> forces = fluids.solidForces();
        return Vector<double>{forces[0].sum().z, forces[1].sum().z, 0};
    });
    state.force = {4 * mean.x, -4 * mean.y};
    return state;
}

namespace {

/// The height, in nodes, at which the liquid is thinnest between the spheres, and its area there.
std::pair<std::size_t, double> neck(const std::vector<double>& found, const PairCase& pair, double parted) {
    const auto begin = static_cast<std::size_t>(centres(pair, parted)[0] + pair.radius[0]) + 1,
               end = static_cast<std::size_t>(centres(pair, parted)[1] - pair.radius[1]);
    const auto least = std::min_element(found.begin() + static_cast<std::ptrdiff_t>(begin),
                                        found.begin() + static_cast<std::ptrdiff_t>(end));
    return {static_cast<std::size_t>(least - found.begin()), *least};
}

}  // namespace

PartingEnd part(TwoFluids& fluids, const PairCase& pair, const Parting& parting, const TensionLine& line,
                const std::function<void(const PartingRow&)>& note) {
    checkValue("parting", "speed", parting.speed, "nodes a step", {1e-6, 0.1});
    const Probes probes = probesOf(fluids, pair);
    const double level = midLevel(fluids, probes);  // of the bridge at rest
    const double tension =
        line.at(0.5 * (fluids.densityAt(probes.liquid)[0] + fluids.densityAt(probes.other)[1]));
    const Densities mass = fluids.mass();
    constexpr double stride = 0.1;  // nodes
    const auto steps = static_cast<std::size_t>(std::max(1.0, std::round(stride / parting.speed)));
    PartingEnd end{std::nan(""), {0, 0}, 0};
    for (double parted = 0; parted < pair.room;) {
        parted += static_cast<double>(steps) * parting.speed;
        end.corrected += std::abs(fluids.moveSolids(spheres(pair, parted, parting.speed), mass)[0]) / mass[0];
        fluids.steps(steps);
        const std::vector<SolidForce> forces = fluids.solidForces();
        const std::vector<double> found = areas(fluids, level);
        double volume = 0;
        for (const double area : found) volume += 4 * area;
        note(
            {pair.gap + parted, volume, {4 * forces[0].sum().z / tension, -4 * forces[1].sum().z / tension}});
        const auto [height, area] = neck(found, pair, parted);
        if (area > 0) continue;
        end.gap = pair.gap + parted;
        for (std::size_t k = 0; k < found.size(); ++k) end.share[k < height ? 0 : 1] += 4 * found[k] / volume;
        break;
    }
    return end;
}

}  // namespace pendular::lattice
