#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Features/EnergyLedger/GrainSums.h"
#include "Kernel/Features/Insertion/ClumpInsertion.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Math/CountedRandom.h"
#include "Kernel/MercuryNames.h"
#include "Kernel/Scene/SuperquadricSimulation.h"

namespace pendular {

/// What all beds have in common. Lengths are in d, the diameter of a sphere of a mean grain's volume.
struct EllipsoidBedOptions {
    std::size_t number = 240;
    double diameter = 2e-3;  // m, d
    double width = 6;        // d, the period of x and of y
    int exponent = 2;        // of the shape; 2: ellipsoids
    double friction = 0;
    double stiffness = 1e4;  // of a contact, over m g / d
    double endTime = 3;      // s, at most
    std::uint64_t seed = 1;
    RunOptions run{.output = "EllipsoidPacking-output"};
};

/// A shape of volume 1 with two equal half lengths and a third that is `aspect` times as long.
inline Superquadric spheroidOf(double aspect, int exponent) {
    const Superquadric one{1, 1, aspect, exponent, exponent};
    const double scale = std::cbrt(1 / one.volume());
    return {scale, scale, scale * aspect, exponent, exponent};
}

/// All lengths of a grain are even between 1 - this and 1 + this of those of the mean: equal spheres without
/// friction crystallise on a flat floor.
inline constexpr double spreadOfEllipsoids = 0.2;

/// m, the length unit of the mean shape, of volume 1: the mean of the cubes of sizes is 1 + spread^2.
inline double sizeOfEllipsoids(const EllipsoidBedOptions& options) {
    return options.diameter * std::cbrt(constants::pi / 6 / (1 + spreadOfEllipsoids * spreadOfEllipsoids));
}
/// m, the width of the cells of a lattice in which no two can touch.
inline double cellOfEllipsoids(const EllipsoidBedOptions& options, double aspect) {
    return 2.001 * (1 + spreadOfEllipsoids) * sizeOfEllipsoids(options) *
           spheroidOf(aspect, options.exponent).boundingRadius();
}

/// The share of a grain that is between two heights, by points on a grid in it where it is cut.
/// @param up unit, the vertical in the axes of the shape; @param z m, of its centre; @param bottom, top: m
inline double shareBetween(const Superquadric& shape, const Vec3D& up, double z, double bottom, double top) {
    const double reach = shape.boundingRadius();
    if (z - reach >= bottom && z + reach <= top) return 1;
    if (z + reach <= bottom || z - reach >= top) return 0;
    constexpr int points = 24;  // along each axis
    const auto at = [&](int k) { return (2.0 * k + 1) / points - 1; };
    const auto power = [](double x, double n) { return std::pow(std::abs(x), n); };
    int inside = 0, between = 0;
    for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j)
            for (int k = 0; k < points; ++k) {
                const double across = power(at(i), shape.n2) + power(at(j), shape.n2);
                if (power(across, 1.0 * shape.n1 / shape.n2) + power(at(k), shape.n1) > 1) continue;
                const double height = z + up.dot(Vec3D(shape.a * at(i), shape.b * at(j), shape.c * at(k)));
                ++inside, between += height >= bottom && height < top ? 1 : 0;
            }
    return 1.0 * between / inside;
}

/// Ellipsoids fall on a floor, in a box that repeats itself along x and y, until they are at rest.
class EllipsoidBed : public SuperquadricSimulation<LinearViscoelasticSlidingFrictionSpecies> {
public:
    EllipsoidBed(const EllipsoidBedOptions& given, double aspectRatio)
        : options(given), aspect(aspectRatio), shape(spheroidOf(aspectRatio, given.exponent)) {
        options.run.apply(*this, fmt::format("aspect-{:g}", aspect));
        setTimeMax(options.endTime);
    }

    void setupInitialConditions() override {
        auto* const material = speciesHandler.copyAndAddObject(materialOf(options));
        for (int axis = 0; axis < 2; ++axis) setPeriodic(axis, 0, width());
        InfiniteWall floor;
        floor.setSpecies(material), floor.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(floor);
        setGravity({0, 0, -gravity});
        const CountedRandom random(options.seed);
        for (std::uint32_t k = 0; k < options.number; ++k) {
            const auto even = [&](std::uint32_t n) { return random.uniform(-1, 1, k, n); };
            const double scale = sizeOfEllipsoids(options) * (1 + spreadOfEllipsoids * even(0));
            SuperquadricGrain grain({scale * shape.a, scale * shape.b, scale * shape.c, shape.n1, shape.n2});
            grain.setSpecies(material);
            grain.setPosition(placeOf(k));
            grain.setOrientation(evenTurn(random.uniform(k, 3), random.uniform(k, 4), random.uniform(k, 5)));
            grain.setVelocity(0.05 * Vec3D(even(1), even(2), 0));
            superquadricHandler.copyAndAddObject(grain);
        }
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25));
    }
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 200 != 0 ||
            getTime() < std::sqrt(2 * placeOf(lastNumber()).z() / gravity))
            return;
        isAtRest = restlessness() < 5e-4 ? 1 : 0;
    }
    [[nodiscard]] bool continueSolve() const override { return isAtRest == 0; }
    void visitState(StateArchive& archive) override { archive.value("isAtRest", isAtRest); }

    [[nodiscard]] double width() const { return options.width * options.diameter; }  // m
    /// Kinetic energy of a grain, on average, over m g d.
    /// On several ranks all of them must call this together.
    [[nodiscard]] double restlessness() {
        return (getKineticEnergy() + getRotationalEnergy()) /
               (static_cast<double>(options.number) * meanMass(options) * gravity * options.diameter);
    }

    /// kg
    static double meanMass(const EllipsoidBedOptions& options) {
        return density * constants::pi / 6 * std::pow(options.diameter, 3);
    }
    static LinearViscoelasticSlidingFrictionSpecies materialOf(const EllipsoidBedOptions& options) {
        LinearViscoelasticSlidingFrictionSpecies material;
        const double mass = meanMass(options);
        material.setDensity(density);
        material.setStiffnessAndRestitutionCoefficient(options.stiffness * mass * gravity / options.diameter,
                                                       0.3, mass);
        material.setSlidingStiffness(2.0 / 7 * material.getStiffness());
        material.setSlidingDissipation(material.getDissipation());
        material.setSlidingFrictionCoefficient(options.friction);
        return material;
    }

    /// The middle of the bed: what is between a quarter and three quarters of its height, which is twice that
    /// of its centre of mass.
    struct Middle {
        double grains = 0, solidFraction = 0, contacts = 0, largestOverlap = 0;
    };
    [[nodiscard]] Middle middle() {
        const double mean = getCentreOfMass().z(), bottom = 0.5 * mean, top = 1.5 * mean;
        Middle found;
        std::vector<bool> isInside;
        double volume = 0;
        for (std::size_t k = 0; k < bodyHandler.getSize(); ++k) {
            const BodyReference body = bodyHandler.getObject(k);
            const double z = body.getPosition().z();
            isInside.push_back(z >= bottom && z < top);
            found.grains += isInside.back() ? 1 : 0;
            const Vec3D up = body.getOrientation().conjugate() * Vec3D::UnitZ();
            volume += body.getMass() / density *
                      shareBetween(superquadricHandler.shapeOf(body.getGrains()[0]), up, z, bottom, top);
        }
        if (found.grains == 0)
            throw RunError("No grain has its centre in the middle half of the bed; take more (--number).");
        found.solidFraction = volume / (width() * width() * (top - bottom));
        for (const ObservedContact& seen : interactions()) {
            found.largestOverlap = std::max(found.largestOverlap, seen.overlap() / options.diameter);
            if (seen.particle2 == ObservedContact::none) continue;
            found.contacts +=
                isInside[*bodyHandler.bodyOf(seen.particle1)] + isInside[*bodyHandler.bodyOf(seen.particle2)];
        }
        found.contacts /= found.grains;
        return found;
    }

private:
    static constexpr double density = 2500, gravity = 9.81;  // kg/m^3, m/s^2

    [[nodiscard]] std::uint32_t lastNumber() const { return static_cast<std::uint32_t>(options.number - 1); }
    /// m, on a lattice on which no two can touch.
    [[nodiscard]] Vec3D placeOf(std::uint32_t k) const {
        const double cell = cellOfEllipsoids(options, aspect);
        const auto row = static_cast<std::uint32_t>(width() / cell);
        const double spacing = width() / row;
        return {(k % row + 0.5) * spacing, (k / row % row + 0.5) * spacing, (k / (row * row) + 0.5) * cell};
    }
    EllipsoidBedOptions options;
    double aspect;
    Superquadric shape;  // of volume 1
    int isAtRest = 0;
};

}  // namespace pendular
