#pragma once

#include <memory>

#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Motion/TimeIntegration.h"
#include "Kernel/Output/LastState.h"
#include "Kernel/Particles/ParticleHandler.h"
#include "Kernel/Simulation/EnergyAccount.h"
#include "Kernel/Simulation/Run.h"
#include "Kernel/Simulation/SceneCheck.h"
#include "Kernel/Simulation/SceneDomain.h"
#include "Kernel/Walls/WallHandler.h"

namespace pendular {

/// What a driver derives from: a scene of grains of species S, and its run.
/// A driver adds species, grains and walls in setupInitialConditions() or before solve(), and overrides
/// hooks.
template <class S>
class Simulation : public Run {
public:
    virtual void setupInitialConditions() {}

    SpeciesHandler<S> speciesHandler;
    ParticleHandler<S> particleHandler{speciesHandler};
    WallHandler wallHandler;

    /// From now on output.write(*this) is called before each writeOutput(): addOutput(ParaViewOutput()). If
    /// it has a function prepare(), that is called at once, and again when the scene is set up;
    /// visitState(archive, *this) is what it remembers.
    template <class Output>
    void addOutput(Output output) {
        const auto kept = std::make_shared<Output>(std::move(output));
        KeptOutput calls{.write = [this, kept] { kept->write(*this); }};
        if constexpr (requires { kept->prepare(*this); }) {
            kept->prepare(*this);
            calls.prepare = [this, kept] { kept->prepare(*this); };
        }
        if constexpr (requires { kept->complete(*this); })
            calls.complete = [this, kept] { kept->complete(*this); };
        if constexpr (requires(StateArchive archive) { kept->visitState(archive, *this); })
            calls.visitState = [this, kept](StateArchive& archive) { kept->visitState(archive, *this); };
        keepOutput(std::move(calls));
    }
    /// @param acceleration m/s^2
    void setGravity(const Vec3D& acceleration) {
        for (const double part : acceleration) checkValue("Simulation", "gravity", part, "m/s^2", anyFinite);
        gravity = toVector(acceleration);
    }
    /// The scene repeats itself along an axis (0, 1, 2: x, y, z) from lowest to highest (m). The length must
    /// be at least twice the largest distance of two centres at which grains act on each other.
    void setPeriodic(int axis, double lowest, double highest) {
        checkValue("Simulation", "periodic axis", axis, "", fromZeroTo(2));
        checkValue("Simulation", "periodic length", highest - lowest, "m", positive);
        double Vector<double>::*const along[] = {&Vector<double>::x, &Vector<double>::y, &Vector<double>::z};
        periodic.lowest.*along[axis] = lowest;
        periodic.length.*along[axis] = highest - lowest;
    }
    /// OpenMP threads, at least 1; the results do not depend on their number.
    void setNumberOfThreads(int count) {
        checkValue("Simulation", "number of threads", count, "", {1, 4096});
        threads = count;
        contactSystem.setThreads(count);
    }
    /// How velocities follow from forces; before the run. The README of Kernel/Motion compares them.
    void setIntegrator(const Integrator& scheme) { integrator = scheme; }
    /// Runs also with a step above the stability limit. That is sound only where overlaps stay so small that
    /// the contacts are softer than those of the limit, or where no bed comes to rest; else the results mean
    /// nothing.
    void acceptUnstableTimeStep(bool accept = true) { unstableAccepted = accept; }
    /// Keeps account of the energy; costs time, and is off by default.
    void keepEnergyLedger(bool keep = true) { ledgerKept = keep; }

    [[nodiscard]] bool acceptsUnstableTimeStep() const { return unstableAccepted; }
    [[nodiscard]] int getNumberOfThreads() const { return threads; }
    [[nodiscard]] Vec3D getGravity() const { return toEigen(gravity); }
    [[nodiscard]] const ContactSystem<S>& contacts() const { return contactSystem; }
    [[nodiscard]] bool keepsEnergyLedger() const { return ledgerKept; }
    [[nodiscard]] const EnergyLedger& energyLedger() const { return ledger; }
    /// J: what the ledger's total has changed by since the scene began, before any restart.
    [[nodiscard]] double energyUnaccountedFor() const { return ledger.total() - energyAtStart; }

    /// The time step (s) above which the stiffest possible contacts of this scene, in the densest bed, are no
    /// longer stable: by their springs and dashpots, and the integrator.
    [[nodiscard]] double stabilityLimit() {
        speciesHandler.mixAll();
        return sceneStabilityLimit<S>(speciesHandler, particleHandler.store(), wallHandler, integrator);
    }
    [[nodiscard]] const Integrator& getIntegrator() const { return integrator; }
    /// Half a period (s) of the fastest oscillation of two grains: about the shortest time of a contact, for
    /// steps that are as accurate as is wanted (the README of Kernel/Motion says which).
    [[nodiscard]] double shortestContactTime() {
        speciesHandler.mixAll();
        return shortestHalfPeriod<S>(speciesHandler, particleHandler.store(), wallHandler);
    }

    void initialise() override {
        setupInitialConditions();
        prepareOutputs();
        requireTimeStep();
        speciesHandler.mixAll();
        if (isRestarted()) return readRestart();
        smallestRadius = particleHandler.store().smallestRadius();
        prepare();
        contactSystem.refresh(particleHandler.store(), 0, 0);
        refuseInitialOverlaps(contactSystem, particleHandler.store());
        Motion::start(particleHandler.store(), integrator);
        advance(0);  // a step of no length: forces and accelerations at the start
        energyAtStart = ledger.total();
        Motion::start(particleHandler.store(), integrator);
    }

private:
    using Motion = TimeIntegration<S::hasTorque>;

    void advanceByStep() override {
        try {
            advance(getTimeStep());
        } catch (const RunError&) {
            Motion::takeBack(particleHandler.store(), getTimeStep(), integrator);
            wallHandler.moveTo(getTime());
            if (ledgerKept) account.takeBack(ledger);
            throw;
        }
    }

    [[nodiscard]] RunNumbers numbers() const override {
        std::size_t acting = 0;
        for (const BlockState& state : contactSystem.store().states)
            acting += static_cast<std::size_t>(std::popcount(unsigned{state.touching} | state.bridged));
        return {particleHandler.getSize(), acting, kineticEnergy(particleHandler.store())};
    }

    /// When species, walls and grains are known.
    void prepare() {
        checkScene<S>(speciesHandler, particleHandler.store(), wallHandler,
                      unstableAccepted ? 0 : getTimeStep(), integrator);
        checkPeriodicLengths<S>(speciesHandler, particleHandler.store(), wallHandler, periodic);
        contactSystem.prepare(speciesHandler, wallHandler, periodic, SkinChoice::byCost(smallestRadius),
                              ledgerKept);
        if (isQuiet()) return;
        for (const BrokenLimit& broken :
             brokenLimits<S>(speciesHandler, particleHandler.store(), wallHandler))
            fmt::print(stderr, "Warning: {}.\n", broken.text());
        warnOfFedSprings();
    }

    void warnOfFedSprings() const {
        const double fewest = fewestStepsToDouble<S>(speciesHandler, particleHandler.store(), wallHandler,
                                                     integrator, getTimeStep());
        if (fewest > 1e7) return;
        const std::string time = fewest < 1 ? "less than one step" : fmt::format("some {:.0f} steps", fewest);
        fmt::print(stderr,
                   "Warning: {}: its springs have too weak dashpots for a time step of {:.3g} s, at which "
                   "motions of grains at rest may double in {}; give it a larger dissipation, "
                   "or take a smaller step or integrators::velocityVerlet.\n",
                   S::Friction::name, getTimeStep(), time);
    }

    void visitAll(StateArchive& archive) override {
        visitScene(archive);
        if (archive.isReading()) prepare();
        archive.group("contacts", [&] { contactSystem.visitState(archive, particleHandler.store()); });
        visitOutputs(archive);
    }
    void visitScene(StateArchive& archive) {
        archive.group("species", [&] { speciesHandler.visitState(archive); });
        archive.group("walls", [&] { wallHandler.visitState(archive); });
        visitSteps(archive);
        archive.same("integrator", integrator.name);
        archive.same("ledgerKept", ledgerKept, {},
                     "the energy ledger is kept from the begin of a run to its end or not at all, so give "
                     "--energy-interval-s (or keepEnergyLedger()) as it was: above 0 where the file has 1, 0 "
                     "where it has 0");
        archive.finite("gravity", gravity);
        archive.finite("periodic", periodic);
        archive.finite("ledger", ledger);
        archive.finite("energyAtStart", energyAtStart);
        archive.value("smallestRadius", smallestRadius);
        archive.require(smallestRadius > 0, "smallestRadius", "is not positive");
        archive.group("particles", [&] { particleHandler.visitState(archive); });
    }
    void writeLastState(const std::filesystem::path& grains, const std::filesystem::path& contacts,
                        const std::string& remark) override {
        writeGrains(grains, particleHandler.store(), remark);
        writeContacts(contacts, contactSystem, particleHandler.store(), remark);
    }

    void advance(double length) {
        auto& grains = particleHandler.store();
        intoLedger([&] { account.begin(grains, gravity, length, ledger); });
        enter(StepTimes::Part::Motion);
        const double grainShift = std::sqrt(Motion::begin(grains, length, threads, integrator));
        refuseRunaway(grainShift);
        const double wallShift = wallHandler.moveTo(getTime() + length);
        enter(StepTimes::Part::Search);
        intoLedger([&] { account.moved(grains, gravity, ledger); });
        if (contactSystem.refresh(grains, grainShift, wallShift)) {
            if (periodic.any()) intoLedger([&] { account.wentRound(grains, gravity, ledger); });
            refuseDeepOverlaps(contactSystem.store(), grains, periodic, getTime());
        }
        enter(StepTimes::Part::Contacts);
        contactSystem.computePairForces(grains, length, integrator.contacts);
        enter(StepTimes::Part::Walls);
        contactSystem.computeWallForces(grains, length, integrator.contacts);
        enter(StepTimes::Part::Sum);
        Motion::finish(grains, contactSystem.store(), gravity, length, threads, integrator);
        enter(StepTimes::Part::Other);
        intoLedger([&] { account.finish(grains, contactSystem, gravity, length, integrator, ledger); });
    }
    template <class Entries>
    void intoLedger(Entries&& make) {
        if (!ledgerKept) return;
        const StepTimes::Part before = enter(StepTimes::Part::Ledger);
        make();
        enter(before);
    }

    /// A grain that moves its radius in a step, or whose motion is not a number, ends the run.
    void refuseRunaway(double shift) const {
        if (!(shift <= smallestRadius))
            throw runawayError(particleHandler.store(), smallestRadius, getTime(), getTimeStep());
    }

    ContactSystem<S> contactSystem;
    EnergyLedger ledger;
    EnergyAccount<S> account;
    PeriodicBox periodic;
    Vector<double> gravity{0, 0, 0};
    Integrator integrator = integrators::predictedVelocityVerlet;
    double smallestRadius = infinity;
    double energyAtStart = 0;  // J, of the ledger
    int threads = 1;
    bool unstableAccepted = false;
    bool ledgerKept = false;
};

}  // namespace pendular
