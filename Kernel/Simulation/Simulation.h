#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Motion/TimeIntegration.h"
#include "Kernel/Output/LastState.h"
#include "Kernel/Output/Progress.h"
#include "Kernel/Particles/ParticleHandler.h"
#include "Kernel/Simulation/EnergyLedger.h"
#include "Kernel/Simulation/Program.h"
#include "Kernel/Simulation/RunControl.h"
#include "Kernel/Simulation/SceneCheck.h"
#include "Kernel/Simulation/StepTimes.h"
#include "Kernel/State/RestartFile.h"
#include "Kernel/Walls/WallHandler.h"

namespace pendular {

/// What a driver derives from: a scene of grains of species S, and its run.
/// A driver adds species, grains and walls in setupInitialConditions() or before solve(), and overrides
/// hooks.
template <class S>
class Simulation {
public:
    Simulation() { reportUncaughtExceptions(); }
    virtual ~Simulation() = default;
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    virtual void setupInitialConditions() {}
    virtual void actionsBeforeTimeStep() {}
    virtual void actionsAfterTimeStep() {}
    /// Called at the start, after every saveCount steps and at the end.
    virtual void writeOutput() {}
    /// Called when the run has ended, or was asked to stop: files are to be completed here.
    virtual void completeOutput() {}
    /// What the driver itself remembers from step to step, for restart files (StateArchive says how).
    virtual void visitState(StateArchive& /*archive*/) {}
    /// The run ends when this returns false.
    [[nodiscard]] virtual bool continueSolve() const { return true; }

    SpeciesHandler<S> speciesHandler;
    ParticleHandler<S> particleHandler{speciesHandler};
    WallHandler wallHandler;

    /// What the names of files begin with that a run writes by itself; a folder may be in it.
    void setName(std::string beginning) {
        if (beginning.empty())
            throw InputError("Simulation: name is empty; it must have at least one character.");
        name = std::move(beginning);
    }
    /// @param step s
    void setTimeStep(double step) {
        checkValue("Simulation", "time step", step, "s", positive);
        timeStep = step;
    }
    /// @param end s
    void setTimeMax(double end) {
        checkValue("Simulation", "maximum time", end, "s", notNegative);
        timeMax = end;
    }
    /// Steps from one writeOutput() to the next; 0 writes only at the start and at the end.
    void setSaveCount(std::size_t steps) { saveCount = steps; }
    /// From now on output.write(*this) is called before each writeOutput(): addOutput(ParaViewOutput()). If
    /// it has a function prepare(), that is called at once.
    template <class Output>
    void addOutput(Output output) {
        if constexpr (requires { output.prepare(*this); }) output.prepare(*this);
        const auto kept = std::make_shared<Output>(std::move(output));
        outputs.push_back([this, kept] { kept->write(*this); });
        if constexpr (requires { kept->complete(*this); })
            completions.push_back([this, kept] { kept->complete(*this); });
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
    /// Keeps a restart file, NAME-restart.h5: written at the end of the run, and when it is asked to stop.
    /// Throws InputError where this build of Pendular cannot write one.
    void keepRestartFile(bool keep = true) {
        if (keep) requireRestartFiles();
        restarts.kept = keep;
    }
    /// Writes it also after so many steps; 0: does not.
    void setRestartCount(std::size_t steps) { restarts.count = steps; }
    /// Writes it also whenever this time (s of the clock on the wall) has passed; 0: does not.
    void setRestartInterval(double seconds) {
        checkValue("Simulation", "restart interval", seconds, "s", notNegative);
        restarts.interval = seconds;
    }
    /// Goes on from a restart file instead of beginning: initialise() then takes the grains, and all else
    /// that changes in a run, from it. The scene is set up as it was, but for its grains, which are ignored;
    /// the end time, outputs and threads may be others.
    void restartFrom(std::filesystem::path file) { restartSource = std::move(file); }
    [[nodiscard]] bool isRestarted() const { return !restartSource.empty(); }
    [[nodiscard]] std::filesystem::path restartFile() const { return name + "-restart.h5"; }
    /// Writes the state after the last step. Throws InputError if that fails.
    void writeRestart(const std::filesystem::path& file) {
        writeRestartFile(file, [&](StateArchive& archive) {
            visitScene(archive);
            visitContacts(archive);
        });
    }
    /// Shows no progress.
    void setQuiet(bool beQuiet = true) { quiet = beQuiet; }
    /// Runs also with a step above the stability limit. The results of such a run mean nothing.
    void acceptUnstableTimeStep(bool accept = true) { unstableAccepted = accept; }
    /// Keeps account of the energy; costs time, and is off by default.
    void keepEnergyLedger(bool keep = true) { ledgerKept = keep; }

    [[nodiscard]] const std::string& getName() const { return name; }
    [[nodiscard]] double getTime() const { return static_cast<double>(steps) * timeStep; }
    [[nodiscard]] double getTimeStep() const { return timeStep; }
    [[nodiscard]] double getTimeMax() const { return timeMax; }
    [[nodiscard]] std::size_t getNumberOfTimeSteps() const { return steps; }
    [[nodiscard]] int getNumberOfThreads() const { return threads; }
    [[nodiscard]] Vec3D getGravity() const { return toEigen(gravity); }
    [[nodiscard]] const ContactSystem<S>& contacts() const { return contactSystem; }
    /// Measures the time by part of the step.
    void measureStepTimes(bool measure = true) { times.measure(measure); }
    [[nodiscard]] const StepTimes& stepTimes() const { return times; }
    [[nodiscard]] bool keepsEnergyLedger() const { return ledgerKept; }
    [[nodiscard]] const EnergyLedger& energyLedger() const { return ledger; }

    /// The time step (s) above which the stiffest possible contact of this scene is no longer stable.
    [[nodiscard]] double stabilityLimit() {
        speciesHandler.mixAll();
        return sceneStabilityLimit<S>(speciesHandler, particleHandler.store(), wallHandler);
    }

    /// Sets up, and steps until the maximum time. A run that cannot go on ends with a RunError; the grains
    /// and contacts at the end of the last whole step are then in NAME-last-state.csv and
    /// NAME-last-contacts.csv, and writeOutput() was called once more. A run that SIGINT, SIGTERM or the
    /// limit of wall time asks to stop ends with RunStopped, its files complete and at one time.
    void solve() {
        RunControl control(restarts);
        initialise();
        if (!isRestarted()) writeAll();
        try {
            stepToTheEnd(control);
        } catch (const RunError& stop) {
            throw RunError(withLastState(stop.what()));
        }
    }

    /// Checks the scene and computes the forces at its start, or takes them from the restart file. solve()
    /// calls it; a driver that steps by itself does.
    void initialise() {
        setupInitialConditions();
        checkValue("Simulation", "time step", timeStep, "s", positive);
        speciesHandler.mixAll();
        if (isRestarted()) return readRestart();
        smallestRadius = particleHandler.store().smallestRadius();
        prepare();
        contactSystem.refresh(particleHandler.store(), 0, 0);
        refuseInitialOverlaps(contactSystem, particleHandler.store());
        Motion::start(particleHandler.store(), integrator);
        advance(0);  // a step of no length: forces and accelerations at the start
        Motion::start(particleHandler.store(), integrator);
    }

    /// What the outputs and writeOutput() write; a driver that steps by itself calls it.
    void writeAll() {
        const StepTimes::Part before = times.enter(StepTimes::Part::Output);
        for (const auto& output : outputs) output();
        writeOutput();
        times.enter(before);
    }

    /// What completes the outputs; a driver that steps by itself calls it at its end.
    void completeAll() {
        for (const auto& completion : completions) completion();
        completeOutput();
    }

    void step() {
        actionsBeforeTimeStep();
        try {
            advance(timeStep);
        } catch (const RunError&) {
            Motion::takeBack(particleHandler.store(), timeStep, integrator);
            wallHandler.moveTo(getTime());
            throw;
        }
        ++steps;
        actionsAfterTimeStep();
    }

private:
    using Motion = TimeIntegration<S::hasTorque>;
    using Request = RunControl::Request;

    void stepToTheEnd(RunControl& control) {
        std::optional<Progress> progress;
        if (!quiet) progress.emplace(timeMax, getTime(), steps);
        const auto last = static_cast<std::size_t>(std::ceil(timeMax / timeStep * (1 - 1e-12)));
        Request request = control.request(steps);
        while (request != Request::Stop && steps < last && continueSolve()) {
            step();
            if (saveCount > 0 && steps % saveCount == 0) writeAll();
            if (progress && progress->isDue(steps))
                progress->show(getTime(), steps, [this] { return numbers(); });
            request = control.request(steps);
            if (request == Request::WriteRestart) writeRestart(restartFile());
        }
        // Before the last output: a run that goes on from here knows nothing of one that is not due.
        if (restarts.kept) writeRestart(restartFile());
        if (steps > 0 && (saveCount == 0 || steps % saveCount != 0)) writeAll();
        completeAll();
        if (request == Request::Stop)
            throw control.stopped(getTime(), steps, restarts.kept ? restartFile().string() : std::string());
    }

    RunNumbers numbers() const {
        std::size_t acting = 0;
        for (const BlockState& state : contactSystem.store().states)
            acting += static_cast<std::size_t>(std::popcount(unsigned{state.touching} | state.bridged));
        return {particleHandler.getSize(), acting, kineticEnergy(particleHandler.store())};
    }

    /// When species, walls and grains are known.
    void prepare() {
        checkScene<S>(speciesHandler, particleHandler.store(), wallHandler, unstableAccepted ? 0 : timeStep);
        checkPeriodicLengths<S>(speciesHandler, particleHandler.store(), wallHandler, periodic);
        contactSystem.prepare(speciesHandler, wallHandler, periodic, SkinChoice::byCost(smallestRadius),
                              ledgerKept);
    }

    void readRestart() {
        readRestartFile(restartSource, [&](StateArchive& archive) {
            visitScene(archive);
            prepare();
            visitContacts(archive);
        });
    }
    void visitScene(StateArchive& archive) {
        archive.group("species", [&] { speciesHandler.visitState(archive); });
        archive.group("walls", [&] { wallHandler.visitState(archive); });
        archive.same("timeStep", timeStep, "s");
        archive.same("integrator", integrator.name);
        archive.same("ledgerKept", ledgerKept);
        archive.value("steps", steps);
        archive.record<double>("gravity", gravity);
        archive.record<double>("periodic", periodic);
        archive.record<double>("ledger", ledger);
        archive.value("smallestRadius", smallestRadius);
        archive.group("particles", [&] { particleHandler.store().visitState(archive); });
    }
    void visitContacts(StateArchive& archive) {
        archive.group("contacts", [&] { contactSystem.visitState(archive); });
        archive.group("driver", [&] { visitState(archive); });
    }

    /// Writes the state as it is, and adds to a sentence where it is.
    std::string withLastState(std::string sentence) {
        const std::string grains = name + "-last-state.csv", contacts = name + "-last-contacts.csv";
        try {
            writeGrains(grains, particleHandler.store(), sentence);
            writeContacts(contacts, contactSystem, particleHandler.store(), sentence);
            writeAll();
            for (const auto& completion : completions) completion();
        } catch (const std::exception& problem) {
            return fmt::format("{}; writing the last state failed: {}", withoutFullStop(sentence),
                               problem.what());
        }
        return fmt::format("{}; the last whole step is in {} and {}.", withoutFullStop(sentence), grains,
                           contacts);
    }
    static std::string_view withoutFullStop(std::string_view sentence) {
        return sentence.substr(0, sentence.size() - (sentence.ends_with('.') ? 1 : 0));
    }

    void advance(double length) {
        auto& grains = particleHandler.store();
        times.enter(StepTimes::Part::Motion);
        const double grainShift = std::sqrt(Motion::begin(grains, length, threads, integrator));
        refuseRunaway(grainShift);
        const double wallShift = wallHandler.moveTo(getTime() + length);
        times.enter(StepTimes::Part::Search);
        const bool goesRound = ledgerKept && periodic.any();
        const double before = goesRound ? potentialEnergy(grains, gravity) : 0;
        if (contactSystem.refresh(grains, grainShift, wallShift)) {
            if (goesRound) ledger.goRound(before - potentialEnergy(grains, gravity));
            refuseDeepOverlaps(contactSystem.store(), grains, periodic, getTime());
        }
        times.enter(StepTimes::Part::Contacts);
        contactSystem.computeForces(grains, length, integrator.contacts);
        times.enter(StepTimes::Part::Sum);
        Motion::finish(grains, contactSystem.store(), gravity, length, threads, integrator);
        times.enter(StepTimes::Part::Other);
        if (ledgerKept) account(length);
    }

    void account(double length) {
        ledger.add(contactSystem.energies(), length, HasNormalHistory<typename S::Normal>);
        ledger.measureGrains(particleHandler.store(), gravity);
    }

    /// A grain that moves its radius in a step, or whose motion is not a number, ends the run.
    void refuseRunaway(double shift) const {
        if (!(shift <= smallestRadius))
            throw runawayError(particleHandler.store(), smallestRadius, getTime(), timeStep);
    }

    std::string name = "pendular";
    std::vector<std::function<void()>> outputs, completions;
    ContactSystem<S> contactSystem;
    EnergyLedger ledger;
    StepTimes times;
    PeriodicBox periodic;
    Vector<double> gravity{0, 0, 0};
    Integrator integrator = integrators::predictedVelocityVerlet;
    double timeStep = unset;
    double timeMax = 0;
    double smallestRadius = infinity;
    std::size_t saveCount = 0;
    std::size_t steps = 0;
    int threads = 1;
    RestartSchedule restarts;
    std::filesystem::path restartSource;  // empty: a run from its beginning
    bool quiet = false;
    bool unstableAccepted = false;
    bool ledgerKept = false;
};

}  // namespace pendular
