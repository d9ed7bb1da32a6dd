#include "Kernel/Simulation/Scene.h"

#include "Kernel/Motion/TimeIntegration.h"
#include "Kernel/Output/LastState.h"
#include "Kernel/Simulation/SceneCheck.h"
#include "Kernel/Simulation/SceneDomain.h"

namespace pendular {

using Motion = TimeIntegration;

void Scene::setGravity(const Vec3D& acceleration) {
    for (const double part : acceleration) checkValue("Simulation", "gravity", part, "m/s^2", anyFinite);
    gravity = toVector(acceleration);
}

void Scene::setPeriodic(int axis, double lowest, double highest) {
    checkValue("Simulation", "periodic axis", axis, "", fromZeroTo(2));
    checkValue("Simulation", "periodic length", highest - lowest, "m", positive);
    double Vector<double>::*const along[] = {&Vector<double>::x, &Vector<double>::y, &Vector<double>::z};
    periodic.lowest.*along[axis] = lowest;
    periodic.length.*along[axis] = highest - lowest;
}

void Scene::setNumberOfThreads(int count) {
    checkValue("Simulation", "number of threads", count, "", {1, 4096});
    threads = count;
    contactSystem.setThreads(count);
}

double Scene::stabilityLimit() {
    laws().mixAll();
    return sceneStabilityLimit(laws(), particleHandler.store(), wallHandler, integrator);
}

double Scene::shortestContactTime() {
    laws().mixAll();
    return shortestHalfPeriod(laws(), particleHandler.store(), wallHandler);
}

void Scene::initialise() {
    setupInitialConditions();
    prepareOutputs();
    requireTimeStep();
    laws().mixAll();
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

void Scene::advanceByStep() {
    try {
        advance(getTimeStep());
    } catch (const RunError&) {
        Motion::takeBack(particleHandler.store(), getTimeStep(), integrator);
        wallHandler.moveTo(getTime());
        if (ledgerKept) account.takeBack(ledger);
        throw;
    }
}

RunNumbers Scene::numbers() const {
    std::size_t acting = 0;
    for (const BlockState& state : contactSystem.store().states)
        acting += static_cast<std::size_t>(std::popcount(unsigned{state.touching} | state.bridged));
    return {particleHandler.getSize(), acting, kineticEnergy(particleHandler.store())};
}

void Scene::prepare() {
    checkScene(laws(), particleHandler.store(), wallHandler, unstableAccepted ? 0 : getTimeStep(),
               integrator);
    checkPeriodicLengths(laws(), particleHandler.store(), wallHandler, periodic);
    contactSystem.prepare(laws(), wallHandler, periodic, SkinChoice::byCost(smallestRadius), ledgerKept);
    if (isQuiet()) return;
    for (const BrokenLimit& broken : brokenLimits(laws(), particleHandler.store(), wallHandler))
        fmt::print(stderr, "Warning: {}.\n", broken.text());
    warnOfFedSprings();
}

void Scene::warnOfFedSprings() const {
    const double fewest =
        fewestStepsToDouble(laws(), particleHandler.store(), wallHandler, integrator, getTimeStep());
    if (fewest > 1e7) return;
    const std::string time = fewest < 1 ? "less than one step" : fmt::format("some {:.0f} steps", fewest);
    fmt::print(stderr,
               "Warning: {}: its springs have too weak dashpots for a time step of {:.3g} s, at which "
               "motions of grains at rest may double in {}; give it a larger dissipation, "
               "or take a smaller step or integrators::velocityVerlet.\n",
               laws().friction, getTimeStep(), time);
}

void Scene::visitAll(StateArchive& archive) {
    visitScene(archive);
    if (archive.isReading()) prepare();
    archive.group("contacts", [&] { contactSystem.visitState(archive, particleHandler.store()); });
    visitOutputs(archive);
}

void Scene::visitScene(StateArchive& archive) {
    archive.group("species", [&] { laws().visitState(archive); });
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
    archive.finite("approachUnseen", approachUnseen);
    archive.value("smallestRadius", smallestRadius);
    archive.require(smallestRadius > 0, "smallestRadius", "is not positive");
    archive.group("particles", [&] { particleHandler.visitState(archive); });
}

void Scene::writeLastState(const std::filesystem::path& grains, const std::filesystem::path& contacts,
                           const std::string& remark) {
    writeGrains(grains, particleHandler.store(), remark);
    writeContacts(contacts, contactSystem, particleHandler.store(), remark);
}

void Scene::advance(double length) {
    auto& grains = particleHandler.store();
    intoLedger([&] { account.begin(grains, gravity, length, ledger); });
    enter(StepTimes::Part::Motion);
    const double grainShift = std::sqrt(Motion::begin(grains, length, threads, integrator));
    refuseRunaway(grainShift);
    const double wallShift = wallHandler.moveTo(getTime() + length);
    enter(StepTimes::Part::Search);
    intoLedger([&] { account.moved(grains, gravity, ledger); });
    bringBack(grains);
    contactSystem.refresh(grains, grainShift, wallShift);
    lookForDeepOverlaps(grains, 2 * grainShift);
    enter(StepTimes::Part::Contacts);
    contactSystem.computePairForces(grains, length, integrator.contacts);
    enter(StepTimes::Part::Walls);
    contactSystem.computeWallForces(grains, length, integrator.contacts);
    enter(StepTimes::Part::Sum);
    Motion::finish(grains, contactSystem.store(), gravity, length, threads, integrator);
    enter(StepTimes::Part::Other);
    intoLedger([&] { account.finish(grains, contactSystem, gravity, length, integrator, ledger); });
}

void Scene::bringBack(ParticleStore& grains) {
    if (!periodic.any() || getNumberOfTimeSteps() % stepsBetweenBringingBack != 0) return;
    for (TranslationRecord& grain : grains.translation) grain.position = periodic.wrap(grain.position);
    intoLedger([&] { account.wentRound(grains, gravity, ledger); });
}

void Scene::lookForDeepOverlaps(const ParticleStore& grains, double approach) {
    approachUnseen += approach;
    if (approachUnseen < 0.1 * smallestRadius) return;
    approachUnseen = 0;
    refuseDeepOverlaps(contactSystem.store(), grains, periodic, getTime());
}

void Scene::refuseRunaway(double shift) const {
    if (!(shift <= smallestRadius))
        throw runawayError(particleHandler.store(), smallestRadius, getTime(), getTimeStep());
}

}  // namespace pendular
