#pragma once

#include <algorithm>

#include "Drivers/Shared/Beverloo.h"
#include "Drivers/Shared/GrainLattice.h"
#include "Drivers/Shared/GrainRows.h"
#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Simulation/Simulation.h"
#include "Kernel/Species/Laws.h"
#include "Kernel/Walls/AxisymmetricWall.h"

namespace pendular {

/// A cylindrical hopper with a flat bottom at z = 0, and the grains in it.
struct Hopper {
    double diameter = 0.045;       // m
    double grainDiameter = 0.002;  // m, the mean; radii are spread evenly by 10 % to either side
    std::size_t number = 9000;     // of grains
    double youngModulus = 5e6;     // Pa
    double friction = 0.5;         // of grains and walls

    static constexpr double gravity = 9.8;   // m/s^2
    static constexpr double density = 2500;  // kg/m^3
    static constexpr double poissonRatio = 0.3;
    static constexpr double restitution = 0.5;
    static constexpr double spread = 0.1;  // of the radii, so that the grains do not form a crystal
};

/// Grains that leave a hopper through a circular orifice in its middle. A grain that has fallen two of the
/// mean diameters below the orifice is counted and removed.
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
        AxisymmetricWall wall;
        wall.setSpecies(material);
        wall.set(Vec3D::UnitZ(), Vec3D::Zero(),
                 {{0.5 * orifice, 0}, {0.5 * hopper.diameter, 0}, {0.5 * hopper.diameter, 2 * top}});
        wallHandler.copyAndAddObject(wall);
        setGravity({0, 0, -Hopper::gravity});
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 15));
    }

    void actionsAfterTimeStep() override {
        // The store is read itself, because this looks at all grains in every step.
        const ParticleStore& grains = particleHandler.store();
        std::vector<std::uint32_t> gone;
        for (const std::uint32_t at : grains.place)
            if (grains.translation[at].position.z < -2 * hopper.grainDiameter)
                gone.push_back(grains.identity[at]);
        for (const std::uint32_t identity : gone) {
            mass += particleHandler.getObject(identity).getMass();
            particleHandler.removeObject(identity);
        }
        number += gone.size();
    }

    void writeOutput() override {
        if (curve) curve->push_back({getTime(), mass});
    }

    void visitState(StateArchive& archive) override {
        archive.same("orifice", orificeDiameter, "m");
        archive.value("mass", mass);
        archive.value("number", number);
        if (curve) archive.column<double>("curve", *curve);
    }

    /// Appends the time (s) and the mass that has left (kg) whenever output is due.
    void keepCurve(std::vector<CurvePoint>* points) { curve = points; }
    /// kg, of the grains that have left.
    [[nodiscard]] double dischargedMass() const { return mass; }
    [[nodiscard]] std::size_t dischargedNumber() const { return number; }
    /// kg/m^3, between a quarter and three quarters of the height of the highest grain.
    [[nodiscard]] double bulkDensity() {
        double height = 0, sum = 0;
        for (const GrainReference grain : particleHandler) height = std::max(height, grain.getPosition().z());
        for (const GrainReference grain : particleHandler)
            if (std::abs(grain.getPosition().z() - 0.5 * height) < 0.25 * height) sum += grain.getMass();
        return sum / (0.25 * std::numbers::pi * hopper.diameter * hopper.diameter * 0.5 * height);
    }

private:
    using Material = HertzianViscoelasticMindlinSpecies;

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
    double mass = 0;  // kg, of the grains that have left
    std::size_t number = 0;
};

/// Grains that have fallen into the closed hopper from a loose lattice, for three times the time in which a
/// stone falls through it.
/// @param next names of the runs that follow, whose earlier restart files are removed when this one begins
inline std::vector<GrainRow> settledHopperGrains(const Hopper& hopper, const RunOptions& options = {},
                                                 const std::vector<std::string>& next = {}) {
    checkValue("HopperScene", "grain diameter", hopper.grainDiameter, "m", positive);
    checkValue("HopperScene", "hopper diameter", hopper.diameter, "m",
               {3 * hopper.grainDiameter, infinity, true, false});
    const double radius = 0.5 * hopper.diameter;
    const double edge = (1 + Hopper::spread) * latticeLooseness * hopper.grainDiameter;
    const auto fits = [&](const Vec3D& c) { return std::hypot(c.x(), c.y()) + 0.5 * edge <= radius; };
    // Before any of them is made.
    const double across = std::max(hopper.diameter - edge, 0.0) / edge,
                 inLayer = 0.25 * std::numbers::pi * across * across;
    constexpr double most = 1e6;  // cells: they take some 50 MB
    if (!(inLayer <= std::max(most, static_cast<double>(hopper.number))))
        throw InputError(
            fmt::format("HopperScene: one layer of grains of {:g} m in a hopper of {:g} m would be about "
                        "{:.2g} grains; it "
                        "must be at most {:g}, or the number of grains, {}.",
                        hopper.grainDiameter, hopper.diameter, inLayer, most, hopper.number));
    const auto inBox = [&](double height) {
        return latticeCells({-radius, -radius, 0}, {radius, radius, height}, edge, fits);
    };
    const auto perLayer = static_cast<double>(inBox(edge).size());
    const double height = edge * (std::ceil(static_cast<double>(hopper.number) / perLayer) + 0.5);
    const std::vector<Vec3D> cells = inBox(height);
    UniformRandom random(1);
    std::vector<GrainRow> loose;
    for (std::size_t k = 0; k < hopper.number; ++k) {
        const double size =
            0.5 * hopper.grainDiameter * random.uniform(1 - Hopper::spread, 1 + Hopper::spread);
        loose.push_back(jittered(size, cells[k], random));
    }
    HopperScene scene(hopper, loose, 0);
    options.apply(scene, "settling");
    options.forgetAtStart(scene, next);
    scene.setTimeMax(3 * std::sqrt(2 * height / Hopper::gravity));
    scene.solve();
    return grainRows(scene.particleHandler);
}

/// How a hopper was emptied through one orifice.
struct Discharge {
    double orifice;                 // diameter, m
    double bulkDensity;             // kg/m^3, at the start
    std::vector<CurvePoint> curve;  // x: time, s; y: mass that has left, kg
    double flow;                    // kg/s, the slope of the line through the steady part of the curve
    double change;                  // of the flow from the first half of the steady part to the second, of 1
};

/// Of the run through one orifice, what its files begin with.
inline std::string dischargeName(double orifice) { return fmt::format("orifice-{:g}", orifice); }

/// Lets grains out of a hopper.
/// @param begin s, of the steady part; @param end s, of the run; @param interval s, between points
inline Discharge discharge(const Hopper& hopper, std::span<const GrainRow> grains, double orifice,
                           double begin, double end, double interval, const RunOptions& options = {}) {
    HopperScene scene(hopper, grains, orifice);
    Discharge result{orifice, scene.bulkDensity(), {}, 0, 0};
    checkValue("HopperScene", "bulk density", result.bulkDensity, "kg/m^3", positive);
    scene.keepCurve(&result.curve);
    options.apply(scene, dischargeName(orifice));
    scene.setTimeMax(end);
    scene.setSaveCount(stepsOf(interval, scene.getTimeStep()));
    scene.solve();
    // A run that was resumed may have gone on to a later end.
    std::erase_if(result.curve, [&](const CurvePoint& p) { return p.x > end + scene.getTimeStep(); });

    const auto after = [&](double time) {
        return std::find_if(result.curve.begin(), result.curve.end(),
                            [&](const CurvePoint& p) { return p.x >= time; });
    };
    const auto first = after(begin), middle = after(0.5 * (begin + end)), last = result.curve.end();
    result.flow = fitLine({first, last}).slope;
    if (!(result.flow > 0))
        throw InputError(fmt::format(
            "HopperScene: no grain left the orifice of {:g} m from {:g} s to {:g} s; take one that is wider "
            "than five grain diameters, or a later end.",
            orifice, begin, end));
    result.change = (fitLine({middle, last}).slope - fitLine({first, middle}).slope) / result.flow;
    return result;
}

}  // namespace pendular
