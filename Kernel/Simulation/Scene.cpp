#include "Kernel/Simulation/Scene.h"

#include <algorithm>

#include "Kernel/Motion/TimeIntegration.h"
#include "Kernel/Simulation/LastState.h"
#include "Kernel/Parallel.h"
#include "Kernel/Shapes/SphereGroups.h"
#include "Kernel/Simulation/SceneCheck.h"
#include "Kernel/Simulation/SceneDomain.h"
#include "Kernel/Simulation/StressServo.h"
#include "Kernel/Walls/WallSeams.h"
#include "Kernel/Walls/WornWall.h"

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

template <class State>
void Scene::takeIfImagesAllow(State& now, const State& asked) {
    const State before = std::exchange(now, asked);
    try {
        refuseForMovingImages();
    } catch (const InputError&) {
        now = before;
        throw;
    }
}

void Scene::setGravity(const Vec3D& acceleration) {
    for (const double part : acceleration) checkValue("Simulation", "gravity", part, "m/s^2", anyFinite);
    particleHandler.finishStep();  // with the gravity that it had
    takeIfImagesAllow(gravity, toVector(acceleration));
    particleHandler.setGravity(gravity);
    adaptive.chooseAnew();
    gravityChanged |= hasBegun();
}

void Scene::setPeriodic(int axis, double lowest, double highest) {
    requireSetUp("periodic length");
    checkValue("Simulation", "periodic axis", axis, "", fromZeroTo(2));
    checkValue("Simulation", "periodic length", highest - lowest, "m", positive);
    periodic.lowest.*LeesEdwards::axes[axis] = lowest;
    periodic.length.*LeesEdwards::axes[axis] = highest - lowest;
    lowestAtSetUp = periodic.lowest;
    lengthAtSetUp = periodic.length;
    shear.settle(periodic);
    shear.move(periodic, getTime());
}

void Scene::setLeesEdwards(int flow, int gradient, double rate) {
    requireSetUp("shear");
    checkValue("Simulation", "axis of the flow", flow, "", fromZeroTo(2));
    checkValue("Simulation", "axis of the gradient", gradient, "", fromZeroTo(2));
    checkValue("Simulation", "shear rate", rate, "1/s", anyFinite);
    if (flow == gradient)
        throw InputError(fmt::format(
            "Simulation: shear: the flow and its gradient are both along axis {}; take two axes.", flow));
    for (const int axis : {flow, gradient})
        if (!(periodic.length.*LeesEdwards::axes[axis] > 0))
            throw InputError(
                fmt::format("Simulation: shear: the scene does not repeat itself along axis {}; call "
                            "setPeriodic() for the flow and the gradient first.",
                            axis));
    periodic = {periodic.lowest, periodic.length};
    periodic.imagesMove = strain.isSet;
    shear = {};
    shear.flow = flow;
    shear.gradient = gradient;
    shear.rate = rate;
    shear.isSet = true;
    shear.settle(periodic);
    shear.move(periodic, getTime());
    shearAtSetUp = shear;
}

void Scene::setShearRate(double rate) {
    if (!shear.isSet)
        throw InputError(
            "Simulation: shear rate: the scene was not set up to be sheared; call setLeesEdwards() at set-up "
            "(a rate of 0 will do).");
    checkValue("Simulation", "shear rate", rate, "1/s", anyFinite);
    if (!hasBegun()) return setLeesEdwards(shear.flow, shear.gradient, rate);
    shear.rate = rate;
    shear.isControlled = false;
}

void Scene::setTargetShearStress(double stress, double time, std::optional<double> largest) {
    if (!shear.isSet)
        throw InputError(
            "Simulation: target shear stress: the scene was not set up to be sheared; call setLeesEdwards() "
            "at set-up (a rate of 0 will do).");
    checkValue("Simulation", "target shear stress", stress, "Pa", anyFinite);
    checkValue("Simulation", "time of the target shear stress", time, "s", positive);
    const double largestRate = largest.value_or(1 / time);
    checkValue("Simulation", "largest shear rate", largestRate, "1/s", positive);
    LeesEdwards asked = shear;
    if (shear.isControlled) {
        asked.servo.beginAnew(time == shear.time);
    } else {
        asked.servo = {.speed = shear.rate};
        asked.atLargest = 0;
    }
    asked.isControlled = true;
    asked.stress = stress;
    asked.time = time;
    asked.largestRate = largestRate;
    if (hasBegun()) takeIfImagesAllow(shear, asked);
    else shear = shearAtSetUp = asked;
}

AxisStrain& Scene::axisToStrain(int axis, std::string_view what) {
    checkValue("Simulation", fmt::format("axis of the {}", what), axis, "", fromZeroTo(2));
    if (hasBegun() && !strain.isSet)
        throw InputError(
            fmt::format("Simulation: {}: the scene was not set up to be strained; call setStrainRate() at "
                        "set-up (a rate of 0 will do).",
                        what));
    if (!(periodic.length.*LeesEdwards::axes[axis] > 0))
        throw InputError(fmt::format(
            "Simulation: {}: the scene does not repeat itself along axis {}; call setPeriodic() first.", what,
            axis));
    return strain.axes[static_cast<std::size_t>(axis)];
}

void Scene::setStrain(int axis, const AxisStrain& how) {
    HomogeneousStrain asked = strain;
    asked.axes[static_cast<std::size_t>(axis)] = how;
    asked.isSet = periodic.imagesMove = true;
    if (hasBegun()) takeIfImagesAllow(strain, asked);
    else strain = strainAtSetUp = asked;
}

void Scene::setStrainRate(int axis, double rate) {
    static_cast<void>(axisToStrain(axis, "strain rate"));
    checkValue("Simulation", "strain rate", rate, "1/s", anyFinite);
    setStrain(axis, {.rate = rate});
}

void Scene::setTargetStress(int axis, double stress, double time, std::optional<double> largest) {
    AxisStrain asked = axisToStrain(axis, "target stress");
    checkValue("Simulation", "target stress", stress, "Pa", anyFinite);
    checkValue("Simulation", "time of the target stress", time, "s", positive);
    const double largestRate = largest.value_or(0.1 / time);
    checkValue("Simulation", "largest strain rate", largestRate, "1/s", positive);
    if (asked.isControlled) {
        asked.servo.beginAnew(time == asked.time);
    } else {
        asked = {.rate = asked.rate, .isControlled = true, .servo = {.speed = asked.rate}};
    }
    asked.stress = stress;
    asked.time = time;
    asked.largestRate = largestRate;
    setStrain(axis, asked);
}

double Scene::getStrainRate(int axis) const {
    checkValue("Simulation", "axis of the strain rate", axis, "", fromZeroTo(2));
    return strain.axes[static_cast<std::size_t>(axis)].rate;
}

void Scene::acceptOverlaps(double share) {
    checkValue("Simulation", "accepted overlap", share, "of the smaller radius",
               fromZeroTo(largestOverlapInRun));
    acceptedOverlap = share;
}

void Scene::setIntegrator(const Integrator& scheme) {
    requireSetUp("integrator");
    checkIntegrator(scheme);
    integrator = scheme;
}

/// Where springs are moved in the step, only what contacts make of it is another one.
Integrator Scene::scheme() const {
    if (!springsInStep) return integrator;
    if (integrator == integrators::predictedVelocityVerlet) return integrators::springsInStep;
    Integrator own = integrator;
    own.contacts = integrators::springsInStep.contacts;
    return own;
}

void Scene::setNumberOfThreads(int count) {
    checkValue("Simulation", "number of threads", count, "", {1, 4096});
    threads = count;
    contactSystem.setThreads(count);
}

double Scene::stabilityLimit() {
    mixChangedLaws();
    return sceneStabilityLimit(laws(), grainSizes(particleHandler.store()), wallHandler, scheme());
}

double Scene::stabilityLimit(std::span<const SphericalParticle> toCome) {
    mixChangedLaws();
    ParticleStore grains = particleHandler.store();
    for (const SphericalParticle& grain : toCome) {
        const double mass = particleHandler.massOf(grain.getRadius(), grain.getSpeciesIndex());
        grains.add({{0, 0, 0}, grain.getRadius(), {0, 0, 0}, grain.isFixed() ? 0 : 1 / mass}, {0, 0, 0},
                   static_cast<std::uint16_t>(grain.getSpeciesIndex()));
    }
    return sceneStabilityLimit(laws(), grainSizes(grains), wallHandler, scheme());
}

double Scene::shortestContactTime() {
    mixChangedLaws();
    return shortestHalfPeriod(laws(), grainSizes(particleHandler.store()), wallHandler);
}

GrainSizes Scene::grainSizes(const ParticleStore& grains) const {
    GrainSizes sizes(grains, laws().speciesCount());
    for (const InletHandler::Sizes& toCome : inletHandler.sizes()) {
        // Twice, so that of all sizes between them any number may come; the count is that of a dense bed.
        const auto species = static_cast<std::size_t>(toCome.species);
        for (const double radius : {toCome.smallest, toCome.smallest, toCome.largest, toCome.largest})
            for (auto* ranges : {&sizes.all, &sizes.free}) ranges->at(species).add(radius);
        sizes.count += contactsInDensestBed + 1;
    }
    return sizes;
}

/// Why less than the amount was inserted, and what helps.
static std::array<std::string, 2> whyLess(const Inserted& made) {
    if (made.wanted == 0)
        return {
            fmt::format("insert(): no grain came, because the first random one is heavier than the amount "
                        "of {:.6g} kg",
                        made.wantedMass),
            "take a larger amount, another seed, or Sample::Exact"};
    return {fmt::format("insert(): {} of {} grains found room, {:.6g} kg of {:.6g} kg, a solid fraction of "
                        "{:.3g} of the region; the first left out has a radius of {:.6g} m",
                        made.number, made.wanted, made.mass, made.wantedMass, made.solidFraction,
                        made.firstLeftOut),
            "take a smaller amount, a larger region, or more tries"};
}

Inserted Scene::insert(const SizeDistribution& sizes, const Region& region, const Amount& amount,
                       const SphericalParticle& like, const InsertOptions& options) {
    if (hasBegun() && periodic.imagesMove)
        throw InputError(
            "insert(): in a run in shear or strain grains cannot be inserted; insert them at set-up.");
    return tellOf(insertGrains(insertionScene(), sizes, region, amount, like, options));
}

Inserted Scene::tellOf(const Inserted& made) {
    if (made.number == made.wanted && made.wanted > 0) return made;
    const auto [what, advice] = whyLess(made);
    if (!hasBegun()) throw InputError(fmt::format("{}; {}.", what, advice));
    if (!std::exchange(noRoomWasTold, true)) logger(LogLevel::Warn, "{}.", what);
    return made;
}

Inserted Scene::insert(const SizeDistribution& sizes, const Region& region, const Amount& amount,
                       const Clump& like, const InsertOptions& options) {
    if (hasBegun() && periodic.imagesMove)
        throw InputError(
            "insert(): in a run in shear or strain clumps cannot be inserted; insert them at set-up.");
    const std::size_t before = bodyHandler.getSize();
    const Inserted made = insertClumps(insertionScene(), bodyHandler, sizes, region, amount, like, options);
    if (hasBegun()) warnOfGapsInBodies(before);
    return tellOf(made);
}

void Scene::letOutAndIn(double time) {
    if (outletHandler.isEmpty() && inletHandler.isEmpty()) return;
    try {
        if (!outletHandler.isEmpty()) {
            outletHandler.letOut(particleHandler, time, threads);
            contactSystem.sumLostForces(particleHandler.storeInStep());
        }
        if (!inletHandler.isEmpty())
            inletHandler.letIn(insertionScene(), time, [this](const std::string& sentence) {
                logger(LogLevel::Warn, "{}", sentence);
            });
    } catch (const InputError& refusal) {
        throw RunError(refusal.what());
    }
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
    // It tells what slides.
    ledgerKept |=
        std::ranges::any_of(wornWalls(wallHandler), [](const WornWall* wall) { return wall != nullptr; });
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
    if (periodicWalls.haveEnds()) wrapAll(grains);
    contactSystem.refresh(grains, 0, 0);
    if (gapOfFirstBridges > 0) {
        refuseUnlessBridgesJoin(laws(), gapOfFirstBridges);
        contactSystem.join(grains, gapOfFirstBridges);
    }
    refuseInitialOverlaps(contactSystem, grains, acceptedOverlap, [](auto&&...) { return true; });
    Motion::start(grains, integrator);
    advance(0, false);  // a step of no length: forces and accelerations at the start
    energyAtStart = ledger.total();
    Motion::start(grains, integrator);
    tellEvents();
}

void Scene::advanceByStep(bool another) {
    takeOverChanges();
    membraneMotion.renewForces(wallHandler, contactSystem, particleHandler.storeInStep(), gravity);
    if (adaptive.isDue()) chooseTimeStep();
    emitDroplets();
    serveStress();
    checkTouchesOfPistons();
    boxAtStep = periodic;
    const LeesEdwards shearAtStep = shear;
    planeMotion.forget();
    membraneMotion.forget();
    try {
        advance(getTimeStep(), another);
        if (ledgerKept) EnergyAccount::finishWear(wallHandler, getTime() + getTimeStep());
    } catch (const RunError&) {
        Motion::takeBack(particleHandler.store(), getTimeStep(), integrator);
        if (!particleHandler.store().bodies.empty())
            RigidBodyMotion::takeBack(particleHandler.store(), getTimeStep(), integrator);
        planeMotion.takeBack(wallHandler);
        membraneMotion.takeBack(wallHandler);
        wallHandler.moveTo(getTime());
        periodic = boxAtStep;
        if (strain.isSet || shear.isSet) {
            ParticleStore& grains = particleHandler.storeInStep();
            for (TranslationRecord& grain : grains.translation)
                grain.velocity -= changeOfFlow(grain.position);
            for (std::size_t k = 0; k < grains.bodies.size(); ++k)
                grains.bodies[k].velocity -= changeOfFlow(grains.bodies[k].position);
            grains.bodies.placeAll(grains);
        }
        shear = shearAtStep;
        contactSystem.setPeriodicBox(periodic);
        if (ledgerKept) account.takeBack(ledger);
        fluxPlaneHandler.takeBack();
        throw;
    }
    letOutAndIn(getTime() + getTimeStep());
}

void Scene::tellEvents() {
    for (const ContactEvent& event : contactSystem.events().ofStep()) actionsOnContactEvent(event);
}

void Scene::check() {
    widestBody = bodyHandler.refuseTooWide();
    refuseForBodies(particleHandler.store().bodies);
    if (const GrainShapes* const shapes = laws().shapes()) {
        shapes->check(wallHandler);
        if (!inletHandler.isEmpty())
            throw InputError("Simulation: inlets do not know superquadrics; leave the inlets out.");
    }
    refuseWear(wallHandler, ledgerKept, laws().layout.hasTorque, !particleHandler.store().bodies.empty());
    GrainSizes sizes = grainSizes(particleHandler.store());
    if (hasBegun() && getTimeStep() != checkedStep) refuseOtherStep();
    const bool checksStep = !unstableAccepted && !adaptive.hasChosen();
    checkScene(laws(), sizes, wallHandler, checksStep ? getTimeStep() : 0, scheme());
    springsInStep =
        !sizes.hasBodies && schemeOfScene(laws(), sizes, wallHandler, scheme()).contacts.springsInStep;
    if (adaptive.isSet()) {
        refuseForAdaptiveStep();
        springsInStep |= integrator.contacts.implicitForces && laws().layout.hasTorque;
    }
    refuseFarFaces(periodic, sizes.smallest());
    largestReach = checkPeriodicLengths(laws(), sizes, wallHandler, periodic);
    refuseForMovingImages();
    refuseForDrivenPlanes();
    const double smallest = sizes.smallest();
    periodicWalls.check(wallHandler, wallHandler.hasChanges(), periodic, laws(), sizes, widestBody,
                        std::min(smallestRadius, smallest));
    checkedStep = getTimeStep();
    wallHandler.changesAreKnown();
    checkedSizes = std::move(sizes);
    if (hasBegun() && smallest < smallestRadius) contactSystem.setSmallestRadius(smallest);
    smallestRadius = std::min(smallestRadius, smallest);
}

void Scene::refuseForBodies(const RigidBodies& bodies) const {
    if (bodies.empty()) return;
    if (integrator.remembersEarlier() || integrator.contacts.springsInStep)
        throw InputError(
            fmt::format("Simulation: the integrator {} does not move rigid bodies; take "
                        "integrators::predictedVelocityVerlet or velocityVerlet.",
                        shownName(integrator)));
    if (!outletHandler.isEmpty())
        throw InputError("Simulation: outlets do not know rigid bodies; leave the outlets out.");
    if (liquidDensity > 0)
        throw InputError(
            "Simulation: the mass of films (setLiquidDensity()) is not known of rigid bodies; leave it out.");
}

/// Of a scene that has become too short for a body.
void Scene::refuseWideBodies() {
    if (widestBody <= 0.5 * periodic.shortestLength()) return;
    try {
        widestBody = bodyHandler.refuseTooWide();  // the widest may have been removed
    } catch (const InputError& refusal) {
        throw RunError(fmt::format("At time {:.6g} s {}", getTime(), refusal.what()));
    }
}

void Scene::refuseForMovingImages() const {
    if (!periodic.imagesMove) return;
    const AxisStrain& alongFlow = strain.axes[static_cast<std::size_t>(shear.flow)];
    if (shear.isSet && (alongFlow.rate != 0 || alongFlow.isControlled))
        throw InputError(fmt::format(
            "Simulation: in shear (setLeesEdwards()) along axis {} the length along this axis stays; strain "
            "(setStrainRate(), setTargetStress()) the others.",
            shear.flow));
    const auto refuse = [this](std::string_view what) {
        throw InputError(fmt::format(
            "Simulation: in {} there can be no {}.",
            shear.isSet ? "shear (setLeesEdwards())" : "strain (setStrainRate(), setTargetStress())", what));
    };
    if (wallHandler.getSize() > 0) refuse("walls");
    const ParticleStore& grains = particleHandler.store();
    for (const std::uint32_t place : grains.place)
        if (grains.translation[place].inverseMass == 0)
            refuse(
                fmt::format("grains that are held in place, which particle {} is: they would not go with the "
                            "flow as their images do; let it go by fixParticle(false), or make it heavy",
                            grains.identity[place]));
    if (strain.isSet && gravity != Vector<double>{0, 0, 0}) refuse("gravity");
    if (shear.isSet && gravity.*LeesEdwards::axes[shear.gradient] != 0) refuse("gravity along the gradient");
    if (!sprayHandler.isEmpty()) refuse("sprays");
    if (!inletHandler.isEmpty()) refuse("inlets");
    if (!outletHandler.isEmpty()) refuse("outlets");
    if (!fluxPlaneHandler.isEmpty()) refuse("flux planes");
    const auto checkServo = [this](double time, std::string_view what) {
        if (laws().shapes())
            throw InputError(
                fmt::format("Simulation: target {}: its servo does not know how stiff contacts of "
                            "superquadrics are; give the scene a rate instead.",
                            what));
        if (getTimeStep() >= 2 * time)
            throw InputError(
                fmt::format("Simulation: time of the target {} = {:.6g} s; it must be more than half a "
                            "time step of {:.6g} s, or the stress would ring ever more.",
                            what, time, getTimeStep()));
        for (const double length : {periodic.length.x, periodic.length.y, periodic.length.z})
            if (!(length > 0))
                throw InputError(fmt::format(
                    "Simulation: target {}: the scene does not repeat itself along all three axes, so its "
                    "stress is not known; call setPeriodic() for all of them.",
                    what));
    };
    for (const AxisStrain& axis : strain.axes)
        if (axis.isControlled) checkServo(axis.time, "stress");
    if (shear.isControlled) checkServo(shear.time, "shear stress");
}

void Scene::refuseForDrivenPlanes() const {
    for (std::size_t w = 0; w < wallHandler.getSize(); ++w) {
        const Wall& wall = wallHandler.getObject(w);
        const PlaneDrive* const drive = wall.drive();
        if (!drive) continue;
        if (!PlaneMotion::canMove(wall))
            throw InputError(fmt::format(
                "wall {}: only a plane (InfiniteWall) can be moved by forces; give this wall no drive.", w));
        if (drive->isServo() && getTimeStep() >= 2 * drive->asked.time)
            throw InputError(fmt::format(
                "wall {}: time of the target force = {:.6g} s; it must be more than half a time step of "
                "{:.6g} s, or the force would ring ever more.",
                w, drive->asked.time, getTimeStep()));
        if (particleHandler.getSize() == 0 && inletHandler.isEmpty())
            throw InputError(
                fmt::format("wall {}: a piston or a target force needs grains, and there are none and no "
                            "inlet that brings "
                            "any; call setPiston() or setTargetForce() in the run, when they are there.",
                            w));
    }
}

void Scene::sumForcesOnNewDrives() {
    for (std::size_t w = 0; w < wallHandler.getSize(); ++w)
        if (const PlaneDrive* const drive = wallHandler.getObject(w).drive(); drive && drive->steps == 0)
            contactSystem.sumForcesOn(particleHandler.store(), w);
}

PlaneMotion::Step Scene::planeStep(double length) const {
    return {getTime(), length, gravity, integrator, smallestRadius, !inletHandler.isEmpty()};
}

void Scene::checkTouchesOfPistons() {
    for (std::size_t w = 0; w < wallHandler.getSize(); ++w) {
        PlaneDrive* const drive = wallHandler.getObject(w).drive();
        if (!drive || !drive->isPiston() || drive->touches <= drive->mostTouches) continue;
        drive->mostTouches = drive->touches;
        try {
            checkPistons(laws(), checkedSizes, wallHandler, unstableAccepted ? 0 : getTimeStep(), integrator);
        } catch (const InputError& refusal) {
            throw RunError(fmt::format("At time {:.6g} s {}", getTime(), refusal.what()));
        }
    }
}

void Scene::mixChangedLaws() {
    if (!laws().hasChanged()) return;
    laws().mixAll();
    lawsAreNew = true;
}

void Scene::takeOverChanges() {
    try {
        contactSystem.sumLostForces(particleHandler.storeInStep());
        mixChangedLaws();
        const bool newLaws = std::exchange(lawsAreNew, false), changedWalls = wallHandler.hasChanges();
        const auto firstNewWall = static_cast<int>(wallHandler.firstNewWall());
        if (!newLaws && !changedWalls && getTimeStep() == checkedStep && !particleHandler.hasChanges())
            return;
        const GrainChanges changes = particleHandler.takeChanges();
        const bool newBodies = changedWalls || !changes.placed.empty() || !changes.altered.empty();
        if (adaptive.isSet()) {
            if (newLaws || newBodies || getTimeStep() != checkedStep) adaptive.chooseAnew();
            else shortenTimeStep();
        }
        if (newLaws) {
            ContactLayout asked = laws().layout;
            asked.named = contactSystem.columns().size();
            if (asked != contactSystem.store().memory.getLayout())
                throw InputError(
                    "Simulation: a species was added in the run whose contacts remember more, or have "
                    "friction "
                    "where no others have; add it before the run begins.");
            particleHandler.renewMasses();
            speciesChanged = true;
        }
        if (changedWalls) {
            sumForcesOnNewDrives();
            intoLedger([&] { EnergyAccount::wallsChanged(wallHandler, ledger); });
        }
        const bool withShapes = laws().shapes() && !changes.added.empty(), hadEnds = periodicWalls.haveEnds();
        if (newLaws || newBodies || withShapes || getTimeStep() != checkedStep ||
            isNewToChecks(changes.added))
            check();
        ParticleStore& grains = particleHandler.store();
        if (periodicWalls.haveEnds()) wrapPlaced(grains, changes, hadEnds);
        if (newLaws || newBodies) {
            bookEnded(contactSystem.renew(grains));
            renewAccelerations(changes);
        } else if (!contactSystem.takeIn(grains, changes.added)) {
            contactSystem.listNow(grains);
        } else {
            return;
        }
        refuseOverlapsOf(changes, firstNewWall);
    } catch (const InputError& refusal) {
        throw RunError(refusal.what());
    }
}

/// The forces that contacts had at the end of the last step act on in the first half of the next one, on the
/// masses and at the arms that grains have now, so that the account of the energy closes.
void Scene::renewAccelerations(const GrainChanges& changes) {
    ParticleStore& grains = particleHandler.store();
    std::vector<std::uint32_t> places;
    for (const auto* identities : {&changes.placed, &changes.altered})
        for (const std::uint32_t identity : *identities) places.push_back(grains.place[identity]);
    Motion::renewAccelerations(grains, contactSystem.store(), gravity, places);
}

bool Scene::isNewToChecks(std::span<const std::uint32_t> added) const {
    const ParticleStore& grains = particleHandler.store();
    if (!added.empty() && grains.count() <= contactsInDensestBed + added.size()) return true;
    return std::ranges::any_of(added, [&](std::uint32_t identity) {
        const std::uint32_t place = grains.place[identity];
        const TranslationRecord& grain = grains.translation[place];
        if (periodic.imagesMove && grain.inverseMass == 0) return true;
        return !checkedSizes.hold(grains.species[place], grain.radius, grain.inverseMass > 0);
    });
}

/// Of bodies that were put where they are.
void Scene::refuseOverlapsOf(const GrainChanges& changes, int firstNewWall) const {
    const ParticleStore& grains = particleHandler.store();
    std::vector<bool> isNew(grains.size());
    for (const auto* identities : {&changes.added, &changes.placed})
        for (const std::uint32_t identity : *identities) isNew[grains.place[identity]] = true;
    refuseInitialOverlaps(contactSystem, grains, acceptedOverlap,
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
    if (!isRestarted()) shear.settle(periodic);
    shear.move(periodic, getTime());
    outletHandler.begin(periodic, particleHandler.store(), getTime());
    fluxPlaneHandler.begin(periodic);
    inletHandler.begin(insertionScene(), isRestarted());
    contactSystem.prepare(laws(), wallHandler, periodic, SkinChoice::byCost(smallestRadius), ledgerKept,
                          films.areKept() ? &films : nullptr);
    if (isQuiet()) return;
    if (threads > processorCount())
        logger(LogLevel::Warn, "{} threads share {} processors; the run is slower than with {}.", threads,
               processorCount(), processorCount());
    for (const BrokenLimit& broken : brokenLimits(laws(), checkedSizes, wallHandler))
        logger(LogLevel::Warn, "{}.", broken.text());
    if (const std::string remark = remarkOnFarGrains(particleHandler.store()); !remark.empty())
        logger(LogLevel::Warn, "{}.", remark);
    warnOfFedSprings();
    warnOfSeams();
    warnOfGapsInBodies(0);
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
    double toCome = liquidToCome.value_or(0);
    const double sprayed = sprayHandler.volumeBy(getTimeMax());
    const double withGrains = inletHandler.liquidBy(particleHandler, getTimeMax());
    if (!liquidToCome) {
        double largest = 0;
        const auto count = static_cast<int>(laws().speciesCount());
        for (int a = 0; a < count; ++a)
            for (int b = a; b < count; ++b)
                largest = std::max(largest, laws().liquidRules(a, b).value_or(LiquidRules{}).largest);
        toCome = std::max(0x1p20, 6.0 * static_cast<double>(particleHandler.getSize())) * largest + sprayed +
                 withGrains;
    } else if (sprayed > toCome) {
        throw InputError(fmt::format(
            "Simulation: liquid to come = {:.6g} m^3, but the sprays emit up to {:.6g} m^3 until the end of "
            "the run; set at least that, or leave it out.",
            toCome, sprayed));
    }
    GrainFilms& films = particleHandler.films();
    films.begin(particleHandler.store(), toCome);
    sprayHandler.begin(films.quantum());
    if (liquidDensity > 0) particleHandler.weighFilms();  // rounded to quanta
}

void Scene::setLiquidDensity(double density) {
    requireSetUp("density of the liquid");
    checkValue("Simulation", "density of the liquid", density, "kg/m^3", notNegative);
    liquidDensity = density;
    particleHandler.setLiquidDensity(density);
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
    try {
        inletHandler.requireLiquid(particleHandler, getTime() + getTimeStep());
        if (!sprayHandler.isEmpty()) sprayHandler.emit(particleHandler.films(), getTime() + getTimeStep());
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

/// @param first of the bodies that are looked at
void Scene::warnOfGapsInBodies(std::size_t first) const {
    const ParticleStore& grains = particleHandler.store();
    std::size_t count = 0;
    std::string one;
    for (std::size_t k = first; k < grains.bodies.size(); ++k) {
        const RigidBody& body = grains.bodies[k];
        std::vector<Ball> spheres;
        for (const BodyMember& member : grains.bodies.membersOf(k))
            spheres.push_back({toEigen(body.position + body.orientation.turn(member.arm)),
                               grains.translation[grains.place[member.grain]].radius});
        const std::optional<std::string> gap = gapInClump(spheres);
        if (gap && count++ == 0) one = fmt::format("rigid body {}: {}", grains.bodies.numberOf(k), *gap);
    }
    if (count > 0)
        logger(LogLevel::Warn, "{}{}.", one, count > 1 ? fmt::format("; so it is in {} bodies", count) : "");
}

void Scene::warnOfFedSprings() const {
    const double fewest = fewestStepsToDouble(laws(), checkedSizes, wallHandler, scheme(), getTimeStep());
    if (fewest > 1e7) return;
    const std::string time = fewest < 1 ? "less than one step" : fmt::format("some {:.0f} steps", fewest);
    const std::string_view advice =
        checkedSizes.hasBodies
            ? "give it a larger dissipation, or take a smaller step, or integrators::velocityVerlet"
            : "give it a larger dissipation, or take a smaller step, integrators::springsInStep or "
              "velocityVerlet";
    logger(LogLevel::Warn,
           "{}: its springs have too weak dashpots for a time step of {:.3g} s, at which motions of grains "
           "at rest may double in {}; {}.",
           laws().friction, getTimeStep(), time, advice);
}

void Scene::warnOfSeams() const {
    const ParticleStore& grains = particleHandler.store();
    double largest = 0;
    for (const std::uint32_t place : grains.place)
        largest = std::max(largest, grains.translation[place].radius);
    if (!(largest > 0) || laws().shapes()) return;
    for (const std::string& sentence : doubtfulSeams(wallHandler, smallestRadius, largest))
        logger(LogLevel::Warn, "{}.", sentence);
}

void Scene::visitAll(StateArchive& archive) {
    // A file holds bodies, laws and contacts that fit together: what hooks have just changed is taken over.
    if (archive.isWriting() && hasBegun()) {
        takeOverChanges();
        membraneMotion.renewForces(wallHandler, contactSystem, particleHandler.storeInStep(), gravity);
    }
    visitScene(archive);
    if (archive.isReading()) prepare();
    if (periodicWalls.haveEnds()) archive.group("periodicWalls", [&] { periodicWalls.visitState(archive); });
    archive.group("contacts", [&] { contactSystem.visitState(archive, particleHandler.store()); });
    contactSystem.expectOverlaps(adaptive.supposedOverlap());
    if (contactSystem.movesLiquid()) {
        archive.same("liquidDensity", liquidDensity, "kg/m^3");
        archive.group("sprays", [&] { sprayHandler.visitState(archive, particleHandler.films()); });
    }
    archive.group("inlets", [&] { inletHandler.visitState(archive); });
    archive.group("outlets", [&] { outletHandler.visitState(archive); });
    archive.group("fluxPlanes", [&] { fluxPlaneHandler.visitState(archive); });
    archive.value("noRoomWasTold", noRoomWasTold);
    visitOutputs(archive);
}

void Scene::visitScene(StateArchive& archive) {
    archive.group("species", [&] { laws().visitState(archive, speciesChanged); });
    if (archive.isReading() && speciesChanged) laws().mixAll();
    archive.group("walls", [&] { wallHandler.visitState(archive); });
    visitSteps(archive);
    archive.same("integrator", description(integrator));
    archive.value("springsInStep", springsInStep);
    archive.group("adaptiveStep", [&] { adaptive.visitState(archive); });
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
    archive.same("shearRate", shearAtSetUp.rate, "1/s");
    archive.same("shearFlow", shear.flow);
    archive.same("shearGradient", shear.gradient);
    archive.same("shearIsSet", shear.isSet);
    if (shear.isSet) archive.group("shear", [&] { visitShear(archive); });
    for (std::size_t k = 0; k < 3; ++k) {
        if (!gravityChanged)
            archive.group("gravity", [&] { archive.same(axes[k], gravity.*along[k], "m/s^2"); });
        archive.group("periodicLowest", [&] { archive.same(axes[k], lowestAtSetUp.*along[k], "m"); });
        archive.group("periodicLength", [&] { archive.same(axes[k], lengthAtSetUp.*along[k], "m"); });
    }
    archive.group("strain", [&] { visitStrain(archive); });
}

void Scene::visitShear(StateArchive& archive) {
    archive.same("firstStress", shearAtSetUp.stress, "Pa");
    archive.same("firstTime", shearAtSetUp.time, "s");
    archive.same("firstLargestRate", shearAtSetUp.largestRate, "1/s");
    archive.value("isControlled", shear.isControlled);
    archive.finite("rate", shear.rate);
    archive.finite("stress", shear.stress);
    archive.finite("time", shear.time);
    archive.finite("largestRate", shear.largestRate);
    shear.servo.visitState(archive);
    archive.finite("atLargest", shear.atLargest);
    archive.finite("speed", shear.speed);
    archive.finite("began", shear.began);
    archive.finite("offset", shear.offset);
}

/// Rates and targets are set up as they were; what the run has made of them comes from the file.
void Scene::visitStrain(StateArchive& archive) {
    archive.same("isSet", strain.isSet);
    if (!strain.isSet) return;
    for (std::size_t k = 0; k < 3; ++k)
        archive.group(fmt::format("axis{}", k), [&] {
            const AxisStrain& first = strainAtSetUp.axes[k];
            archive.same("firstRate", first.rate, "1/s");
            archive.same("firstStress", first.stress, "Pa");
            archive.same("firstTime", first.time, "s");
            archive.same("firstLargestRate", first.largestRate, "1/s");
            AxisStrain& now = strain.axes[k];
            archive.value("isControlled", now.isControlled);
            archive.finite("rate", now.rate);
            archive.finite("stress", now.stress);
            archive.finite("time", now.time);
            archive.finite("largestRate", now.largestRate);
            now.servo.visitState(archive);
            archive.finite("oneWay", now.oneWay);
        });
    archive.finite("lowest", periodic.lowest);
    archive.finite("length", periodic.length);
    archive.finite("imageSpeed", periodic.strainRate);
    for (std::size_t k = 0; k < 3; ++k)
        archive.require(
            (periodic.length.*LeesEdwards::axes[k] > 0) == (lengthAtSetUp.*LeesEdwards::axes[k] > 0),
            "length", "is not that of a periodic scene");
}

void Scene::writeLastState(const std::filesystem::path& grains, const std::filesystem::path& contacts,
                           const std::string& remark) {
    writeGrains(grains, particleHandler.store(), laws(), remark);
    writeContacts(contacts, contactSystem, particleHandler.store(), remark);
}

/// The first half of a step's motion, and what was left of the last step.
double Scene::move(ParticleStore& grains, double length) {
    double farthest = 0;  // m^2
    const bool hasBodies = !grains.bodies.empty();
    if (particleHandler.takeUnfinishedStep()) {
        enter(StepTimes::Part::Sum);
        farthest = Motion::finishAndBegin(grains, contactSystem.store(), gravity, leftLength, length, threads,
                                          integrator, periodic);
        if (hasBodies)
            farthest = std::max(
                farthest, RigidBodyMotion::finishAndBegin(grains, contactSystem.store(), gravity, leftLength,
                                                          length, threads, integrator, periodic));
    } else {
        enter(StepTimes::Part::Motion);
        farthest = Motion::begin(grains, length, threads, integrator, periodic);
        if (hasBodies)
            farthest =
                std::max(farthest, RigidBodyMotion::begin(grains, length, threads, integrator, periodic));
    }
    if (!periodic.imagesMove) return std::sqrt(farthest);
    // The flow carries all grains, and those that are near each other together at this rate at most, -n.G.n
    // of any direction n and the gradient G of the flow: n_f n_g is at most 1/2, and the strains are weighed
    // by n_x^2 + n_y^2 + n_z^2 = 1. The skin of a list is at most the smallest radius.
    const Vector<double> rates = periodic.strainRate;
    const double rate =
        0.5 * std::abs(shear.rate) + std::max({std::abs(rates.x), std::abs(rates.y), std::abs(rates.z)});
    if (strain.isSet) HomogeneousStrain::move(periodic, length);
    // To the time that a restart file holds: with its bits.
    shear.move(periodic, length > 0 ? timeAfterNextStep() : getTime());
    contactSystem.setPeriodicBox(periodic);
    if (const auto objection = objectionToLengths(periodic, largestReach))
        throw RunError(fmt::format("At time {:.6g} s the {}", getTime(), *objection));
    if (hasBodies) refuseWideBodies();
    if (grains.count() == 0) return 0;
    return std::sqrt(farthest) +
           0.5 * rate * length * (largestReach + contactSystem.filmReach() + smallestRadius);
}

void Scene::finishLeftStep() {
    const StepTimes::Part before = enter(StepTimes::Part::Sum);
    ParticleStore& grains = particleHandler.storeInStep();
    Motion::finish(grains, contactSystem.store(), gravity, leftLength, threads, integrator);
    if (!grains.bodies.empty())
        RigidBodyMotion::finish(grains, contactSystem.store(), gravity, leftLength, threads, integrator);
    enter(before);
}

void Scene::advance(double length, bool another) {
    ParticleStore& grains = particleHandler.storeInStep();
    intoLedger([&] { account.begin(grains, contactSystem.store(), wallHandler, gravity, length, ledger); });
    if (!fluxPlaneHandler.isEmpty()) fluxPlaneHandler.beforeMotion(grains);
    beginStrain(grains, length);
    const double grainShift = move(grains, length);
    if (!fluxPlaneHandler.isEmpty())
        fluxPlaneHandler.afterMotion(particleHandler, length, [&](std::uint32_t place) {
            return particleHandler.films().of(grains, place) + contactSystem.liquidAt(grains, place);
        });
    refuseRunaway(grainShift);
    if (length > 0) {
        planeMotion.begin(wallHandler, contactSystem, grains, planeStep(length));
        membraneMotion.begin(wallHandler, planeStep(length));
    }
    const double wallShift = wallHandler.moveTo(getTime() + length);
    periodicWalls.follow(wallHandler, wallShift, getTime() + length);
    adaptive.moved(grainShift, wallShift, length);
    enter(StepTimes::Part::Search);
    intoLedger([&] { account.moved(grains, gravity, ledger); });
    bringBack(grains);
    contactSystem.refresh(grains, grainShift, wallShift);
    if (periodicWalls.haveEnds()) bringBackAtWalls(grains, grainShift, getTime() + length);
    lookForDeepOverlaps(grains, 2 * grainShift);
    enter(StepTimes::Part::Contacts);
    ContactTiming timing = scheme().contacts;
    timing.comingStep = getTimeStep();
    contactSystem.computePairForces(grains, length, timing);
    enter(StepTimes::Part::Walls);
    contactSystem.computeWallForces(grains, length, timing);
    if (contactSystem.overlaps().isSurprised()) adaptive.pressed();
    if (contactSystem.movesLiquid()) {
        enter(StepTimes::Part::Liquid);
        contactSystem.moveLiquid(grains, getTime() + length, length);
    }
    if (length > 0) PlaneMotion::finish(wallHandler, planeStep(length));
    membraneMotion.finish(wallHandler, contactSystem, grains, planeStep(length), ledgerKept);
    enter(StepTimes::Part::Sum);
    leftLength = length;
    particleHandler.leaveStepUnfinished();
    if (!another || ledgerKept || !sprayHandler.isEmpty() || liquidDensity > 0 || strain.isSet)
        particleHandler.finishStep();
    enter(StepTimes::Part::Other);
    intoLedger(
        [&] { account.finish(grains, contactSystem, wallHandler, gravity, length, integrator, ledger); });
    if (!sprayHandler.isEmpty()) flyDroplets(grains, length, grainShift);
    if (liquidDensity > 0) particleHandler.weighFilms();
    enter(StepTimes::Part::Other);
}

template <class Function>
void Scene::changeVelocities(ParticleStore& grains, Function&& changeAt) {
    std::size_t number = 0;
    for (const std::uint32_t place : grains.place) {
        TranslationRecord& grain = grains.translation[place];
        // A rigid body goes over as a whole, when its centre does.
        const std::uint32_t body = grains.bodies.bodyOf(grains.identity[place]);
        const Vector<double> at =
            body == RigidBodies::none ? grain.position : grains.bodies[grains.bodies.find(body)].position;
        if (const Vector<double> change = changeAt(at); squaredNorm(change) > 0) {
            grain.velocity += change;
            intoLedger([&] {
                if (body == RigidBodies::none) account.changedImage(grains, place, number, change, ledger);
                else account.changedImageOfMember(number, change);
            });
        }
        ++number;
    }
    for (std::size_t k = 0; k < grains.bodies.size(); ++k)
        if (const Vector<double> change = changeAt(grains.bodies[k].position); squaredNorm(change) > 0) {
            grains.bodies[k].velocity += change;
            intoLedger([&] { account.changedImageOfBody(grains, k, change, ledger); });
        }
}

void Scene::beginStrain(ParticleStore& grains, double length) {
    if (length == 0) return;
    shearChange = {0, 0, 0};
    if (shear.isSet) shearChange.*LeesEdwards::axes[shear.flow] = shear.begin(periodic, getTime());
    if (strain.isSet) strainChange = strain.begin(periodic, length);
    if (!strain.isSet && shearChange == Vector<double>{0, 0, 0}) return;
    particleHandler.finishStep();
    changeVelocities(grains, [&](const Vector<double>& place) { return changeOfFlow(place); });
}

Vector<double> Scene::changeOfFlow(const Vector<double>& place) const {
    const Vector<double> byStrain = periodic.strainAt(place, strainChange);
    if (!shear.isSet) return byStrain;
    return byStrain + dot(periodic.across, place - periodic.middle()) * shearChange;
}

void Scene::serveStress() {
    double shortest = infinity;  // s
    double lowest = 0;           // Pa
    for (const AxisStrain& axis : strain.axes)
        if (axis.isControlled)
            shortest = std::min(shortest, axis.time), lowest = std::min(lowest, axis.stress);
    if (shear.isControlled) shortest = std::min(shortest, shear.time);
    if (shortest == infinity) return;
    constexpr double looksInTime = 100;
    const auto interval =
        static_cast<std::size_t>(std::clamp(shortest / getTimeStep() / looksInTime, 1.0, 1e15));
    if (getNumberOfTimeSteps() % interval != 0) return;
    const DiagonalStress now = diagonalStress(contactSystem, particleHandler.store(), strain, shear);
    if (now.touches == 0 && lowest < 0)
        throw RunError(fmt::format(
            "At time {:.6g} s no two grains touch, and the target stress of {:.6g} Pa is a tension: grains "
            "that are apart cannot bear it; take a higher one, or grains that stick together.",
            getTime(), lowest));
    controlStress(strain, shear, now, static_cast<double>(interval) * getTimeStep(), getTime());
}

void Scene::bringBack(ParticleStore& grains) {
    if (!periodic.any() || periodicWalls.haveEnds() || getNumberOfTimeSteps() % stepsBetweenBringingBack != 0)
        return;
    // Grains that have left a scene whose images move go over to the velocity of their image inside.
    if (periodic.imagesMove)
        changeVelocities(grains, [&](const Vector<double>& place) { return periodic.velocityOfWrap(place); });
    wrapAll(grains);
    intoLedger([&] { account.wentRound(grains, gravity, ledger); });
}

void Scene::bringBackAtWalls(ParticleStore& grains, double shift, double time) {
    if (!periodicWalls.isBringingBackDue(grains, shift)) return;
    bookEnded(contactSystem.goThroughFaces(grains, periodicWalls.outside(grains), periodicWalls.endsOfWalls(),
                                           time, [&] { wrapAll(grains); }));
    intoLedger([&] { account.wentRound(grains, gravity, ledger); });
}

void Scene::wrapAll(ParticleStore& grains) const {
    for (TranslationRecord& grain : grains.translation) grain.position = periodic.wrap(grain.position);
    for (std::size_t k = 0; k < grains.bodies.size(); ++k)
        grains.bodies[k].position = periodic.wrap(grains.bodies[k].position);
    grains.bodies.placeAll(grains);  // each body stays whole
}

void Scene::wrapPlaced(ParticleStore& grains, const GrainChanges& changes, bool hadEnds) {
    const double before = potentialEnergy(grains, gravity);
    if (!hadEnds) wrapAll(grains);  // no contact is at a part of a wall
    for (const auto* identities : {&changes.added, &changes.placed})
        for (const std::uint32_t identity : *identities)
            if (!grains.bodies.contains(identity)) {
                Vector<double>& position = grains.translation[grains.place[identity]].position;
                position = periodic.wrap(position);
            }
    intoLedger([&] { ledger.carried += before - potentialEnergy(grains, gravity); });
    periodicWalls.lookAgain();
}

void Scene::lookForDeepOverlaps(const ParticleStore& grains, double approach) {
    approachUnseen += approach;
    if (approachUnseen < 0.1 * smallestRadius) return;
    approachUnseen = 0;
    refuseFarGrains(grains, getTime());
    refuseDeepOverlaps(contactSystem.store(), grains, periodic, laws(), getTime());
}

void Scene::refuseRunaway(double shift) const {
    if (!(shift <= smallestRadius))
        throw runawayError(particleHandler.store(), smallestRadius, getTime(), getTimeStep());
}

}  // namespace pendular
