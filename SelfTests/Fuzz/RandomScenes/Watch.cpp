#include "SelfTests/Fuzz/RandomScenes/Watch.h"

#include <algorithm>
#include <cmath>

namespace pendular::fuzz {

namespace {

bool isFinite(const Vector<double>& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

void Watch::Sizes::raiseTo(const Sizes& other) {
    for (const auto member : {&Sizes::momentum, &Sizes::angularMomentum, &Sizes::force, &Sizes::torque,
                              &Sizes::speed, &Sizes::energy})
        this->*member = std::max(this->*member, other.*member);
}

void Watch::tell(std::string_view kind, const std::string& what) {
    if (std::ranges::any_of(found, [&](const std::string& fault) { return fault.starts_with(kind); })) return;
    found.push_back(fmt::format("{}: {} after {} steps", kind, what, making.scene.getNumberOfTimeSteps()));
}

double Watch::roundOff() const {
    return 0x1p-53 * static_cast<double>(making.scene.getNumberOfTimeSteps() - firstStep);
}

void Watch::begin() {
    if (hasBegun) return;
    hasBegun = true;
    firstStep = making.scene.getNumberOfTimeSteps();
    firstMomentum = toVector(making.scene.getTotalMomentum());
    firstAngularMomentum = angularMomentumNow();
    largest = sizesNow();
    for (const GrainReference grain : making.scene.particleHandler)
        if (grain.isFixed() && grain.getVelocity() == Vec3D::Zero() &&
            !making.scene.bodyHandler.bodyOf(grain.getId()))
            heldAt.emplace(grain.getId(), grain.getPosition());
}

void Watch::look() {
    lookAtNumbers();
    lookAtLiquid();
    if (!right) return;  // a wrong number that is accepted may be as large as it likes
    largest.raiseTo(sizesNow());
    lookAtEnergy();
    lookAtMomentum();
    lookAtPlaces();
    lookAtHeld();
}

void Watch::lookAtList() {
    if (!right) return;
    if (const std::string touch = unlisted.lookAt(making.scene); !touch.empty()) tell("list", touch);
}

void Watch::lookAtNumbers() {
    const ParticleStore& grains = making.scene.particleHandler.store();
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        const bool isNumber = isFinite(grain.position) && isFinite(grain.velocity) &&
                              std::isfinite(grain.radius) &&
                              (!grains.hasSpin || isFinite(grains.rotation[place].spin));
        if (!isNumber) tell("not a number", fmt::format("grain {}", grains.identity[place]));
    }
    for (GrainReference grain : making.scene.particleHandler)
        if (!(grain.getLiquidVolume() >= 0))
            tell("not a number", fmt::format("film of grain {}: {}", grain.getId(), grain.getLiquidVolume()));
}

Watch::Sizes Watch::sizesNow() const {
    Sizes sizes;
    const ParticleStore& grains = making.scene.particleHandler.store();
    double farthest = 0;
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        const double mass = making.scene.particleHandler.massAt(place), speed = norm(grain.velocity),
                     away = norm(grain.position) + grain.radius,
                     spin = grains.hasSpin ? norm(grains.rotation[place].spin) : 0;
        sizes.momentum += mass * speed;
        sizes.angularMomentum += mass * (away * speed + grain.radius * grain.radius * spin);
        sizes.speed = std::max(sizes.speed, speed + grain.radius * spin);
        farthest = std::max(farthest, away);
    }
    for (const ObservedContact& contact : making.scene.interactions()) sizes.force += norm(contact.force);
    sizes.torque = sizes.force * farthest;
    const EnergyLedger& ledger = making.scene.energyLedger();
    for (const auto& entry : EnergyLedger::entries()) sizes.energy += std::abs(ledger.*entry.member);
    return sizes;
}

/// About the origin, of all that is free.
Vector<double> Watch::angularMomentumNow() const {
    const ParticleStore& grains = making.scene.particleHandler.store();
    Vector<double> sum{0, 0, 0};
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        if (grain.inverseMass == 0 || grains.bodies.contains(grains.identity[place])) continue;
        const double mass = 1 / grain.inverseMass;
        sum += mass * cross(grain.position, grain.velocity);
        if (grains.hasSpin) sum += 0.4 * mass * grain.radius * grain.radius * grains.rotation[place].spin;
    }
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        const RigidBody& body = grains.bodies[k];
        sum += body.mass * cross(body.position, body.velocity) + body.angularMomentum;
    }
    return sum;
}

/// A step rounds each velocity and what the forces of the contacts add to it, some ten operations each.
void Watch::lookAtMomentum() {
    const double step = making.scene.getTimeStep();
    if (!(making.loses() & momentum)) {
        const double change = norm(toVector(making.scene.getTotalMomentum()) - firstMomentum),
                     allowed = 16 * roundOff() * (largest.momentum + step * largest.force);
        if (!(change <= allowed))
            tell("momentum", fmt::format("it has changed by {:.3g} of {:.3g} kg m/s, and round-off is {:.3g}",
                                         change, largest.momentum, allowed));
    }
    if (making.loses() & angularMomentum) return;
    const double change = norm(angularMomentumNow() - firstAngularMomentum),
                 allowed = 16 * roundOff() * (largest.angularMomentum + step * largest.torque);
    if (!(change <= allowed))
        tell("angular momentum",
             fmt::format("it has changed by {:.3g} of {:.3g} kg m^2/s, and round-off is {:.3g}", change,
                         largest.angularMomentum, allowed));
}

/// A step adds to some 30 entries, from the work of each contact.
void Watch::lookAtEnergy() {
    if (!making.scene.keepsEnergyLedger()) return;
    const double open = std::abs(making.scene.energyUnaccountedFor() + making.scene.energyLedger().stepError),
                 allowed = 64 * roundOff() *
                           (largest.energy + making.scene.getTimeStep() * largest.force * largest.speed);
    if (!(open <= allowed))
        tell("energy ledger", fmt::format("{:.3g} of {:.3g} J are missing, and round-off is {:.3g}", open,
                                          largest.energy, allowed));
}

/// Liquid is counted in whole quanta.
void Watch::lookAtLiquid() {
    if (!making.scene.movesLiquid()) return;
    if (const double missing = making.scene.liquidLedger().unaccounted(); missing != 0)
        tell("liquid ledger", fmt::format("{:.3g} m^3 are missing", missing));
}

/// Grains that leave a period are brought back each 256 steps: until then they may be a run's way outside.
void Watch::lookAtPlaces() {
    if (making.loses() & places) return;
    for (const GrainReference grain : making.scene.particleHandler) {
        const Vec3D at = grain.getPosition();
        for (int axis = 0; axis < 3; ++axis)
            if (making.isClosed[static_cast<std::size_t>(axis)] &&
                !(at[axis] >= making.lowest[axis] && at[axis] <= making.highest[axis]))
                tell("out of the box",
                     fmt::format("grain {} is at {:.6g} m of {:.6g} to {:.6g} m along {}", grain.getId(),
                                 at[axis], making.lowest[axis], making.highest[axis], "xyz"[axis]));
    }
}

void Watch::lookAtHeld() {
    if (making.has("change") || making.has("strain")) return;
    for (const auto& [identity, place] : heldAt)
        if (making.scene.particleHandler.contains(identity) &&
            making.scene.particleHandler.getObject(identity).getPosition() != place)
            tell("held grain", fmt::format("grain {} has moved", identity));
}

}  // namespace pendular::fuzz
