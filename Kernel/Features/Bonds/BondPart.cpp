#include "Kernel/Features/Bonds/BondPart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Core/Motion/TimeIntegration.h"
#include "Kernel/Core/Step/StepList.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Features/EnergyLedger/EnergyLedger.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

std::size_t BondPart::addMaterial(const BondMaterial& material) {
    const std::string owner = fmt::format("bond material {}", materials.size());
    checkValue(owner, "radius", material.radius, "m", positive);
    checkValue(owner, "damping", material.damping, "", notNegative);
    checkValue(owner, "share of moments", material.strength.momentShare, "", fromZeroTo(1));
    for (const double strength : {material.strength.tensile, material.strength.shear})
        if (!(strength > 0))
            throw InputError(fmt::format("{}: strength = {} Pa; it must be greater than 0 Pa, or infinite.",
                                         owner, strength));
    if (!material.stiffness) throw InputError(fmt::format("{}: no stiffness is set.", owner));
    materials.push_back(material);
    return materials.size() - 1;
}

void BondPart::join(std::uint32_t first, std::uint32_t second, std::size_t material, double length) {
    if (material >= materials.size())
        throw InputError(fmt::format("bonds: there is no material {}; add it by addMaterial().", material));
    checkValue(fmt::format("bond of particles {} and {}", first, second), "length", length, "m", notNegative);
    toJoin.push_back({{first, second, static_cast<std::uint32_t>(material)}, length});
}

Quaternion BondPart::orientationOf(std::uint32_t identity) const {
    const auto found = numbers.find(identity);
    return found == numbers.end() ? Quaternion{} : joined[found->second].orientation;
}

std::span<const Conflict> BondPart::ownConflicts() const {
    constexpr std::string_view leaveOut = "leave the bonds out";
    constexpr std::string_view single = "bonds join single spheres";
    static constexpr std::array table{
        Conflict{Feature::OwnPart, Feature::RigidBodies, single, leaveOut},
        Conflict{Feature::OwnPart, Feature::Superquadrics, single, leaveOut},
        Conflict{Feature::OwnPart, Feature::Shear, "bonds do not know images that move", leaveOut},
        Conflict{Feature::OwnPart, Feature::Strain, "bonds do not know images that move", leaveOut},
        Conflict{Feature::OwnPart, Feature::AdaptiveStep, "its bound of the step does not know bonds",
                 "leave setAdaptiveTimeStep() out"},
        Conflict{Feature::OwnPart, Feature::EarlierAccelerations, "bonds act by the steps of Verlet",
                 "take integrators::predictedVelocityVerlet or velocityVerlet"}};
    return table;
}

void BondPart::check(const StepContext& scene) {
    if (!scene.grains().hasSpin)
        throw InputError(
            "bonds: grains of this scene do not spin; take species with a friction law, as bonds twist and "
            "bend.");
}

/// The turn of the x axis to a unit vector.
static Quaternion turnTo(const Vector<double>& e) {
    if (e.x < 0) return turnTo(-e) * Quaternion{0, {0, 1, 0}};
    return Quaternion{1 + e.x, {0, -e.z, e.y}}.normalised();
}

/// Each rank keeps all bonds, so that all must ask for the same ones. Whether any does.
bool BondPart::areAsked(const AllRanks& ranks) const {
    if (!ranks.any(!toJoin.empty())) return false;
    const std::vector<ToJoin> all = ranks.gather(toJoin);
    bool areSame = !toJoin.empty() && all.size() % toJoin.size() == 0;
    for (std::size_t k = 0; areSame && k < all.size(); ++k) {
        const ToJoin &own = toJoin[k % toJoin.size()], &other = all[k];
        areSame = own.first == other.first && own.second == other.second && own.material == other.material &&
                  own.length == other.length;
    }
    if (!areSame)
        throw InputError(
            "bonds: on several ranks (setRanks()) each must join the same grains in the same step; join() "
            "was "
            "called otherwise on one of them.");
    return true;
}

void BondPart::joinNew(StepContext& step) {
    if (!areAsked(step.contacts.ranks())) return;
    const ParticleStore& grains = step.grains();
    const auto key = [](std::uint32_t a, std::uint32_t b) {
        return std::pair(std::min(a, b), std::max(a, b));
    };
    std::set<std::pair<std::uint32_t, std::uint32_t>> before;
    for (const Bond& bond : bonds) before.insert(key(bond.first, bond.second));
    for (const ToJoin& pair : toJoin)
        for (const std::uint32_t identity : {pair.first, pair.second}) static_cast<void>(joinedAt(identity));
    findGrains(step);
    const std::vector<bool> there = areThere(step);
    for (const ToJoin& pair : toJoin) {
        const auto owner = [&] {
            return fmt::format("bond of particles {} and {}", pair.first, pair.second);
        };
        const std::uint32_t at1 = joinedAt(pair.first), at2 = joinedAt(pair.second);
        if (!there[at1] || !there[at2] || at1 == at2)
            throw InputError(owner() + ": they must be two grains of the scene.");
        if (!before.insert(key(pair.first, pair.second)).second)
            throw InputError(owner() + ": they are joined already.");
        const Vector<double> between =
            step.box.nearest(movingOf(grains, joined[at2]).position - movingOf(grains, joined[at1]).position);
        const double distance = norm(between), length = pair.length > 0 ? pair.length : distance;
        const Quaternion frame = turnTo((1 / distance) * between);
        const BondStiffness k = stiffnessOf(pair.material, length);
        checkValue(owner(), "normal stiffness", k.normal, "N/m", positive);
        checkValue(owner(), "shear stiffness", k.shear, "N/m", notNegative);
        checkValue(owner(), "bending stiffness", k.bending, "N m/rad", notNegative);
        checkValue(owner(), "twist stiffness", k.twist, "N m/rad", notNegative);
        bonds.push_back({pair.first,
                         pair.second,
                         pair.material,
                         at1,
                         at2,
                         k,
                         length,
                         inverse(joined[at1].orientation) * frame,
                         inverse(joined[at2].orientation) * frame,
                         between,
                         {},
                         {}});
    }
    toJoin.clear();
    longest.reset();
}

std::uint32_t BondPart::joinedAt(std::uint32_t identity) {
    const auto [found, isNew] = numbers.emplace(identity, static_cast<std::uint32_t>(joined.size()));
    if (isNew) joined.push_back({.identity = identity, .place = 0, .orientation = {}, .before = {}});
    return found->second;
}

/// Grains are sorted now and then: their places are those of this step.
void BondPart::findPlaces(const ParticleStore& grains) {
    for (Joined& one : joined) one.place = grains.place[one.identity];
}

void BondPart::findGrains(StepContext& step) {
    const ParticleStore& grains = step.grains();
    findPlaces(grains);
    const AllRanks& ranks = step.contacts.ranks();
    if (!ranks.areSeveral()) return;
    struct Told {
        std::uint32_t number;
        Elsewhere motion;
    };
    std::vector<Told> own;
    for (std::uint32_t k = 0; k < joined.size(); ++k)
        if (const std::uint32_t place = joined[k].place; place != PlaceIndex::none)
            own.push_back({k, {grains.translation[place], grains.rotation[place], grains.heldAt(place)}});
    elsewhere.resize(joined.size());
    for (const Told& told : ranks.gather(own)) elsewhere[told.number] = told.motion;
}

void BondPart::shareAccelerations(StepContext& step) {
    const AllRanks& ranks = step.contacts.ranks();
    if (!ranks.areSeveral()) return;
    struct Told {
        std::uint32_t number;
        Vector<double> acceleration, angularAcceleration;
    };
    std::vector<Told> own;
    own.reserve(joined.size());
    for (std::uint32_t k = 0; k < joined.size(); ++k)
        if (const Joined& one = joined[k]; one.place != PlaceIndex::none)
            own.push_back({k, one.acceleration, one.angularAcceleration});
    for (const Told& told : ranks.gather(own)) {
        joined[told.number].acceleration = told.acceleration;
        joined[told.number].angularAcceleration = told.angularAcceleration;
    }
}

std::vector<bool> BondPart::areThere(const StepContext& step) const {
    const AllRanks& ranks = step.contacts.ranks();
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t k = 0; k < joined.size(); ++k)
        if (joined[k].place != PlaceIndex::none) numbers.push_back(k);
    if (ranks.areSeveral()) numbers = ranks.gather(numbers);
    std::vector<bool> all(joined.size());
    for (const std::uint32_t k : numbers) all[k] = true;
    return all;
}

const TranslationRecord& BondPart::movingOf(const ParticleStore& grains, const Joined& one) const {
    if (one.place != PlaceIndex::none) return grains.translation[one.place];
    return elsewhere[static_cast<std::size_t>(&one - joined.data())].moving;
}
const RotationRecord& BondPart::turningOf(const ParticleStore& grains, const Joined& one) const {
    if (one.place != PlaceIndex::none) return grains.rotation[one.place];
    return elsewhere[static_cast<std::size_t>(&one - joined.data())].turning;
}

HeldBits BondPart::heldOf(const ParticleStore& grains, const Joined& one) const {
    if (one.place != PlaceIndex::none) return grains.heldAt(one.place);
    return elsewhere[static_cast<std::size_t>(&one - joined.data())].held;
}

/// Where hooks have changed a grain, its contacts or the gravity, its acceleration was found anew without
/// bonds, or changed with them in it: it is made of its contacts, the gravity and its bonds. Where a grain
/// has gone, its neighbours do not feel its bonds any more.
void BondPart::renewForces(StepContext& step) {
    ParticleStore& grains = step.grains();
    findPlaces(grains);
    for (const Joined& one : joined) {
        if (one.place == PlaceIndex::none ||
            (grains.acceleration[one.place] == one.acceleration &&
             grains.rotation[one.place].angularAcceleration == one.angularAcceleration))
            continue;
        TimeIntegration::renewAccelerations(grains, step.contacts.store(), step.gravity, {&one.place, 1});
        changeAcceleration(grains, one.place, one.force, one.torque);
        step.parts->addAccelerations(step, {&one.place, 1}, this);
    }
    const std::vector<bool> there = areThere(step);
    std::erase_if(bonds, [&](const Bond& bond) {
        if (there[bond.at1] && there[bond.at2]) return false;
        const std::uint32_t first = joined[bond.at1].place, second = joined[bond.at2].place;
        const BondLoad load = bond.elastic + bond.damping;
        if (first != PlaceIndex::none) changeAcceleration(grains, first, load.force, -load.torque1);
        if (second != PlaceIndex::none) changeAcceleration(grains, second, -load.force, -load.torque2);
        return true;
    });
    if (std::ranges::find(there, false) == there.end()) return;
    std::erase_if(joined,
                  [&](const Joined& one) { return !there[static_cast<std::size_t>(&one - joined.data())]; });
    numbers.clear();
    for (const Joined& one : joined)
        numbers.emplace(one.identity, static_cast<std::uint32_t>(numbers.size()));
    for (Bond& bond : bonds) bond.at1 = numbers.at(bond.first), bond.at2 = numbers.at(bond.second);
    atBegin = bonds;  // those of grains that have gone do nothing more
}

void BondPart::addAccelerations(StepContext& step, std::span<const std::uint32_t> places) {
    ParticleStore& grains = step.grains();
    for (const std::uint32_t place : places)
        if (const auto found = numbers.find(grains.identity[place]); found != numbers.end())
            changeAcceleration(grains, place, joined[found->second].force, joined[found->second].torque);
}

/// By a force (N) and a torque (N m).
void BondPart::changeAcceleration(ParticleStore& grains, std::uint32_t place, const Vector<double>& force,
                                  const Vector<double>& torque) {
    const HeldBits held = grains.heldAt(place);
    RotationRecord& turning = grains.rotation[place];
    grains.acceleration[place] += grains.translation[place].inverseMass * held.partAlong(force);
    turning.angularAcceleration += turning.inverseInertia * held.partAbout(torque);
}

BondStiffness BondPart::stiffnessOf(std::uint32_t material, double length) const {
    return materials[material].stiffness(BondSection{materials[material].radius}, length);
}

/// The difference of two positions, to the image that was there in the last step.
static Vector<double> sameImage(const PeriodicBox& box, const Vector<double>& apart,
                                const Vector<double>& last) {
    const auto along = [](double d, double before, double length) {
        return length > 0 ? d + length * std::nearbyint((before - d) / length) : d;
    };
    return {along(apart.x, last.x, box.length.x), along(apart.y, last.y, box.length.y),
            along(apart.z, last.z, box.length.z)};
}

BondState BondPart::stateOf(const StepContext& step, const Bond& bond) const {
    const Joined &one = joined[bond.at1], &other = joined[bond.at2];
    const ParticleStore& grains = step.grains();
    const Vector<double> apart = movingOf(grains, other).position - movingOf(grains, one).position;
    return {sameImage(step.box, apart, bond.between), bond.length,
            Axes<double>(one.orientation * bond.frame1), Axes<double>(other.orientation * bond.frame2)};
}

double BondPart::energy(const StepContext& step) const {
    ExactSum sum;
    for (const Bond& bond : bonds) sum.add(stateOf(step, bond).energy(bond.stiffness));
    return sum.value();
}

namespace {

/// Of a bond, each for the stiffness of the same name: 2 z sqrt(k m*) along and across it, kg/s, and 2 z
/// sqrt(k I*) about and across it, kg m^2/s; none between grains that are held.
struct BondDashpots {
    double normal, shear, bending, twist;

    BondDashpots(double inverseMass, double inverseInertia, const BondStiffness& k, double share) {
        const auto dashpot = [&](double stiffness, double inverse) {
            return inverse > 0 ? 2 * share * std::sqrt(stiffness / inverse) : 0;
        };
        normal = dashpot(k.normal, inverseMass), shear = dashpot(k.shear, inverseMass);
        bending = dashpot(k.bending, inverseInertia), twist = dashpot(k.twist, inverseInertia);
    }
};

}  // namespace

/// The velocity across is that in the middle, so that forces and torques balance.
BondLoad BondPart::dampingOf(const StepContext& step, const Bond& bond, const BondState& state) const {
    const double share = materials[bond.material].damping;
    if (share == 0) return {};
    const ParticleStore& grains = step.grains();
    const Joined &first = joined[bond.at1], &second = joined[bond.at2];
    const TranslationRecord &a = movingOf(grains, first), &b = movingOf(grains, second);
    const RotationRecord &turnA = turningOf(grains, first), &turnB = turningOf(grains, second);
    const BondDashpots dashpot(a.inverseMass + b.inverseMass, turnA.inverseInertia + turnB.inverseInertia,
                               bond.stiffness, share);
    const Vector<double> e = state.axis();
    const Vector<double> velocity =
        b.velocity - a.velocity - 0.5 * cross(turnA.spin + turnB.spin, state.between);
    const Vector<double> turning = turnB.spin - turnA.spin;
    const double along = dot(velocity, e), about = dot(turning, e);
    const Vector<double> across = -dashpot.shear * (velocity - along * e);
    const Vector<double> lever = -0.5 * cross(state.between, across);
    const Vector<double> couple = -dashpot.twist * about * e - dashpot.bending * (turning - about * e);
    return {across - dashpot.normal * along * e, lever - couple, lever + couple};
}

/// With the masses and inertias of a grain, each bond adds at most max(2 k_n, 4 k_s) / m and (2 max(k_b, k_t)
/// + k_s L L_max) / I to the square of the highest frequency, and as much of its dashpots to what damps it:
/// the rows of both matrices. The integrator says which step stands both (StabilityLimit.h).
double BondPart::largestStep(const StepContext& scene) const {
    const ParticleStore& grains = scene.grains();
    double longestBond = 0;  // m
    for (const Bond& bond : bonds) longestBond = std::max(longestBond, bond.length);
    std::map<std::uint32_t, std::array<SpringAndDashpot, 2>> rows;
    for (const Bond& bond : bonds) {
        const auto massOf = [&](std::uint32_t at) { return movingOf(grains, joined[at]).inverseMass; };
        const auto inertiaOf = [&](std::uint32_t at) { return turningOf(grains, joined[at]).inverseInertia; };
        const BondStiffness& k = bond.stiffness;
        const BondDashpots d(massOf(bond.at1) + massOf(bond.at2), inertiaOf(bond.at1) + inertiaOf(bond.at2),
                             k, materials[bond.material].damping);
        const double lever = bond.length * longestBond;
        for (const std::uint32_t at : {bond.at1, bond.at2}) {
            auto& [moving, turning] = rows[at];
            const double ofMass = massOf(at), ofInertia = inertiaOf(at);
            moving.spring += std::max(2 * k.normal, 4 * k.shear) * ofMass;
            moving.dashpot += std::max(2 * d.normal, 4 * d.shear) * ofMass;
            turning.spring += (2 * std::max(k.bending, k.twist) + k.shear * lever) * ofInertia;
            turning.dashpot += (2 * std::max(d.bending, d.twist) + d.shear * lever) * ofInertia;
        }
    }
    const SignChange limitOf(*scene.scheme);
    double step = infinity;
    for (const auto& [at, both] : rows)
        for (const SpringAndDashpot& row : both)
            if (row.spring > 0) step = std::min(step, limitOf.limit(row));
    return step;
}

void BondPart::refuseStep(const StepContext& step) {
    if (!longest) longest = largestStep(step);
    if (step.acceptsUnstableStep || step.length <= *longest) return;
    throw InputError(fmt::format(
        "bonds: time step = {:.6g} s is too large; it must be at most {:.6g} s with the stiffnesses and "
        "masses of this scene, or acceptUnstableTimeStep().",
        step.length, *longest));
}

/// Grains turn as they move: by the spin and half of the change in the step.
void BondPart::turnGrains(StepContext& step) {
    const ParticleStore& grains = step.grains();
    for (Joined& one : joined) {
        const RotationRecord& turning = turningOf(grains, one);
        one.before = one.orientation;
        one.forceBefore = one.force, one.torqueBefore = one.torque;
        one.velocity = movingOf(grains, one).velocity;
        one.spin = turning.spin;
        const Vector<double> way = step.length * (turning.spin + (step.scheme->position0 * step.length) *
                                                                     turning.angularAcceleration);
        const double angle = norm(way);
        if (angle > 0)
            one.orientation = (rationalTurn((1 / angle) * way, angle) * one.orientation).normalised();
    }
}

/// What hooks have asked for is done before the step, and is not taken back with it.
void BondPart::prepare(StepContext& step) {
    renewForces(step);
    joinNew(step);
}

void BondPart::beforeMotion(StepContext& step) {
    if (step.length == 0) prepare(step);  // the start of a run, where forces are found
    findGrains(step);
    atBegin = bonds;
    isAccelerated = false;
    refuseStep(step);
    if (step.ledger && step.length > 0) {
        const double now = energy(step);
        step.ledger->driver += now - stored;
        stored = now;
    }
    turnGrains(step);
}

void BondPart::computeLoads(StepContext& step) {
    findGrains(step);
    for (Joined& one : joined) one.force = one.torque = {0, 0, 0};
    for (Bond& bond : bonds) {
        const BondState state = stateOf(step, bond);
        bond.between = state.between;
        bond.elastic = state.elastic(bond.stiffness);
        bond.damping = dampingOf(step, bond, state);
        const BondLoad load = bond.elastic + bond.damping;
        Joined &one = joined[bond.at1], &other = joined[bond.at2];
        one.force -= load.force, one.torque += load.torque1;
        other.force += load.force, other.torque += load.torque2;
    }
}

/// Adds a share (s) of the accelerations by bonds to velocities.
void BondPart::push(StepContext& step, double time) {
    ParticleStore& grains = step.grains();
    for (const Joined& one : joined) {
        if (one.place == PlaceIndex::none) continue;
        const HeldBits held = grains.heldAt(one.place);
        TranslationRecord& moving = grains.translation[one.place];
        RotationRecord& turning = grains.rotation[one.place];
        moving.velocity += time * moving.inverseMass * held.partAlong(one.force);
        turning.spin += time * turning.inverseInertia * held.partAbout(one.torque);
    }
}

void BondPart::afterForces(StepContext& step) { computeLoads(step); }

/// The velocities get the part of the new forces that the end of the step gives them: Integrator.h. The
/// accelerations get theirs when the end has made them of the contacts' forces.
void BondPart::accelerate(StepContext& step) {
    for (Joined& one : joined) {
        if (one.place == PlaceIndex::none) continue;
        one.velocityBefore = step.grains().translation[one.place].velocity;
        one.spinBefore = step.grains().rotation[one.place].spin;
    }
    push(step, step.scheme->corrector * step.length);
    isAccelerated = true;
}

void BondPart::takeBack(StepContext& step) {
    ParticleStore& grains = step.grains();
    for (Joined& one : joined) {
        one.orientation = one.before;
        one.force = one.forceBefore, one.torque = one.torqueBefore;
        if (!isAccelerated || one.place == PlaceIndex::none) continue;
        grains.translation[one.place].velocity = one.velocityBefore;
        grains.rotation[one.place].spin = one.spinBefore;
    }
    bonds = atBegin;
    isAccelerated = false;
}

/// W, of a load at the mean velocities of the step.
double BondPart::power(const StepContext& step, const Bond& bond, const BondLoad& load) const {
    const ParticleStore& grains = step.grains();
    const auto mean = [&](const Joined& one) {
        return std::pair(0.5 * (one.velocity + movingOf(grains, one).velocity),
                         0.5 * (one.spin + turningOf(grains, one).spin));
    };
    const auto [velocity1, spin1] = mean(joined[bond.at1]);
    const auto [velocity2, spin2] = mean(joined[bond.at2]);
    return dot(load.force, velocity2 - velocity1) + dot(load.torque1, spin1) + dot(load.torque2, spin2);
}

/// Half of that of a step, as a bond gives it at the loads of one of its ends.
void BondPart::addWork(const StepContext& step, const Bond& bond, Work& work) const {
    const double half = 0.5 * step.length;
    work.elastic.add(half * power(step, bond, bond.elastic));
    work.damping.add(half * power(step, bond, bond.damping));
    const ParticleStore& grains = step.grains();
    const BondLoad load = bond.elastic + bond.damping;
    for (const bool isFirst : {true, false}) {
        const Joined& one = joined[isFirst ? bond.at1 : bond.at2];
        const Vector<double> force = isFirst ? -load.force : load.force,
                             torque = isFirst ? load.torque1 : load.torque2;
        const TranslationRecord& moving = movingOf(grains, one);
        const HeldBits held = heldOf(grains, one);
        const bool moves = moving.inverseMass > 0;
        const Vector<double> kept = moves ? force - held.partAlong(force) : force,
                             turned = moves ? torque - held.partAbout(torque) : torque;
        work.onHeld.add(half * (dot(kept, 0.5 * (one.velocity + moving.velocity)) +
                                dot(turned, 0.5 * (one.spin + turningOf(grains, one).spin))));
    }
}

void BondPart::account(StepContext& step) const {
    Work work;
    for (const auto* const some : {&atBegin, &bonds})
        for (const Bond& bond : *some) addWork(step, bond, work);
    step.ledger->bondDamping -= work.damping.value();
    step.ledger->walls -= work.onHeld.value();
    if (step.length > 0) step.ledger->stepError -= work.elastic.value() + energy(step) - stored;
}

/// A bond that breaks has given its grains their part of the velocity of this step, and nothing from here on.
void BondPart::breakBonds(StepContext& step) {
    std::vector<Bond> left;
    ExactSum lost;
    for (const Bond& bond : bonds) {
        const BondMaterial& material = materials[bond.material];
        const BondState state = stateOf(step, bond);
        const SectionLoad load(state, bond.elastic, material.strength.atEnds);
        if (!load.breaks(material.strength, BondSection{material.radius})) {
            left.push_back(bond);
            continue;
        }
        ++brokenCount;
        const BondLoad all = bond.elastic + bond.damping;
        Joined &one = joined[bond.at1], &other = joined[bond.at2];
        one.force += all.force, one.torque -= all.torque1;
        other.force -= all.force, other.torque -= all.torque2;
        lost.add(state.energy(bond.stiffness));
    }
    if (step.ledger) step.ledger->fracture += lost.value();
    bonds.swap(left);
}

void BondPart::finish(StepContext& step) {
    if (step.ledger) {
        findGrains(step);
        account(step);
    }
    breakBonds(step);
    ParticleStore& grains = step.grains();
    for (Joined& one : joined) {
        if (one.place == PlaceIndex::none) continue;
        changeAcceleration(grains, one.place, one.force, one.torque);
        one.acceleration = grains.acceleration[one.place];
        one.angularAcceleration = grains.rotation[one.place].angularAcceleration;
    }
    shareAccelerations(step);
    if (step.ledger) stored = step.ledger->bondElastic = energy(step);
}

static std::string text(const BondStiffness& k) {
    return fmt::format("{} N/m, {} N/m, {} N m/rad, {} N m/rad", k.normal, k.shear, k.bending, k.twist);
}

/// Materials are those with which the run began; stiffnesses are compared for each bond, by visitState().
void BondPart::compareSetUp(StateArchive& archive, StepContext& /*scene*/) {
    archive.same("materials", static_cast<std::uint64_t>(materials.size()));
    for (std::size_t k = 0; k < materials.size(); ++k)
        archive.group(fmt::format("material{}", k), [&] {
            const BondMaterial& m = materials[k];
            archive.same("radius", m.radius, "m");
            archive.same("tensileStrength", m.strength.tensile, "Pa");
            archive.same("shearStrength", m.strength.shear, "Pa");
            archive.same("momentShare", m.strength.momentShare);
            archive.same("strengthAtEnds", m.strength.atEnds ? 1 : 0);
            archive.same("damping", m.damping);
        });
}

/// Grains that a hook has joined since the last step.
void BondPart::visitWaiting(StateArchive& archive) {
    std::vector<Pair> pairs;
    std::vector<double> lengths;
    for (const ToJoin& one : toJoin) pairs.push_back(one), lengths.push_back(one.length);
    archive.column<std::uint32_t>("toJoin", pairs);
    archive.column<double>("lengthsToJoin", lengths);
    if (!archive.isReading()) return;
    archive.require(pairs.size() == lengths.size(), "toJoin", "do not fit their lengths");
    toJoin.clear();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        archive.require(pairs[k].material < materials.size(), "toJoin", "are of materials that are not set");
        toJoin.push_back({pairs[k], lengths[k]});
    }
}

void BondPart::visitState(StateArchive& archive, StepContext& /*scene*/) {
    struct Numbers {
        double length;
        BondStiffness stiffness;
        Quaternion frame1, frame2;
        Vector<double> between;
        BondLoad elastic, damping;
    };
    struct Motion {
        Quaternion orientation;
        Vector<double> force, torque, acceleration, angularAcceleration;
    };
    std::vector<Pair> pairs;
    std::vector<std::uint32_t> identities;
    std::vector<Numbers> ofBonds;
    std::vector<Motion> motions;
    for (const Bond& b : bonds) {
        pairs.push_back({b.first, b.second, b.material});
        ofBonds.push_back({b.length, b.stiffness, b.frame1, b.frame2, b.between, b.elastic, b.damping});
    }
    for (const Joined& one : joined) {
        identities.push_back(one.identity);
        motions.push_back(
            {one.orientation, one.force, one.torque, one.acceleration, one.angularAcceleration});
    }
    visitWaiting(archive);
    archive.column<std::uint32_t>("pairs", pairs);
    archive.column<double>("numbers", ofBonds);
    archive.column<std::uint32_t>("joined", identities);
    archive.column<double>("motions", motions);
    archive.finite("stored", stored);
    archive.value("broken", brokenCount);
    if (!archive.isReading()) return;
    archive.require(pairs.size() == ofBonds.size() && identities.size() == motions.size(), "pairs",
                    "do not fit their numbers");
    bonds.clear(), joined.clear(), numbers.clear();
    longest.reset();
    for (std::size_t k = 0; k < identities.size(); ++k) {
        Joined& one = joined[joinedAt(identities[k])];
        one.orientation = motions[k].orientation, one.acceleration = motions[k].acceleration;
        one.angularAcceleration = motions[k].angularAcceleration;
        one.force = motions[k].force, one.torque = motions[k].torque;
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        archive.require(pairs[k].material < materials.size(), "pairs", "are of materials that are not set");
        archive.require(numbers.contains(pairs[k].first) && numbers.contains(pairs[k].second), "pairs",
                        "are of grains that are not joined");
        const Numbers& n = ofBonds[k];
        const BondStiffness now = stiffnessOf(pairs[k].material, n.length);
        archive.requireSame(n.stiffness == now, "stiffness", text(n.stiffness), text(now), "",
                            "a run goes on with the values it began with");
        bonds.push_back({pairs[k].first, pairs[k].second, pairs[k].material, joinedAt(pairs[k].first),
                         joinedAt(pairs[k].second), now, n.length, n.frame1, n.frame2, n.between, n.elastic,
                         n.damping});
    }
}

void BondPart::addTo(SummaryRows& rows) const {
    rows.add("bonds", bonds.size());
    rows.add("bonds that have broken", brokenCount);
}

}  // namespace pendular
