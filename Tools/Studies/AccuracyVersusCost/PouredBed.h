#pragma once

#include <array>
#include <numbers>

#include "Drivers/Shared/GrainLattice.h"
#include "Drivers/Shared/GrainRows.h"
#include "Kernel/Features/EnergyLedger/GrainSums.h"
#include "Tools/Studies/AccuracyVersusCost/BulkFigures.h"
#include "Tools/Studies/AccuracyVersusCost/BulkLaws.h"

// Grains that are poured on a floor and come to rest.

namespace pendular::bulk {

inline constexpr double gravity = 9.8;  // m/s^2

/// A grain in a cell, of 0.8 to 1 times the largest radius, so that the bed does not crystallise.
inline GrainRow randomGrain(const Vec3D& cell, UniformRandom& random) {
    return jittered(largestRadius * random.uniform(0.8, 1), cell, random);
}
/// m/s, with which the grains begin, so that each seed gives another packing.
inline Vec3D randomVelocity(UniformRandom& random) {
    const auto speed = [&] { return random.uniform(-0.2, 0.2); };
    const double x = speed(), y = speed();
    return {x, y, speed()};
}
inline constexpr double looseCell = 2.2 * largestRadius;  // m, edge of a grain's cell at the start

struct BedOptions {
    int grains = 1200, across = 7;  // loose cells along x and y
};

/// Periodic along x and y.
template <class S>
class PouredBed : public Simulation<S> {
public:
    static constexpr std::array names{"coordination",
                                      "coordination_of_load_bearing",
                                      "share_of_rattlers",
                                      "solid_fraction",
                                      "horizontal_over_vertical_stress",
                                      "mean_stress_Pa",
                                      "vertical_stress_over_weight"};
    using Figures = std::array<double, names.size()>;

    PouredBed(const LawVariant& variant, const BedOptions& options, std::uint64_t seed)
        : width(options.across * looseCell) {
        const S* species = this->speciesHandler.copyAndAddObject(speciesOf<S>(variant.elasticModulus));
        for (const int axis : {0, 1}) this->setPeriodic(axis, 0, width);
        InfiniteWall floor;
        floor.setSpecies(species);
        floor.set({0, 0, -1}, {0, 0, 0});
        this->wallHandler.copyAndAddObject(floor);
        const double height = looseCell * (1.0 + options.grains / (options.across * options.across));
        const auto cells =
            latticeCells({0, 0, 0}, {width, width, height}, looseCell, [](const Vec3D&) { return true; });
        UniformRandom random(seed);
        for (int k = 0; k < options.grains; ++k) {
            const GrainRow row = randomGrain(cells[static_cast<std::size_t>(k)], random);
            addGrainRow(this->particleHandler, species, row, randomVelocity(random));
        }
        this->setGravity({0, 0, -gravity});
        this->setTimeStep(variant.stepTimesOmega * this->shortestContactTime() / std::numbers::pi);
        this->acceptUnstableTimeStep();  // its limit is that of a bed at rest, of friction that sticks
        fallTime = std::sqrt(2 * height / gravity);
    }

    /// To be called after initialise(): until the motion of a grain is a millionth of what it would gain by
    /// falling through its radius, at most ten times the time of a fall through all of the bed.
    std::vector<Figures> run() {
        const std::size_t steps = stepsOf(fallTime), between = stepsOf(0.02 * fallTime);
        while (this->getNumberOfTimeSteps() < steps ||
               (!isAtRest() && this->getNumberOfTimeSteps() < 10 * steps))
            for (std::size_t k = 0; k < between; ++k) this->step();
        return {figures()};
    }

    [[nodiscard]] Figures figures() const {
        const auto& grains = this->particleHandler.store();
        const ContactFigures contacts = contactFigures(*this);
        double mass = 0, moment = 0;  // kg, kg m
        std::vector<double> heights;
        for (const TranslationRecord& grain : grains.translation) {
            mass += 1 / grain.inverseMass;
            moment += grain.position.z / grain.inverseMass;
            heights.push_back(grain.position.z);
        }
        std::sort(heights.begin(), heights.end());
        const double low = heights[heights.size() / 5], high = heights[heights.size() * 4 / 5];
        std::vector<int> inside;
        double solid = 0;  // m^3
        for (std::size_t k = 0; k < grains.size(); ++k) {
            const double z = grains.translation[k].position.z, r = grains.translation[k].radius;
            if (z >= low && z <= high) inside.push_back(contacts.contactsOf[k]);
            solid += volumeBelow(high, z, r) - volumeBelow(low, z, r);
        }
        const Coordination c = coordination(inside);
        const Eigen::Vector3d normal = contacts.virial.diagonal();
        // The volume of a bed as high as twice the centre of mass.
        const double volume = width * width * 2 * moment / mass;
        return {c.all,
                c.loadBearing,
                c.rattlers,
                solid / (width * width * (high - low)),
                (normal.x() + normal.y()) / (2 * normal.z()),
                normal.sum() / (3 * volume),
                normal.z() / (gravity * moment)};
    }

private:
    [[nodiscard]] std::size_t stepsOf(double time) const {
        return std::max<std::size_t>(1, static_cast<std::size_t>(time / this->getTimeStep()));
    }
    [[nodiscard]] bool isAtRest() const {
        const auto& grains = this->particleHandler.store();
        double fall = 0;  // J
        for (const TranslationRecord& grain : grains.translation)
            fall += gravity * grain.radius / grain.inverseMass;
        return translationalEnergy(grains) < 1e-6 * fall;
    }

    double width, fallTime = 0;  // m, s
};

}  // namespace pendular::bulk
