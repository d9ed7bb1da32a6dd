#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Scene/DomainWarnings.h"
#include "Kernel/Scene/RankAgreement.h"
#include "Kernel/Scene/SceneCheck.h"
#include "Kernel/Scene/SceneInside.h"

// A step of a scene.

namespace pendular {

StepContext& Scene::Inside::contextNow(double length) {
    context.time = scene.getTime();
    context.length = length;
    context.timeAfter = length > 0 ? scene.timeAfterNextStep() : context.time;
    context.number = scene.getNumberOfTimeSteps();
    context.shifts = {};
    context.grainsHaveMoved = false;
    return context;
}

void Scene::Inside::advanceByStep(bool another) {
    if (sharing && !isDistributed()) agreeOnAll();  // hooks or the driver may have changed all of it
    WithinStep time(scene);
    takeOverChanges();
    try {
        parts.call(&StepPart::prepare, contextNow(stepLength()));
    } catch (const InputError& refusal) {
        throw RunError(refusal.what());
    }
    choosePartsLength();
    try {
        moveAndFindForces(stepLength());
    } catch (const InputError& refusal) {
        time.leave();
        takeBack();
        throw RunError(refusal.what());
    } catch (...) {
        time.leave();
        takeBack();
        throw;
    }
    try {
        finishStep(another);
        parts.call(&StepPart::atEnd, context);
    } catch (const InputError& refusal) {
        throw RunError(refusal.what());
    }
}

void Scene::Inside::takeBack() {
    parts.takeBack(context);
    scene.wallHandler.moveTo(scene.getTime());
}

/// A part may have chosen another length of the steps from now on.
void Scene::Inside::choosePartsLength() {
    if (context.length == stepLength()) return;
    scene.setTimeStep(context.length);
    checkedStep = stepLength();
}

void Scene::Inside::advance(double length, bool another) {
    const WithinStep time(scene);
    moveAndFindForces(length);
    finishStep(another);
}

void Scene::Inside::moveAndFindForces(double length) {
    StepContext& step = contextNow(length);
    moveAll(step);
    findForces(step);
    parts.call(&StepPart::afterForces, step);
    parts.call(&StepPart::accelerate, step);
}

void Scene::Inside::finishStep(bool another) {
    context.times.enter(StepTimes::Part::Sum);
    context.unfinished = context.length;
    ParticleHandler::Inside::leaveStepUnfinished(scene.particleHandler);
    if (!another || parts.needFinishedStep()) scene.particleHandler.finishStep();
    if (context.account) contacts.renewGhosts(context.grains());  // it looks at their motion
    context.times.enter(StepTimes::Part::Other);
    parts.call(&StepPart::finish, context);
    context.times.enter(StepTimes::Part::Other);
}

void Scene::Inside::moveAll(StepContext& step) {
    parts.call(&StepPart::beforeMotion, step);
    step.finishesLast = ParticleHandler::Inside::takeUnfinishedStep(scene.particleHandler);
    step.grainsHaveMoved = true;
    parts.call(&StepPart::moveGrains, step);
    if (sharing) {
        // All list in the same step.
        const GrainSharing::OfAll all =
            sharing->exchangeStep(step.grains(), contactScheme(step).contacts.springsInStep,
                                  step.shifts.grains, isDistributed() ? hashOfStep() : 0);
        if (!all.areAlike)
            refuseDifference(
                differenceOfRanks(*sharing, [this](StateArchive& archive) { visitStep(archive); }));
        step.shifts.grains = all.shift;
        step.shifts.approach = 2 * step.shifts.grains;
    }
    refuseRunaway(step.shifts.grains);
    parts.call(&StepPart::moveSurroundings, step);
    refuseRunaway(step.shifts.grains);  // with what a flow carries them
    scene.goToEndOfStep(step.timeAfter);
    step.shifts.walls = scene.wallHandler.moveTo(step.time + step.length);
    periodicWalls.follow(scene.wallHandler, step.shifts.walls, step.time + step.length);
    step.times.enter(StepTimes::Part::Search);
    parts.call(&StepPart::afterMotion, step);
}

void Scene::Inside::exchangeMotion(StepContext& step) {
    sharing->exchangeMotion(step.grains(), contactScheme(step).contacts.springsInStep);
}

void Scene::Inside::findForces(StepContext& step) {
    ParticleStore& grains = step.grains();
    bringBack(step);
    if (periodicWalls.takeNewImages()) contacts.listNow(grains);
    else contacts.refresh(grains, step.shifts.grains, step.shifts.walls);
    agreeAtList();
    if (periodicWalls.haveEnds()) bringBackAtWalls(step);
    lookForDeepOverlaps(grains, step.shifts.approach);
    step.times.enter(StepTimes::Part::Contacts);
    ContactTiming timing = contactScheme(step).contacts;
    timing.comingStep = stepLength();
    contacts.computePairForces(grains, step.length, timing);
    overlapsAreSeen = true;
    step.times.enter(StepTimes::Part::Walls);
    contacts.computeWallForces(grains, step.length, timing);
}

void Scene::Inside::bookWentRound(const StepContext& step) {
    if (!step.ledger) return;
    const StepTimes::Within ledger(step.times, StepTimes::Part::Ledger);
    step.account->wentRound(step.grains(), contacts.ranks(), step.gravity, *step.ledger);
}

void Scene::Inside::bringBack(StepContext& step) {
    constexpr std::size_t stepsBetween = 256;
    if (!box.any() || periodicWalls.haveEnds() || step.number % stepsBetween != 0) return;
    if (box.imagesMove) FlowPart::takeVelocitiesOfImages(step);
    wrapAll(step.grains());
    if (sharing) exchangeMotion(step);  // a body is brought back as a whole
    bookWentRound(step);
}

void Scene::Inside::bringBackAtWalls(StepContext& step) {
    ParticleStore& grains = step.grains();
    if (!periodicWalls.isBringingBackDue(grains, step.shifts.grains, checkedSizes.hasBodies,
                                         contacts.ranks()))
        return;
    const double stored = contacts.goThroughFaces(grains, periodicWalls.outside(grains),
                                                  periodicWalls.endsOfWalls(), step.time + step.length, [&] {
                                                      wrapAll(grains);
                                                      if (sharing)
                                                          exchangeMotion(step);  // a body goes as a whole
                                                  });
    if (step.ledger) step.ledger->driver -= stored;  // in the step, as finish() sums what is stored anew
    bookWentRound(step);
}

void Scene::Inside::wrapAll(ParticleStore& grains) const {
    for (TranslationRecord& grain : grains.translation) grain.position = box.wrap(grain.position);
    for (std::size_t k = 0; k < grains.bodies.size(); ++k)
        grains.bodies[k].position = box.wrap(grains.bodies[k].position);
    grains.bodies.placeAll(grains);  // each body stays whole
}

void Scene::Inside::lookForDeepOverlaps(const ParticleStore& grains, double approach) {
    approachUnseen += approach;
    if (approachUnseen < 0.1 * context.smallestRadius) return;
    approachUnseen = 0;
    refuseFarGrains(grains, context.time);
    warnOfOverlaps();
    if (canOverlapDeeply(approach)) refuseDeepOverlaps(contacts.store(), grains, box, laws(), context.time);
}

/// A contact that overlapped by d at the last forces overlaps by at most d + approach now. The watch has the
/// largest d / R*, and R* is not larger than the smaller radius: d + approach is at most the sum below times
/// this radius. 1e-9 is for rounding. Superquadrics also turn into each other.
bool Scene::Inside::canOverlapDeeply(double approach) const {
    if (laws().shapes()) return true;
    const double seen = overlapsAreSeen ? contacts.ownOverlaps().largestOverlap() : infinity,
                 most = contacts.ranks().largest(seen) + approach / context.smallestRadius;
    return !(most < (1 - 1e-9) * leastDeepOverlap(contacts.store(), laws()));
}

/// On several ranks, each of which has seen some contacts only, the end of the run tells.
void Scene::Inside::warnOfOverlaps() const {
    if (sharing || !scene.warnsOnItsWay() || contacts.ownOverlaps().countAbove() == 0 ||
        scene.hasWarnedOf(kindOfOverlapWarning))
        return;
    if (const auto warning = overlapWarning(contacts.ownOverlaps(), laws().overlapLimit))
        scene.warnOnce({*warning});
}

void Scene::Inside::refuseRunaway(double shift) const {
    if (!(shift <= context.smallestRadius))
        throw runawayError(scene.particleHandler.store(), context.smallestRadius, context.time, stepLength());
}

}  // namespace pendular
