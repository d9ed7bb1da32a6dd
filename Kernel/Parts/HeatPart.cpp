#include "Kernel/Parts/HeatPart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Base/InputError.h"
#include "Kernel/Base/RunError.h"
#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Energy/EnergyAccount.h"
#include "Kernel/Particles/GrainName.h"
#include "Kernel/State/StateArchive.h"
#include "Kernel/Step/SummaryRows.h"

namespace pendular {

void HeatPart::setMaterialOf(int species, const HeatMaterial& material) {
    const std::string owner = fmt::format("heat of species {}", species);
    checkValue(owner, "conductivity", material.conductivity, "W/(m K)", notNegative);
    checkValue(owner, "heatCapacity", material.heatCapacity, "J/(kg K)", positive);
    materials[species] = material;
}

void HeatPart::holdWall(int wall, double temperature, std::optional<double> conductivity) {
    const std::string owner = fmt::format("heat of wall {}", wall);
    checkValue(owner, "temperature", temperature, "K", notNegative);
    if (conductivity) checkValue(owner, "conductivity", *conductivity, "W/(m K)", positive);
    heldWalls[wall] = {temperature, conductivity.value_or(infinity)};
}

void HeatPart::setSoftening(double ratio) {
    checkValue("heat", "softening", ratio, "", positiveUpTo(1));
    radiusFactor = std::cbrt(ratio);
}

std::span<const Conflict> HeatPart::ownConflicts() const {
    static constexpr Conflict shapes{Feature::OwnPart, Feature::Superquadrics,
                                     "its contact radii are those of spheres", "leave the heat out"};
    return {&shapes, 1};
}

void HeatPart::check(const StepContext& scene) {
    const auto species = static_cast<int>(scene.laws->speciesCount());
    for (int k = 0; k < species; ++k)
        if (!materials.contains(k))
            throw InputError(fmt::format(
                "heat of species {}: no material is set; every species of the scene needs a conductivity and "
                "a heat capacity, by setMaterial().",
                k));
    for (const auto& [wall, held] : heldWalls) {
        if (wall < 0 || static_cast<std::size_t>(wall) >= scene.walls.getSize())
            throw InputError(fmt::format("heat of wall {}: there is no such wall; the scene has {}.", wall,
                                         scene.walls.getSize()));
        if (conduction == Conduction::AreaOverDistance)
            throw InputError(
                fmt::format("heat of wall {}: area over distance conducts between grains only; take "
                            "Conduction::Constriction, or hold no walls at a temperature.",
                            wall));
    }
    if (contactsHeat && !scene.account)
        throw InputError("heat: heatByContacts() needs the energy ledger; call keepEnergyLedger().");
    for (const std::uint32_t place : scene.grains().place)
        checkValue(nameOfGrain(scene.grains(), scene.grains().identity[place]), "temperature",
                   temperatures[scene.grains().identity[place]], "K", notNegative);
}

void HeatPart::begin(StepContext& scene, bool isRestarted) {
    if (contactsHeat) scene.account->noteLosses();
    if (!isRestarted) heat.stored = storedIn(scene);
}

double HeatPart::capacityAt(const StepContext& step, std::uint32_t place) const {
    return step.particles.massAt(place) * materials.at(step.grains().species[place]).heatCapacity;
}

double HeatPart::storedIn(StepContext& step) const {
    double sum = 0;
    const ParticleStore& grains = step.grains();
    for (const std::uint32_t place : grains.place)
        sum += capacityAt(step, place) * temperatures[grains.identity[place]];
    return sum;
}

double HeatPart::contactRadius(double effectiveRadius, double overlap) const {
    return radiusFactor * std::sqrt(effectiveRadius * overlap);
}

/// Of two conductivities in series: twice their harmonic sum.
static double inSeries(double k1, double k2) {
    if (k1 == 0 || k2 == 0) return 0;
    return std::isinf(k2) ? 2 * k1 : 2 * k1 * k2 / (k1 + k2);
}

double HeatPart::conductance(int a, int b, double effectiveRadius, double overlap, double distance) const {
    const double k = inSeries(materials.at(a).conductivity, materials.at(b).conductivity);
    if (conduction == Conduction::AreaOverDistance)
        return k * std::numbers::pi * 2 * effectiveRadius * overlap / distance;
    return 2 * k * contactRadius(effectiveRadius, overlap);
}

double HeatPart::conductanceAtWall(const HeldWall& wall, int species, const ObservedContact& seen,
                                   double radius) const {
    return 2 * inSeries(materials.at(species).conductivity, wall.conductivity) *
           contactRadius(radius, seen.overlap());
}

void HeatPart::conductBetween(const StepContext& step, const ObservedContact& seen) {
    const ParticleStore& grains = step.grains();
    const std::uint32_t first = grains.place[seen.particle1];
    const TranslationRecord& one = grains.translation[first];
    const double temperature = temperatures[seen.particle1];
    if (seen.wall >= 0) {
        const auto held = heldWalls.find(seen.wall);
        if (held == heldWalls.end()) return;
        const double found = conductanceAtWall(held->second, grains.species[first], seen, one.radius);
        const double power = found * (held->second.temperature - temperature);
        flow[first] += power, conductances[first] += found;
        heat.fromWalls += step.length * power;
        return;
    }
    const std::uint32_t second = grains.place[seen.particle2];
    const TranslationRecord& other = grains.translation[second];
    const double found =
        conductance(grains.species[first], grains.species[second],
                    Bodies{one.radius, other.radius}.effectiveRadius(), seen.overlap(), norm(seen.shift));
    const double power = found * (temperatures[seen.particle2] - temperature);
    flow[first] += power, flow[second] -= power;
    conductances[first] += found, conductances[second] += found;
}

void HeatPart::conduct(StepContext& step) {
    const ParticleStore& grains = step.grains();
    step.contacts.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        if (!step.contacts.touches(contact)) return;
        const ObservedContact seen = step.contacts.observe(grains, bucket, contact);
        if (seen.overlap() > 0) conductBetween(step, seen);
    });
}

void HeatPart::takeLosses(const StepContext& step) {
    const ParticleStore& grains = step.grains();
    for (const ContactLoss& loss : step.account->losses()) {
        const double half = 0.5 * loss.energy;
        const auto give = [&](std::uint32_t identity) {
            const std::uint32_t place = grains.place[identity];
            if (place == PlaceIndex::none) return;  // it has left the scene in this step
            source[place] += half;
            heat.fromContacts += half;
        };
        give(loss.first);
        if (loss.wall < 0) give(loss.second);
        else heat.toWalls += half;
    }
}

void HeatPart::refuseStep(const StepContext& step, std::uint32_t place, double bound) const {
    throw RunError(fmt::format(
        "At time {:.6g} s heat: the time step, {:.6g} s, is too long for {}, whose contacts take its heat in "
        "{:.6g} s; it must be at most that.",
        step.time, step.length, nameOfGrain(step.grains(), step.grains().identity[place]), bound));
}

void HeatPart::changeTemperatures(StepContext& step) {
    const ParticleStore& grains = step.grains();
    longest = infinity;
    for (const std::uint32_t place : grains.place) {
        const double capacity = capacityAt(step, place);
        if (conductances[place] > 0) longest = std::min(longest, capacity / conductances[place]);
        if (step.length * conductances[place] > capacity) refuseStep(step, place, longest);
        temperatures[grains.identity[place]] += (step.length * flow[place] + source[place]) / capacity;
    }
}

void HeatPart::atEnd(StepContext& step) {
    const std::size_t size = step.grains().size();
    for (std::vector<double>* const column : {&flow, &source, &conductances}) column->assign(size, 0);
    heat.fromDriver += storedIn(step) - heat.stored;
    conduct(step);
    if (contactsHeat) takeLosses(step);
    changeTemperatures(step);
    heat.stored = storedIn(step);
}

void HeatPart::visitState(StateArchive& archive, StepContext& /*scene*/) { archive.finite("ledger", heat); }

void HeatPart::addTo(SummaryRows& rows) const {
    rows.addNumber("heat: stored in grains", heat.stored, "J");
    rows.addNumber("heat: from walls", heat.fromWalls, "J");
    if (contactsHeat) {
        rows.addNumber("heat: from contacts, into grains", heat.fromContacts, "J");
        rows.addNumber("heat: from contacts, into walls", heat.toWalls, "J");
    }
    rows.addNumber("heat: longest time step", longest, "s");
}

}  // namespace pendular
