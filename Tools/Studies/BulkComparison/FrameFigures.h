#pragma once

#include <algorithm>
#include <map>

#include "Drivers/Shared/MeanFlow.h"
#include "Tools/Studies/AccuracyVersusCost/BulkFigures.h"
#include "Tools/Studies/BulkComparison/BulkScene.h"

// Figures of a scene from places and velocities alone, which every code can write: the same for all.

namespace pendular::bulk {

/// Contacts and normal forces of grains, from their overlaps.
struct Overlaps {
    double coordination = 0;  // contacts of a free grain with grains
    double virial = 0;        // J, sum of l F over the pairs, by Hertz's law without dashpots
};
inline Overlaps overlapsOf(const BulkScene& scene, const std::vector<PeerGrain>& grains) {
    const double modulus =
        PeerMaterial::elasticModulus / (2 * (1 - PeerMaterial::poissonRatio * PeerMaterial::poissonRatio));
    const Vec3D size = scene.highest - scene.lowest;
    Overlaps found;
    double sides = 0, number = 0;
    for (std::size_t a = 0; a < grains.size(); ++a) {
        const bool isFree = grains[a].kind == GrainKind::Free;
        number += isFree ? 1 : 0;
        for (std::size_t b = a + 1; b < grains.size(); ++b) {
            Vec3D apart = grains[b].position - grains[a].position;
            for (int k = 0; k < 3; ++k)
                if (scene.periodic[static_cast<std::size_t>(k)])
                    apart[k] -= size[k] * std::round(apart[k] / size[k]);
            const double reach = grains[a].radius + grains[b].radius, square = apart.squaredNorm();
            if (!(square < reach * reach)) continue;
            sides += (isFree ? 1 : 0) + (grains[b].kind == GrainKind::Free ? 1 : 0);
            const double distance = std::sqrt(square), overlap = reach - distance,
                         curvature = grains[a].radius * grains[b].radius / reach;
            found.virial += distance * 4.0 / 3 * modulus * std::sqrt(curvature * overlap) * overlap;
        }
    }
    found.coordination = number > 0 ? sides / number : 0;
    return found;
}

/// A named figure of a run.
using Figure = std::pair<std::string, double>;

/// Collects the frames of a run.
class FrameFigures {
public:
    explicit FrameFigures(const BulkScene& given) : scene(given) {
        for (const PeerGrain& grain : scene.grains)
            if (grain.kind == GrainKind::Free) massAtStart += massOf(grain);
        number = scene.grains.size();
    }

    /// @param grains those that have not left
    void add(double time, const std::vector<PeerGrain>& grains) {
        isLost = isLost || (!scene.drains && grains.size() != number);
        double energy = 0, mass = 0;  // J, kg
        for (const PeerGrain& grain : grains) {
            if (!grain.position.allFinite() || !grain.velocity.allFinite()) isLost = true;
            if (grain.kind == GrainKind::Intruder) deepest = std::min(deepest, grain.position.z());
            if (grain.kind != GrainKind::Free) continue;
            energy += 0.5 * massOf(grain) * grain.velocity.squaredNorm();
            if (!scene.drains || grain.position.z() > -PeerMaterial::radius) mass += massOf(grain);
        }
        energies.push_back({time, energy});
        left.push_back({time, massAtStart - mass});
        if (isLost || time < scene.measureFrom - 0.5 * scene.interval) return;
        if (scene.name == "bed") {
            addBed(grains);
            sum("agitation", energy / (massAtStart * PeerMaterial::gravity * 2 * PeerMaterial::radius));
        }
        if (scene.name == "drum") addDrum(grains);
        if (!scene.drains) sum("kinetic_energy_J", energy);
        if (scene.name == "impact") sum("coordination", overlapsOf(scene, grains).coordination);
    }

    [[nodiscard]] bool survived() const {
        return !isLost && !energies.empty() && energies.back().x > scene.endTime - 1.5 * scene.interval;
    }

    /// The figures of a run that survived.
    [[nodiscard]] std::vector<Figure> figures() const {
        std::vector<Figure> found;
        const auto mean = [&](const std::string& name) {
            const auto at = sums.find(name);
            if (at != sums.end()) found.emplace_back(name, at->second.first / at->second.second);
        };
        for (const char* name : {"coordination", "solid_fraction", "mean_stress_Pa", "agitation",
                                 "centre_angle_deg", "surface_angle_deg"})
            mean(name);
        if (scene.name == "bed") found.emplace_back("settling_time_s", settlingTime());
        if (scene.name != "bed") mean("kinetic_energy_J");
        if (scene.drains) {
            std::vector<CurvePoint> steady;
            for (const CurvePoint& p : left)
                if (p.x >= scene.measureFrom) steady.push_back(p);
            found.emplace_back("flow_kg/s", meanFlow(steady).flow);
        }
        if (scene.name == "impact") found.emplace_back("depth_m", scene.grains.back().position.z() - deepest);
        return found;
    }

private:
    static double massOf(const PeerGrain& grain) {
        return 4.0 / 3 * std::numbers::pi * std::pow(grain.radius, 3) * grain.density;
    }
    void sum(const std::string& name, double value) {
        sums[name].first += value;
        sums[name].second += 1;
    }
    /// Adds figures of the middle 60 % of the grains, as in the study of laws, and the stress of all.
    void addBed(const std::vector<PeerGrain>& grains) {
        std::vector<double> heights;
        double moment = 0, mass = 0;  // kg m, kg
        for (const PeerGrain& grain : grains) {
            heights.push_back(grain.position.z());
            moment += massOf(grain) * grain.position.z(), mass += massOf(grain);
        }
        std::sort(heights.begin(), heights.end());
        const double low = heights[heights.size() / 5], high = heights[heights.size() * 4 / 5];
        double solid = 0;  // m^3
        for (const PeerGrain& grain : grains)
            solid += volumeBelow(high, grain.position.z(), grain.radius) -
                     volumeBelow(low, grain.position.z(), grain.radius);
        const Vec3D size = scene.highest - scene.lowest;
        const Overlaps overlaps = overlapsOf(scene, grains);
        sum("coordination", overlaps.coordination);
        sum("solid_fraction", solid / (size.x() * size.y() * (high - low)));
        sum("mean_stress_Pa", overlaps.virial / (3 * size.x() * size.y() * 2 * moment / mass));
    }
    void addDrum(const std::vector<PeerGrain>& grains) {
        std::vector<Vec3D> centres;
        std::vector<double> radii;
        for (const PeerGrain& grain : grains) {
            centres.emplace_back(grain.position.x(), grain.position.z(), grain.position.y());
            radii.push_back(grain.radius);
        }
        sum("centre_angle_deg", centreAngle(centres, radii));
        sum("surface_angle_deg", surfaceAngle(centres, {0.5 * scene.cylinder, 2 * PeerMaterial::radius}));
        sum("coordination", overlapsOf(scene, grains).coordination);
    }
    /// s, until the kinetic energy stays below a thousandth of its largest.
    [[nodiscard]] double settlingTime() const {
        double largest = 0, time = 0;
        for (const CurvePoint& p : energies) largest = std::max(largest, p.y);
        for (const CurvePoint& p : energies)
            if (p.y > 1e-3 * largest) time = p.x;
        return time;
    }

    BulkScene scene;
    double massAtStart = 0;  // kg, of free grains
    std::size_t number = 0;
    double deepest = infinity;  // m, height of the intruder
    bool isLost = false;
    std::vector<CurvePoint> energies, left;  // s; J and kg
    std::map<std::string, std::pair<double, double>> sums;
};

}  // namespace pendular::bulk
