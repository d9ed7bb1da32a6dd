#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Analysis/Output/WallForceFile.h"
#include "Kernel/Features/Bonds/BondPart.h"
#include "Kernel/Features/Heat/HeatPart.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Mercury/MercuryOutput.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Ranks/SharedInlets.h"
#include "SelfTests/Scenes/SettlingBox.h"

/// Runs with files that ranks share, as threads of a test and as processes.
namespace pendular::ranks {

using Dry = LinearViscoelasticSpecies;
using Wet = HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies;
using Moving = Species<HertzianViscoelastic, Mindlin, LiquidMigration<LiquidBridgeBagheri>>;

inline constexpr std::size_t half = 210, whole = 420;  // steps

/// Six layers of grains that fall and touch, with a table of the driver and all kinds of files.
template <class Box>
class RunWithFiles : public Box {
public:
    /// @param finer of how many steps one is made
    RunWithFiles(const std::filesystem::path& folder, std::size_t steps, std::string_view columns,
                 int finer = 1)
        : Box(6), table(folder / "table.csv", std::string(columns)) {
        this->setQuiet();
        this->setName((folder / "run").string());
        this->setTimeMax(static_cast<double>(steps) * this->getTimeStep());
        const double interval = 100 * this->getTimeStep();
        this->setTimeStep(this->getTimeStep() / finer);
        this->setSaveCount(static_cast<std::size_t>(70 * finer));
        this->keepRestartFile();
        this->addOutput(ParaViewOutput().withInterval(interval));
        this->addOutput(Hdf5Output().withInterval(interval));
        this->addOutput(WallForceFile(interval));
        this->addOutput(MercuryOutput().withEnergies(false));
        if (std::filesystem::exists(this->restartFile())) this->restartFrom(this->restartFile());
    }
    void completeOutput() override { table.close(); }
    void visitState(StateArchive& archive) override { table.visitState(archive); }

protected:
    RunTable table;
};

/// Of wet grains.
class SharedRun : public RunWithFiles<scenes::SettlingBox<Wet>> {
public:
    SharedRun(const std::filesystem::path& folder, std::size_t steps, int finer = 1)
        : RunWithFiles(folder, steps, "time_s,z_m,J", finer) {}
    void writeOutput() override {
        table.row(getTime(), particleHandler.getObject(3).getPosition().z(), getKineticEnergy());
    }
};

/// Of dry grains, of which some are hit from outside between two steps.
class DryRun : public RunWithFiles<scenes::SettlingBox<Dry>> {
public:
    DryRun(const std::filesystem::path& folder, std::size_t steps)
        : RunWithFiles(folder, steps, "time_s,momentum_kg_m_per_s") {}

private:
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 100 != 0) return;
        for (GrainReference grain : particleHandler.ownGrains())
            if (grain.getId() % 3 == 0) grain.setVelocity(grain.getVelocity() + Vec3D(0.3, 0, 0.3));
    }
    void writeOutput() override { table.row(getTime(), getTotalMomentum().x()); }
};

/// With rigid bodies, an account of the energy, and grains that leave at the bottom.
class RichRun : public SharedRun {
public:
    RichRun(const std::filesystem::path& folder, std::size_t steps, int finer = 4)
        : SharedRun(folder, steps, finer) {
        for (std::uint32_t k = 0; k + 1 < 96; k += 8) bodyHandler.join({k, k + 1});
        keepEnergyLedger();
        addOutput(EnergyFile(200 * getTimeStep()));
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0.0018});
        outletHandler.copyAndAddObject(outlet);
        wallHandler.keepForces();
    }
    void writeOutput() override {}
};

/// Clumps of two spheres come as well, with grains between them.
class ClumpRun : public RichRun {
public:
    ClumpRun(const std::filesystem::path& folder, std::size_t steps) : RichRun(folder, steps, 8) {
        letClumpsIn(*this, 0.0186, 0.0212, 6000);
    }
};

/// Grains with films whose liquid moves: they touch, part, come by an inlet and leave at the bottom.
class MovingRun : public RunWithFiles<wet::WetBox<Moving>> {
public:
    MovingRun(const std::filesystem::path& folder, std::size_t steps)
        : RunWithFiles(folder, steps, "time_s,begun,ended,formed,ruptured,films_m3,bridges_m3,walls_m3") {
        listenToContacts();
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0.0018});
        outletHandler.copyAndAddObject(outlet);
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        Inlet inlet;
        inlet.setGrain(grain);
        inlet.setSizes(evenSizes(1.8e-3, 2.1e-3));
        inlet.setRegion(BoxRegion({0.001, 0.001, 0.0186}, {0.0115, 0.0115, 0.0212}));
        inlet.setNumberFlow(5000);
        inletHandler.copyAndAddObject(inlet);
    }

private:
    /// Every other grain is thrown up, so that bridges rupture.
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 120 != 0) return;
        for (GrainReference grain : particleHandler.ownGrains())
            if (grain.getId() % 2 == 0) grain.setVelocity(grain.getVelocity() + Vec3D(0, 0, 1));
    }
    void writeOutput() override {
        const ContactEventCounts& events = contactEventCounts();
        const LiquidLedger liquid = liquidLedger();
        table.row(getTime(), events.touchesBegun, events.touchesEnded, events.bridgesFormed,
                  events.bridgesRuptured, liquid.films, liquid.bridges, liquid.walls);
    }
};

/// Droplets of a spray are caught, and films have mass: so much that the motion is another one.
class SprayedRun : public RunWithFiles<wet::WetBox<Moving>> {
public:
    SprayedRun(const std::filesystem::path& folder, std::size_t steps)
        : RunWithFiles(folder, steps, "time_s,emitted_m3,airborne_m3,lost_m3,films_m3,z_m") {
        setLiquidDensity(1e6);
        setLiquidToCome(1e-9);  // the same quantum for a part of the run
        sprayHandler.copyAndAddObject(rainFrom(0.0205));
    }

private:
    void writeOutput() override {
        const LiquidLedger liquid = liquidLedger();
        table.row(getTime(), liquid.emitted, liquid.airborne, liquid.lost, liquid.films,
                  particleHandler.getObject(3).getPosition().z());
    }
};

/// Grains that conduct heat, from a hot floor and from what their contacts lose.
class HeatedRun : public SharedRun {
public:
    HeatedRun(const std::filesystem::path& folder, std::size_t steps) : SharedRun(folder, steps, 4) {
        const GrainColumnReference temperature = particleHandler.addColumn("temperature", "K", 293);
        for (std::uint32_t k = 0; k < 96; ++k) temperature[k] = 280 + k;
        heat = &addPart<HeatPart>(temperature);
        for (const std::size_t kind : {0u, 1u})
            heat->setMaterial(speciesHandler.getObject(kind), {.conductivity = 1, .heatCapacity = 800});
        heat->holdWall(5, 400);
        heat->heatByContacts();
        keepEnergyLedger();
    }
    void writeOutput() override {
        table.row(getTime(), heat->ledger().fromWalls, heat->ledger().fromContacts);
    }
    HeatPart* heat;
};

/// Chains of grains that bonds join, some of which break; one of the grains leaves the scene.
class BondedRun : public SharedRun {
public:
    BondedRun(const std::filesystem::path& folder, std::size_t steps) : SharedRun(folder, steps, 4) {
        bonds = &addPart<BondPart>();
        const std::size_t cement =
            bonds->addMaterial({.radius = 4e-4,
                                .stiffness = [](const BondSection& s,
                                                double length) { return beamBond(2e6, 8e5, 0.9, s, length); },
                                .strength = {.tensile = 1e5, .shear = 1e5},
                                .damping = 0.1});
        for (std::uint32_t k = 0; k < 96; ++k)
            if (k % 4 < 3) bonds->join(k, k + 1, cement);
        keepEnergyLedger();
        addOutput(EnergyFile(200 * getTimeStep()));
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0.0014});
        outletHandler.copyAndAddObject(outlet);
    }
    void writeOutput() override {
        table.row(getTime(), static_cast<double>(bonds->broken()), energyLedger().fracture);
    }
    BondPart* bonds;
};

}  // namespace pendular::ranks
