#pragma once

#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Scene/Simulation.h"
#include "Tools/Studies/BulkComparison/BulkScene.h"

namespace pendular::bulk {

/// A scene of the comparison, with the laws of LIGGGHTS' `hertz tangential history`; with a bridge law
/// between grains, as its `cohesion easo/capillary/viscous` has it, whose walls are dry.
template <class Material>
class PeerSceneOf : public Simulation<Material> {
public:
    static constexpr bool isWet = requires(Material & wet) { wet.setLiquidBridgeVolume(0); };
    using Simulation<Material>::particleHandler;
    using Simulation<Material>::speciesHandler;
    using Simulation<Material>::wallHandler;

    /// @param isClosed grains settle on a plane in the opening of a floor
    explicit PeerSceneOf(const BulkScene& given, bool isClosed = false) {
        const Material* grains = speciesHandler.copyAndAddObject(material(PeerMaterial::density));
        const Material* heavy = speciesHandler.copyAndAddObject(material(3 * PeerMaterial::density));
        const Material* walls = speciesHandler.copyAndAddObject(material(PeerMaterial::density));
        for (const Material* other : {grains, heavy}) {
            auto* const atWalls = speciesHandler.getMixedObject(other, walls);
            atWalls->setSlidingFrictionCoefficient(given.wallFriction);
            if constexpr (isWet) atWalls->setLiquidBridgeVolume(0);
        }
        for (int axis = 0; axis < 3; ++axis)
            if (given.periodic[static_cast<std::size_t>(axis)])
                this->setPeriodic(axis, given.lowest[axis], given.highest[axis]);
        Vec3D down = Vec3D::Zero();
        down[given.up] = -PeerMaterial::gravity;
        this->setGravity(down);
        addWalls(given, walls, isClosed);
        for (const PeerGrain& row : given.grains) add(row, row.kind == GrainKind::Intruder ? heavy : grains);
    }

    /// The grains as they are now, in rows as other codes' files give them.
    [[nodiscard]] std::vector<PeerGrain> grainsNow(const BulkScene& given) const {
        const ParticleStore& store = particleHandler.store();
        std::vector<PeerGrain> rows;
        for (const std::uint32_t at : store.place) {
            const TranslationRecord& grain = store.translation[at];
            rows.push_back(given.grains[store.identity[at]]);
            rows.back().position = toEigen(grain.position);
            rows.back().velocity = toEigen(grain.velocity);
        }
        return rows;
    }

private:
    static Material material(double density) {
        using M = PeerMaterial;
        Material made;
        made.setDensity(density);
        made.setElasticModulusAndPoissonRatio(M::elasticModulus, M::poissonRatio);
        made.setEffectiveShearModulus(computeEffectiveShearModulus(M::elasticModulus, M::poissonRatio));
        made.setRestitutionCoefficient(M::restitution);
        made.setSlidingFrictionCoefficient(M::friction);
        made.setSpringFactor(1);  // as the peers have it
        if constexpr (isWet) {
            made.setLiquidBridgeVolume(M::bridgeVolume);
            made.setSurfaceTension(M::surfaceTension);
            made.setContactAngle(0);
        }
        return made;
    }
    void addWalls(const BulkScene& given, const Material* walls, bool isClosed) {
        for (const PeerMesh& mesh : given.meshes) {
            TriangleWall wall;
            wall.setSpecies(walls);
            wall.set(mesh.triangles);
            if (mesh.spin != 0) wall.setAngularVelocity({0, 0, mesh.spin}, Vec3D::Zero());
            wallHandler.copyAndAddObject(wall);
        }
        if (!given.meshes.empty()) return;
        if (given.cylinder > 0) {
            FiniteCylinder wall;
            wall.setSpecies(walls);
            const Vec3D middle(0, 0, 0.5 * (given.lowest.z() + given.highest.z()));
            wall.set(Vec3D::UnitZ(), middle, given.cylinder,
                     given.highest.z() - given.lowest.z() + 8 * PeerMaterial::radius);
            wall.setAngularVelocity({0, 0, given.spin}, Vec3D::Zero());
            wallHandler.copyAndAddObject(wall);
            return;
        }
        const auto plane = [&](const Vec3D& outward, const Vec3D& point) {
            InfiniteWall wall;
            wall.setSpecies(walls);
            wall.set(outward, point);
            wallHandler.copyAndAddObject(wall);
        };
        if (!given.drains) {
            plane(-Vec3D::UnitZ(), given.lowest);
            return;
        }
        if (!given.periodic[0]) plane(-Vec3D::UnitX(), given.lowest), plane(Vec3D::UnitX(), given.highest);
        if (isClosed) {
            plane(-Vec3D::UnitZ(), {0, 0, -PeerMaterial::radius});
            return;
        }
        Outlet below;
        below.setPlane(-Vec3D::UnitZ(), given.lowest);
        this->outletHandler.copyAndAddObject(below);
    }
    void add(const PeerGrain& row, const Material* species) {
        SphericalParticle grain;
        grain.setSpecies(species);
        grain.setRadius(row.radius);
        grain.setPosition(row.position);
        grain.setVelocity(row.velocity);
        if (row.kind == GrainKind::Held) grain.fixParticle();
        particleHandler.copyAndAddObject(grain);
    }
};

using PeerScene = PeerSceneOf<HertzianViscoelasticMindlinSpecies>;
using WetPeerScene = PeerSceneOf<HertzianViscoelasticMindlinLiquidBridgeSoulieSpecies>;

/// Grains and places of a scene that begins at rest: settled by the default at a small step.
inline BulkScene startOf(const std::string& name, std::uint64_t seed) {
    BulkScene scene = bulkScene(name, seed);
    if (!scene.settles) return scene;
    PeerScene settling(scene, true);
    settling.setTimeStep(0.2 * PeerMaterial::rayleighTime());
    settling.acceptUnstableTimeStep();
    settling.initialise();
    settling.step(static_cast<std::size_t>(0.5 / settling.getTimeStep()));
    scene.grains = settling.grainsNow(scene);
    for (PeerGrain& grain : scene.grains) grain.velocity = Vec3D::Zero();
    if (name == "impact") scene.grains.push_back(intruder(scene));
    return scene;
}

}  // namespace pendular::bulk
