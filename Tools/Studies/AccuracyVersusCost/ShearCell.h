#pragma once

#include <algorithm>
#include <numbers>
#include <vector>

#include "Drivers/Shared/BedMaterial.h"
#include "Drivers/Shared/GrainLattice.h"
#include "Drivers/Shared/GrainRows.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Scene/Simulation.h"

// Wet grains between two rough walls that shear them: a small scene whose bulk figures depend on the bridges.

namespace pendular::scenes {

struct ShearCellOptions {
    double radius = 1e-3;  // m
    double elasticModulus =
        1e6;  // Pa: soft, for long steps; a bridge of V* = 0.02 presses grains 0.009 R together
    double solidFraction = 0.57;  // of the sheared cell
    double rate = 10;             // 1/s
    double strainBefore = 1.5, strainMeasured = 3;
    int across = 8;                     // grains, along x and y
    double dimensionlessVolume = 0.02;  // V* of a bridge between two grains
    double contactAngle = std::numbers::pi / 9;
};

/// Means over the time of measurement.
struct ShearFigures {
    double shearStress = 0;       // Pa, - sum of f_x (z1 - z2) / V over the contacts, f the force on body 1
    double wallStress = 0;        // Pa, the same from the force on the upper wall
    double capillaryTension = 0;  // Pa, sum of F_bridge x distance of centres / (3 V)
    double coordination = 0;      // bodies that touch a grain or are bridged with it
};

/// Periodic along x and y, without gravity. Both walls are layers of held grains: the upper one moves along
/// x, and down until the solid fraction is reached.
template <class S>
class ShearCell : public Simulation<S> {
public:
    ShearCell(const ShearCellOptions& choice, std::uint64_t seed) : options(choice) {
        BedMaterial material;
        material.elasticModulus = options.elasticModulus;
        material.liquidVolume = options.dimensionlessVolume * std::pow(options.radius, 3);
        material.contactAngle = options.contactAngle;
        species = this->speciesHandler.copyAndAddObject(material.species<S>());
        const double edge = 2 * latticeLooseness * options.radius;
        width = options.across * edge;
        this->setPeriodic(0, 0, width), this->setPeriodic(1, 0, width);
        addGrains(edge, seed);
        this->setTimeStep(std::min(this->stabilityLimit(), this->shortestContactTime() / 10));
    }

    /// To be called after initialise().
    ShearFigures run() {
        const double speed = options.rate * targetHeight();
        const auto stepsOf = [&](double strain) {
            return std::max<std::size_t>(
                1, static_cast<std::size_t>(strain / (options.rate * this->getTimeStep())));
        };
        const std::size_t before = stepsOf(options.strainBefore), measured = stepsOf(options.strainMeasured);
        // The first half of the strain before is that of compression.
        moveUpperWall(
            {speed, 0, -2 * (height - targetHeight()) / (this->getTimeStep() * static_cast<double>(before))});
        for (std::size_t k = 0; k < before / 2; ++k) this->step();
        height = targetHeight();
        moveUpperWall({speed, 0, 0});
        for (std::size_t k = before / 2; k < before; ++k) this->step();
        ShearFigures sum;
        std::size_t samples = 0;
        for (std::size_t k = 0; k < measured; ++k) {
            this->step();
            if (k % 25 == 0) add(sum), ++samples;
        }
        const double share = 1 / static_cast<double>(samples);
        return {share * sum.shearStress, share * sum.wallStress, share * sum.capillaryTension,
                share * sum.coordination};
    }

private:
    void addGrains(double edge, std::uint64_t seed) {
        UniformRandom random(seed);
        // Two more layers are the walls; the loose lattice is higher than the sheared cell.
        const double top = edge * (options.across + 2 + looseLayers);
        const auto cells =
            latticeCells({0, 0, 0}, {width, width, top}, edge, [](const Vec3D&) { return true; });
        for (const Vec3D& cell : cells) {
            SphericalParticle grain;
            const GrainRow row = jittered(options.radius, cell, random);
            grain.setSpecies(species);
            grain.setRadius(row.radius);
            grain.setPosition(row.position);
            const bool lower = cell.z()<edge, upper = cell.z()> top - edge;
            if (lower || upper) grain.fixParticle();
            else ++freeGrains;
            const auto added = this->particleHandler.copyAndAddObject(grain);
            if (upper) upperWall.push_back(added.getId());
        }
        height = top - edge;
    }
    /// m, between the centres of the walls, of each of which half a layer is inside.
    [[nodiscard]] double targetHeight() const {
        const double inside = static_cast<double>(freeGrains + upperWall.size());
        const double grain = 4.0 / 3 * std::numbers::pi * std::pow(options.radius, 3);
        return inside * grain / (options.solidFraction * width * width);
    }
    [[nodiscard]] bool isOfUpperWall(const TranslationRecord& grain) const {
        return grain.inverseMass == 0 && grain.position.z > 0.5 * height;
    }
    void moveUpperWall(const Vec3D& velocity) {
        for (const std::uint32_t id : upperWall) this->particleHandler.getObject(id).setVelocity(velocity);
    }
    void add(ShearFigures& sum) const {
        const auto& grains = this->particleHandler.store();
        const ContactSystem& contacts = this->contacts();
        const double perVolume = 1 / (width * width * height);
        contacts.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            if (!contacts.acts(contact)) return;
            const TranslationRecord& first = grains.translation[contacts.firstOf(contact)];
            const TranslationRecord& second = grains.translation[contacts.secondOf(contact)];
            const int free = (first.inverseMass > 0) + (second.inverseMass > 0);
            if (free == 0) return;
            const ObservedContact seen = contacts.observe(grains, bucket, contact);
            sum.coordination += static_cast<double>(free) / static_cast<double>(freeGrains);
            sum.capillaryTension +=
                seen.adhesiveForce * (first.radius + second.radius + seen.separation) * perVolume / 3;
            const double force = contacts.forceOf(contact).x;  // on the first
            sum.shearStress -= force * (first.position.z - second.position.z) * perVolume;
            if (isOfUpperWall(first)) sum.wallStress -= force / (width * width);
            if (isOfUpperWall(second)) sum.wallStress += force / (width * width);
        });
    }

    static constexpr int looseLayers = 3;
    ShearCellOptions options;
    const S* species = nullptr;
    std::vector<std::uint32_t> upperWall;
    double width = 0, height = 0;  // m
    std::size_t freeGrains = 0;
};

}  // namespace pendular::scenes
