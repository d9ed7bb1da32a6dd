#pragma once

#include <array>

#include "Drivers/Shared/GrainLattice.h"
#include "Drivers/Shared/PublishedScene.h"
#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/Meshes/TriangleWall.h"

namespace pendular {

/// A closed drum about the y axis, its middle in the origin.
struct DrumShape {
    double radius = 0.1;   // m
    double length = 0.06;  // m
};

/// The drum of the benchmark, large enough for this number of grains as the published one is for 38 000.
inline DrumShape drumFor(std::size_t grains) {
    const double scale = std::cbrt(static_cast<double>(grains) / 38000);
    return {0.1 * scale, 0.06 * scale};
}

/// A drum with grains of material M1 (radius 1 mm) and M2 (2 mm) that turns about -y. Source: Dosta et al.
/// (2024), Comput. Phys. Commun. 296, 109066, case 2.
class DrumScene : public PublishedScene {
public:
    static constexpr double smallRadius = 1e-3, largeRadius = 2e-3;  // m, of M1 and M2
    static constexpr double publishedSpeed = 2;                      // rad/s
    static constexpr double publishedStep = 0.8e-6;                  // s

    static PublishedMaterial materialOf(const GrainRow& grain) {
        return grain.radius < 0.5 * (smallRadius + largeRadius) ? M1 : M2;
    }

    /// Grains and walls of files, with the published step; the wall's surface may have any shape.
    DrumScene(std::span<const GrainRow> grains, std::span<const Triangle> triangles, double softening = 1)
        : PublishedScene(publishedStep, softening) {
        addGrains(grains);
        TriangleWall wall;
        wall.set(triangles);
        drum = addSteelWall(wall);
        // It is 1.8 times the stability limit, 0.44 us, which is for overlaps of 5 % of the smaller radius.
        // Stiffness goes with the root of the overlap and the limit with its fourth root: at the largest
        // overlap of the published state's first 15 ms, 0.56 % of the effective radius (of the smaller radius
        // 0.28 % between equal grains, 0.56 % at the wall), it is 0.91 us and 0.77 us.
        acceptUnstableTimeStep();
    }
    /// A generated state, with a step that is stable.
    DrumScene(std::span<const GrainRow> grains, const DrumShape& shape, double softening = 1)
        : PublishedScene(stableStep({{M1, smallRadius}, {M2, largeRadius}}), softening) {
        addGrains(grains);
        const double end = 0.5 * shape.length;
        AxisymmetricWall wall;
        wall.set(Vec3D::UnitY(), Vec3D::Zero(),
                 {{0, -end}, {shape.radius, -end}, {shape.radius, end}, {0, end}});
        drum = addSteelWall(wall);
    }

    /// Called before the run begins.
    /// @param speed rad/s about -y: at the bottom the wall moves towards +x
    void turn(double speed) { drum->setAngularVelocity({0, -speed, 0}, Vec3D::Zero()); }

    /// How many grains of M1 and of M2 have their centres in each quarter of the drum: x > 0 and z > 0, x < 0
    /// and z > 0, x < 0 and z < 0, x > 0 and z < 0.
    [[nodiscard]] std::array<std::array<std::size_t, 2>, 4> countQuarters() const {
        std::array<std::array<std::size_t, 2>, 4> counts{};
        const auto& grains = particleHandler.store();
        for (std::size_t k = 0; k < grains.size(); ++k) {
            const Vector<double>& at = grains.translation[k].position;
            const std::size_t quarter = at.z > 0 ? (at.x > 0 ? 0 : 1) : (at.x > 0 ? 3 : 2);
            ++counts[quarter][grains.species[k]];
        }
        return counts;
    }

private:
    void addGrains(std::span<const GrainRow> grains) {
        for (const GrainRow& grain : grains) addGrain(grain, materialOf(grain));
    }

    RigidWall* drum = nullptr;
};

/// Grains in a loose lattice in the lower part of a drum, M2 below M1 as in the published state and in its
/// proportion of 8 to 30: the number that is asked for, or fewer if the drum has no room for more.
inline std::vector<GrainRow> looseDrumGrainsThatFit(std::size_t number, const DrumShape& drum) {
    const double edge = 2 * latticeLooseness * DrumScene::largeRadius;  // for one grain of M2 or eight of M1
    const Vec3D corner(drum.radius, 0.5 * drum.length, drum.radius);
    const auto fits = [&](const Vec3D& c) {
        return std::hypot(std::abs(c.x()) + 0.5 * edge, std::abs(c.z()) + 0.5 * edge) <= drum.radius;
    };
    const std::size_t numberLarge = number * 8 / 38;
    UniformRandom random(1);
    std::vector<GrainRow> grains;
    for (const Vec3D& cell : latticeCells(-corner, corner, edge, fits)) {
        if (grains.size() < numberLarge) {
            grains.push_back(jittered(DrumScene::largeRadius, cell, random));
            continue;
        }
        for (int k = 0; k < 8 && grains.size() < number; ++k)
            grains.push_back(
                jittered(DrumScene::smallRadius,
                         cell + 0.25 * edge * Vec3D(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1), random));
    }
    return grains;
}

/// The same, all of them. Throws InputError if the drum is too small.
inline std::vector<GrainRow> looseDrumGrains(std::size_t number, const DrumShape& drum) {
    std::vector<GrainRow> grains = looseDrumGrainsThatFit(number, drum);
    if (number > 0 && grains.size() == number) return grains;
    // Only few grains are refused: a cell of their lattice is large beside their drum.
    std::size_t next = number + 1;
    while (looseDrumGrainsThatFit(next, drumFor(next)).size() < next) ++next;
    throw InputError(fmt::format(
        "The drum of radius {:.3g} m and length {:.3g} m has room for {} loose grains; the number "
        "of grains is {}; the next number that fits in its drum, which is larger in proportion, "
        "is {}.",
        drum.radius, drum.length, grains.size(), number, next));
}

/// The grains of looseDrumGrains() after they have fallen in the drum at rest: for three times the time in
/// which a stone falls through its radius twice.
inline std::vector<GrainRow> settledDrumGrains(std::size_t number, const DrumShape& drum,
                                               double softening = 1, const RunOptions& options = {}) {
    DrumScene scene(looseDrumGrains(number, drum), drum, softening);
    options.applyToPreparation(scene);
    scene.setTimeMax(3 * std::sqrt(4 * drum.radius / 9.8));
    scene.solve();
    scene.tellOfSoftening();
    return grainRows(scene.particleHandler);
}

}  // namespace pendular
