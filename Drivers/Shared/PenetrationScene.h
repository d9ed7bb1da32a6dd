#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "Drivers/Shared/GrainLattice.h"
#include "Drivers/Shared/PublishedScene.h"
#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Features/Meshes/TriangleWall.h"

namespace pendular {

/// The bed's grains, and the sphere that hits it, if there is one.
struct PenetrationGrains {
    std::vector<GrainRow> bed;
    std::optional<GrainRow> intruder;
};

/// The largest of the grains is the intruder. Throws InputError unless one is larger than all others.
inline PenetrationGrains separateIntruder(std::vector<GrainRow> grains) {
    const auto isSmaller = [](const GrainRow& a, const GrainRow& b) { return a.radius < b.radius; };
    const auto largest = std::max_element(grains.begin(), grains.end(), isSmaller);
    const auto asLarge = [&](const GrainRow& g) { return g.radius == largest->radius; };
    if (grains.size() < 2 || std::count_if(grains.begin(), grains.end(), asLarge) != 1)
        throw InputError(
            "The grains of the penetration have no intruder: one must be larger than all others.");
    const GrainRow intruder = *largest;
    grains.erase(largest);
    return {grains, intruder};
}

/// A box that is open above: x and y from minus to plus half its width and depth, z from 0 on; and the size
/// of the intruder in proportion.
struct BedBox {
    double width = 0.098;          // m, along x
    double depth = 0.06;           // m, along y
    double intruderRadius = 0.01;  // m
};

/// The box of the benchmark, for this number of grains as the published one is for 25 000.
inline BedBox bedBoxFor(std::size_t grains) {
    const double scale = std::cbrt(static_cast<double>(grains) / 25000);
    return {0.098 * scale, 0.06 * scale, 0.01 * scale};
}

/// A bed of grains of material M1 that a steel sphere meets from above. Source: Dosta et al. (2024), Comput.
/// Phys. Commun. 296, 109066, case 3.
class PenetrationScene : public PublishedScene {
public:
    static constexpr double grainRadius = 1e-3;    // m
    static constexpr double publishedSpeed = 5;    // m/s, downwards
    static constexpr double publishedStep = 5e-7;  // s

    /// Walls of a file, and the published step.
    /// @param speed m/s, of the intruder, downwards
    PenetrationScene(const PenetrationGrains& grains, std::span<const Triangle> triangles,
                     double speed = publishedSpeed, double softening = 1)
        : PublishedScene(publishedStep, softening) {
        addGrains(grains, speed);
        TriangleWall wall;
        wall.set(triangles);
        addSteelWall(wall);
        // It is 1.13 times the stability limit, 0.44 us, which is for overlaps of 5 % of the smaller radius
        // and goes with their fourth root. Until the sphere arrives they are below 0.3 % of the effective
        // radius. Below it they reach 37 % when it comes to the floor, where the step is 1.9 times the limit,
        // for a few contacts and steps (4748 evaluations above 10 %).
        acceptUnstableTimeStep();
    }
    /// A generated state, with the published step or a shorter one that is stable.
    PenetrationScene(const PenetrationGrains& grains, const BedBox& box, double speed = publishedSpeed,
                     double softening = 1)
        : PublishedScene(stepOf(grains, box), softening) {
        addGrains(grains, speed);
        addPlane({0, 0, -1}, Vec3D::Zero());
        for (const double side : {-1.0, 1.0}) {
            addPlane({side, 0, 0}, {0.5 * side * box.width, 0, 0});
            addPlane({0, side, 0}, {0, 0.5 * side * box.depth, 0});
        }
    }

    /// The last grain; throws InputError where there is no intruder.
    [[nodiscard]] auto intruder() { return particleHandler.getObject(bedSize); }
    /// m, of the highest point of the bed at the start.
    [[nodiscard]] double surface() const { return surfaceHeight; }
    struct Fall {
        double depth;     // m, of the intruder's lowest point below surface(); negative above
        double velocity;  // m/s, along z
    };
    /// Of the intruder, whichever rank has it: all must call this together.
    [[nodiscard]] Fall fall() {
        SumOverRanks<std::array<double, 2>> sum;
        if (particleHandler.contains(bedSize))
            sum.add({surfaceHeight - (intruder().getPosition().z() - intruder().getRadius()),
                     intruder().getVelocity().z()});
        const auto [depth, velocity] = sum.ofAll(*this);
        return {depth, velocity};
    }
    [[nodiscard]] double penetration() { return fall().depth; }

    void visitState(StateArchive& archive) override {
        archive.value("bedSize", bedSize);
        archive.value("surfaceHeight", surfaceHeight);
    }

private:
    /// s; a run that goes on is made without grains, and has an intruder.
    static double stepOf(const PenetrationGrains& grains, const BedBox& box) {
        const bool settles = !grains.bed.empty() && !grains.intruder;
        return std::min(publishedStep, settles
                                           ? stableStep({{M1, grainRadius}})
                                           : stableStep({{M1, grainRadius}, {Steel, box.intruderRadius}}));
    }
    void addGrains(const PenetrationGrains& grains, double speed) {
        for (const GrainRow& grain : grains.bed) {
            addGrain(grain, M1);
            surfaceHeight = std::max(surfaceHeight, grain.position.z() + grain.radius);
        }
        bedSize = grains.bed.size();
        if (grains.intruder) addGrain(*grains.intruder, Steel, {0, 0, -speed});
    }
    void addPlane(const Vec3D& outward, const Vec3D& point) {
        InfiniteWall plane;
        plane.set(outward, point);
        addSteelWall(plane);
    }

    std::size_t bedSize = 0;
    double surfaceHeight = -infinity;
};

/// Grains in a loose lattice on the floor of the box. Throws InputError if none fit side by side.
inline std::vector<GrainRow> looseBed(std::size_t number, const BedBox& box) {
    const double edge = 2 * latticeLooseness * PenetrationScene::grainRadius;
    const double perLayer = std::floor(box.width / edge) * std::floor(box.depth / edge);
    if (!(perLayer >= 1))
        throw InputError(
            fmt::format("The number of grains of the bed is {}, and their box of {:.3g} m x "
                        "{:.3g} m has no room for one; take more, for which the box is larger.",
                        number, box.width, box.depth));
    const double height = edge * (std::ceil(static_cast<double>(number) / perLayer) + 0.5);
    const Vec3D corner(0.5 * box.width, 0.5 * box.depth, 0);
    const auto cells =
        latticeCells(-corner, corner + Vec3D(0, 0, height), edge, [](const Vec3D&) { return true; });
    UniformRandom random(1);
    std::vector<GrainRow> bed;
    for (std::size_t k = 0; k < number; ++k)
        bed.push_back(jittered(PenetrationScene::grainRadius, cells[k], random));
    return bed;
}

/// The grains of looseBed() after they have settled, for three times the time in which a stone falls through
/// their lattice, and the intruder, one of its radii above them.
inline PenetrationGrains settledBed(std::size_t number, const BedBox& box, double softening = 1,
                                    const RunOptions& options = {}) {
    PenetrationScene scene({looseBed(number, box), {}}, box, 0, softening);
    options.applyToPreparation(scene);
    scene.setTimeMax(3 * std::sqrt(2 * scene.surface() / 9.8));
    scene.solve();
    scene.tellOfSoftening();
    PenetrationGrains grains{grainRows(scene.particleHandler), {}};
    double top = 0;
    for (const GrainRow& grain : grains.bed) top = std::max(top, grain.position.z() + grain.radius);
    grains.intruder = {box.intruderRadius, Vec3D(0, 0, top + 2 * box.intruderRadius)};
    return grains;
}

}  // namespace pendular
