#pragma once

#include "Kernel/Output/CsvFile.h"
#include "Kernel/Simulation/EnergyLedger.h"
#include "Kernel/Simulation/SceneCheck.h"
#include "Kernel/Simulation/StepTimes.h"

namespace pendular {

/// NAME-summary.csv, written anew at outputs, once a second at most, and at the end: what runs, with which
/// species and values, how far it is, and what tells whether it is healthy. Tools/summary shows it. Given to
/// Simulation::addOutput(); the time by part of the step is measured from then on.
class RunSummary {
public:
    template <class Scene>
    void prepare(Scene& scene) {
        scene.measureStepTimes();
    }

    template <class Scene>
    void write(const Scene& scene) {
        if (Clock::now() >= next) complete(scene);
    }

    template <class Scene>
    void complete(const Scene& scene) {
        next = Clock::now() + std::chrono::seconds(1);
        CsvFile file(scene.getName() + "-summary.csv", "quantity,value,unit");
        writeRun(file, scene);
        writeHealth(file, scene);
        writeSpecies(file, scene.speciesHandler);
        const StepTimes& times = scene.stepTimes();
        for (std::size_t part = 0; part < StepTimes::names.size(); ++part)
            file.row(fmt::format("wall time: {}", StepTimes::names[part]), times.seconds(part), "s");
        file.close();
    }

private:
    template <class Scene>
    static void writeRun(CsvFile& file, const Scene& scene) {
        const bool atEnd = scene.getTime() >= scene.getTimeMax() * (1 - 1e-12) || !scene.continueSolve();
        file.row("name", scene.getName(), "");
        file.row("state", atEnd ? "at its end" : "on its way", "");
        file.row("time", scene.getTime(), "s");
        file.row("end time", scene.getTimeMax(), "s");
        file.row("steps", scene.getNumberOfTimeSteps(), "");
        file.row("time step", scene.getTimeStep(), "s");
        file.row("stability limit",
                 sceneStabilityLimit(scene.speciesHandler, scene.particleHandler.store(), scene.wallHandler),
                 "s");
        file.row("threads", scene.getNumberOfThreads(), "");
        file.row("grains", scene.particleHandler.getSize(), "");
        file.row("walls", scene.wallHandler.getSize(), "");
        const Vec3D g = scene.getGravity();
        file.row("gravity", fmt::format("{} {} {}", g.x(), g.y(), g.z()), "m/s^2");
    }

    template <class Scene>
    void writeHealth(CsvFile& file, const Scene& scene) {
        const auto& grains = scene.particleHandler.store();
        const auto& contacts = scene.contacts();
        std::size_t touching = 0, bridged = 0;
        contacts.store().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            if (!contacts.store().acts(contact)) return;
            const ObservedContact seen = contacts.observe(grains, bucket, contact);
            const auto radius = [&](std::uint32_t k) { return grains.translation[grains.place[k]].radius; };
            double smaller = radius(seen.particle1);
            if (bucket.wall < 0) smaller = std::min(smaller, radius(seen.particle2));
            deepest = std::max(deepest, -seen.separation / smaller);
            touching += seen.separation < 0 ? 1 : 0;
            bridged += seen.bridged ? 1 : 0;
        });
        double speed2 = 0;
        for (const TranslationRecord& grain : grains.translation)
            speed2 = std::max(speed2, squaredNorm(grain.velocity));
        file.row("touching contacts", touching, "");
        file.row("bridges", bridged, "");
        file.row("lists of contacts made", contacts.rebuildCount(), "");
        file.row("largest overlap at an output", deepest, "of the smaller radius");
        file.row("largest speed", std::sqrt(speed2), "m/s");
        file.row("kinetic energy", kineticEnergy(grains), "J");
        if (!scene.keepsEnergyLedger()) return;
        const EnergyLedger& ledger = scene.energyLedger();
        if (isFirst) firstTotal = ledger.total();
        isFirst = false;
        file.row("energy lost in dashpots", ledger.dissipated, "J");
        file.row("energy given to friction", ledger.tangential, "J");
        file.row("energy unaccounted for", ledger.total() - firstTotal, "J");
    }

    template <class S>
    static void writeSpecies(CsvFile& file, const SpeciesHandler<S>& handler) {
        file.row("species", S::name, "");
        for (std::size_t k = 0; k < handler.getSize(); ++k) {
            const auto owner = fmt::format("species {}", k);
            file.row(owner + ": density", handler.getObject(k)->getDensity(), "kg/m^3");
            const auto index = static_cast<int>(k);
            handler.mixture(index, index).forEachLaw([&]<class Law>(const Law& law) {
                for (const auto& field : Law::fields())
                    file.row(fmt::format("{}: {}", owner, field.name), law.*field.member, field.unit);
            });
        }
    }

    using Clock = std::chrono::steady_clock;

    Clock::time_point next = Clock::now();
    double deepest = 0;     // of the smaller radius
    double firstTotal = 0;  // J
    bool isFirst = true;
};

}  // namespace pendular
