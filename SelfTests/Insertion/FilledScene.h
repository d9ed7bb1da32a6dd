#pragma once

#include <gtest/gtest.h>

#include "Kernel/Features/Laws.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Insertion/Meshes.h"
#include "SelfTests/Scenes/SettlingBox.h"

namespace pendular::scenes {

/// A scene without grains, into which a test inserts some.
class FilledScene : public Simulation<HertzianViscoelasticMindlinSpecies> {
public:
    static constexpr double density = 2500;  // kg/m^3

    explicit FilledScene(int numberOfThreads = 1) {
        material = speciesHandler.copyAndAddObject(boxMaterial<HertzianViscoelasticMindlinSpecies>(0));
        setNumberOfThreads(numberOfThreads);
        setQuiet();
        setTimeStep(1e-6);
        setTimeMax(1);
    }
    [[nodiscard]] SphericalParticle grain(const Vec3D& velocity = Vec3D::Zero()) const {
        SphericalParticle made;
        made.setSpecies(material);
        made.setVelocity(velocity);
        return made;
    }
    void addWall(const Vec3D& outward, const Vec3D& point) {
        InfiniteWall wall;
        wall.set(outward, point);
        wall.setSpecies(material);
        wallHandler.copyAndAddObject(wall);
    }
    /// A box whose faces are a wall of triangles; corners in m.
    void addMesh(const Vector<double>& lowest, const Vector<double>& highest) {
        TriangleWall wall;
        wall.set(boxMesh(lowest, highest));
        wall.setSpecies(material);
        wallHandler.copyAndAddObject(wall);
        mesh = {lowest, highest};
    }
    /// m, from a point on either side to the faces of that box.
    [[nodiscard]] double gapToMesh(const Vector<double>& p) const {
        const Vector<double> half = 0.5 * (mesh.highest - mesh.lowest), from = p - mesh.middle();
        const Vector<double> out{std::abs(from.x) - half.x, std::abs(from.y) - half.y,
                                 std::abs(from.z) - half.z};
        const double farthest = std::max({out.x, out.y, out.z});
        if (farthest < 0) return -farthest;
        return norm(Vector<double>{std::max(out.x, 0.0), std::max(out.y, 0.0), std::max(out.z, 0.0)});
    }
    void steps(int count) {
        for (int k = 0; k < count; ++k) step();
    }
    [[nodiscard]] std::uint64_t hash() const { return stateHash(particleHandler.store()); }
    /// m, the least gap between two grains, or their images, over all pairs; negative: they overlap.
    [[nodiscard]] double leastGap(const PeriodicBox& periodic = {}) const {
        const ParticleStore& grains = particleHandler.store();
        double least = infinity;
        for (std::size_t a = 0; a < grains.size(); ++a)
            for (std::size_t b = 0; b < a; ++b) {
                const TranslationRecord &p = grains.translation[a], &q = grains.translation[b];
                if (p.radius == 0 || q.radius == 0) continue;
                least =
                    std::min(least, norm(periodic.nearest(p.position - q.position)) - p.radius - q.radius);
            }
        return least;
    }

    HertzianViscoelasticMindlinSpecies* material = nullptr;
    Box mesh;
};

/// Grains of one diameter (m).
inline SizeDistribution equalSizes(double diameter) {
    return SizeDistribution({{diameter, diameter, 1, 1}}, SizeBasis::Number);
}

}  // namespace pendular::scenes
