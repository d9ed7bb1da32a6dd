#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Features/EnergyLedger/GrainSums.h"
#include "Kernel/Features/RigidBodies/ClumpTemplate.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/MercuryNames.h"

namespace pendular {

/// A rod of diameter 1 and this aspect ratio (length over diameter, 1: a sphere): spheres in a row.
/// @param spacing of their centres, at most, in diameters
inline ClumpTemplate rodOf(double aspect, double spacing) {
    const int gaps = static_cast<int>(std::ceil((aspect - 1) / spacing - 1e-9));  // 0.6 / 0.3 is 2
    std::vector<Ball> spheres{{Vec3D(0, 0, -0.5 * (aspect - 1)), 0.5}};
    for (int k = 1; k <= gaps; ++k)
        spheres.push_back({Vec3D(0, 0, (aspect - 1) * (1.0 * k / gaps - 0.5)), 0.5});
    return ClumpTemplate(std::move(spheres));
}

/// What all beds have in common. Lengths are in d, the diameter of a sphere of a mean rod's volume.
struct RodBedOptions {
    std::size_t number = 240;
    double diameter = 2e-3;  // m, d
    double width = 6;        // d, the period of x and of y
    double spacing = 0.5;    // of a rod's spheres, in its own diameters
    double friction = 0;
    double stiffness = 1e4;  // of a contact, over m g / d
    double endTime = 1;      // s, at most
    std::uint64_t seed = 1;
    RunOptions run{.output = "RodPacking-output"};
};

/// Rods fall on a floor, in a box that repeats itself along x and y, until they are at rest.
class RodBed : public Simulation<LinearViscoelasticSlidingFrictionSpecies> {
public:
    RodBed(const RodBedOptions& given, double aspect)
        : options(given), aspectRatio(aspect), shape(rodOf(aspect, given.spacing)) {
        options.run.apply(*this, nameOf(aspect));
        setTimeMax(options.endTime);
    }
    /// The beginning of the names of the files of the run with this aspect ratio.
    static std::string nameOf(double aspect) { return fmt::format("aspect-{:g}", aspect); }

    void setupInitialConditions() override {
        auto* const material = addMaterial();
        for (int axis = 0; axis < 2; ++axis) setPeriodic(axis, 0, width());
        InfiniteWall floor;
        floor.setSpecies(material), floor.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(floor);
        setGravity({0, 0, -gravity});
        Clump rod(shape);
        rod.setSpecies(material);
        insert(evenSizes((1 - sizeSpread) * options.diameter, (1 + sizeSpread) * options.diameter),
               BoxRegion({0, 0, 0}, {width(), width(), fillHeight()}), Amount::grains(options.number), rod,
               {.seed = options.seed});
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25));
    }
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 200 != 0 || getTime() < std::sqrt(2 * fillHeight() / gravity)) return;
        isAtRest = restlessness() < 1e-4 ? 1 : 0;
    }
    [[nodiscard]] bool continueSolve() const override { return isAtRest == 0; }
    void visitState(StateArchive& archive) override { archive.value("isAtRest", isAtRest); }

    [[nodiscard]] double width() const { return options.width * options.diameter; }              // m
    [[nodiscard]] double rodDiameter() const { return options.diameter / shape.getDiameter(); }  // m
    [[nodiscard]] std::size_t spheresOfRod() const { return shape.getSpheres().size(); }
    /// m, up to which rods are inserted: a solid fraction of 0.18 at most, and room for one that stands.
    [[nodiscard]] double fillHeight() const {
        return static_cast<double>(options.number) * rodVolume() / (0.18 * width() * width()) +
               aspectRatio * rodDiameter();
    }
    [[nodiscard]] double rodVolume() const {
        return constants::pi / 6 * std::pow(options.diameter, 3);
    }  // m^3
    /// Kinetic energy of a rod, on average, over m g d.
    /// On several ranks all of them must call this together.
    [[nodiscard]] double restlessness() {
        return (getKineticEnergy() + getRotationalEnergy()) /
               (static_cast<double>(options.number) * density * rodVolume() * gravity * options.diameter);
    }

    /// A layer of the bed, m.
    struct Layer {
        double bottom, top;
        [[nodiscard]] bool contains(double z) const { return z >= bottom && z < top; }
    };
    /// The layer of the bed from a quarter to three quarters of its height, which is twice that of its centre
    /// of mass.
    [[nodiscard]] Layer middle() {
        double sum = 0;
        for (std::size_t k = 0; k < bodyHandler.getSize(); ++k)
            sum += bodyHandler.getObject(k).getPosition().z();
        const double mean = sum / static_cast<double>(bodyHandler.getSize());
        return {0.5 * mean, 1.5 * mean};
    }
    /// The share of a layer that is in a sphere, each point counted once: by vertical lines on a square grid.
    [[nodiscard]] double solidFraction(const Layer& layer) {
        constexpr int lines = 250;  // along x, and along y
        const double step = width() / lines;
        std::vector<std::vector<std::pair<double, double>>> chords(lines * lines);
        for (const GrainReference grain : particleHandler) {
            const Vec3D centre = grain.getPosition();
            const double r = grain.getRadius();
            const auto first = [&](double x) { return static_cast<int>(std::ceil((x - r) / step - 0.5)); };
            for (int i = first(centre.x()); (i + 0.5) * step < centre.x() + r; ++i)
                for (int j = first(centre.y()); (j + 0.5) * step < centre.y() + r; ++j) {
                    const double x = (i + 0.5) * step - centre.x(), y = (j + 0.5) * step - centre.y();
                    const double square = r * r - x * x - y * y;
                    if (square <= 0) continue;
                    const double half = std::sqrt(square);
                    const int line = (i + lines) % lines * lines + (j + lines) % lines;
                    chords[static_cast<std::size_t>(line)].push_back({centre.z() - half, centre.z() + half});
                }
        }
        double solid = 0;  // m, of all lines
        for (auto& line : chords) {
            std::sort(line.begin(), line.end());
            double reached = layer.bottom;
            for (const auto& [from, to] : line) {
                solid += std::max(0.0, std::min(to, layer.top) - std::clamp(from, reached, layer.top));
                reached = std::clamp(to, reached, layer.top);
            }
        }
        return solid / (lines * lines * (layer.top - layer.bottom));
    }

    /// Means of the rods whose centres are in a layer.
    struct Means {
        double rods = 0;
        double neighbours = 0;  // rods that one touches
        double contacts = 0;    // pairs of spheres that touch
        double order = 0;       // (3 <cos^2> - 1) / 2 to the vertical: 0 even, -1/2 all flat; 0 of spheres
    };
    [[nodiscard]] Means meansOf(const Layer& layer) {
        Means means;
        std::vector<bool> isInside;
        for (std::size_t k = 0; k < bodyHandler.getSize(); ++k) {
            const BodyReference rod = bodyHandler.getObject(k);
            isInside.push_back(layer.contains(rod.getPosition().z()));
            if (!isInside.back()) continue;
            means.rods += 1;
            const double cosine = (rod.getPrincipalAxes() * Vec3D::UnitX()).z();  // of the least moment
            if (aspectRatio > 1) means.order += 1.5 * cosine * cosine - 0.5;
        }
        std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;  // of rods
        for (const ObservedContact& seen : interactions()) {
            if (!seen.touching || seen.particle2 == ObservedContact::none) continue;
            const std::uint32_t a = *bodyHandler.bodyOf(seen.particle1),
                                b = *bodyHandler.bodyOf(seen.particle2);
            const int ends = isInside[a] + isInside[b];
            means.contacts += ends;
            if (pairs.insert(std::minmax(a, b)).second) means.neighbours += ends;
        }
        if (means.rods == 0)
            throw RunError("No rod has its centre in the middle half of the bed; take more rods (--number).");
        for (double* sum : {&means.neighbours, &means.contacts, &means.order}) *sum /= means.rods;
        return means;
    }

private:
    /// All lengths of a rod are even between 1 - this and 1 + this of those of the mean: equal spheres
    /// without friction crystallise on a flat floor (0.730 of the room, 10.3 neighbours).
    static constexpr double sizeSpread = 0.2;
    static constexpr double density = 2500, gravity = 9.81;  // kg/m^3, m/s^2

    LinearViscoelasticSlidingFrictionSpecies* addMaterial() {
        auto* const material = speciesHandler.copyAndAddObject({});
        const double mass = density * rodVolume();
        material->setDensity(density);
        material->setStiffnessAndRestitutionCoefficient(options.stiffness * mass * gravity / options.diameter,
                                                        0.3, mass);
        material->setSlidingStiffness(2.0 / 7 * material->getStiffness());
        material->setSlidingDissipation(material->getDissipation());
        material->setSlidingFrictionCoefficient(options.friction);
        return material;
    }

    RodBedOptions options;
    double aspectRatio;
    ClumpTemplate shape;  // of diameter 1
    int isAtRest = 0;
};

}  // namespace pendular
