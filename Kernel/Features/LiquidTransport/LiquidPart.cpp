#include "Kernel/Features/LiquidTransport/LiquidPart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Core/Step/StepTimes.h"
#include "Kernel/Features/Inlets/Inlet.h"
#include "Kernel/Features/LiquidTransport/SprayHandler.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

Features LiquidPart::features(const StepContext& scene) const {
    return scene.particles.films().areKept() ? Features{Feature::MovingLiquid} : Features{};
}

void LiquidPart::afterForces(StepContext& step) {
    step.times.enter(StepTimes::Part::Liquid);
    step.contacts.moveLiquid(step.grains(), step.time + step.length, step.length);
}

void LiquidPart::setToCome(double volume) {
    checkValue("Simulation", "liquid to come", volume, "m^3", notNegative);
    toCome = volume;
}

void LiquidPart::refuseWhereNoneMoves(const StepContext& scene, double densityOfFilms) const {
    if (scene.particles.films().areKept()) return;
    constexpr std::string_view advice =
        "but no species of this scene moves liquid; take an adhesion law whose name begins with "
        "LiquidMigration, or leave it out.";
    if (!sprays.isEmpty()) throw InputError(fmt::format("Simulation: there is a spray, {}", advice));
    if (scene.contacts.movingLiquid().evaporation().dropletsEvaporate())
        throw InputError(fmt::format("Simulation: evaporation is set, {}", advice));
    if (densityOfFilms > 0)
        throw InputError(fmt::format("Simulation: the density of the liquid is set, {}", advice));
}

/// m^3, of the largest bridge that a pair of species can have.
static double largestBridge(const ContactLaws& laws) {
    double largest = 0;
    const auto count = static_cast<int>(laws.speciesCount());
    for (int a = 0; a < count; ++a)
        for (int b = a; b < count; ++b)
            largest = std::max(largest, laws.liquidRules(a, b).value_or(LiquidRules{}).largest);
    return largest;
}

double LiquidPart::beginToCount(const StepContext& scene, double timeMax) const {
    GrainFilms& films = scene.particles.films();
    if (!films.areKept()) return 0;
    const double sprayed = sprays.volumeBy(timeMax);
    if (toCome && sprayed > *toCome)
        throw InputError(fmt::format(
            "Simulation: liquid to come = {:.6g} m^3, but the sprays emit up to {:.6g} m^3 until the end of "
            "the run; set at least that, or leave it out.",
            *toCome, sprayed));
    const double bridges = std::max(0x1p20, 6.0 * static_cast<double>(scene.particles.getSize()));
    films.begin(scene.particles.store(), toCome.value_or(bridges * largestBridge(*scene.laws) + sprayed +
                                                         inlets.liquidBy(scene.particles, timeMax)));
    return films.quantum();
}

void LiquidPart::refuseMoreSpray(const StepContext& scene, double timeMax) const {
    const GrainFilms& films = scene.particles.films();
    const double more = sprays.volumeBy(timeMax) - sprays.volumeBy(scene.time);
    if (films.areKept() && films.objectionToMore(more))
        throw InputError(fmt::format(
            "Simulation: time max = {:.6g} s; the sprays emit up to {:.6g} m^3 from {:.6g} s until then, and "
            "the run was begun for less liquid; say by setLiquidToCome() how much will come, and begin it "
            "again.",
            timeMax, more, scene.time));
}

void LiquidPart::requireAll(const LiquidLedger& ledger, double time) {
    const double missing = ledger.unaccounted();
    if (missing != 0)
        throw RunError(fmt::format(
            "At time {:.6g} s {} m^3 of liquid are {}: this is an error in the program, not in the scene.",
            time, std::abs(missing), missing < 0 ? "lost" : "too many"));
}

Features FilmMassPart::features(const StepContext& /*scene*/) const {
    return density > 0 ? Features{Feature::FilmMass} : Features{};
}

/// On several ranks, ghosts have the mass of the grains that they stand for.
void FilmMassPart::afterMotion(StepContext& step) {
    if (!step.contacts.ranks().areSeveral()) return;
    ParticleStore& grains = step.grains();
    const auto tell = [&](auto&& numberAt) {
        std::vector<double> ofGrains(grains.size()), ofBodies(grains.bodies.sizeWithGhosts());
        for (std::size_t place = 0; place < grains.ownSize(); ++place) ofGrains[place] = numberAt(place);
        step.contacts.tellGhosts(ofGrains, ofBodies);
        for (std::size_t place = grains.ownSize(); place < grains.size(); ++place)
            if (!grains.isGap(place)) numberAt(place) = ofGrains[place];
    };
    tell([&](std::size_t place) -> double& { return grains.translation[place].inverseMass; });
    if (grains.hasSpin)
        tell([&](std::size_t place) -> double& { return grains.rotation[place].inverseInertia; });
}

void FilmMassPart::finish(StepContext& step) { ParticleHandler::Inside::weighFilms(step.particles); }

void FilmMassPart::setDensity(const StepContext& scene, double liquid) {
    checkValue("Simulation", "density of the liquid", liquid, "kg/m^3", notNegative);
    density = liquid;
    ParticleHandler::Inside::setLiquidDensity(scene.particles, liquid);
}

void FilmMassPart::compareSetUp(StateArchive& archive, StepContext& /*scene*/) {
    archive.same("density", density, "kg/m^3");
}

}  // namespace pendular
