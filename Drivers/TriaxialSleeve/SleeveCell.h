#pragma once

#include <algorithm>
#include <cmath>

#include "Drivers/Shared/StressCell.h"
#include "Kernel/Core/Walls/InfiniteWall.h"
#include "Kernel/Features/Insertion/Insertion.h"
#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"

namespace pendular {

struct SleeveOptions {
    std::size_t number = 1000;
    double friction = 0.3, inertialNumber = 2e-3;
    double stiffness = 1e3;      // of a contact, over pressure x diameter
    double sleeveStiffness = 1;  // E t, over pressure x diameter of a grain
    double strain = 0.15, interval = 0.002;
    RunOptions run{.output = "TriaxialSleeve-output"};
};

/// Grains in a sleeve, twice as high as wide, between two planes. The sleeve is held at the planes, and its
/// rims keep their radius; a pressure from outside acts on it. The upper plane is pressed with the same
/// pressure by a servo, until it is told a velocity.
class SleeveCell : public StressCell {
public:
    void setupInitialConditions() override {
        addMaterial(options.stiffness * pressure * diameter, 0.6, options.friction);
        addPlaten({0, 0, -1}, 0);
        upper = addPlaten({0, 0, 1}, height0());
        addSleeve();
        addGrains();  // also of a run that goes on: the step is chosen for them
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25));
        upper->setTargetForce(pressure * rimArea(), servoTime(), 2 * rate() * height0());
        setInterval(options.interval / rate(), 20);
    }

protected:
    static constexpr double pressure = 1000;  // Pa

    SleeveCell(const SleeveOptions& given, const std::string& columns)
        : StressCell(given.run, columns), options(given) {}

    /// 1/s; the inertial number is rate x diameter x sqrt(density / pressure).
    [[nodiscard]] double rate() const {
        return options.inertialNumber / (diameter * std::sqrt(density / pressure));
    }
    [[nodiscard]] double compressionTime() const { return 0.1 / rate(); }  // s
    [[nodiscard]] double height() const { return upper->pointOnPlane().z; }
    /// m^3, between the platens. The sleeve's net counts the cones from a corner of its lower rim, which lie
    /// in that plane and above; those to the upper platen, height x area / 3, are what it lacks.
    [[nodiscard]] double volume() const override { return sleeve->getVolume() + rimHeight() * rimArea() / 3; }
    /// Pa, of the hoops of a sleeve whose mean radius has grown: E t strain / R.
    /// @param area m^2, the mean cross-section
    [[nodiscard]] double sleevePull(double area) const {
        const double ratio = std::sqrt(area / rimArea());
        return youngsModulus() * thickness * (ratio - 1) / (radius() * ratio);
    }
    /// The upper rim is where the platen was when the last step ended; it goes there as fast as that takes.
    void followPlaten() {
        const double at = rimHeight(), speed = (height() - at) / getTimeStep();
        const double rim2 = std::pow((1 - 1e-9) * radius(), 2);
        sleeve->hold(
            [&](const Vec3D& x) {
                return std::abs(x.z() - at) < 1e-9 * at && x.x() * x.x() + x.y() * x.y() > rim2;
            },
            {0, 0, speed});
    }

    SleeveOptions options;
    InfiniteWall* upper = nullptr;
    Membrane* sleeve = nullptr;

private:
    static constexpr double thickness = 3e-4, sleeveDensity = 1000;  // m, kg/m^3
    static constexpr double damping = 1000;                          // 1/s, of the sleeve
    static constexpr double startFraction = 0.50;  // of the volume, that grains have before they are pressed

    [[nodiscard]] double youngsModulus() const {
        return options.sleeveStiffness * pressure * diameter / thickness;
    }
    /// m; volume 4 pi R^3 with the mean volume of diameters that are uniform from 0.9 to 1.
    [[nodiscard]] double radius() const {
        const double meanCube = (1 - std::pow(0.9, 4)) / 0.4 * std::pow(diameter, 3);
        return std::cbrt(double(options.number) * meanCube / 24 / startFraction);
    }
    [[nodiscard]] double height0() const { return 4 * radius(); }
    /// s, twice that in which sound passes the cell, at diameter x sqrt(stiffness / mass).
    [[nodiscard]] double servoTime() const {
        const double mass = density * constants::pi / 6 * std::pow(diameter, 3);
        return 2 * height0() / diameter * std::sqrt(mass / (options.stiffness * pressure * diameter));
    }
    /// Edges about as long as a grain is wide.
    [[nodiscard]] int around() const {
        return std::max(16, int(std::lround(2 * constants::pi * radius() / diameter)));
    }
    [[nodiscard]] double rimArea() const {  // m^2
        return 0.5 * around() * radius() * radius() * std::sin(2 * constants::pi / around());
    }
    [[nodiscard]] double rimHeight() const { return sleeve->getPosition(cornerAbove).z(); }

    InfiniteWall* addPlaten(const Vec3D& normal, double z) {
        InfiniteWall platen;
        platen.setSpecies(speciesHandler.getObject(0));
        platen.set(normal, {0, 0, z});
        platen.keepForces();
        return wallHandler.copyAndAddObject(platen);
    }
    void addSleeve() {
        Membrane tube;
        tube.set(membraneTube(radius(), height0(), around()),
                 {.youngsModulus = youngsModulus(), .thickness = thickness, .density = sleeveDensity});
        tube.setSpecies(speciesHandler.getObject(0));
        tube.holdRim();
        tube.setPressure(-pressure);
        tube.setDamping(damping);
        const auto& corners = tube.getNet().vertices();
        cornerAbove =
            std::size_t(std::ranges::max_element(corners, {}, &Vector<double>::z) - corners.begin());
        sleeve = wallHandler.copyAndAddObject(tube);
    }
    void addGrains() {
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        // Within the flat faces of the sleeve.
        const CylinderRegion inside({0, 0, 0}, {0, 0, height0()},
                                    radius() * std::cos(constants::pi / around()));
        insert(evenSizes(0.9 * diameter, diameter), inside, Amount::grains(options.number), grain);
    }

    std::size_t cornerAbove = 0;  // a vertex at the upper rim
};

}  // namespace pendular
