#pragma once

#include <algorithm>
#include <optional>

#include "Drivers/Shared/GrainRows.h"
#include "Drivers/Shared/MeanFlow.h"
#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Scene/Simulation.h"

namespace pendular {

/// A cylindrical hopper with a flat bottom at z = 0, or with a cone whose tip is there, and the grains in it.
struct Hopper {
    double diameter = 0.045;       // m
    double grainDiameter = 0.002;  // m, the mean; without sizes, diameters are even to 10 % to either side
    std::size_t number = 9000;     // of grains
    double youngModulus = 5e6;     // Pa
    double friction = 0.5;         // of grains and walls
    double coneSlope = 0;          // rad, to the horizontal; 0: a flat bottom
    std::optional<SizeDistribution> sizes{};  // of the grains

    static constexpr double gravity = 9.8;   // m/s^2
    static constexpr double density = 2500;  // kg/m^3
    static constexpr double poissonRatio = 0.3;
    static constexpr double restitution = 0.5;
    static constexpr double spread = 0.1;  // of the diameters, so that the grains do not form a crystal

    [[nodiscard]] SizeDistribution sizesOfGrains() const {
        return sizes ? *sizes : evenSizes((1 - spread) * grainDiameter, (1 + spread) * grainDiameter);
    }
    [[nodiscard]] double area() const { return 0.25 * std::numbers::pi * diameter * diameter; }  // m^2
    /// m, of the bottom at a distance from the axis.
    [[nodiscard]] double heightAt(double radius) const { return std::tan(coneSlope) * radius; }
    /// m^3, of the hopper up to a height (m)
    [[nodiscard]] double volumeBelow(double height) const {
        const double radius = 0.5 * diameter, rim = heightAt(radius);
        if (height >= rim) return std::numbers::pi * radius * radius * (height - 2.0 / 3 * rim);
        const double there = height / std::tan(coneSlope);
        return std::numbers::pi / 3 * there * there * height;
    }
    /// The height above the orifice (m, its diameter) up to which a mass (kg) of this bulk density (kg/m^3)
    /// fills the hopper evenly, over the diameter.
    [[nodiscard]] double headOf(double mass, double bulk, double orifice) const {
        const double hole = heightAt(0.5 * orifice), filled = mass / bulk + volumeBelow(hole);
        double low = 0, high = 1;  // of the height over the diameter of the hopper
        const auto below = [&](double share) { return volumeBelow(hole + share * diameter) < filled; };
        while (below(high) && high < 1e6) high *= 2;
        for (int k = 0; k < 60; ++k) (below(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
        return low * diameter / orifice;
    }
};

/// Grains that leave a hopper through a circular orifice in its middle. A grain that has fallen two of the
/// mean diameters below the orifice is counted and removed; the run ends with the last one.
class HopperScene : public Simulation<HertzianViscoelasticMindlinSpecies> {
public:
    /// @param orifice diameter, m; 0: a closed bottom
    HopperScene(const Hopper& given, std::span<const GrainRow> grains, double orifice)
        : hopper(given), orificeDiameter(orifice) {
        checkValue("HopperScene", "orifice diameter", orifice, "m", {0, hopper.diameter, true, false});
        const Material* material = speciesHandler.copyAndAddObject(makeMaterial());
        double top = 0;
        for (const GrainRow& row : grains) {
            addGrainRow(particleHandler, material, row);
            top = std::max(top, row.position.z() + row.radius);
        }
        build(material, 2 * top);
    }
    /// Closed, and filled at random above the bottom, at half the density of the solid.
    explicit HopperScene(const Hopper& given) : hopper(given), orificeDiameter(0) {
        const Material* material = speciesHandler.copyAndAddObject(makeMaterial());
        const SizeDistribution sizes = hopper.sizesOfGrains();
        const double rim = hopper.heightAt(0.5 * hopper.diameter);
        // A layer more, because walls keep grains from being dense.
        const double height = static_cast<double>(hopper.number) * std::numbers::pi / 6 * sizes.moment(3) /
                                  (0.5 * 0.25 * std::numbers::pi * hopper.diameter * hopper.diameter) +
                              sizes.largest();
        build(material, rim + 2 * height);
        SphericalParticle grain;
        grain.setSpecies(material);
        insert(sizes, CylinderRegion({0, 0, rim}, {0, 0, rim + height}, 0.5 * hopper.diameter),
               Amount::grains(hopper.number), grain);
        chooseTimeStep();
        setTimeMax(3 * std::sqrt(2 * (rim + height) / Hopper::gravity));
    }

    [[nodiscard]] bool continueSolve() const override { return particleHandler.getSize() > 0; }

    void writeOutput() override {
        if (curve) curve->push_back({getTime(), dischargedMass()});
    }

    void visitState(StateArchive& archive) override {
        archive.same("orifice", orificeDiameter, "m");
        if (curve) archive.column<double>("curve", *curve);
    }

    /// Appends the time (s) and the mass that has left (kg) whenever output is due.
    void keepCurve(std::vector<CurvePoint>* points) { curve = points; }
    /// kg, of the grains that have left.
    [[nodiscard]] double dischargedMass() const { return outletHandler.removedMass(); }
    [[nodiscard]] std::size_t dischargedNumber() const { return outletHandler.removedNumber(); }
    /// kg/m^3, between a quarter and three quarters of the height of the highest grain.
    [[nodiscard]] double bulkDensity() {
        double height = 0, sum = 0;
        for (const GrainReference grain : particleHandler) height = std::max(height, grain.getPosition().z());
        for (const GrainReference grain : particleHandler)
            if (std::abs(grain.getPosition().z() - 0.5 * height) < 0.25 * height) sum += grain.getMass();
        return sum / (hopper.volumeBelow(0.75 * height) - hopper.volumeBelow(0.25 * height));
    }

private:
    using Material = HertzianViscoelasticMindlinSpecies;

    /// @param height m, of its wall
    void build(const Material* material, double height) {
        const double radius = 0.5 * hopper.diameter, hole = 0.5 * orificeDiameter;
        AxisymmetricWall wall;
        wall.setSpecies(material);
        wall.set(Vec3D::UnitZ(), Vec3D::Zero(),
                 {{hole, hopper.heightAt(hole)}, {radius, hopper.heightAt(radius)}, {radius, height}});
        wallHandler.copyAndAddObject(wall);
        Outlet below;
        below.setPlane(-Vec3D::UnitZ(), {0, 0, hopper.heightAt(hole) - 2 * hopper.grainDiameter});
        outletHandler.copyAndAddObject(below);
        setGravity({0, 0, -Hopper::gravity});
        if (particleHandler.getSize() > 0) chooseTimeStep();
    }
    void chooseTimeStep() { setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 15)); }

    Material makeMaterial() const {
        Material material;
        material.setDensity(Hopper::density);
        material.setElasticModulusAndPoissonRatio(hopper.youngModulus, Hopper::poissonRatio);
        material.setEffectiveShearModulus(
            computeEffectiveShearModulus(hopper.youngModulus, Hopper::poissonRatio));
        material.setRestitutionCoefficient(Hopper::restitution);
        material.setSlidingFrictionCoefficient(hopper.friction);
        return material;
    }

    Hopper hopper;
    double orificeDiameter;  // m
    std::vector<CurvePoint>* curve = nullptr;
};

/// Grains that have settled in the closed hopper, for three times the time in which a stone falls through it.
/// @param next names of the runs that follow, whose earlier restart files are removed when this one begins
inline std::vector<GrainRow> settledHopperGrains(const Hopper& hopper, const RunOptions& options = {},
                                                 const std::vector<std::string>& next = {}) {
    checkValue("HopperScene", "grain diameter", hopper.grainDiameter, "m", positive);
    checkValue("HopperScene", "hopper diameter", hopper.diameter, "m",
               {3 * hopper.grainDiameter, infinity, true, false});
    checkValue("HopperScene", "slope of the cone", hopper.coneSlope * 180 / std::numbers::pi, "degrees",
               {0, 80});
    // The number of grains is checked before any of them is made.
    const double across = std::max(hopper.diameter - hopper.grainDiameter, 0.0) / hopper.grainDiameter,
                 inLayer = 0.25 * std::numbers::pi * across * across;
    constexpr double most = 1e6;
    if (!(inLayer <= std::max(most, static_cast<double>(hopper.number))))
        throw InputError(
            fmt::format("HopperScene: one layer of grains of {:g} m in a hopper of {:g} m would be about "
                        "{:.2g} grains; it "
                        "must be at most {:g}, or the number of grains, {}.",
                        hopper.grainDiameter, hopper.diameter, inLayer, most, hopper.number));
    HopperScene scene(hopper);
    options.apply(scene, "settling");
    options.forgetAtStart(scene, next);
    scene.solve();
    return grainRows(scene.particleHandler);
}

/// How a hopper was emptied through one orifice.
struct Discharge {
    double orifice;                 // diameter, m
    double bulkDensity;             // kg/m^3, at the start
    std::vector<CurvePoint> curve;  // x: time, s; y: mass that has left, kg
    MeanFlow mean;                  // of the steady part
    std::size_t number;             // of grains that have left
    double change;                  // of the flow from the first half of the steady part to the second, of 1
    double end;                     // s, of the steady part
    double head;                    // m, of what was left then, above the orifice, over its diameter
};

/// Orifice diameters of filling above the orifice, below which the flow falls: da Silva et al. (2025,
/// arXiv 2512.03698) ask for this head where Beverloo's law is to hold.
inline constexpr double leastHead = 2;

/// Lets grains out of a hopper. The steady part ends with the run, or where the head falls below leastHead,
/// if that leaves at least half of it.
/// @param begin s, of the steady part; @param end s, of the run; @param interval s, between points
inline Discharge discharge(const Hopper& hopper, std::span<const GrainRow> grains, double orifice,
                           double begin, double end, double interval, const RunOptions& options = {}) {
    HopperScene scene(hopper, grains, orifice);
    Discharge result{orifice, scene.bulkDensity(), {}, {0, unset}, 0, 0, end, 0};
    double mass = 0;  // kg
    for (const GrainReference grain : scene.particleHandler) mass += grain.getMass();
    checkValue("HopperScene", "bulk density", result.bulkDensity, "kg/m^3", positive);
    scene.keepCurve(&result.curve);
    options.apply(scene, dischargeName(orifice));
    scene.setTimeMax(end);
    scene.setSaveCount(stepsOf(interval, scene.getTimeStep()));
    scene.solve();
    result.number = scene.dischargedNumber();
    // A run that was resumed may have gone on to a later end.
    std::erase_if(result.curve, [&](const CurvePoint& p) { return p.x > end + scene.getTimeStep(); });

    result.end = std::min(end, result.curve.back().x);  // it may have emptied
    if (!(begin < result.end))
        throw InputError(fmt::format(
            "HopperScene: the hopper was empty at {:g} s, before the steady part that starts at {:g} s.",
            result.end, begin));
    const auto headAt = [&](const CurvePoint& p) {
        return hopper.headOf(mass - p.y, result.bulkDensity, orifice);
    };
    const auto low =
        std::ranges::find_if(result.curve, [&](const CurvePoint& p) { return headAt(p) < leastHead; });
    if (low != result.curve.end() && low->x - begin >= 0.5 * (result.end - begin)) result.end = low->x;
    const auto steady = partOf(result.curve, begin, result.end);
    result.mean = meanFlow(steady);  // which refuses fewer than two points
    result.head = headAt(steady.back());
    if (!(result.mean.flow > 0))
        throw InputError(fmt::format(
            "HopperScene: no grain left the orifice of {:g} m from {:g} s to {:g} s; take one that is wider "
            "than five grain diameters, or a later end.",
            orifice, begin, end));
    const std::size_t middle = steady.size() / 2;
    if (middle > 0)
        result.change = (meanFlow(steady.subspan(middle)).flow - meanFlow(steady.first(middle + 1)).flow) /
                        result.mean.flow;
    return result;
}

}  // namespace pendular
