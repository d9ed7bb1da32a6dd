#include "Kernel/Features/Fluid/FluidPart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Particles/GrainName.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Features/EnergyLedger/EnergyLedger.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

FluidPart::FluidPart(const FluidGrid& grid, const FluidMaterial& material, const DragLaw& drag,
                     std::unique_ptr<FluidHost> ofFluid, PressureModel pressure)
    : cells(grid), fluid(material), law(drag), host(std::move(ofFluid)), model(pressure) {
    cells.check();
    checkFields(fluid);
    if (!host) throw InputError("fluid: there is no host, which says how the fluid moves.");
    host->check(cells);
    now = FluidFields(cells.size());
}

std::span<const Conflict> FluidPart::ownConflicts() const {
    static constexpr std::array table{
        Conflict{Feature::OwnPart, Feature::RigidBodies,
                 "the drag laws of the fluid are those of single spheres", "take single grains"},
        Conflict{Feature::OwnPart, Feature::Superquadrics, "the drag laws of the fluid are those of spheres",
                 "take spheres"},
        Conflict{Feature::OwnPart, Feature::Shear, "the fluid does not move with the images",
                 "leave the fluid out"},
        Conflict{Feature::OwnPart, Feature::EarlierAccelerations, "its forces act by the steps of Verlet",
                 "take integrators::predictedVelocityVerlet or velocityVerlet"},
        Conflict{Feature::OwnPart, Feature::Strain, "the grid of the fluid is not strained",
                 "leave the fluid out"},
        Conflict{Feature::OwnPart, Feature::Ranks, "a cell of the fluid needs the grains of all ranks",
                 "take one process"}};
    return table;
}

/// Cells on both sides of a periodic face would have to share what is near it.
void FluidPart::check(const StepContext& scene) {
    const std::array lengths{scene.box.length.x, scene.box.length.y, scene.box.length.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (lengths[axis] > 0 && cells.cells[axis] > 1)
            throw InputError(fmt::format(
                "fluid: the grid has {} cells along {}, along which the scene is periodic; it may have one.",
                cells.cells[axis], "xyz"[axis]));
    const std::array begins{scene.box.lowest.x, scene.box.lowest.y, scene.box.lowest.z};
    const std::array lowest{cells.lowest.x, cells.lowest.y, cells.lowest.z},
        highest{cells.highest.x, cells.highest.y, cells.highest.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double error = 1e-9 * lengths[axis];
        if (!(lengths[axis] > 0) || (std::abs(lowest[axis] - begins[axis]) <= error &&
                                     std::abs(highest[axis] - begins[axis] - lengths[axis]) <= error))
            continue;
        throw InputError(fmt::format(
            "fluid: the grid goes from {:.6g} to {:.6g} m along {}, along which the scene is periodic; it "
            "must go from {:.6g} to {:.6g} m.",
            lowest[axis], highest[axis], "xyz"[axis], begins[axis], begins[axis] + lengths[axis]));
    }
    if (scene.laws->grainsAreDiscs())
        throw InputError("fluid: the drag laws are those of spheres, and grains are discs; take spheres.");
}

/// m: grains that have gone through a periodic face are brought back now and then only.
static Vector<double> placeOf(const StepContext& step, const GrainReference& grain) {
    return step.box.wrap(toVector(grain.getPosition()));
}

void FluidPart::requireInside(const StepContext& step, const GrainReference& grain) const {
    const Vector<double> p = placeOf(step, grain);
    if (cells.contains(p)) return;
    throw RunError(
        fmt::format("At time {:.6g} s fluid: {} is at ({:.6g}, {:.6g}, {:.6g}) m, outside the grid; make the "
                    "grid larger, or "
                    "take the grain out by an outlet.",
                    step.time, nameOfGrain(step.grains(), grain.getId()), p.x, p.y, p.z));
}

void FluidPart::spreadGrains(StepContext& step) {
    now.porosity.assign(cells.size(), 1);
    now.solidFlux.assign(cells.size(), {0, 0, 0});
    immersed.clear();
    const double cellVolume = cells.cellVolume();
    for (const GrainReference grain : step.particles) {
        requireInside(step, grain);
        const double share = grain.getVolume() / cellVolume;
        const Vector<double> velocity = toVector(grain.getVelocity());
        immersed.push_back({.identity = grain.getId(), .shares = sharesAt(cells, placeOf(step, grain))});
        for (const CellShare& own : immersed.back().shares) {
            now.porosity[own.cell] -= own.share * share;
            now.solidFlux[own.cell] += own.share * share * velocity;
        }
    }
}

void FluidPart::countOutside(const DragState& state) const {
    ++asked;
    if (!law.porosity.contains(state.porosity) || state.reynolds() > law.highestReynolds) ++outside;
}

double FluidPart::resistanceOf(const GrainReference& grain, const std::array<CellShare, 8>& shares,
                               const Vector<double>& slip) const {
    const double porosity = porosityOfDrag(meanOf(now.porosity, shares));
    const DragState state{porosity, norm(slip), 2 * grain.getRadius(), fluid};
    countOutside(state);
    return law.resistance(state);
}

void FluidPart::spreadDrag(StepContext& step) {
    now.drag.assign(cells.size(), {0, 0, 0});
    auto here = immersed.begin();
    for (const GrainReference grain : step.particles) {
        Immersed& one = *here++;
        const Vector<double> slip = meanOf(now.velocity, one.shares) - toVector(grain.getVelocity());
        one.resistance = resistanceOf(grain, one.shares, slip);
        const Vector<double> force = one.resistance / cells.cellVolume() * slip;
        for (const CellShare& own : one.shares) now.drag[own.cell] += own.share * force;
    }
}

void FluidPart::findForce(const StepContext& step, const GrainReference& grain, Immersed& here) {
    const auto& shares = here.shares;
    const Vector<double> u = meanOf(now.velocity, shares), v = toVector(grain.getVelocity());
    const bool isA = model == PressureModel::A;
    double resistance = here.resistance;
    if (!isA) resistance /= porosityOfDrag(meanOf(now.porosity, shares));
    const Vector<double> gradient = isA ? meanOf(now.pressureGradient, shares) : fluid.density * step.gravity;
    const Vector<double> pressure = -grain.getVolume() * gradient;  // N
    Vector<double> after = v;
    here.velocity = v;
    if (!grain.isFixed()) {
        const std::uint32_t place = step.grains().place[here.identity];
        const double inverse = step.grains().translation[place].inverseMass,
                     k = step.length * resistance * inverse;
        const Vector<double> others = step.grains().acceleration[place],
                             moved = 1 / (1 + k) * (v + k * u + step.length * (inverse * pressure + others));
        const HeldBits held = step.grains().heldAt(place);
        after = v + held.partAlong(moved - v);
        here.change = inverse * held.partAlong(resistance * (u - after) + pressure);
    }
    const Vector<double> drag = step.length * resistance * (u - after);
    ofStep += drag;
    total.impulse += drag + step.length * pressure;
    for (const CellShare& own : shares)
        now.source[own.cell] += -own.share / (step.length * cells.cellVolume()) * drag;
}

void FluidPart::prepare(StepContext& step) {
    if (step.length == 0) return;
    leaveAccelerations(step);
    spreadGrains(step);
    host->findVelocity(cells, now, step.time);
    spreadDrag(step);
    host->findPressure(cells, now, step.gravity);
    now.source.assign(cells.size(), {0, 0, 0});
    ofStep = {0, 0, 0};
    auto here = immersed.begin();
    for (const GrainReference grain : step.particles) findForce(step, grain, *here++);
    host->take(cells, now, step.length);
}

/// A step that has failed: the accelerations of its start are without the fluid again, where they are still
/// those.
void FluidPart::leaveAccelerations(StepContext& step) {
    if (!std::exchange(isInAccelerations, false)) return;
    ParticleStore& grains = step.grains();
    for (const Immersed& one : immersed) {
        const std::uint32_t place = grains.place[one.identity];
        if (place == PlaceIndex::none) continue;
        if (grains.acceleration[place] == one.accelerationBefore + one.change)
            grains.acceleration[place] = one.accelerationBefore;
    }
}

void FluidPart::beforeMotion(StepContext& step) {
    isInVelocities = false;
    if (step.length == 0) return;
    ParticleStore& grains = step.grains();
    for (Immersed& one : immersed) {
        Vector<double>& acceleration = grains.acceleration[grains.place[one.identity]];
        one.accelerationBefore = acceleration;
        acceleration += one.change;
    }
    isInAccelerations = true;
}

/// The share of the step's end. The accelerations that the end makes of the contacts are without the fluid,
/// which is computed anew in the next step.
void FluidPart::accelerate(StepContext& step) {
    if (step.length == 0) return;
    ParticleStore& grains = step.grains();
    const double time = step.scheme->corrector * step.length;
    for (Immersed& one : immersed) {
        Vector<double>& velocity = grains.translation[grains.place[one.identity]].velocity;
        one.velocityBefore = velocity;
        velocity += time * one.change;
    }
    isInVelocities = true;
}

/// The work of a step: by the mean of its velocities, which is what Verlet's steps give.
void FluidPart::finish(StepContext& step) {
    if (step.length == 0) return;
    isInAccelerations = false;
    const ParticleStore& grains = step.grains();
    double work = 0;  // J
    for (const Immersed& one : immersed) {
        const TranslationRecord& grain = grains.translation[grains.place[one.identity]];
        if (!(grain.inverseMass > 0)) continue;
        work += step.length / grain.inverseMass * dot(one.change, 0.5 * (one.velocity + grain.velocity));
    }
    total.work += work;
    if (step.ledger) step.ledger->driver += work;
}

/// The accelerations stay: by them the motion is taken back, after this.
void FluidPart::takeBack(StepContext& step) {
    if (!std::exchange(isInVelocities, false)) return;
    ParticleStore& grains = step.grains();
    for (const Immersed& one : immersed)
        if (const std::uint32_t place = grains.place[one.identity]; place != PlaceIndex::none)
            grains.translation[place].velocity = one.velocityBefore;
}

void FluidPart::compareSetUp(StateArchive& archive, StepContext& scene) {
    archive.sameRecord<double>("lowest", cells.lowest, "m");
    archive.sameRecord<double>("highest", cells.highest, "m");
    archive.sameRecord<std::int32_t>("cells", cells.cells);
    compareFluid(archive, fluid);
    compareDragLaw(archive, law, fluid);
    archive.same("model", model == PressureModel::A ? "A" : "B");
    archive.group("host", [&] { host->compareSetUp(archive, scene.time); });
}

void FluidPart::visitState(StateArchive& archive, StepContext& /*scene*/) {
    archive.finite("ledger", total);
    archive.finite("dragOfStep", ofStep);
    const auto visit = [&](const char* name, auto& field) {
        archive.column<double>(name, field);
        archive.require(field.size() == cells.size(), name, "has not one row for each cell");
    };
    visit("porosity", now.porosity);
    visit("solidFlux", now.solidFlux);
    visit("drag", now.drag);
    visit("source", now.source);
    visit("velocity", now.velocity);
    visit("pressureGradient", now.pressureGradient);
    archive.value("asked", asked);
    archive.value("outside", outside);
    archive.group("host", [&] { host->visitState(archive); });
}

void FluidPart::addTo(SummaryRows& rows) const {
    rows.add("fluid: drag law", law.name);
    rows.addNumber("fluid: work on grains", total.work, "J");
    if (outside > 0)
        rows.addNumber("fluid: share of drags beyond where the law holds",
                       static_cast<double>(outside) / static_cast<double>(asked), "");
}

}  // namespace pendular
