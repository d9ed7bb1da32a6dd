#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "Kernel/Features/Fluid/ColumnFlow.h"
#include "Kernel/Scene/Simulation.h"

namespace pendular {

/// Grains of one size in a column of fluid: case A of the README, 1 mm glass in water.
struct ColumnMaterial {
    double diameter = 1e-3;  // m
    double density = 2500;   // kg/m^3
    FluidMaterial fluid{.density = 998.2, .viscosity = 1.002e-3};
};

/// A chain of grains on the axis of a column. It has the porosity of a bed because the column is just so
/// wide: the area of the column is that of a grain's volume over (1 - porosity) times its diameter. Grains
/// move along the axis only. A cell is four diameters high.
struct ColumnBed : Simulation<LinearViscoelasticSpecies> {
    ColumnMaterial material;
    double porosity = 0.40;  // of the chain at rest, and spread evenly at the start where `spread` is set
    double spread = 0;       // porosity at the start; 0: the chain at rest
    std::size_t cellsOfBed = 10;  // filled by the chain at rest: four grains each
    std::size_t cellsOfColumn = 25;
    std::string law = "Gidaspow";
    PressureModel model = PressureModel::A;
    bool areFixed = false;
    double gravity = 9.81;  // m/s^2

    static constexpr std::size_t grainsOfCell = 4;
    static constexpr double stiffness = 100;  // N/m

    /// m^2, across the column.
    [[nodiscard]] double area() const {
        return std::numbers::pi / 6 * material.diameter * material.diameter / (1 - porosity);
    }
    /// m, from the floor to the top of the chain at rest.
    [[nodiscard]] double heightAtRest() const {
        return material.diameter * static_cast<double>(grainsOfCell * cellsOfBed);
    }

    /// Adds grains, floor and fluid. @param superficialSpeed m/s, up, over the time
    void fill(std::function<double(double)> superficialSpeed) {
        auto* const glass = speciesHandler.copyAndAddObject({});
        const double d = material.diameter, mass = std::numbers::pi / 6 * d * d * d * material.density;
        glass->setDensity(material.density);
        glass->setStiffness(stiffness), glass->setDissipation(0.3 * std::sqrt(stiffness * mass));
        const double step = spread > 0 ? d * (1 - porosity) / (1 - spread) : d;
        SphericalParticle grain;
        grain.setSpecies(glass), grain.setRadius(0.5 * d);
        for (std::size_t k = 0; k < grainsOfCell * cellsOfBed && !isRestarted(); ++k) {
            grain.setPosition({0, 0, (static_cast<double>(k) + 0.5) * step});
            auto added = particleHandler.copyAndAddObject(grain);
            if (areFixed) added.fixParticle();
            else added.setHeldAxes({.x = true, .y = true});
        }
        InfiniteWall floor;
        floor.setSpecies(glass), floor.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(floor)->keepForces();
        setGravity({0, 0, -gravity});
        setTimeStep(0.05 * std::numbers::pi * std::sqrt(0.5 * mass / stiffness));
        const double half = 0.5 * std::sqrt(area());
        const FluidGrid grid{{-half, -half, 0},
                             {half, half, d * static_cast<double>(grainsOfCell * cellsOfColumn)},
                             {1, 1, static_cast<int>(cellsOfColumn)}};
        auto flow = std::make_unique<ColumnFlow>(material.fluid, std::move(superficialSpeed));
        column = flow.get();
        fluid = &addPart<FluidPart>(grid, material.fluid, dragLaw(law), std::move(flow), model);
    }

    /// m/s, superficial: where the law has this porosity's drag for the weight of the grains.
    [[nodiscard]] double balanced(double ofPorosity) const {
        return balancedSpeed(dragLaw(law), ofPorosity, material.diameter, material.density, material.fluid,
                             gravity);
    }
    /// m: the top grain's upper end.
    [[nodiscard]] double height() {
        return particleHandler.getObject(particleHandler.getSize() - 1).getPosition().z() +
               0.5 * material.diameter;
    }
    /// The mean of the cells in the middle half of the bed, in the last step.
    [[nodiscard]] double porosityInside() {
        const double cell = material.diameter * static_cast<double>(grainsOfCell), top = height();
        double sum = 0, count = 0;
        for (std::size_t k = 0; k < cellsOfColumn; ++k) {
            const double middle = cell * (static_cast<double>(k) + 0.5);
            if (middle < 0.25 * top || middle > 0.75 * top) continue;
            sum += fluid->fields().porosity[k], count += 1;
        }
        return count > 0 ? sum / count : porosity;
    }
    /// N: the weight of the grains in the fluid.
    [[nodiscard]] double weightInFluid() const {
        const double d = material.diameter;
        return std::numbers::pi / 6 * d * d * d * (material.density - material.fluid.density) * gravity *
               static_cast<double>(grainsOfCell * cellsOfBed);
    }

    FluidPart* fluid = nullptr;  // both of the scene
    const ColumnFlow* column = nullptr;
};

}  // namespace pendular
