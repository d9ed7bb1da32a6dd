#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <vector>

#include "Drivers/Shared/Beverloo.h"
#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/RigidBodies/ClumpTemplate.h"
#include "Kernel/Features/RigidBodies/MovingBodies.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Scene/SuperquadricSimulation.h"

namespace pendular {

/// A cylindrical hopper with a flat bottom at z = 0, and what fills it: spheres, clumps of two spheres,
/// ellipsoids and rounded blocks, of the volume of spheres of diameter d.
struct MixedHopper {
    double diameter = 0.04;                                // m
    double size = 0.004;                                   // m, d
    std::size_t number = 400;                              // bodies
    std::array<double, 4> shares{0.25, 0.25, 0.25, 0.25};  // of the number, of the four shapes
    double youngModulus = 5e6;                             // Pa
    double friction = 0.5;                                 // of grains and walls
    std::uint64_t seed = 1;

    static constexpr double gravity = 9.81;  // m/s^2
    static constexpr double density = 2500;  // kg/m^3
    static constexpr double spread = 0.1;    // of the sizes to either side
    static constexpr double speed = 0.5;     // m/s, with which bodies come in

    [[nodiscard]] double area() const { return 0.25 * std::numbers::pi * diameter * diameter; }  // m^2
    /// m^3, of a mean body
    [[nodiscard]] double meanVolume() const {
        return std::numbers::pi / 6 * size * size * size * (1 + spread * spread);
    }
    /// m, of a filling of solid fraction 0.5
    [[nodiscard]] double filling() const {
        return static_cast<double>(number) * meanVolume() / (0.5 * area());
    }
    /// bodies/s: a stream of half the solid fraction that an inlet may have.
    [[nodiscard]] double inflow() const { return 0.5 * Inlet::densestStream * speed * area() / meanVolume(); }
    /// s, until all have come and have settled
    [[nodiscard]] double fillingTime() const {
        return static_cast<double>(number) / inflow() + 3 * std::sqrt(4 * filling() / gravity);
    }
};

/// Bodies come in above a closed orifice; later it is opened, and what falls below it is counted and removed.
class MixedHopperScene : public SuperquadricSimulation<HertzianViscoelasticMindlinSpecies> {
public:
    /// @param orifice diameter, m; @param interval s, between two points of the curve
    MixedHopperScene(const MixedHopper& given, double orifice, double interval)
        : hopper(given), orificeDiameter(orifice), pointInterval(interval) {
        checkValue("MixedHopper", "orifice diameter", orifice, "m", {0, hopper.diameter, false, false});
        const Material* const material = speciesHandler.copyAndAddObject(makeMaterial());
        const double radius = 0.5 * hopper.diameter, hole = 0.5 * orifice, top = 2.5 * hopper.filling();
        addWall(material, {{hole, 0}, {radius, 0}, {radius, 1.5 * top}});
        lid = addWall(material, {{0, 0}, {hole, 0}});
        addInlet(material, top);
        Outlet below;
        below.setPlane(-Vec3D::UnitZ(), {0, 0, -4 * hopper.size});
        outletHandler.copyAndAddObject(below);
        setGravity({0, 0, -MixedHopper::gravity});
        setTimeStep(stabilityLimit());
        setAdaptiveTimeStep(0.9, shortestContactTime() / 15);
    }

    void actionsBeforeTimeStep() override {
        if (isOpen || getTime() < hopper.fillingTime()) return;
        gather();  // on several ranks: for the density, and before walls are changed
        density = bulkDensity();
        wallHandler.removeObject(lid);
        isOpen = true;
    }
    [[nodiscard]] bool continueSolve() const override { return !isOpen || particleHandler.getSize() > 0; }
    void actionsAfterTimeStep() override {
        const double time = getTime() - hopper.fillingTime();
        if (isOpen && time >= static_cast<double>(curve.size()) * pointInterval)
            curve.push_back({time, outletHandler.removedMass()});
    }
    void visitState(StateArchive& archive) override {
        archive.same("orifice", orificeDiameter, "m");
        archive.value("isOpen", isOpen);
        archive.value("bulkDensity", density);
        archive.column<double>("curve", curve);
    }

    /// x: time since the orifice is open, s; y: mass that has left, kg.
    [[nodiscard]] const std::vector<CurvePoint>& getCurve() const { return curve; }
    /// kg/m^3, when the orifice was opened, from 2 d above the bottom to three quarters of the highest body
    [[nodiscard]] double getBulkDensity() const { return density; }

private:
    using Material = HertzianViscoelasticMindlinSpecies;

    /// A surface of revolution of plane facets about z. @param profile radius and height of its rings, m
    std::size_t addWall(const Material* material, const std::vector<std::array<double, 2>>& profile) {
        constexpr int facets = 48;
        std::vector<Triangle> triangles;
        const auto at = [&](const std::array<double, 2>& ring, int k) {
            const double angle = 2 * std::numbers::pi * k / facets;
            return Vector<double>{ring[0] * std::cos(angle), ring[0] * std::sin(angle), ring[1]};
        };
        for (std::size_t s = 0; s + 1 < profile.size(); ++s)
            for (int k = 0; k < facets; ++k) {
                const auto a = at(profile[s], k), b = at(profile[s], (k + 1) % facets),
                           c = at(profile[s + 1], k), d = at(profile[s + 1], (k + 1) % facets);
                if (profile[s][0] > 0) triangles.push_back({a, b, c});
                triangles.push_back({b, d, c});
            }
        TriangleWall wall;
        wall.set(triangles);
        wall.setSpecies(material);
        wallHandler.copyAndAddObject(wall);
        return wallHandler.getSize() - 1;
    }

    void addInlet(const Material* material, double top) {
        const double d = hopper.size;
        const SizeDistribution sizes =
            evenSizes((1 - MixedHopper::spread) * d, (1 + MixedHopper::spread) * d);
        const Vec3D down(0, 0, -MixedHopper::speed);
        const auto prepared = [&](auto one) {
            one.setSpecies(material);
            one.setVelocity(down);
            return one;
        };
        BodyMixture mixture;
        const auto& [spheres, clumps, ellipsoids, blocks] = hopper.shares;
        if (spheres > 0) mixture.add(prepared(SphericalParticle()), sizes, spheres);
        if (clumps > 0)
            mixture.add(prepared(Clump(ClumpTemplate({{{-0.5, 0, 0}, 1}, {{0.5, 0, 0}, 1}}))), sizes, clumps);
        if (ellipsoids > 0) mixture.add(prepared(SuperquadricGrain({1.5, 1, 0.75, 2, 2})), sizes, ellipsoids);
        if (blocks > 0) mixture.add(prepared(SuperquadricGrain({1, 1, 1, 5, 5})), sizes, blocks);
        Inlet inlet;
        inlet.setRegion(CylinderRegion({0, 0, top}, {0, 0, top + 4 * d}, 0.5 * hopper.diameter));
        inlet.setBodies(mixture);
        inlet.setNumberFlow(hopper.inflow());
        inlet.setTimes(0, static_cast<double>(hopper.number) / hopper.inflow());
        inlet.setSeed(hopper.seed);
        inletHandler.copyAndAddObject(inlet);
    }

    [[nodiscard]] double bulkDensity() {
        const double low = 2 * hopper.size;
        double highest = 0, mass = 0;  // m, kg
        forEachMovingBody(particleHandler.store(),
                          [&](double, const Vector<double>& place, const Vector<double>&) {
                              highest = std::max(highest, place.z);
                          });
        const double high = 0.75 * highest;
        forEachMovingBody(particleHandler.store(),
                          [&](double own, const Vector<double>& place, const Vector<double>&) {
                              if (place.z > low && place.z < high) mass += own;
                          });
        return high > low ? mass / (hopper.area() * (high - low)) : 0;
    }

    Material makeMaterial() const {
        Material material;
        material.setDensity(MixedHopper::density);
        material.setElasticModulusAndPoissonRatio(hopper.youngModulus, 0.3);
        material.setEffectiveShearModulus(computeEffectiveShearModulus(hopper.youngModulus, 0.3));
        material.setRestitutionCoefficient(0.5);
        material.setSlidingFrictionCoefficient(hopper.friction);
        return material;
    }

    MixedHopper hopper;
    double orificeDiameter;  // m
    double pointInterval;    // s
    std::size_t lid;         // its number in wallHandler
    bool isOpen = false;
    double density = 0;  // kg/m^3
    std::vector<CurvePoint> curve;
};

}  // namespace pendular
