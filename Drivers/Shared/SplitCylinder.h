#pragma once

#include "Drivers/Shared/GrainLattice.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/MercuryNames.h"

namespace pendular {

/// Sizes of a cylinder whose rough floor is split into a disc, which turns about the z axis, and a ring.
struct SplitShape {
    double disc = 0.024, cylinder = 0.036;  // m, radii
    int layers = 8;                         // of loose grains, from which the bed settles
    double rate = 1;                        // rad/s, of the disc
};

/// Grains in such a cylinder. Both parts of the floor are held grains on concentric rings, half a gap away
/// from the split on either side. The grains of the bed have the first identities.
class SplitCylinder : public Simulation<LinearViscoelasticSlidingFrictionSpecies> {
public:
    using Material = LinearViscoelasticSlidingFrictionSpecies;
    static constexpr double radius = 1e-3;  // m, of the largest grain; the others have 0.8 of it and more

    explicit SplitCylinder(const SplitShape& given) : shape(given) {}

    void setupInitialConditions() override {
        auto* const material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500), material->setStiffness(100), material->setDissipation(1.2e-3);
        material->setSlidingStiffness(100 * 2.0 / 7), material->setSlidingDissipation(1.2e-3 * 2.0 / 7);
        material->setSlidingFrictionCoefficient(0.5);
        InfiniteWall floor;  // at the middles of the held grains, so that none falls between two of them
        floor.setSpecies(material), floor.set({0, 0, -1}, {0, 0, -radius});
        wallHandler.copyAndAddObject(floor);
        InfiniteCylinder side;
        side.setSpecies(material), side.set({0, 0, 1}, {0, 0, 0}, shape.cylinder, CylinderSide::Inside);
        wallHandler.copyAndAddObject(side);
        setGravity({0, 0, -9.81}), setTimeStep(3e-5);  // 1/17 of a contact
        if (isRestarted()) return;
        addBed(material);
        bed = particleHandler.getSize();
        for (double r = shape.disc - radius; r > 0; r -= 2 * radius) addRing(material, r);
        discEnd = particleHandler.getSize();
        for (double r = shape.disc + radius; r < shape.cylinder; r += 2 * radius) addRing(material, r);
    }
    void actionsBeforeTimeStep() override {
        const Vec3D turn(0, 0, shape.rate);
        for (std::size_t k = bed; k < discEnd; ++k) {
            if (!particleHandler.contains(k)) continue;  // it is on another rank
            auto grain = particleHandler.getObject(k);
            // That of the middle of the step, so that grains stay on their circle.
            const Vec3D velocity = turn.cross(grain.getPosition());
            grain.setVelocity(velocity + 0.5 * getTimeStep() * turn.cross(velocity));
            grain.setAngularVelocity(turn);
        }
    }
    void visitState(StateArchive& archive) override {
        std::uint64_t first = bed, end = discEnd;
        archive.value("bed", first), archive.value("disc_end", end);
        if (archive.isReading()) bed = first, discEnd = end;
    }

protected:
    [[nodiscard]] std::size_t bedSize() const { return bed; }

private:
    auto add(const Material* material, const GrainRow& row) {
        SphericalParticle grain;
        grain.setSpecies(material), grain.setRadius(row.radius), grain.setPosition(row.position);
        return particleHandler.copyAndAddObject(grain);
    }
    /// On a lattice 1.9 times as high as the bed that they settle to.
    void addBed(const Material* material) {
        const double reach = shape.cylinder, edge = 2 * latticeLooseness * radius;
        const Vec3D high(reach, reach, (shape.layers + 0.5) * edge);
        const auto isInside = [&](const Vec3D& at) { return at.head<2>().norm() < reach - 0.5 * edge; };
        for (const Vec3D& cell : latticeCells({-reach, -reach, 0}, high, edge, isInside))
            add(material, jittered(random.uniform(0.8, 1) * radius, cell, random));
    }
    /// Held grains; their tops are at a height of 0 or a little below.
    void addRing(const Material* material, double r) {
        for (double k = 0, count = std::ceil(constants::pi * r / radius); k < count; ++k) {
            const double a = 2 * constants::pi * k / count;
            const Vec3D place(r * std::cos(a), r * std::sin(a), -radius);
            add(material, {random.uniform(0.8, 1) * radius, place}).fixParticle();
        }
    }

    SplitShape shape;
    std::size_t bed = 0, discEnd = 0;  // how many grains the bed has, and then the bed and the disc
    UniformRandom random{1};
};

}  // namespace pendular
