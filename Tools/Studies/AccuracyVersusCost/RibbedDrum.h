#pragma once

#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Tools/Studies/AccuracyVersusCost/PouredBed.h"

// Grains in a slice of a rotating drum with ribs, which carry them with any friction.

namespace pendular::bulk {

/// A cylinder about y whose surface goes between two radii (m), from -y to y.
struct RibbedCylinder {
    double outerRadius, innerRadius, from, to;  // m
    int ribs;

    [[nodiscard]] std::vector<Triangle> triangles() const {
        const auto corner = [&](int k, double y) {
            const double angle = std::numbers::pi * k / ribs, r = k % 2 == 0 ? outerRadius : innerRadius;
            return Vector<double>{r * std::cos(angle), y, r * std::sin(angle)};
        };
        std::vector<Triangle> faces;
        for (int k = 0; k < 2 * ribs; ++k) {
            const int next = (k + 1) % (2 * ribs);
            faces.push_back({corner(k, from), corner(next, from), corner(next, to)});
            faces.push_back({corner(k, from), corner(next, to), corner(k, to)});
        }
        return faces;
    }
};

struct DrumOptions {
    double radius = 0.02, length = 4 * looseCell;  // m, inside of the ribs
    double filling = 0.35;                         // of the section, by grains of the solid fraction 0.58
    double speed = 3;                              // rad/s: omega^2 R / g = 0.02
    double before = 2;                             // rad, until the flow is steady
    double measured = 4;                           // rad
    int blocks = 4;                                // of the measured time, with a mean of each
    int samplesOfBlock = 100;                      // at least
};

/// The drum turns about -y, so that grains climb towards +x; periodic along y.
template <class S>
class RibbedDrum : public Simulation<S> {
public:
    static constexpr std::array names{"surface_angle_deg", "centre_angle_deg", "coordination"};
    using Figures = std::array<double, names.size()>;

    RibbedDrum(const LawVariant& variant, const DrumOptions& given, std::uint64_t seed) : options(given) {
        const S* species = this->speciesHandler.copyAndAddObject(speciesOf<S>(variant.elasticModulus));
        this->setPeriodic(1, 0, options.length);
        TriangleWall wall;
        wall.setSpecies(species);
        const double height = largestRadius;
        const RibbedCylinder ribs{
            options.radius + height, options.radius, -1.5 * largestRadius,
            options.length + 1.5 * largestRadius,
            static_cast<int>(std::lround(0.5 * std::numbers::pi * options.radius / largestRadius))};
        wall.set(ribs.triangles());
        wall.setAngularVelocity({0, -options.speed, 0}, Vec3D::Zero());
        drum = this->wallHandler.copyAndAddObject(wall);
        addGrains(species, seed);
        this->setGravity({0, 0, -gravity});
        this->setTimeStep(variant.stepTimesOmega * this->shortestContactTime() / std::numbers::pi);
        this->acceptUnstableTimeStep();  // its limit is that of a bed at rest, of friction that sticks
    }

    /// To be called after initialise(). One row for each block of time.
    std::vector<Figures> run() {
        for (std::size_t k = 0; k < stepsOf(options.before); ++k) this->step();
        const std::size_t ofBlock = stepsOf(options.measured / options.blocks);
        const std::size_t between =
            std::max<std::size_t>(1, ofBlock / static_cast<std::size_t>(options.samplesOfBlock));
        std::vector<Figures> means;
        for (int block = 0; block < options.blocks; ++block) {
            Figures sum{};
            int samples = 0;
            for (std::size_t k = 0; k < ofBlock; ++k) {
                this->step();
                if (k % between != 0) continue;
                const Figures now = figures();
                for (std::size_t f = 0; f < sum.size(); ++f) sum[f] += now[f];
                ++samples;
            }
            for (double& figure : sum) figure /= samples;
            means.push_back(sum);
        }
        return means;
    }

    [[nodiscard]] Figures figures() const {
        std::vector<Vec3D> centres;
        std::vector<double> radii;
        for (const TranslationRecord& grain : this->particleHandler.store().translation) {
            centres.push_back(toEigen(grain.position));
            radii.push_back(grain.radius);
        }
        return {surfaceAngle(centres, {0.5 * options.radius, 2 * largestRadius}), centreAngle(centres, radii),
                coordination(contactFigures(*this).contactsOf).all};
    }

    [[nodiscard]] TriangleWall& wall() { return *drum; }

private:
    /// The steps in which the drum turns by an angle (rad).
    [[nodiscard]] std::size_t stepsOf(double angle) const {
        return std::max<std::size_t>(1,
                                     static_cast<std::size_t>(angle / (options.speed * this->getTimeStep())));
    }
    /// Adds grains from below, on a lattice.
    void addGrains(const S* species, std::uint64_t seed) {
        const double radius = options.radius, room = std::numbers::pi * radius * radius * options.length;
        const auto fits = [&](const Vec3D& cell) {
            return std::hypot(std::abs(cell.x()) + 0.5 * looseCell, std::abs(cell.z()) + 0.5 * looseCell) <=
                   radius;
        };
        const auto cells =
            latticeCells({-radius, 0, -radius}, {radius, options.length, radius}, looseCell, fits);
        UniformRandom random(seed);
        double solid = 0;  // m^3
        for (const Vec3D& cell : cells) {
            if (solid > 0.58 * options.filling * room) break;
            const GrainRow row = randomGrain(cell, random);
            solid += 4.0 / 3 * std::numbers::pi * std::pow(row.radius, 3);
            addGrainRow(this->particleHandler, species, row, randomVelocity(random));
        }
    }

    DrumOptions options;
    TriangleWall* drum = nullptr;
};

}  // namespace pendular::bulk
