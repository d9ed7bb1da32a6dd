#include "Kernel/Simulation/Scene.h"

#include <algorithm>

#include "Kernel/Motion/TimeIntegration.h"
#include "Kernel/Output/LastState.h"
#include "Kernel/Parallel.h"
#include "Kernel/Simulation/SceneCheck.h"
#include "Kernel/Simulation/SceneDomain.h"

namespace pendular {

using Motion = TimeIntegration;

Scene::Scene() {
    // A grain that is removed takes the energy of its contacts with it; that of its motion the ledger sees.
    particleHandler.callBeforeRemoval([this](std::uint32_t place) {
        bookEnded(contactSystem.endContactsOf(particleHandler.store(), place));
    });
    particleHandler.callToFinishStep([this] { finishLeftStep(); });
    wallHandler.callBeforeRemoval(
        [this](int wall) { bookEnded(contactSystem.endContactsAtWall(particleHandler.store(), wall)); });
}

void Scene::bookEnded(double stored) {
    if (ledgerKept) ledger.driver -= stored;
}

std::vector<ObservedContact> Scene::interactions() const {
    std::vector<ObservedContact> all;
    const ParticleStore& grains = particleHandler.store();
    contactSystem.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        all.push_back(contactSystem.observe(grains, bucket, contact));
    });
    return all;
}

std::vector<ObservedContact> Scene::interactionsOf(std::size_t identity) const {
    std::vector<ObservedContact> all;
    const std::uint32_t place = particleHandler.placeOf(identity);
    contactSystem.forEachActingOf(place, [&](const Bucket& bucket, std::uint32_t contact) {
        all.push_back(contactSystem.observe(particleHandler.store(), bucket, contact));
    });
    return all;
}

Vec3D Scene::contactForceOn(std::size_t identity) const {
    Vector<double> sum{0, 0, 0};
    for (const ObservedContact& contact : interactionsOf(identity))
        sum += contact.particle1 == identity ? contact.force : -contact.force;
    return toEigen(sum);
}

void Scene::setGravity(const Vec3D& acceleration) {
    for (const double part : acceleration) checkValue("Simulation", "gravity", part, "m/s^2", anyFinite);
    particleHandler.finishStep();  // with the gravity that it had
    gravity = toVector(acceleration);
    particleHandler.setGravity(gravity);
    gravityChanged |= hasBegun();
}

void Scene::setPeriodic(int axis, double lowest, double highest) {
    requireSetUp("periodic length");
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
    mixChangedLaws();
    return sceneStabilityLimit(laws(), {particleHandler.store(), laws().speciesCount()}, wallHandler,
                               integrator);
}

double Scene::stabilityLimit(std::span<const SphericalParticle> toCome) {
    mixChangedLaws();
    ParticleStore grains = particleHandler.store();
    for (const SphericalParticle& grain : toCome) {
        const double mass = particleHandler.massOf(grain.getRadius(), grain.getSpeciesIndex());
        grains.add({{0, 0, 0}, grain.getRadius(), {0, 0, 0}, grain.isFixed() ? 0 : 1 / mass}, {0, 0, 0},
                   static_cast<std::uint16_t>(grain.getSpeciesIndex()));
    }
    return sceneStabilityLimit(laws(), {grains, laws().speciesCount()}, wallHandler, integrator);
}

double Scene::shortestContactTime() {
    mixChangedLaws();
    return shortestHalfPeriod(laws(), {particleHandler.store(), laws().speciesCount()}, wallHandler);
}

/// Of a run that goes on for longer than it was planned.
static void refuseMoreSpray(const GrainFilms& films, const SprayHandler& sprays, double time,
                            double timeMax) {
    const double more = sprays.volumeBy(timeMax) - sprays.volumeBy(time);
    if (films.areKept() && films.objectionToMore(more))
        throw InputError(fmt::format(
            "Simulation: time max = {:.6g} s; the sprays emit up to {:.6g} m^3 from {:.6g} s until then, and "
            "the run "
            "was begun for less liquid; say by setLiquidToCome() how much will come, and begin it again.",
            timeMax, more, time));
}

static void refuseUnlessBridgesJoin(const ContactLaws& laws, double gap) {
    const auto count = static_cast<int>(laws.speciesCount());
    for (int a = 0; a < count; ++a)
        for (int b = a; b < count; ++b)
            if (laws.ofPair(a, b).formsAtContact && !laws.liquidRules(a, b)) return;
    throw InputError(
        fmt::format("Simulation: gap of bridges at the start = {:.6g} m, but no species has bridges of a "
                    "volume of their own "
                    "that form at a touch; leave joinAtStart() out, or take such a species.",
                    gap));
}

void Scene::setUp() {
    setupInitialConditions();
    prepareOutputs();
    requireTimeStep();
    laws().mixAll();
    particleHandler.settleSpin();
    if (!isRestarted()) particleHandler.renewMasses();
    particleHandler.films().settle(particleHandler.store(), laws().layout.liquid > 0);
    refuseLiquidThatCannotMove();
    if (isRestarted()) {
        readRestart();
        return refuseMoreSpray(particleHandler.films(), sprayHandler, getTime(), getTimeMax());
    }
    beginLiquid();
    prepare();
    ParticleStore& grains = particleHandler.store();
    contactSystem.refresh(grains, 0, 0);
    if (gapOfFirstBridges > 0) {
        refuseUnlessBridgesJoin(laws(), gapOfFirstBridges);
        contactSystem.join(grains, gapOfFirstBridges);
    }
    refuseInitialOverlaps(contactSystem, grains, [](auto&&...) { return true; });
    Motion::start(grains, integrator);
    advance(0, false);  // a step of no length: forces and accelerations at the start
    energyAtStart = ledger.total();
    Motion::start(grains, integrator);
    tellEvents();
}

void Scene::advanceByStep(bool another) {
    takeOverChanges();
    emitDroplets();
    try {
        advance(getTimeStep(), another);
    } catch (const RunError&) {
        Motion::takeBack(particleHandler.store(), getTimeStep(), integrator);
        if (!particleHandler.store().bodies.empty()) bodyMotion.takeBack(particleHandler.store());
        wallHandler.moveTo(getTime());
        if (ledgerKept) account.takeBack(ledger);
        throw;
    }
}

void Scene::tellEvents() {
    for (const ContactEvent& event : contactSystem.events().ofStep()) actionsOnContactEvent(event);
}

void Scene::check() {
    refuseForBodies(particleHandler.store().bodies);
    GrainSizes sizes(particleHandler.store(), laws().speciesCount());
    checkScene(laws(), sizes, wallHandler, unstableAccepted ? 0 : getTimeStep(), integrator);
    checkPeriodicLengths(laws(), sizes, wallHandler, periodic);
    checkedStep = getTimeStep();
    wallHandler.changesAreKnown();
    const double smallest = sizes.smallest();
    checkedSizes = std::move(sizes);
    if (hasBegun() && smallest < smallestRadius) contactSystem.setSmallestRadius(smallest);
    smallestRadius = std::min(smallestRadius, smallest);
}

void Scene::refuseForBodies(const RigidBodies& bodies) const {
    if (bodies.empty()) return;
    if (ledgerKept)
        throw InputError("Simulation: the energy ledger does not know rigid bodies; leave it out.");
    if (integrator.remembersEarlier())
        throw InputError(
            fmt::format("Simulation: the integrator {} does not move rigid bodies; take "
                        "integrators::predictedVelocityVerlet or velocityVerlet.",
                        integrator.name));
}

void Scene::mixChangedLaws() {
    if (!laws().hasChanged()) return;
    laws().mixAll();
    lawsAreNew = true;
}

void Scene::takeOverChanges() {
    try {
        mixChangedLaws();
        const bool newLaws = std::exchange(lawsAreNew, false), changedWalls = wallHandler.hasChanges();
        const auto firstNewWall = static_cast<int>(wallHandler.firstNewWall());
        if (!newLaws && !changedWalls && getTimeStep() == checkedStep && !particleHandler.hasChanges())
            return;
        const GrainChanges changes = particleHandler.takeChanges();
        if (newLaws) {
            ContactLayout asked = laws().layout;
            asked.named = contactSystem.columns().size();
            if (asked != contactSystem.store().memory.getLayout())
                throw InputError(
                    "Simulation: a species was added in the run whose contacts remember more, or have "
                    "friction "
                    "where no others have; add it before the run begins.");
            particleHandler.renewMasses();
            if (liquidDensity > 0) weighFilms(particleHandler.store());
            speciesChanged = true;
        }
        const bool newBodies = changedWalls || !changes.placed.empty() || !changes.altered.empty();
        if (newLaws || newBodies || getTimeStep() != checkedStep || isNewToChecks(changes.added)) check();
        ParticleStore& grains = particleHandler.store();
        const bool isRenewed = newLaws || newBodies;
        if (!isRenewed && contactSystem.takeIn(grains, changes.added)) return;
        bookEnded(contactSystem.renew(grains));
        refuseOverlapsOf(changes, firstNewWall);
    } catch (const InputError& refusal) {
        throw RunError(refusal.what());
    }
}

bool Scene::isNewToChecks(std::span<const std::uint32_t> added) const {
    const ParticleStore& grains = particleHandler.store();
    if (!added.empty() && grains.count() <= contactsInDensestBed + added.size()) return true;
    return std::ranges::any_of(added, [&](std::uint32_t identity) {
        const std::uint32_t place = grains.place[identity];
        const TranslationRecord& grain = grains.translation[place];
        return !checkedSizes.hold(grains.species[place], grain.radius, grain.inverseMass > 0);
    });
}

/// Of bodies that were put where they are.
void Scene::refuseOverlapsOf(const GrainChanges& changes, int firstNewWall) const {
    const ParticleStore& grains = particleHandler.store();
    std::vector<bool> isNew(grains.size());
    for (const auto* identities : {&changes.added, &changes.placed})
        for (const std::uint32_t identity : *identities) isNew[grains.place[identity]] = true;
    refuseInitialOverlaps(contactSystem, grains,
                          [&](const Bucket& bucket, std::uint32_t first, std::uint32_t second) {
                              return isNew[first] || isNew[second] || bucket.wall >= firstNewWall;
                          });
}

RunNumbers Scene::numbers() const {
    std::size_t acting = 0;
    for (const BlockState& state : contactSystem.store().states)
        acting += static_cast<std::size_t>(std::popcount(unsigned{state.touching} | state.bridged));
    return {particleHandler.getSize(), acting, kineticEnergy(particleHandler.store())};
}

void Scene::prepare() {
    check();
    static_cast<void>(particleHandler.takeChanges());
    particleHandler.closeColumns();
    lawsAreNew = false;
    GrainFilms& films = particleHandler.films();
    if (films.areKept()) keepOutput({.write = [this] { requireLiquid(); }});
    setHasBegun();
    sprayHandler.close();
    contactSystem.prepare(laws(), wallHandler, periodic, SkinChoice::byCost(smallestRadius), ledgerKept,
                          films.areKept() ? &films : nullptr);
    if (isQuiet()) return;
    if (threads > processorCount())
        logger(LogLevel::Warn, "{} threads share {} processors; the run is slower than with {}.", threads,
               processorCount(), processorCount());
    for (const BrokenLimit& broken : brokenLimits(laws(), checkedSizes, wallHandler))
        logger(LogLevel::Warn, "{}.", broken.text());
    warnOfFedSprings();
}

void Scene::setLiquidToCome(double volume) {
    requireSetUp("liquid to come");
    checkValue("Simulation", "liquid to come", volume, "m^3", notNegative);
    liquidToCome = volume;
}

void Scene::joinAtStart(double gap) {
    requireSetUp("gap of bridges at the start");
    checkValue("Simulation", "gap of bridges at the start", gap, "m", notNegative);
    gapOfFirstBridges = gap;
}

void Scene::beginLiquid() {
    if (!particleHandler.films().areKept()) return;
    double toCome = liquidToCome;
    const double sprayed = sprayHandler.volumeBy(getTimeMax());
    if (!isSet(toCome)) {
        double largest = 0;
        const auto count = static_cast<int>(laws().speciesCount());
        for (int a = 0; a < count; ++a)
            for (int b = a; b < count; ++b)
                largest = std::max(largest, laws().liquidRules(a, b).value_or(LiquidRules{}).largest);
        toCome = std::max(0x1p20, 6.0 * static_cast<double>(particleHandler.getSize())) * largest + sprayed;
    } else if (sprayed > toCome) {
        throw InputError(fmt::format(
            "Simulation: liquid to come = {:.6g} m^3, but the sprays emit up to {:.6g} m^3 until the end of "
            "the run; set at least that, or leave it out.",
            toCome, sprayed));
    }
    GrainFilms& films = particleHandler.films();
    films.begin(particleHandler.store(), toCome);
    sprayHandler.begin(films.quantum());
    if (liquidDensity > 0) weighFilms(particleHandler.store());
}

void Scene::setLiquidDensity(double density) {
    requireSetUp("density of the liquid");
    checkValue("Simulation", "density of the liquid", density, "kg/m^3", notNegative);
    liquidDensity = density;
}

/// Of grains that move by themselves.
void Scene::weighFilms(ParticleStore& grains) const {
    const GrainFilms& films = particleHandler.films();
    for (const std::uint32_t at : grains.place) {
        if (!grains.isFree(at)) continue;
        TranslationRecord& grain = grains.translation[at];
        const double solid = particleHandler.massOf(grain.radius, grains.species[at]);
        const double film = liquidDensity * films.of(grains, at);
        grain.inverseMass = 1 / (solid + film);
        if (grains.hasSpin)
            grains.rotation[at].inverseInertia =
                1 / ((2.0 / 5 * solid + 2.0 / 3 * film) * grain.radius * grain.radius);
    }
}

void Scene::setEvaporation(const Evaporation& law) {
    requireSetUp("evaporation");
    contactSystem.setEvaporation(law);
}

void Scene::refuseLiquidThatCannotMove() const {
    if (particleHandler.films().areKept()) return;
    constexpr std::string_view advice =
        "but no species of this scene moves liquid; take an adhesion law whose name begins with "
        "LiquidMigration, or leave it out.";
    if (!sprayHandler.isEmpty()) throw InputError(fmt::format("Simulation: there is a spray, {}", advice));
    if (getEvaporation().dropsDry())
        throw InputError(fmt::format("Simulation: evaporation is set, {}", advice));
    if (liquidDensity > 0)
        throw InputError(fmt::format("Simulation: the density of the liquid is set, {}", advice));
}

LiquidLedger Scene::liquidLedger() const {
    LiquidLedger found = contactSystem.liquidLedger(particleHandler.store());
    sprayHandler.addTo(found);
    return found;
}

void Scene::emitDroplets() {
    if (sprayHandler.isEmpty()) return;
    try {
        sprayHandler.emit(particleHandler.films(), getTime() + getTimeStep());
    } catch (const InputError& refusal) {
        throw RunError(refusal.what());
    }
}

void Scene::flyDroplets(ParticleStore& grains, double length, double grainShift) {
    enter(StepTimes::Part::Liquid);
    sprayHandler.advance({grains, particleHandler.films(), contactSystem, wallHandler, periodic, gravity,
                          getTime() + length, length, grainShift, smallestRadius, threads});
}

void Scene::requireLiquid() const {
    const double missing = liquidLedger().unaccounted();
    if (missing != 0)
        throw RunError(fmt::format(
            "At time {:.6g} s {} m^3 of liquid are {}: this is an error in the program, not in the scene.",
            getTime(), std::abs(missing), missing < 0 ? "lost" : "too many"));
}

void Scene::warnOfFedSprings() const {
    const double fewest = fewestStepsToDouble(laws(), checkedSizes, wallHandler, integrator, getTimeStep());
    if (fewest > 1e7) return;
    const std::string time = fewest < 1 ? "less than one step" : fmt::format("some {:.0f} steps", fewest);
    logger(
        LogLevel::Warn,
        "{}: its springs have too weak dashpots for a time step of {:.3g} s, at which motions of grains at "
        "rest may double in {}; give it a larger dissipation, or take a smaller step or "
        "integrators::velocityVerlet.",
        laws().friction, getTimeStep(), time);
}

void Scene::visitAll(StateArchive& archive) {
    // A file holds bodies, laws and contacts that fit together: what hooks have just changed is taken over.
    if (archive.isWriting() && hasBegun()) takeOverChanges();
    visitScene(archive);
    if (archive.isReading()) prepare();
    archive.group("contacts", [&] { contactSystem.visitState(archive, particleHandler.store()); });
    if (contactSystem.movesLiquid()) {
        archive.same("liquidDensity", liquidDensity, "kg/m^3");
        archive.group("sprays", [&] { sprayHandler.visitState(archive, particleHandler.films()); });
    }
    visitOutputs(archive);
}

void Scene::visitScene(StateArchive& archive) {
    archive.group("species", [&] { laws().visitState(archive, speciesChanged); });
    if (archive.isReading() && speciesChanged) laws().mixAll();
    archive.group("walls", [&] { wallHandler.visitState(archive); });
    visitSteps(archive);
    archive.same("integrator", integrator.name);
    archive.same("ledgerKept", ledgerKept, {},
                 "the energy ledger is kept from the start of a run to its end or not at all, so give "
                 "--energy-interval-s (or keepEnergyLedger()) as it was: above 0 where the file has 1, 0 "
                 "where it has 0");
    visitSurroundings(archive);
    archive.finite("ledger", ledger);
    archive.finite("energyAtStart", energyAtStart);
    archive.finite("approachUnseen", approachUnseen);
    archive.value("smallestRadius", smallestRadius);
    archive.require(smallestRadius > 0, "smallestRadius", "is not positive");
    archive.group("particles", [&] { particleHandler.visitState(archive); });
}

/// The directions in which the scene repeats itself are as they were set up, and so is gravity unless the run
/// has changed it.
void Scene::visitSurroundings(StateArchive& archive) {
    constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
    constexpr std::array along{&Vector<double>::x, &Vector<double>::y, &Vector<double>::z};
    archive.value("gravityChanged", gravityChanged);
    if (gravityChanged) archive.finite("gravity", gravity);
    particleHandler.setGravity(gravity);
    for (std::size_t k = 0; k < 3; ++k) {
        if (!gravityChanged)
            archive.group("gravity", [&] { archive.same(axes[k], gravity.*along[k], "m/s^2"); });
        archive.group("periodicLowest", [&] { archive.same(axes[k], periodic.lowest.*along[k], "m"); });
        archive.group("periodicLength", [&] { archive.same(axes[k], periodic.length.*along[k], "m"); });
    }
}

void Scene::writeLastState(const std::filesystem::path& grains, const std::filesystem::path& contacts,
                           const std::string& remark) {
    writeGrains(grains, particleHandler.store(), laws(), remark);
    writeContacts(contacts, contactSystem, particleHandler.store(), remark);
}

/// The first half of a step's motion, and what was left of the last step.
double Scene::move(ParticleStore& grains, double length) {
    if (particleHandler.takeUnfinishedStep()) {
        enter(StepTimes::Part::Sum);
        return Motion::finishAndBegin(grains, contactSystem.store(), gravity, leftLength, length, threads,
                                      integrator);
    }
    enter(StepTimes::Part::Motion);
    return Motion::begin(grains, length, threads, integrator);
}

void Scene::finishLeftStep() {
    const StepTimes::Part before = enter(StepTimes::Part::Sum);
    Motion::finish(particleHandler.storeInStep(), contactSystem.store(), gravity, leftLength, threads,
                   integrator);
    enter(before);
}

void Scene::advance(double length, bool another) {
    ParticleStore& grains = particleHandler.storeInStep();
    intoLedger([&] { account.begin(grains, gravity, length, ledger); });
    double farthest = move(grains, length);
    if (!grains.bodies.empty()) farthest = std::max(farthest, bodyMotion.begin(grains, length, integrator));
    const double grainShift = std::sqrt(farthest);
    refuseRunaway(grainShift);
    const double wallShift = wallHandler.moveTo(getTime() + length);
    enter(StepTimes::Part::Search);
    intoLedger([&] { account.moved(grains, gravity, ledger); });
    bringBack(grains);
    contactSystem.refresh(grains, grainShift, wallShift);
    lookForDeepOverlaps(grains, 2 * grainShift);
    enter(StepTimes::Part::Contacts);
    ContactTiming timing = integrator.contacts;
    timing.comingStep = getTimeStep();
    contactSystem.computePairForces(grains, length, timing);
    enter(StepTimes::Part::Walls);
    contactSystem.computeWallForces(grains, length, timing);
    if (contactSystem.movesLiquid()) {
        enter(StepTimes::Part::Liquid);
        contactSystem.moveLiquid(grains, getTime() + length, length);
    }
    enter(StepTimes::Part::Sum);
    leftLength = length;
    particleHandler.leaveStepUnfinished();
    if (!another || ledgerKept || !grains.bodies.empty() || !sprayHandler.isEmpty() || liquidDensity > 0)
        particleHandler.finishStep();
    if (!grains.bodies.empty())
        RigidBodyMotion::finish(grains, contactSystem.store(), gravity, length, integrator);
    enter(StepTimes::Part::Other);
    intoLedger([&] { account.finish(grains, contactSystem, gravity, length, integrator, ledger); });
    if (!sprayHandler.isEmpty()) flyDroplets(grains, length, grainShift);
    if (liquidDensity > 0) weighFilms(grains);
    enter(StepTimes::Part::Other);
}

void Scene::bringBack(ParticleStore& grains) {
    if (!periodic.any() || getNumberOfTimeSteps() % stepsBetweenBringingBack != 0) return;
    for (TranslationRecord& grain : grains.translation) grain.position = periodic.wrap(grain.position);
    for (std::size_t k = 0; k < grains.bodies.size(); ++k)
        grains.bodies[k].position = periodic.wrap(grains.bodies[k].position);
    grains.bodies.place(grains);  // each body stays whole
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
