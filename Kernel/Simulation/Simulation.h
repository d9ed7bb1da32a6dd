#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Motion/VelocityVerlet.h"
#include "Kernel/Output/LastState.h"
#include "Kernel/Output/Progress.h"
#include "Kernel/Particles/ParticleHandler.h"
#include "Kernel/Simulation/EnergyLedger.h"
#include "Kernel/Simulation/Program.h"
#include "Kernel/Simulation/SceneCheck.h"
#include "Kernel/Simulation/StepTimes.h"
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
        outputs.push_back([this, kept = std::make_shared<Output>(std::move(output))] { kept->write(*this); });
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
    /// NAME-last-contacts.csv, and writeOutput() was called once more.
    void solve() {
        initialise();
        writeAll();
        try {
            stepToTheEnd();
        } catch (const RunError& stop) {
            throw RunError(withLastState(stop.what()));
        }
    }

    /// Checks the scene and computes the forces at its start. solve() calls it; a driver that steps by itself
    /// does.
    void initialise() {
        setupInitialConditions();
        checkValue("Simulation", "time step", timeStep, "s", positive);
        speciesHandler.mixAll();
        checkScene<S>(speciesHandler, particleHandler.store(), wallHandler, unstableAccepted ? 0 : timeStep);
        checkPeriodicLengths<S>(speciesHandler, particleHandler.store(), wallHandler, periodic);
        smallestRadius = particleHandler.store().smallestRadius();
        contactSystem.prepare(speciesHandler, wallHandler, periodic, SkinChoice::byCost(smallestRadius),
                              ledgerKept);
        checkOverlaps();
        advance(0);  // a step of no length: forces and accelerations at the start
    }

    /// What the outputs and writeOutput() write; a driver that steps by itself calls it.
    void writeAll() {
        const StepTimes::Part before = times.enter(StepTimes::Part::Output);
        for (const auto& output : outputs) output();
        writeOutput();
        times.enter(before);
    }

    void step() {
        actionsBeforeTimeStep();
        try {
            advance(timeStep);
        } catch (const RunError&) {
            Motion::takeBack(particleHandler.store(), timeStep);
            wallHandler.moveTo(getTime());
            throw;
        }
        ++steps;
        actionsAfterTimeStep();
    }

private:
    using Motion = VelocityVerlet<S::hasTorque>;

    void stepToTheEnd() {
        Progress progress(timeMax, getTime(), steps);
        const auto last = static_cast<std::size_t>(std::ceil(timeMax / timeStep * (1 - 1e-12)));
        while (steps < last && continueSolve()) {
            step();
            if (saveCount > 0 && steps % saveCount == 0) writeAll();
            if (progress.isDue(steps)) progress.show(getTime(), steps, [this] { return numbers(); });
        }
        if (steps > 0 && (saveCount == 0 || steps % saveCount != 0)) writeAll();
    }

    RunNumbers numbers() const {
        std::size_t acting = 0;
        for (const BlockState& state : contactSystem.store().states)
            acting += static_cast<std::size_t>(std::popcount(unsigned{state.touching} | state.bridged));
        return {particleHandler.getSize(), acting, kineticEnergy(particleHandler.store())};
    }

    /// Writes the state as it is, and adds to a sentence where it is.
    std::string withLastState(std::string sentence) {
        const std::string grains = name + "-last-state.csv", contacts = name + "-last-contacts.csv";
        try {
            writeGrains(grains, particleHandler.store(), sentence);
            writeContacts(contacts, contactSystem, particleHandler.store(), sentence);
            writeAll();
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
        const double grainShift = std::sqrt(Motion::begin(grains, length, threads));
        refuseRunaway(grainShift);
        const double wallShift = wallHandler.moveTo(getTime() + length);
        times.enter(StepTimes::Part::Search);
        const bool goesRound = ledgerKept && periodic.any();
        const double before = goesRound ? potentialEnergy(grains, gravity) : 0;
        if (contactSystem.refresh(grains, grainShift, wallShift)) {
            if (goesRound) ledger.goRound(before - potentialEnergy(grains, gravity));
            refuseDeepOverlaps();
        }
        times.enter(StepTimes::Part::Contacts);
        contactSystem.computeForces(grains, length);
        times.enter(StepTimes::Part::Sum);
        Motion::finish(grains, contactSystem.store(), gravity, length, threads);
        times.enter(StepTimes::Part::Other);
        if (ledgerKept) account(length);
    }

    void account(double length) {
        ledger.add(contactSystem.energies(), length);
        ledger.measureGrains(particleHandler.store(), gravity);
    }

    void checkOverlaps() {
        auto& grains = particleHandler.store();
        contactSystem.refresh(grains, 0, 0);
        contactSystem.store().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            refuseOverlap(contactSystem.observe(grains, bucket, contact), smallerRadius(bucket, contact));
        });
    }
    /// At walls, a grain that has gone half its way is followed until its centre crosses the surface.
    void refuseDeepOverlaps() const {
        const auto& store = contactSystem.store();
        store.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            if (bucket.wall >= 0) return;
            const ContactBlock& block = store.blocks[contact / Pack::lanes];
            refuseDeepOverlap(particleHandler.store(), block.first[contact % Pack::lanes],
                              block.second[contact % Pack::lanes], periodic, getTime());
        });
    }
    double smallerRadius(const Bucket& bucket, std::uint32_t contact) const {
        const ContactBlock& block = contactSystem.store().blocks[contact / Pack::lanes];
        const auto& grains = particleHandler.store().translation;
        const double radius1 = grains[block.first[contact % Pack::lanes]].radius;
        return bucket.wall >= 0 ? radius1
                                : std::min(radius1, grains[block.second[contact % Pack::lanes]].radius);
    }

    /// A grain that moves its radius in a step, or whose motion is not a number, ends the run.
    void refuseRunaway(double shift) const {
        if (!(shift <= smallestRadius))
            throw runawayError(particleHandler.store(), smallestRadius, getTime(), timeStep);
    }

    std::string name = "pendular";
    std::vector<std::function<void()>> outputs;
    ContactSystem<S> contactSystem;
    EnergyLedger ledger;
    StepTimes times;
    PeriodicBox periodic;
    Vector<double> gravity{0, 0, 0};
    double timeStep = unset;
    double timeMax = 0;
    double smallestRadius = infinity;
    std::size_t saveCount = 0;
    std::size_t steps = 0;
    int threads = 1;
    bool unstableAccepted = false;
    bool ledgerKept = false;
};

}  // namespace pendular
