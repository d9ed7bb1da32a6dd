#include <numbers>

#include "Kernel/Simulation/Scene.h"

// What a scene says of its time step, and how it chooses one.

namespace pendular {

static constexpr std::string_view orOtherIntegrator =
    ", or take integrators::predictedVelocityVerlet or velocityVerlet";

double Scene::stableStepOfContacts() {
    requireBegun("stableStepOfContacts()");
    refuseBoundForBodies("stableStepOfContacts()");
    return bounds.find(contactSystem, wallHandler, particleHandler.store(), scheme()).step;
}

StabilityAdvice Scene::stabilityAdvice() {
    requireBegun("stabilityAdvice()");
    refuseBoundForBodies("stabilityAdvice()");
    const ParticleStore& grains = particleHandler.store();
    const auto find = [&](const ContactOutlook& outlook) {
        return bounds.find(contactSystem, wallHandler, grains, scheme(), outlook);
    };
    const ContactBound now = find({}), pressed = find({.leastOverlap = largestSoundOverlap}),
                       smooth = find({.sticking = false});
    const double limit = stabilityLimit();
    const bool acts = now.step < infinity;
    std::size_t sides = 0, free = 0;
    contactSystem.store().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        if (contactSystem.store().touches(contact)) sides += bucket.wall < 0 ? 2 : 1;
    });
    for (const std::uint32_t at : grains.place) free += grains.isFree(at) ? 1 : 0;
    return {
        .limit = limit,
        .step = now.step,
        .byOverlap = acts ? now.step / pressed.step : 1,
        .byNeighbours = acts ? pressed.step / limit : 1,
        .byFriction = acts ? smooth.step / now.step : 1,
        .largestOverlap = now.largestOverlap,
        .meanOverlap = now.meanOverlap,
        .contactsOfGrain = static_cast<double>(sides) / static_cast<double>(std::max<std::size_t>(free, 1)),
        .slidingShare = slidingShare(contactSystem, grains),
        .grain = now.grain,
        .species = acts ? grains.species[grains.place[now.grain]] : std::uint16_t{0},
        .contactsOfThis = now.contactsOfGrain,
        .overlapOfThis = now.overlapOfGrain};
}

void Scene::refuseBoundForBodies(std::string_view call) const {
    if (!particleHandler.store().bodies.empty())
        throw InputError(
            fmt::format("Simulation: {} does not know rigid bodies; take stabilityLimit().", call));
}

void Scene::setAdaptiveTimeStep(double share, std::optional<double> largestStep) {
    requireSetUp("adaptive time step");
    checkValue("Simulation", "share of the adaptive time step", share, "", {0, 1, false, true});
    if (largestStep) checkValue("Simulation", "largest adaptive time step", *largestStep, "s", positive);
    adaptive.set(share, largestStep.value_or(0));
}

void Scene::refuseForAdaptiveStep() const {
    refuseBoundForBodies("the adaptive time step");
    if (periodic.imagesMove)
        throw InputError(
            "Simulation: the adaptive time step does not know shear (setLeesEdwards()) and strain "
            "(setStrainRate(), setTargetStress()); leave setAdaptiveTimeStep() out.");
    for (std::size_t w = 0; w < wallHandler.getSize(); ++w)
        if (wallHandler.getObject(w).drive() || wallHandler.getObject(w).membrane())
            throw InputError(fmt::format(
                "wall {}: the adaptive time step does not know walls that forces move (setPiston(), "
                "setTargetForce()) and membranes; leave setAdaptiveTimeStep() out.",
                w));
    if (const std::string reason = whyStepsOfOneLength(); !reason.empty())
        throw InputError(fmt::format("Simulation: {}; leave setAdaptiveTimeStep() out{}.", reason,
                                     laws().resistsMotion ? "" : orOtherIntegrator));
}

/// A bridge pays for the drift of the step that comes, and Adams' formulas have the weights of equal steps.
std::string Scene::whyStepsOfOneLength() const {
    if (laws().resistsMotion)
        return fmt::format("the viscous bridges of {} need steps of one length", laws().name);
    if (integrator.remembersEarlier())
        return fmt::format("the integrator {} needs steps of one length", shownName(integrator));
    return {};
}

void Scene::refuseOtherStep() const {
    if (const std::string reason = whyStepsOfOneLength(); !reason.empty())
        throw InputError(
            fmt::format("Simulation: time step = {:.6g} s cannot be changed to {:.6g} s in the run: {}; set "
                        "it before the run begins{}.",
                        checkedStep, getTimeStep(), reason, laws().resistsMotion ? "" : orOtherIntegrator));
}

double Scene::largestStepOf(const GrainSizes& sizes) const {
    const double most = 0.9 / std::numbers::pi * shortestHalfPeriod(laws(), sizes, wallHandler);
    return most < infinity ? most : getTimeStep();  // nothing can touch
}

void Scene::shortenTimeStep() {
    const GrainSizes sizes = grainSizes(particleHandler.store());
    const double limit = sceneStabilityLimit(laws(), sizes, wallHandler, scheme()),
                 step = adaptive.shorten(getTimeStep(), largestStepOf(sizes), limit);
    if (step < getTimeStep()) setTimeStep(step);
    checkedStep = getTimeStep();
}

void Scene::chooseTimeStep() {
    particleHandler.finishStep();
    ParticleStore& grains = particleHandler.storeInStep();
    const StepTimes::Part before = enter(StepTimes::Part::Search);
    const GrainSizes sizes = grainSizes(grains);
    const double step = getTimeStep(), most = largestStepOf(sizes);
    const AdaptiveStep::Outlook outlook =
        adaptive.lookAhead(grains, step, most, norm(gravity), sizes.smallest());
    ContactBound bound;
    if (outlook.isKnown()) {
        contactSystem.listWithin(grains, outlook.contacts.reach);
        bound = bounds.find(contactSystem, wallHandler, grains, scheme(), outlook.contacts);
    }
    const double limit =
        outlook.isKnown() ? infinity : sceneStabilityLimit(laws(), sizes, wallHandler, scheme());
    setTimeStep(adaptive.choose(step, most, outlook, bound, limit));
    contactSystem.expectOverlaps(adaptive.supposedOverlap());
    checkedStep = getTimeStep();
    enter(before);
}

}  // namespace pendular
