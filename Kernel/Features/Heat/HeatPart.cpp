#include "Kernel/Features/Heat/HeatPart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/GrainName.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Features/EnergyLedger/EnergyAccount.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

void HeatPart::setMaterialOf(int species, const HeatMaterial& material) {
    const std::string owner = fmt::format("heat of species {}", species);
    checkValue(owner, "conductivity", material.conductivity, "W/(m K)", notNegative);
    checkValue(owner, "heatCapacity", material.heatCapacity, "J/(kg K)", positive);
    materials[species] = material;
    changedInRun |= hasBegun;
}

void HeatPart::holdWall(int wall, double temperature, std::optional<double> conductivity) {
    const std::string owner = fmt::format("heat of wall {}", wall);
    checkValue(owner, "temperature", temperature, "K", notNegative);
    if (conductivity) checkValue(owner, "conductivity", *conductivity, "W/(m K)", positive);
    heldWalls[wall] = {temperature, conductivity.value_or(infinity)};
    byWalls.try_emplace(wall);
    changedInRun |= hasBegun;
}

void HeatPart::insulateWall(int wall) {
    heldWalls.erase(wall);
    changedInRun |= hasBegun;
}

void HeatPart::setConduction(Conduction law) {
    conduction = law;
    changedInRun |= hasBegun;
}

void HeatPart::setSoftening(double ratio) {
    checkValue("heat", "softening", ratio, "", positiveUpTo(1));
    radiusFactor = std::cbrt(ratio);
    changedInRun |= hasBegun;
}

[[noreturn]] static void refuseWithoutLedger() {
    throw InputError("heat: heatByContacts() needs the energy ledger; call keepEnergyLedger() at set-up.");
}

/// From now on the account tells what each contact loses.
void HeatPart::noteLosses() const {
    if (!account) refuseWithoutLedger();
    account->noteLosses();
}

void HeatPart::heatByContacts(bool heats) {
    if (heats && hasBegun) noteLosses();
    contactsHeat = heats;
    changedInRun |= hasBegun;
}

std::span<const Conflict> HeatPart::ownConflicts() const {
    static constexpr std::array table{
        Conflict{Feature::OwnPart, Feature::Superquadrics, "its contact radii are those of spheres",
                 "leave the heat out"},
        Conflict{Feature::OwnPart, Feature::RigidBodies,
                 "the spheres of a clump would have a temperature each, and conduct no heat to each other",
                 "leave the heat out"}};
    return table;
}

/// The overlap of a linear spring does not determine the contact spot of real grains at its force; a sintered
/// neck has the size that it has grown to.
std::optional<std::string> HeatPart::objectionToSoftening(const ContactLaws& ofScene) const {
    if (radiusFactor == 1) return {};
    const double ratio = radiusFactor * radiusFactor * radiusFactor;
    if (conduction == Conduction::AreaOverDistance)
        return fmt::format(
            "heat: softening = {:.6g} is for the contact radii of Conduction::Constriction, and area over "
            "distance has none; it must be 1.",
            ratio);
    const auto count = static_cast<int>(ofScene.speciesCount());
    for (int a = 0; a < count; ++a)
        for (int b = a; b < count; ++b)
            if (!ofScene.contactSpot(a, b, Bodies{1, 1}, 0).followsModulus)
                return fmt::format(
                    "heat: softening = {:.6g} is for contact radii that go with the modulus as Hertz's do, "
                    "and those of species {} and {}, {}, do not; it must be 1, or take a Hertzian normal law "
                    "without a sintered neck.",
                    ratio, a, b, ofScene.ofPair(a, b).name);
    return {};
}

void HeatPart::check(const StepContext& scene) {
    laws = scene.laws;
    if (laws->grainsAreDiscs())
        throw InputError(
            "heat: it is conducted by the round spots in which spheres touch, and grains are discs; take "
            "spheres, and hold them in the plane.");
    if (const auto objection = objectionToSoftening(*laws)) throw InputError(*objection);
    scene.contacts.askForHeldContacts();
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
    if (contactsHeat && !scene.ledger) refuseWithoutLedger();
    for (const std::uint32_t place : scene.grains().place)
        checkValue(nameOfGrain(scene.grains(), scene.grains().identity[place]), "temperature",
                   temperatures[scene.grains().identity[place]], "K", notNegative);
}

void HeatPart::begin(StepContext& scene, bool isRestarted) {
    hasBegun = true;
    account = scene.ledger ? scene.account : nullptr;
    if (contactsHeat) noteLosses();
    if (!isRestarted) heat.stored = storedIn(scene);
}

double HeatPart::capacityAt(const StepContext& step, std::uint32_t place) const {
    return step.particles.massAt(place) * materials.at(step.grains().species[place]).heatCapacity;
}

double HeatPart::storedIn(StepContext& step) const {
    ExactSum sum;
    const ParticleStore& grains = step.grains();
    for (const std::uint32_t place : grains.place)
        sum.add(capacityAt(step, place) * temperatures[grains.identity[place]]);
    return step.contacts.ranks().sum(sum);
}

double HeatPart::contactRadius(int a, int b, double effectiveRadius, double overlap) const {
    return radiusFactor * (laws ? laws->contactSpot(a, b, Bodies{effectiveRadius}, overlap).radius
                                : std::sqrt(effectiveRadius * overlap));
}

bool HeatPart::conductsApart(const Bucket& bucket) const {
    return conduction == Conduction::Constriction &&
           laws->contactSpot(bucket.species1, bucket.species2, Bodies{1, 1}, 0).radius > 0;
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
    return 2 * k * contactRadius(a, b, effectiveRadius, overlap);
}

double HeatPart::conductanceAtWall(const HeldWall& wall, const Bucket& bucket, int species,
                                   const ObservedContact& seen, double radius) const {
    return 2 * inSeries(materials.at(species).conductivity, wall.conductivity) *
           contactRadius(bucket.species1, bucket.species2, radius, seen.overlap());
}

/// Of grains, and on several ranks of ghosts.
void HeatPart::readTemperatures(const StepContext& step) {
    const ParticleStore& grains = step.grains();
    before.assign(grains.size(), 0);
    for (const std::uint32_t place : grains.place) before[place] = temperatures[grains.identity[place]];
    std::vector<double> none(grains.bodies.sizeWithGhosts());
    step.contacts.tellGhosts(before, none);
}

void HeatPart::conductBetween(const StepContext& step, const Bucket& bucket, const ObservedContact& seen,
                              std::uint32_t first, std::uint32_t second) {
    const ParticleStore& grains = step.grains();
    const TranslationRecord& one = grains.translation[first];
    if (seen.wall >= 0) {
        const auto held = heldWalls.find(seen.wall);
        if (held == heldWalls.end()) return;
        const double found = conductanceAtWall(held->second, bucket, grains.species[first], seen, one.radius);
        const double power = found * (held->second.temperature - before[first]);
        flow[first] += power, conductances[first] += found;
        fromWalls.add(step.length * power);
        std::ranges::lower_bound(ofStep, seen.wall, {}, &HeatOfWall::wall)->heat.add(step.length * power);
        return;
    }
    const TranslationRecord& other = grains.translation[second];
    const double found =
        conductance(grains.species[first], grains.species[second],
                    Bodies{one.radius, other.radius}.effectiveRadius(), seen.overlap(), norm(seen.shift));
    const double power = found * (before[second] - before[first]);
    flow[first] += power, flow[second] -= power;
    conductances[first] += found, conductances[second] += found;
}

template <class Function>
void HeatPart::forEachActing(const StepContext& step, Function&& function) const {
    const ContactSystem& contacts = step.contacts;
    const ParticleStore& grains = step.grains();
    if (!contacts.ranks().areSeveral()) return contacts.forEachActing(grains, function);
    std::vector<std::pair<const Bucket*, std::uint32_t>> all;
    const auto note = [&](const Bucket& bucket, std::uint32_t contact) { all.push_back({&bucket, contact}); };
    contacts.forEachActing(grains, note);
    for (const std::uint32_t place : grains.place)
        contacts.forEachActingOf(place, [&](const Bucket& bucket, std::uint32_t contact) {
            if (contacts.firstOf(contact) >= grains.ownSize()) note(bucket, contact);
        });
    std::ranges::stable_sort(all, {},
                             [&](const auto& one) { return grains.identity[contacts.firstOf(one.second)]; });
    for (const auto& [bucket, contact] : all) function(*bucket, contact);
}

void HeatPart::conduct(StepContext& step) {
    readTemperatures(step);
    const ContactSystem& contacts = step.contacts;
    forEachActing(step, [&](const Bucket& bucket, std::uint32_t contact) {
        if (!contacts.touches(contact) && !conductsApart(bucket)) return;
        const ObservedContact seen = contacts.observe(step.grains(), bucket, contact);
        if (seen.overlap() > 0 ? seen.touching : seen.bridged && conductsApart(bucket))
            conductBetween(step, bucket, seen, contacts.firstOf(contact), contacts.secondOf(contact));
    });
}

void HeatPart::addUpWalls(const StepContext& step) {
    std::vector<ExactSum*> sums{&fromWalls, &fromContacts, &toWalls};
    for (HeatOfWall& one : ofStep) sums.push_back(&one.heat);
    step.contacts.ranks().addUp(sums);
    for (const HeatOfWall& one : ofStep) byWalls[one.wall] += one.heat.value();
}

double HeatPart::fromWall(int wall) const {
    const auto found = byWalls.find(wall);
    return found == byWalls.end() ? 0 : found->second;
}

std::vector<int> HeatPart::wallsOfHeat() const {
    std::vector<int> walls;
    for (const auto& [wall, given] : byWalls) walls.push_back(wall);
    return walls;
}

void HeatPart::takeLosses(const StepContext& step) {
    const ParticleStore& grains = step.grains();
    const auto isHere = [&](std::uint32_t identity) { return grains.place.contains(identity); };
    const auto give = [&](std::uint32_t identity, double energy) {
        if (!isHere(identity)) return;  // it has left the scene in this step, or is on another rank
        source[grains.place[identity]] += energy;
        fromContacts.add(energy);
    };
    const AllRanks& ranks = step.contacts.ranks();
    std::vector<ContactLoss> losses = step.account->losses(), ofOthers;
    for (const ContactLoss& loss : losses)
        if (loss.wall >= 0) toWalls.add(0.5 * loss.energy);
        else if (ranks.areSeveral() && !isHere(loss.second)) ofOthers.push_back(loss);
    for (const ContactLoss& loss : ranks.gather(ofOthers))
        if (isHere(loss.second)) losses.push_back(loss);
    std::ranges::stable_sort(losses, {}, &ContactLoss::first);
    for (const ContactLoss& loss : losses) {
        give(loss.first, 0.5 * loss.energy);
        if (loss.wall < 0) give(loss.second, 0.5 * loss.energy);
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
    longest = step.contacts.ranks().smallest(longest);
}

/// A driver may have set a temperature that cannot be; plastic work that stiffening gives back takes heat.
void HeatPart::requireTemperatures(StepContext& step) const {
    const ParticleStore& grains = step.grains();
    for (const std::uint32_t place : grains.place) {
        const std::uint32_t identity = grains.identity[place];
        const double temperature = temperatures[identity];
        if (!(temperature >= 0 && std::isfinite(temperature)))
            throw RunError(
                fmt::format("At time {:.6g} s heat: the temperature of {} is {:.6g} K; it must be at least "
                            "0 K, and finite.",
                            step.time, nameOfGrain(grains, identity), temperature));
    }
}

void HeatPart::atEnd(StepContext& step) {
    const std::size_t size = step.grains().size();
    for (std::vector<double>* const column : {&flow, &source, &conductances}) column->assign(size, 0);
    for (ExactSum* const sum : {&fromWalls, &fromContacts, &toWalls}) *sum = {};
    ofStep.clear();
    for (const PresentWall& wall : step.walls.present())
        if (const auto number = static_cast<int>(wall.number); heldWalls.contains(number))
            ofStep.push_back({number, {}});
    requireTemperatures(step);
    if (const auto objection = objectionToSoftening(*step.laws))
        throw RunError(fmt::format("At time {:.6g} s {}", step.time, *objection));
    heat.fromDriver += storedIn(step) - heat.stored;
    conduct(step);
    if (contactsHeat) takeLosses(step);
    changeTemperatures(step);
    requireTemperatures(step);
    addUpWalls(step);
    heat.fromWalls += fromWalls.value();
    heat.fromContacts += fromContacts.value();
    heat.toWalls += toWalls.value();
    heat.stored = storedIn(step);
}

/// Those with which the run began.
void HeatPart::compareSettings(StateArchive& archive) const {
    archive.same("conduction", static_cast<int>(conduction));
    archive.same("materials", static_cast<std::uint64_t>(materials.size()));
    for (const auto& [species, m] : materials)
        archive.group(fmt::format("species{}", species), [&, &m = m] {
            archive.same("conductivity", m.conductivity, "W/(m K)");
            archive.same("heatCapacity", m.heatCapacity, "J/(kg K)");
        });
    archive.same("heldWalls", static_cast<std::uint64_t>(heldWalls.size()));
    for (const auto& [wall, held] : heldWalls)
        archive.group(fmt::format("wall{}", wall), [&, &held = held] {
            archive.same("temperature", held.temperature, "K");
            archive.same("conductivity", held.conductivity, "W/(m K)");
        });
    archive.same("radiusFactor", radiusFactor);
    archive.same("heatByContacts", contactsHeat ? 1 : 0);
}

/// Where the run has changed them, they are those of the file.
void HeatPart::compareSetUp(StateArchive& archive, StepContext& /*scene*/) {
    struct MaterialRow {
        double species, conductivity, heatCapacity;
    };
    struct WallRow {
        double wall, temperature, conductivity;
    };
    archive.value("settingsChanged", changedInRun);
    if (!changedInRun) return compareSettings(archive);
    std::vector<MaterialRow> ofSpecies;
    std::vector<WallRow> ofWalls;
    std::array<double, 3> laws{static_cast<double>(conduction), radiusFactor, contactsHeat ? 1.0 : 0.0};
    for (const auto& [species, m] : materials)
        ofSpecies.push_back({static_cast<double>(species), m.conductivity, m.heatCapacity});
    for (const auto& [wall, held] : heldWalls)
        ofWalls.push_back({static_cast<double>(wall), held.temperature, held.conductivity});
    archive.column<double>("materialsNow", ofSpecies);
    archive.column<double>("heldWallsNow", ofWalls);
    archive.record<double>("laws", laws);
    if (!archive.isReading()) return;
    materials.clear(), heldWalls.clear();
    for (const MaterialRow& row : ofSpecies)
        materials[static_cast<int>(row.species)] = {row.conductivity, row.heatCapacity};
    for (const WallRow& row : ofWalls)
        heldWalls[static_cast<int>(row.wall)] = {row.temperature, row.conductivity};
    archive.require(laws[0] == 0 || laws[0] == 1, "laws", "are not known");
    conduction = static_cast<Conduction>(static_cast<int>(laws[0]));
    radiusFactor = laws[1], contactsHeat = laws[2] != 0;
    if (contactsHeat) noteLosses();  // the run has begun
}

void HeatPart::visitState(StateArchive& archive, StepContext& /*scene*/) {
    struct Row {
        double wall, heat;  // its number, J
    };
    std::vector<Row> ofWalls;
    for (const auto& [wall, given] : byWalls) ofWalls.push_back({static_cast<double>(wall), given});
    archive.finite("ledger", heat);
    archive.column<double>("fromEachWall", ofWalls);
    if (!archive.isReading()) return;
    archive.requireFinite("fromEachWall", ofWalls);
    for (const Row& row : ofWalls) byWalls[static_cast<int>(row.wall)] = row.heat;
}

void HeatPart::addTo(SummaryRows& rows) const {
    rows.addNumber("heat: stored in grains", heat.stored, "J");
    rows.addNumber("heat: from walls", heat.fromWalls, "J");
    for (const auto& [wall, given] : byWalls)
        rows.addNumber(fmt::format("heat: from wall {}", wall), given, "J");
    if (contactsHeat) {
        rows.addNumber("heat: from contacts, into grains", heat.fromContacts, "J");
        rows.addNumber("heat: from contacts, into walls", heat.toWalls, "J");
    }
    rows.addNumber("heat: longest time step", longest, "s");
}

}  // namespace pendular
