#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Features/RigidBodies/MovingBodies.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Scene/ListedContacts.h"
#include "Kernel/Scene/SceneInside.h"

// The functions of a scene that concern its time step.

namespace pendular {

double Scene::stabilityLimit() {
    inside->mixChangedLaws();
    return sceneStabilityLimit(laws(), grainSizes(particleHandler.store()), wallHandler, scheme());
}

double Scene::stabilityLimit(std::span<const SphericalParticle> toCome) {
    inside->mixChangedLaws();
    ParticleStore grains = particleHandler.store();
    for (const SphericalParticle& grain : toCome) {
        const double mass = particleHandler.massOf(grain.getRadius(), grain.getSpeciesIndex());
        grains.add({{0, 0, 0}, grain.getRadius(), {0, 0, 0}, grain.isFixed() ? 0 : 1 / mass}, {0, 0, 0},
                   static_cast<std::uint16_t>(grain.getSpeciesIndex()));
    }
    return sceneStabilityLimit(laws(), grainSizes(grains), wallHandler, scheme());
}

double Scene::shortestContactTime() {
    inside->mixChangedLaws();
    return shortestHalfPeriod(laws(), grainSizes(particleHandler.store()), wallHandler);
}

double Scene::stableStepOfContacts() {
    requireListedContacts(*this, "stableStepOfContacts()");
    return ContactBounds().find(contacts(), wallHandler, particleHandler.store(), scheme()).step;
}

StabilityAdvice Scene::stabilityAdvice() {
    requireListedContacts(*this, "stabilityAdvice()");
    contacts().ranks().requireAllGrains("advice on the stability and its figures");
    const ParticleStore& grains = particleHandler.store();
    const auto find = [&](const ContactOutlook& outlook) {
        return ContactBounds().find(contacts(), wallHandler, grains, scheme(), outlook);
    };
    const ContactBound now = find({}), pressed = find({.leastOverlap = largestSoundOverlap}),
                       smooth = find({.sticking = false});
    const double limit = stabilityLimit();
    const bool acts = now.step < infinity, isOfGrain = acts && now.wall < 0;
    std::size_t sides = 0, moving = 0;
    contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        if (contacts().touches(contact)) sides += bucket.wall < 0 ? 2 : 1;
    });
    forEachMovingBody(grains, [&](double, const Vector<double>&, const Vector<double>&) { ++moving; });
    return {
        .limit = limit,
        .step = now.step,
        .byOverlap = acts ? now.step / pressed.step : 1,
        .byNeighbours = acts ? pressed.step / limit : 1,
        .byFriction = acts ? smooth.step / now.step : 1,
        .largestOverlap = now.largestOverlap,
        .meanOverlap = now.meanOverlap,
        .contactsOfGrain = static_cast<double>(sides) / static_cast<double>(std::max<std::size_t>(moving, 1)),
        .slidingShare = slidingShare(contacts(), grains),
        .grain = now.grain,
        .body = isOfGrain ? grains.bodies.bodyOf(now.grain) : RigidBodies::none,
        .species = isOfGrain ? grains.species[grains.place[now.grain]] : std::uint16_t{0},
        .wall = now.wall,
        .contactsOfThis = now.contactsOfGrain,
        .overlapOfThis = now.overlapOfGrain};
}

void Scene::setAdaptiveTimeStep(double share, std::optional<double> largestStep) {
    requireSetUp("adaptive time step");
    checkValue("Simulation", "share of the adaptive time step", share, "", {0, 1, false, true});
    if (largestStep) checkValue("Simulation", "largest adaptive time step", *largestStep, "s", positive);
    inside->adaptive.set(share, largestStep.value_or(0));
}

StepForError Scene::stepForError(double error, std::optional<double> speed) {
    requireSetUp("time step for an error");
    return findStepForError(*this, error, speed);
}

void Scene::setStepFor(double error, std::optional<double> speed) {
    const StepForError found = stepForError(error, speed);
    setTimeStep(found.step);
    acceptUnstableTimeStep(found.step > found.limit);
    inside->stepForError = found;
    logger(LogLevel::Info, "{}", found.text());
}

std::optional<StepForError> Scene::getStepForError() const {
    const std::optional<StepForError>& found = inside->stepForError;
    return found && found->step == getTimeStep() ? found : std::nullopt;
}

StepForFigure Scene::stepForError(WantedFigure figure, double error) {
    requireSetUp("time step for a bulk quantity");
    inside->contextNow(0);
    return findStepForFigure(*this, inside->featuresNow(), figure, error);
}

void Scene::setStepFor(WantedFigure figure, double error) {
    const StepForFigure found = stepForError(figure, error);
    setTimeStep(found.step);
    acceptUnstableTimeStep(found.step > found.limit);
    inside->stepForFigure = found;
    logger(LogLevel::Info, "{}", found.text());
}

std::optional<StepForFigure> Scene::getStepForFigure() const {
    const std::optional<StepForFigure>& found = inside->stepForFigure;
    return found && found->step == getTimeStep() ? found : std::nullopt;
}

}  // namespace pendular
