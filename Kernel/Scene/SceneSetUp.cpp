#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Motion/TimeIntegration.h"
#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Features/Meshes/WallSeams.h"
#include "Kernel/Features/Wear/WornWall.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Scene/DomainWarnings.h"
#include "Kernel/Scene/LikelySlips.h"
#include "Kernel/Scene/PlaneScene.h"
#include "Kernel/Scene/SceneCheck.h"
#include "Kernel/Scene/SceneDomain.h"
#include "Kernel/Scene/SceneInside.h"
#include "Kernel/Scene/TimeStep/SoftestModulus.h"

// How a scene is set up and checked.

namespace pendular {

Scene::Inside::Inside(Scene& of)
    : scene(of),
      context{of.particleHandler, of.bodyHandler, of.wallHandler, contacts, box, of.logger, of.stepTimer()},
      adaptive(of.inletHandler, flow),
      fluxPlanes(of.fluxPlaneHandler),
      bodies(of.inletHandler),
      liquid(of.sprayHandler, of.inletHandler),
      drives(of.wallHandler),
      outlets(of.outletHandler),
      inlets(of.inletHandler),
      sprays(of.sprayHandler) {
    context.parts = &parts;
    context.scheme = &integrator;
    context.checkedSizes = &checkedSizes;
}

void Scene::Inside::refuseUnlessBridgesJoin() const {
    const auto count = static_cast<int>(laws().speciesCount());
    for (int a = 0; a < count; ++a)
        for (int b = a; b < count; ++b)
            if (laws().ofPair(a, b).formsAtContact && !laws().liquidRules(a, b)) return;
    throw InputError(
        fmt::format("Simulation: gap of bridges at the start = {:.6g} m, but no species has bridges of a "
                    "volume of their own that form at a touch; leave joinAtStart() out, or take such a "
                    "species.",
                    gapOfFirstBridges));
}

void Scene::Inside::setUp() {
    ParticleHandler& particles = scene.particleHandler;
    if (!scene.hasInitialConditions) scene.setupInitialConditions();
    // The account tells what slides at walls that wear.
    account.noteWear(!wornWalls(scene.wallHandler).empty());
    scene.prepareOutputs();
    scene.requireTimeStep();
    account.settle(sharing.has_value());
    account.show(context);
    laws().mixAll();
    ParticleHandler::Inside::settleSpin(particles);
    if (!scene.isRestarted()) ParticleHandler::Inside::renewMasses(particles);
    particles.films().settle(particles.store(), laws().layout.liquid > 0);
    liquid.refuseWhereNoneMoves(context, filmMass.getDensity());
    if (scene.isRestarted()) {
        scene.readRestart();
        return liquid.refuseMoreSpray(contextNow(0), scene.getTimeMax());
    }
    if (const double quantum = liquid.beginToCount(context, scene.getTimeMax()); quantum > 0) {
        scene.sprayHandler.begin(quantum);
        if (filmMass.getDensity() > 0) ParticleHandler::Inside::weighFilms(particles);  // rounded to quanta
    }
    prepare();
    ParticleStore& grains = particles.store();
    if (sharing) agreeOnAll(true);
    if (periodicWalls.haveEnds()) wrapAll(grains);
    contacts.refresh(grains, 0, 0);
    if (gapOfFirstBridges > 0) {
        refuseUnlessBridgesJoin();
        contacts.join(grains, gapOfFirstBridges);
    }
    refuseInitialOverlaps(contacts, grains, acceptedOverlap, [](auto&&...) { return true; });
    if (const std::string remark = remarkOnHeldOverlaps(contacts, grains, acceptedOverlap); !remark.empty())
        scene.logger(LogLevel::Warn, "{}.", remark);
    TimeIntegration::start(grains, integrator);
    advance(0, false);  // a step of no length: forces and accelerations at the start
    account.beginWithThis();
    TimeIntegration::start(grains, integrator);
    scene.tellEvents();
}

Features Scene::Inside::featuresOfScene() const {
    Features found;
    if (!scene.wallHandler.present().empty()) found.add(Feature::Walls);
    for (const NumberedWornWall& worn : wornWalls(scene.wallHandler)) {
        found.add(Feature::WornWalls);
        if (worn.wall->wearLaw().needsImpacts()) found.add(Feature::ImpactWear);
    }
    if (laws().shapes()) found.add(Feature::Superquadrics);
    if (laws().resistsMotion) found.add(Feature::ViscousBridges);
    if (box.any() && !box.imagesMove) found.add(Feature::PeriodicFaces);
    if (context.gravity != Vector<double>{0, 0, 0}) found.add(Feature::Gravity);
    if (integrator.remembersEarlier()) found.add(Feature::EarlierAccelerations);
    if (integrator.contacts.springsInStep) found.add(Feature::SpringsInStep);
    if (contacts.events().areListenedTo()) found.add(Feature::ContactEvents);
    if (sharing) found.add(Feature::Ranks);
    return found;
}

Features Scene::Inside::wakeParts() {
    Features found = parts.wake(context);
    found.add(featuresOfScene());
    return found;
}

Features Scene::Inside::featuresNow() const {
    Features found = parts.features(context);
    found.add(featuresOfScene());
    return found;
}

void Scene::Inside::refuseForMovingImages() {
    contextNow(stepLength());
    bodies.askRanks(!isDistributed());
    const Features found = wakeParts();
    bodies.askRanks(true);
    refuseConflictsOf(flow.features(context), found);
    if (scene.hasBegun()) parts.refuseOwnConflicts(found);
    flow.check(context);
}

bool Scene::Inside::takesSpringsInStep(const GrainSizes& sizes) const {
    const bool needsThem =
        !sizes.hasBodies &&
        schemeOfScene(laws(), sizes, scene.wallHandler, contactScheme(context)).contacts.springsInStep;
    return needsThem ||
           (adaptive.step().isSet() && integrator.contacts.implicitForces && laws().layout.hasTorque);
}

static void refuseWalls(const GrainShapes* shapes, const WallHandler& walls) {
    if (!shapes) return;
    for (const auto& [number, wall] : walls.present())
        if (const std::string reason = shapes->objectionTo(*wall); !reason.empty())
            throw InputError(fmt::format("wall {}: {}.", number, reason));
}

/// Once of each kind, though its numbers change as more grains come.
static void warnOfSlips(const Logger& logger, const ContactLaws& laws, const GrainSizes& sizes,
                        const WallHandler& walls) {
    for (const std::string& slip : likelySlips(laws, sizes, walls)) {
        const std::string kind = slip.substr(0, std::min(slip.find(" = "), slip.find(" it is ")));
        const auto isOfIt = [&](const std::string& told) { return told.starts_with(kind); };
        if (std::ranges::none_of(logger.warnings(), isOfIt)) logger(LogLevel::Warn, "{}.", slip);
    }
}

/// Of what has come in the run. Where its first grains are tells nothing of a mesh: more may come.
static void warnOfNewSlips(const Logger& logger, const ContactLaws& laws, GrainSizes sizes,
                           const WallHandler& walls) {
    const GrainSizes none;
    sizes.lowest = none.lowest, sizes.highest = none.highest;
    warnOfSlips(logger, laws, sizes, walls);
}

void Scene::Inside::check() {
    contextNow(stepLength());
    context.hasInlets = !scene.inletHandler.isEmpty();
    const Features found = wakeParts();
    refuseConflicts(found);
    refuseOutOfPlane(context);
    refuseForDiscs(context);
    parts.refuseOwnConflicts(found);
    refuseWalls(laws().shapes(), scene.wallHandler);
    refuseWear(scene.wallHandler, account.acts(), laws().layout.hasTorque);
    GrainSizes sizes = sizesOf(scene.particleHandler.store());
    if (laws().shapes()) checkedRadii = laws().shapes()->largestRadiusRatio();
    if (scene.hasBegun() && stepLength() != checkedStep) refuseOtherStep();
    const bool checksStep = !context.acceptsUnstableStep && !adaptive.step().hasChosen(),
               willBeInStep = takesSpringsInStep(sizes);
    context.springsInStep &= willBeInStep;
    checkScene(laws(), sizes, scene.wallHandler, checksStep ? stepLength() : 0, contactScheme(context));
    context.springsInStep = willBeInStep;
    refuseFarFaces(box, sizes.smallest());
    context.largestReach =
        std::max(context.largestReach, checkPeriodicLengths(laws(), sizes, scene.wallHandler, box));
    parts.check(context);
    const double smallest = sizes.smallest();
    periodicWalls.check(scene.wallHandler, scene.wallHandler.hasChanges(), box, laws(), sizes,
                        sizes.hasBodies ? bodies.widest() : 0, std::min(context.smallestRadius, smallest));
    checkedStep = stepLength();
    scene.wallHandler.changesAreKnown();
    checkedSizes = std::move(sizes);
    if (scene.hasBegun() && smallest < context.smallestRadius) contacts.setSmallestRadius(smallest);
    context.smallestRadius = std::min(context.smallestRadius, smallest);
    if (scene.hasBegun() && scene.keepsWarnings())
        warnOfNewSlips(scene.logger, laws(), checkedSizes, scene.wallHandler);
}

void Scene::Inside::prepare() {
    check();
    if (!scene.isRestarted()) refuseStepOfOtherScene();
    static_cast<void>(ParticleHandler::Inside::takeChanges(scene.particleHandler));
    ParticleHandler::Inside::closeColumns(scene.particleHandler);
    lawsAreNew = false;
    GrainFilms& films = scene.particleHandler.films();
    if (films.areKept())
        scene.keepOutput({.write = [this] { LiquidPart::requireAll(liquidLedger(), scene.getTime()); }});
    scene.setHasBegun();
    scene.sprayHandler.close();
    parts.begin(context, scene.isRestarted());
    contacts.prepare(laws(), scene.wallHandler, box, SkinChoice::byCost(context.smallestRadius),
                     account.takesSamples(), films.areKept() ? &films : nullptr);
    warn();
}

void Scene::Inside::warn() const {
    Logger& logger = scene.logger;
    if (!scene.keepsWarnings()) return;
    if (laws().grainsAreDiscs())
        logger(LogLevel::Info,
               "Grains are discs: densities are by area (kg/m^2), masses pi r^2 rho, moments of inertia m "
               "r^2 / 2; volumes in outputs are those of spheres.");
    if (context.threads > processorCount())
        logger.show(LogLevel::Warn,  // a matter of this machine
                    fmt::format("{} threads share {} processors; the run is slower than with {}.",
                                context.threads, processorCount(), processorCount()));
    for (const BrokenLimit& broken : brokenLimits(laws(), checkedSizes, scene.wallHandler))
        scene.warnOnce({warningOf(broken)});
    const ParticleStore& grains = scene.particleHandler.store();
    if (const std::string remark = remarkOnFarGrains(grains); !remark.empty())
        logger(LogLevel::Warn, "{}.", remark);
    warnOfSlips(logger, laws(), checkedSizes, scene.wallHandler);
    warnOfEnergyGainOfSprings();
    if (!scene.isQuiet()) warnOfSeams();  // which may take a while
}

void Scene::Inside::refuseStepOfOtherScene() const {
    const auto before = scene.getStepForFigure();
    if (!before || !before->isKnown()) return;
    const StepForFigure now = findStepForFigure(scene, featuresNow(), before->figure, before->asked);
    if (stepLength() <= std::max(now.limit, (1 + 1e-9) * now.step)) return;
    throw InputError(fmt::format(
        "Simulation: the time step of {:.4g} s for {} was chosen before all of the scene was there, which "
        "stands {:.4g} s{}; call setStepFor() last.",
        stepLength(), nameOf(before->figure), now.step, now.isKnown() ? "" : ", because " + now.unknown));
}

void Scene::Inside::warnOfEnergyGainOfSprings() const {
    if (const auto forFigure = scene.getStepForFigure(); forFigure && forFigure->isKnown()) {
        const std::string objection =
            objectionToMeasuredSteps(scene, featuresNow(), checkedSizes, forFigure->figure);
        if (objection.empty()) return;  // beds have stayed at rest with it
        scene.logger(
            LogLevel::Warn,
            "The time step for {} was chosen before all of the scene was there: {}; call setStepFor() "
            "last.",
            nameOf(forFigure->figure), objection);
    }
    const double fewest =
        fewestStepsToDouble(laws(), checkedSizes, scene.wallHandler, contactScheme(context), stepLength());
    if (fewest > 1e7) return;
    const std::string time = fewest < 1 ? "less than one step" : fmt::format("some {:.0f} steps", fewest);
    constexpr std::string_view advice =
        "give it a larger dissipation, or take a smaller step, integrators::springsInStep or velocityVerlet";
    scene.logger(LogLevel::Warn,
                 "{}: its springs have too weak dashpots for a time step of {:.3g} s, at which motions of "
                 "grains at rest may double in {}; {}.",
                 laws().friction, stepLength(), time, advice);
}

void Scene::Inside::warnOfSeams() const {
    const ParticleStore& grains = scene.particleHandler.store();
    double largest = 0;
    for (const std::uint32_t place : grains.place)
        if (!laws().shapes() || !laws().shapes()->isShaped(grains, place))
            largest = std::max(largest, grains.translation[place].radius);
    if (!(largest > 0)) return;
    for (const std::string& sentence : doubtfulSeams(scene.wallHandler, context.smallestRadius, largest))
        scene.logger(LogLevel::Warn, "{}.", sentence);
}

}  // namespace pendular
