#include "Kernel/Features/ShearAndStrain/FlowPart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/StepTimes.h"
#include "Kernel/Core/Walls/InfiniteWall.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Features/EnergyLedger/EnergyAccount.h"
#include "Kernel/Features/ShearAndStrain/StressServo.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

/// The first wall that is no plane, or one across which the scene repeats itself: the flow would carry images
/// through it.
std::optional<std::size_t> wallInFlow(const WallHandler& walls, const PeriodicBox& box) {
    constexpr double roundOff = 1e-12;
    for (const auto& [number, wall] : walls.present()) {
        const auto* const plane = dynamic_cast<const InfiniteWall*>(wall.get());
        if (!plane) return number;
        const Vector<double> normal = plane->drivenNormal();
        for (const auto axis : vectorAxes)
            if (box.length.*axis > 0 && std::abs(normal.*axis) > roundOff) return number;
    }
    return {};
}

/// Grains whose images move otherwise from now on get another velocity; the account knows it.
/// @param changeAt (place, m): by how much, m/s
template <class Function>
void changeVelocities(StepContext& step, Function&& changeAt) {
    ParticleStore& grains = step.grains();
    ExactSum given;                                                  // J
    for (std::uint32_t place = 0; place < grains.size(); ++place) {  // ghosts, too
        if (grains.isGap(place)) continue;
        TranslationRecord& grain = grains.translation[place];
        // A rigid body goes over as a whole, when its centre does.
        const std::uint32_t body = grains.bodies.bodyOf(grains.identity[place]);
        const Vector<double> at =
            body == RigidBodies::none ? grain.position : grains.bodies[grains.bodies.find(body)].position;
        if (const Vector<double> change = changeAt(at); squaredNorm(change) > 0) {
            grain.velocity += change;
            if (!step.account) continue;
            if (body == RigidBodies::none && place < grains.ownSize())
                given.add(EnergyAccount::changedImage(grains, place, change));
            else EnergyAccount::changedImageOfMember(grains, place, change);
        }
    }
    for (std::size_t k = 0; k < grains.bodies.sizeWithGhosts(); ++k)
        if (const Vector<double> change = changeAt(grains.bodies[k].position); squaredNorm(change) > 0) {
            grains.bodies[k].velocity += change;
            if (step.ledger && k < grains.bodies.size())
                given.add(step.account->changedImageOfBody(grains, k, change));
        }
    if (step.ledger) EnergyAccount::givenByImages(given, step.contacts.ranks(), *step.ledger);
}

}  // namespace

Features FlowPart::features(const StepContext& scene) const {
    Features found;
    if (shear.isSet) found.add(Feature::Shear);
    if (strain.isSet) found.add(Feature::Strain);
    if (strain.isSet)
        if (const auto wall = wallInFlow(scene.walls, scene.box))
            found.add(Feature::WallsInStrain, fmt::format("wall {}", *wall));
    const auto isControlled = [](const AxisStrain& axis) { return axis.isControlled; };
    if (shear.isControlled || std::ranges::any_of(strain.axes, isControlled)) found.add(Feature::StressServo);
    if (shear.isSet && scene.gravity.*vectorAxes[shear.gradient] != 0)
        found.add(Feature::GravityAlongGradient);
    return found;
}

void FlowPart::check(const StepContext& scene) {
    const AxisStrain& alongFlow = strain.axes[static_cast<std::size_t>(shear.flow)];
    if (shear.isSet && (alongFlow.rate != 0 || alongFlow.isControlled))
        throw InputError(fmt::format(
            "Simulation: in shear (setLeesEdwards()) along axis {} the length along this axis stays; strain "
            "(setStrainRate(), setTargetStress()) the others.",
            shear.flow));
    for (const AxisStrain& axis : strain.axes)
        if (axis.isControlled) checkServo(scene, axis.time, "stress");
    if (shear.isControlled) checkServo(scene, shear.time, "shear stress");
}

void FlowPart::checkServo(const StepContext& scene, double time, std::string_view what) const {
    if (scene.length >= 2 * time)
        throw InputError(
            fmt::format("Simulation: time of the target {} = {:.6g} s; it must be more than half a "
                        "time step of {:.6g} s, or the stress would ring ever more.",
                        what, time, scene.length));
    for (const auto axis : vectorAxes)
        if (!(scene.box.length.*axis > 0))
            throw InputError(fmt::format(
                "Simulation: target {}: the scene does not repeat itself along all three axes, so its "
                "stress is not known; call setPeriodic() for all of them.",
                what));
}

void FlowPart::begin(StepContext& scene, bool isRestarted) {
    if (!isRestarted) shear.settle(scene.box);
    shear.move(scene.box, scene.time);
}

double FlowPart::shortestServoTime() const {
    double shortest = shear.isControlled ? shear.time : infinity;
    for (const AxisStrain& axis : strain.axes)
        if (axis.isControlled) shortest = std::min(shortest, axis.time);
    return shortest;
}

void FlowPart::prepare(StepContext& step) {
    const double shortest = shortestServoTime();
    if (shortest == infinity) return;
    double lowest = 0;  // Pa
    for (const AxisStrain& axis : strain.axes)
        if (axis.isControlled) lowest = std::min(lowest, axis.stress);
    constexpr double looksInTime = 100;
    const auto interval =
        static_cast<std::size_t>(std::clamp(shortest / step.length / looksInTime, 1.0, 1e15));
    if (step.number % interval != 0) return;
    const DiagonalStress now = diagonalStress(step.contacts, step.particles.store(), strain, shear);
    if (now.touches == 0 && lowest < 0)
        throw RunError(fmt::format(
            "At time {:.6g} s no two grains touch, and the target stress of {:.6g} Pa is a tension: grains "
            "that are apart cannot bear it; take a higher one, or grains that stick together.",
            step.time, lowest));
    controlStress(strain, shear, now, static_cast<double>(interval) * step.length, step.time);
}

void FlowPart::beforeMotion(StepContext& step) {
    boxBefore = step.box;
    shearBefore = shear;
    if (step.length == 0) return;
    shearChange = {0, 0, 0};
    if (shear.isSet) shearChange.*vectorAxes[shear.flow] = shear.begin(step.box, step.time);
    if (strain.isSet) strainChange = strain.begin(step.box, step.length);
    if (!strain.isSet && shearChange == Vector<double>{0, 0, 0}) return;
    step.particles.finishStep();
    changeVelocities(step, [&](const Vector<double>& place) { return changeOfFlow(step.box, place); });
}

Vector<double> FlowPart::changeOfFlow(const PeriodicBox& box, const Vector<double>& place) const {
    const Vector<double> byStrain = box.strainAt(place, strainChange);
    if (!shear.isSet) return byStrain;
    return byStrain + dot(box.across, place - box.middle()) * shearChange;
}

void FlowPart::moveSurroundings(StepContext& step) {
    // The flow carries all grains, and those that are near each other together at this rate at most, -n.G.n
    // of any direction n and the gradient G of the flow: n_f n_g is at most 1/2, and the strains are weighed
    // by n_x^2 + n_y^2 + n_z^2 = 1. The skin of a list is at most the smallest radius.
    const Vector<double> rates = step.box.strainRate;
    const double rate =
        0.5 * std::abs(shear.rate) + std::max({std::abs(rates.x), std::abs(rates.y), std::abs(rates.z)});
    if (strain.isSet) HomogeneousStrain::move(step.box, step.length);
    shear.move(step.box, step.timeAfter);
    step.contacts.setPeriodicBox(step.box);
    if (const auto objection = objectionToLengths(step.box, step.largestReach))
        throw RunError(fmt::format("At time {:.6g} s the {}", step.time, *objection));
    if (!step.contacts.ranks().any(step.grains().count() > 0)) {
        step.shifts.grains = step.shifts.approach = 0;
        return;
    }
    step.shifts.grains +=
        0.5 * rate * step.length * (step.largestReach + step.contacts.filmReach() + step.smallestRadius);
    step.shifts.approach += rate * step.length * step.largestReach;
}

void FlowPart::afterMotion(StepContext& step) {
    if (!strain.isSet) return;
    if (const auto wall = wallInFlow(step.walls, step.box))
        throw RunError(fmt::format(
            "At time {:.6g} s wall {} has turned: in strain its normal must stay along an axis that is not "
            "periodic, because the flow would carry images of grains through it.",
            step.time, *wall));
}

/// The grains are where they were before the step.
void FlowPart::takeBack(StepContext& step) {
    step.box = boxBefore;
    ParticleStore& grains = step.grains();
    for (TranslationRecord& grain : grains.translation)
        grain.velocity -= changeOfFlow(step.box, grain.position);
    for (std::size_t k = 0; k < grains.bodies.size(); ++k)
        grains.bodies[k].velocity -= changeOfFlow(step.box, grains.bodies[k].position);
    grains.bodies.placeAll(grains);
    shear = shearBefore;
    step.contacts.setPeriodicBox(step.box);
}

void FlowPart::takeVelocitiesOfImages(StepContext& step) {
    changeVelocities(step, [&](const Vector<double>& place) { return step.box.velocityOfWrap(place); });
}

void FlowPart::setPeriodic(PeriodicBox& box, int axis, double lowest, double highest, double now) {
    checkValue("Simulation", "periodic axis", axis, "", fromZeroTo(2));
    checkValue("Simulation", "periodic length", highest - lowest, "m",
               {radiusRange.lowest, infinity, true, false});  // of the smallest grains that there may be
    box.lowest.*vectorAxes[axis] = lowest;
    box.length.*vectorAxes[axis] = highest - lowest;
    shear.settle(box);
    shear.move(box, now);
}

void FlowPart::setLeesEdwards(PeriodicBox& box, int flow, int gradient, double rate, double now) {
    checkValue("Simulation", "axis of the flow", flow, "", fromZeroTo(2));
    checkValue("Simulation", "axis of the gradient", gradient, "", fromZeroTo(2));
    checkValue("Simulation", "shear rate", rate, "1/s", anyFinite);
    if (flow == gradient)
        throw InputError(fmt::format(
            "Simulation: shear: the flow and its gradient are both along axis {}; take two axes.", flow));
    for (const int axis : {flow, gradient})
        if (!(box.length.*vectorAxes[axis] > 0))
            throw InputError(
                fmt::format("Simulation: shear: the scene does not repeat itself along axis {}; call "
                            "setPeriodic() for the flow and the gradient first.",
                            axis));
    box = {box.lowest, box.length};
    box.imagesMove = strain.isSet;
    shear = {};
    shear.flow = flow;
    shear.gradient = gradient;
    shear.rate = rate;
    shear.isSet = true;
    shear.settle(box);
    shear.move(box, now);
    shearAtSetUp = shear;
}

static void requireShear(const LeesEdwards& shear, std::string_view what) {
    if (!shear.isSet)
        throw InputError(fmt::format(
            "Simulation: {}: the scene was not set up to be sheared; call setLeesEdwards() at set-up (a rate "
            "of 0 will do).",
            what));
}

void FlowPart::setShearRate(StepContext& scene, double rate, bool inRun) {
    requireShear(shear, "shear rate");
    checkValue("Simulation", "shear rate", rate, "1/s", anyFinite);
    if (!inRun) return setLeesEdwards(scene.box, shear.flow, shear.gradient, rate, scene.time);
    shear.rate = rate;
    shear.isControlled = false;
}

void FlowPart::setTargetShearStress(double stress, double time, std::optional<double> largest,
                                    const Refusal& inRun) {
    requireShear(shear, "target shear stress");
    checkValue("Simulation", "target shear stress", stress, "Pa", anyFinite);
    checkValue("Simulation", "time of the target shear stress", time, "s", positive);
    const double largestRate = largest.value_or(1 / time);
    checkValue("Simulation", "largest shear rate", largestRate, "1/s", positive);
    LeesEdwards asked = shear;
    if (!shear.isControlled) asked.atLargest = 0;
    asked.aimAt(stress, time, largestRate);
    if (inRun) takeUnlessRefused(shear, asked, inRun);
    else shear = shearAtSetUp = asked;
}

AxisStrain& FlowPart::axisToStrain(const PeriodicBox& box, int axis, std::string_view what, bool inRun) {
    checkValue("Simulation", fmt::format("axis of the {}", what), axis, "", fromZeroTo(2));
    if (inRun && !strain.isSet)
        throw InputError(
            fmt::format("Simulation: {}: the scene was not set up to be strained; call setStrainRate() at "
                        "set-up (a rate of 0 will do).",
                        what));
    if (!(box.length.*vectorAxes[axis] > 0))
        throw InputError(fmt::format(
            "Simulation: {}: the scene does not repeat itself along axis {}; call setPeriodic() first.", what,
            axis));
    return strain.axes[static_cast<std::size_t>(axis)];
}

void FlowPart::setStrain(PeriodicBox& box, int axis, const AxisStrain& how, const Refusal& inRun) {
    HomogeneousStrain asked = strain;
    asked.axes[static_cast<std::size_t>(axis)] = how;
    asked.isSet = box.imagesMove = true;
    if (inRun) takeUnlessRefused(strain, asked, inRun);
    else strain = strainAtSetUp = asked;
}

void FlowPart::setStrainRate(PeriodicBox& box, int axis, double rate, const Refusal& inRun) {
    static_cast<void>(axisToStrain(box, axis, "strain rate", static_cast<bool>(inRun)));
    checkValue("Simulation", "strain rate", rate, "1/s", anyFinite);
    AxisStrain given;
    given.rate = rate;
    setStrain(box, axis, given, inRun);
}

void FlowPart::setTargetStress(PeriodicBox& box, int axis, double stress, double time,
                               std::optional<double> largest, const Refusal& inRun) {
    AxisStrain asked = axisToStrain(box, axis, "target stress", static_cast<bool>(inRun));
    checkValue("Simulation", "target stress", stress, "Pa", anyFinite);
    checkValue("Simulation", "time of the target stress", time, "s", positive);
    const double largestRate = largest.value_or(0.1 / time);
    checkValue("Simulation", "largest strain rate", largestRate, "1/s", positive);
    if (!asked.isControlled) asked.oneWay = 0;
    asked.aimAt(stress, time, largestRate);
    setStrain(box, axis, asked, inRun);
}

double FlowPart::strainRate(int axis) const {
    checkValue("Simulation", "axis of the strain rate", axis, "", fromZeroTo(2));
    return strain.axes[static_cast<std::size_t>(axis)].rate;
}

/// Rates and targets are set up as they were; what the run has made of them comes from the file.
void FlowPart::visitSetting(StateArchive& archive, StepContext& scene) {
    PeriodicBox& box = scene.box;
    archive.same("shearRate", shearAtSetUp.rate, "1/s");
    archive.same("shearFlow", shear.flow);
    archive.same("shearGradient", shear.gradient);
    archive.same("shearIsSet", shear.isSet);
    if (shear.isSet)
        archive.group("shear", [&] {
            shearAtSetUp.visitFirst(archive);
            shear.visitNow(archive);
            archive.finite("atLargest", shear.atLargest);
            archive.finite("speed", shear.speed);
            archive.finite("began", shear.began);
            archive.finite("offset", shear.offset);
        });
    archive.same("strainIsSet", strain.isSet);
    if (!strain.isSet) return;
    for (std::size_t k = 0; k < 3; ++k)
        archive.group(fmt::format("axis{}", k), [&] {
            strainAtSetUp.axes[k].visitFirst(archive);
            strain.axes[k].visitNow(archive);
            archive.finite("oneWay", strain.axes[k].oneWay);
        });
    const Vector<double> atSetUp = box.length;
    archive.finite("lowest", box.lowest);
    archive.finite("length", box.length);
    archive.finite("imageSpeed", box.strainRate);
    for (const auto axis : vectorAxes)
        archive.require((box.length.*axis > 0) == (atSetUp.*axis > 0), "length",
                        "is not that of a periodic scene");
}

}  // namespace pendular
