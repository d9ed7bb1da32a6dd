#include "Kernel/Core/Particles/ParticleHandler.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "Kernel/Core/Particles/GrainSpecies.h"
#include "Kernel/Core/Particles/OwnSpecies.h"
#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Core/Particles/Resolution.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

Vector<double> finite(std::uint32_t grain, std::string_view field, const Vec3D& value,
                      std::string_view unit) {
    if (!value.allFinite())
        throw InputError(fmt::format("particle {}: {} = ({}, {}, {}) {} is not finite.", grain, field,
                                     value.x(), value.y(), value.z(), unit));
    return toVector(value);
}

/// Sets the acceleration of a grain that begins to move.
void setAcceleration(ParticleStore& grains, std::uint32_t at, const Vector<double>& acceleration) {
    grains.acceleration[at] = acceleration;
    if (!grains.earlier.empty()) grains.earlier[at].acceleration = acceleration;
}

/// The inertia of a solid sphere or a disc, as the store has it: 5/2 or 2 of 1 / (m r^2).
GrainInertia ofSolid(double mass, double radius, bool isDisc) {
    return {1 / mass, (isDisc ? 2 : 2.5) * (1 / mass) / (radius * radius)};
}

/// What a grain follows of the accelerations that were set.
void followFreely(ParticleStore& grains, std::uint32_t at) {
    const HeldBits held = grains.heldAt(at);
    if (!held.any()) return;
    grains.acceleration[at] = held.partAlong(grains.acceleration[at]);
    if (grains.hasSpin)
        grains.rotation[at].angularAcceleration = held.partAbout(grains.rotation[at].angularAcceleration);
    if (grains.earlier.empty()) return;
    EarlierAcceleration& earlier = grains.earlier[at];
    earlier = {held.partAlong(earlier.acceleration), held.partAbout(earlier.angularAcceleration)};
}

void setInertia(ParticleStore& grains, std::uint32_t at, const GrainInertia& inertia) {
    grains.translation[at].inverseMass = inertia.inverseMass;
    if (grains.hasSpin) grains.rotation[at].inverseInertia = inertia.inverseMoment;
}

/// Changes the mass of a free grain, and with it the accelerations, while forces and torques stay.
void changeInertia(ParticleStore& grains, std::uint32_t at, const GrainInertia& inertia,
                   const Vector<double>& gravity) {
    const double before = grains.translation[at].inverseMass, ratio = inertia.inverseMass / before;
    const double turningBefore = grains.hasSpin ? grains.rotation[at].inverseInertia : 1;
    setInertia(grains, at, inertia);
    const auto scale = [&](Vector<double>& acceleration) {
        acceleration = gravity + ratio * (acceleration - gravity);
    };
    scale(grains.acceleration[at]);
    if (!grains.earlier.empty()) scale(grains.earlier[at].acceleration);
    followFreely(grains, at);
    if (!grains.hasSpin) return;
    const double turning = grains.rotation[at].inverseInertia / turningBefore;
    grains.rotation[at].angularAcceleration *= turning;
    if (!grains.earlier.empty()) grains.earlier[at].angularAcceleration *= turning;
}

}  // namespace

std::uint32_t GrainReference::place() const { return handler->placeOf(number); }
TranslationRecord& GrainReference::record() const { return handler->store().translation[place()]; }

int GrainReference::getSpeciesIndex() const { return handler->store().species[place()]; }

Vec3D GrainReference::getAngularVelocity() const {
    const ParticleStore& grains = handler->store();
    return grains.hasSpin ? toEigen(grains.rotation[place()].spin) : Vec3D::Zero();
}

double GrainReference::getMass() const {
    if (isFixed()) return infinity;
    return handler->store().bodies.contains(number) ? handler->massAt(place()) : 1 / record().inverseMass;
}

Vec3D GrainReference::getForce() const {
    if (isFixed()) return toEigen(loadOfHeld().force);
    return getMass() * toEigen(handler->store().acceleration[place()]);
}

/// A grain that is held has no accelerations, of which the forces of others follow.
GrainLoad GrainReference::loadOfHeld() const {
    handler->finishStep();
    return handler->loadAt ? handler->loadAt(place()) : GrainLoad{};
}

double GrainReference::getInertia() const {
    if (isFixed()) return infinity;
    const ParticleStore& grains = handler->store();
    if (grains.bodies.contains(number)) return 0.4 * getMass() * getRadius() * getRadius();
    return 1 / handler->inertiaAt(place()).inverseMoment;
}

Vec3D GrainReference::getTorque() const {
    const ParticleStore& grains = handler->store();
    if (!grains.hasSpin) return Vec3D::Zero();
    if (isFixed()) return toEigen(loadOfHeld().torque);
    return getInertia() * toEigen(grains.rotation[place()].angularAcceleration);
}

double GrainReference::getLiquidVolume() const { return handler->liquidFilms.of(handler->grains, place()); }
void GrainReference::setLiquidVolume(double volume) {
    checkValue(fmt::format("particle {}", number), "liquid volume", volume, "m^3", notNegative);
    handler->finishStep();  // with the mass that the grain had
    handler->liquidFilms.set(handler->grains, place(), volume);
    if (!(handler->liquidDensity > 0)) return;
    const ParticleStore& grains = handler->grains;
    if (const std::uint32_t body = grains.bodies.bodyOf(number); body != RigidBodies::none)
        handler->weighFilmsOf(grains.bodies.find(body));
    else handler->renewMass(place());
}

void GrainReference::requireOwnBody(std::string_view what) const {
    if (handler->store().bodies.contains(number))
        throw InputError(
            fmt::format("particle {}: its {} cannot be changed, as it is part of the rigid body {}.", number,
                        what, handler->store().bodies.bodyOf(number)));
}

void GrainReference::setVelocity(const Vec3D& velocity) {
    requireOwnBody("velocity");
    const Vector<double> value = finite(number, "velocity", velocity, "m/s");
    handler->requireHeld(fmt::format("particle {}", number), value, {0, 0, 0});
    record().velocity = value;
}
void GrainReference::setAngularVelocity(const Vec3D& spin) {
    requireOwnBody("angular velocity");
    const Vector<double> value = finite(number, "angular velocity", spin, "rad/s");
    handler->requireHeld(fmt::format("particle {}", number), {0, 0, 0}, value);
    if (handler->store().hasSpin) handler->store().rotation[place()].spin = value;
}
/// @param isOther whether the grain has another value than before; if not, contacts are listed again, and
/// keep their forces
static void noteIn(std::vector<std::uint32_t>& changed, std::uint32_t identity, bool isOther) {
    changed.push_back(isOther ? identity : ParticleHandler::Inside::givenWhatItHas);
}

void GrainReference::setPosition(const Vec3D& position) {
    requireOwnBody("position");
    const Vector<double> place = finite(number, "position", position, "m");
    requireResolved(fmt::format("particle {}", number), "position", place, getRadius());
    const bool isThere = record().position == place;
    record().position = place;
    noteIn(handler->changes.placed, number, !isThere);
}
void GrainReference::setRadius(double radius) {
    requireOwnBody("radius");
    checkValue(fmt::format("particle {}", number), "radius", radius, "m", radiusRange);
    requireResolved(fmt::format("particle {}", number), "position", record().position, radius);
    const double before = std::exchange(record().radius, radius);
    handler->renewMass(place());
    noteIn(radius > before ? handler->changes.placed : handler->changes.altered, number, radius != before);
}
void GrainReference::setSpeciesIndex(int index, const SpeciesOwner* owner) {
    requireOwnBody("species");
    handler->requireOwnSpecies(fmt::format("particle {}", number), index, owner);
    static_cast<void>(handler->massOf(getRadius(), index));  // throws if there is no such species
    const auto own = static_cast<std::uint16_t>(index);
    const bool isOther = std::exchange(handler->store().species[place()], own) != own;
    handler->renewMass(place());
    noteIn(handler->changes.altered, number, isOther);
}
void GrainReference::fixParticle(bool fix) {
    requireOwnBody("being held");
    const HeldBits held = handler->store().heldAt(place()).with(handler->heldByScene);
    if (!fix && held.any()) return setHeldAxes({});
    setFixed(fix);
}

void GrainReference::setFixed(bool fix) {
    const std::uint32_t at = place();
    const bool isLetGo = isFixed() && !fix;
    ParticleStore& grains = handler->store();
    const bool isOther = isFixed() != fix || grains.heldAt(at).any();
    grains.setHeldAt(at, {});
    setInertia(grains, at, fix ? GrainInertia{0, 0} : handler->inertiaAt(at));
    if (fix) {  // it keeps no motion, and no force of its own
        grains.translation[at].velocity = grains.acceleration[at] = {0, 0, 0};
        if (grains.hasSpin) grains.rotation[at].spin = grains.rotation[at].angularAcceleration = {0, 0, 0};
        if (!grains.earlier.empty()) grains.earlier[at] = {};
    }
    if (isLetGo) setAcceleration(grains, at, handler->gravity);
    noteIn(isLetGo ? handler->changes.placed : handler->changes.altered, number, isOther);
}

void GrainReference::setHeldAxes(const HeldAxes& axes) {
    requireOwnBody("held axes");
    const HeldBits held = HeldBits(axes).with(handler->heldByScene);
    if (held.areAll() || (!held.any() && isFixed())) return setFixed(held.areAll());
    if (isFixed()) setFixed(false);
    const std::uint32_t at = place();
    ParticleStore& grains = handler->store();
    const HeldBits before = grains.heldAt(at);
    // Along axes along which it was held it begins to fall.
    setAcceleration(
        grains, at,
        before.partAlong(grains.acceleration[at]) + (handler->gravity - before.partAlong(handler->gravity)));
    grains.setHeldAt(at, held);
    followFreely(grains, at);
    grains.translation[at].velocity = held.partAlong(grains.translation[at].velocity);
    if (grains.hasSpin) grains.rotation[at].spin = held.partAbout(grains.rotation[at].spin);
    noteIn(handler->changes.altered, number, held.byte() != before.byte());
}
HeldAxes GrainReference::getHeldAxes() const {
    const ParticleStore& grains = handler->store();
    const std::uint32_t body = grains.bodies.bodyOf(number);
    if (body != RigidBodies::none) return grains.bodies.heldAxesOf(grains.bodies.find(body)).axes();
    return isFixed() ? HeldAxes::all() : grains.heldAt(place()).axes();
}

double& GrainColumnReference::operator[](std::uint32_t identity) const {
    return handler->store().columns[number].values[handler->placeOf(identity)];
}

void ParticleHandler::setSpecies(const GrainSpecies& of) {
    species = &of;
    grains.hasSpin = of.turnGrains();
}

void ParticleHandler::requireHeld(std::string_view whose, const Vector<double>& velocity,
                                  const Vector<double>& spin) const {
    if (!heldByScene.any()) return;
    const auto require = [&](std::string_view field, const Vector<double>& v, const Vector<double>& part,
                             std::string_view unit) {
        if (!(v == part))
            throw InputError(
                fmt::format("{}: {} = ({}, {}, {}) {} is not allowed, as all grains are held in a plane or "
                            "along a line (holdAll(), setSystemDimensions(2)); it must be ({}, {}, {}) {}.",
                            whose, field, v.x, v.y, v.z, unit, part.x, part.y, part.z, unit));
    };
    require("velocity", velocity, heldByScene.partAlong(velocity), "m/s");
    require("angular velocity", spin, heldByScene.partAbout(spin), "rad/s");
}

void ParticleHandler::holdAll(const HeldAxes& axes) {
    if (axes == heldByScene.axes()) return;
    if (columnsAreClosed || !grains.bodies.empty())
        throw InputError(
            "Simulation: axes along which all grains are held (holdAll(), setSystemDimensions(2)) are set "
            "before the run and before the first rigid body.");
    const HeldBits before = std::exchange(heldByScene, HeldBits(axes));
    try {
        for (const GrainReference grain : *this)
            requireHeld(fmt::format("particle {}", grain.getId()), toVector(grain.getVelocity()),
                        toVector(grain.getAngularVelocity()));
    } catch (const InputError&) {
        heldByScene = before;
        throw;
    }
    for (GrainReference grain : *this)
        if (!grain.isFixed()) grain.setHeldAxes(HeldBits(grain.getHeldAxes()).without(before).axes());
}

void ParticleHandler::requireOwnSpecies(std::string_view whose, int index, const SpeciesOwner* owner) const {
    pendular::requireOwnSpecies(*species, whose, index, owner);
}

void ParticleHandler::settleSpin() {
    if (grains.hasSpin && !species->turnGrains()) std::vector<RotationRecord>().swap(grains.rotation);
    grains.hasSpin = species->turnGrains();
}

double ParticleHandler::massOf(double radius, int of) const {
    const auto index = static_cast<std::size_t>(of);
    const double density = species->density(index);
    checkValue(species->typeName(index), "density", density, "kg/m^3", positive);
    return species->massOf(index, radius);
}

double ParticleHandler::massAt(std::uint32_t at) const {
    const auto ofSphere = [this](std::uint32_t place) {
        return massOf(grains.translation[place].radius, grains.species[place]);
    };
    const std::uint32_t identity = grains.identity[at], body = grains.bodies.bodyOf(identity);
    if (body == RigidBodies::none) return ofSphere(at);
    const std::uint32_t k = grains.bodies.find(body);
    const std::vector<double> shares =
        grains.bodies.sharesOfMass(k, [&](std::uint32_t grain) { return ofSphere(grains.place[grain]); });
    const auto members = grains.bodies.membersOf(k);
    const auto own = std::ranges::find(members, identity, &BodyMember::grain);
    return shares[static_cast<std::size_t>(own - members.begin())];
}

GrainReference ParticleHandler::copyAndAddObject(const SphericalParticle& grain) {
    finishStep();
    const std::string owner = fmt::format("particle {}", grains.nextIdentity());
    if (grains.nextIdentity() > ParticleStore::largestIdentity)
        throw InputError(
            fmt::format("{}: no more grains can be added; the number of a grain must be at most {}.", owner,
                        ParticleStore::largestIdentity));
    checkValue(owner, "radius", grain.getRadius(), "m", positive);
    requireOwnSpecies(owner, grain.getSpeciesIndex(), grain.getSpeciesOwner());
    requireResolved(owner, "position", toVector(grain.getPosition()), grain.getRadius());
    requireHeld(owner, toVector(grain.getVelocity()), toVector(grain.getAngularVelocity()));
    const double mass = massOf(grain.getRadius(), grain.getSpeciesIndex());
    const HeldBits held = HeldBits(grain.getHeldAxes()).with(heldByScene);
    const TranslationRecord record{toVector(grain.getPosition()), grain.getRadius(),
                                   toVector(grain.getVelocity()), held.areAll() ? 0 : 1 / mass};
    const std::uint32_t identity = grains.add(record, toVector(grain.getAngularVelocity()),
                                              static_cast<std::uint16_t>(grain.getSpeciesIndex()));
    if (!held.areAll()) {
        if (species->grainsAreDiscs())
            setInertia(grains, grains.place[identity], inertiaAt(grains.place[identity]));
        grains.setHeldAt(grains.place[identity], held);
        setAcceleration(grains, grains.place[identity], gravity);
        followFreely(grains, grains.place[identity]);
    }
    if (grain.getLiquidVolume() > 0) {
        liquidFilms.set(grains, grains.place[identity], grain.getLiquidVolume());
        if (liquidDensity > 0) renewMass(grains.place[identity]);
    }
    changes.added.push_back(identity);
    return {*this, identity};
}

void ParticleHandler::removeObject(std::size_t identity) {
    finishStep();
    const std::uint32_t at = placeOf(identity);
    if (grains.bodies.contains(static_cast<std::uint32_t>(identity)))
        throw InputError(fmt::format(
            "particle {} is part of the rigid body {}; remove that by bodyHandler.removeObject().", identity,
            grains.bodies.bodyOf(static_cast<std::uint32_t>(identity))));
    if (beforeRemoval) beforeRemoval(at);
    liquidFilms.remove(grains, at);
    grains.remove(at);
    const auto forget = [&](std::vector<std::uint32_t>& list) { std::erase(list, identity); };
    forget(changes.added);
    forget(changes.placed);
    forget(changes.altered);
}

bool ParticleHandler::contains(std::size_t identity) const {
    return identity < PlaceIndex::none && grains.place.contains(static_cast<std::uint32_t>(identity));
}

std::uint32_t ParticleHandler::placeOf(std::size_t identity) const {
    if (contains(identity)) return grains.place[static_cast<std::uint32_t>(identity)];
    if (grains.isShared && identity < grains.nextIdentity())
        throw InputError(fmt::format(
            "Particle {} is on another rank, or was removed; ask particleHandler.contains({}) first.",
            identity, identity));
    throw InputError(identity < grains.nextIdentity()
                         ? fmt::format("Particle {} was removed.", identity)
                         : fmt::format("There is no particle {}; the scene has {} (counted from 0).",
                                       identity, getSize()));
}

GrainReference ParticleHandler::getObject(std::size_t identity) {
    static_cast<void>(placeOf(identity));
    return {*this, static_cast<std::uint32_t>(identity)};
}

void ParticleHandler::refusePart(std::string_view what) {
    throw InputError(fmt::format(
        "Simulation: {} needs all grains, and each rank of a scene on several ranks (mpirun, setRanks()) has "
        "its own ones only: call gather() before, on all ranks; or loop over particleHandler.ownGrains() to "
        "change each grain by itself, and sum over all ranks by sumOverGrains() or sumOverInteractions().",
        what));
}

GrainReference ParticleHandler::getLastObject() {
    requireAll("getLastObject()");
    if (isEmpty()) throw InputError("ParticleHandler: getLastObject() needs a grain, and there is none.");
    return {*this, grains.place.last()};
}

GrainReference ParticleHandler::firstBy(std::string_view call,
                                        const std::function<bool(double, double)>& isBefore) {
    requireAll(call);
    if (isEmpty())
        throw InputError(fmt::format("ParticleHandler: {} needs a grain, and there is none.", call));
    std::uint32_t found = *grains.place.begin();
    for (const std::uint32_t place : grains.place)
        if (isBefore(grains.translation[place].radius, grains.translation[found].radius)) found = place;
    return {*this, grains.identity[found]};
}
GrainReference ParticleHandler::getSmallestParticle() {
    return firstBy("getSmallestParticle()", std::less{});
}
GrainReference ParticleHandler::getLargestParticle() {
    return firstBy("getLargestParticle()", std::greater{});
}

void ParticleHandler::clear() {
    for (const GrainReference grain : *this)
        if (!grains.bodies.contains(grain.getId())) removeObject(grain.getId());
}

GrainColumnReference ParticleHandler::addColumn(const std::string& name, const std::string& unit,
                                                double initial) {
    if (columnsAreClosed)
        throw InputError("Simulation: columns of grains can only be added before the run starts.");
    const NamedColumn added{name, unit, initial};
    requireNewColumn(added, "grains", hasColumn(grains.columns, name));
    grains.columns.push_back({added, std::vector<double>(grains.size(), initial)});
    return {*this, grains.columns.size() - 1};
}

void ParticleHandler::renewMass(std::uint32_t at) {
    if (!grains.isFree(at)) return;
    const GrainInertia inertia = inertiaAt(at);
    if (inertia.inverseMass != grains.translation[at].inverseMass)
        changeInertia(grains, at, inertia, gravity);
}

/// A film is a thin shell, of which the moment of inertia is 2/3 m r^2.
GrainInertia ParticleHandler::inertiaAt(std::uint32_t at) const {
    const double radius = grains.translation[at].radius, solid = massOf(radius, grains.species[at]);
    const double film = liquidDensity > 0 ? liquidDensity * liquidFilms.of(grains, at) : 0;
    if (film == 0) return ofSolid(solid, radius, species->grainsAreDiscs());
    return {1 / (solid + film), 1 / ((2.0 / 5 * solid + 2.0 / 3 * film) * radius * radius)};
}

void ParticleHandler::renewMasses() {
    finishStep();
    if (grains.bodies.empty()) densitiesOfJoined.clear();
    for (const auto& [index, density] : densitiesOfJoined)
        if (species->density(index) != density)
            throw InputError(
                fmt::format("{} {}: density = {:.6g} kg/m^3 cannot be changed to {:.6g} kg/m^3, as grains of "
                            "it are part of "
                            "rigid bodies, which keep their mass.",
                            species->typeName(index), index, density, species->density(index)));
    weighFilms();
}

void ParticleHandler::weighFilms() {
    for (const std::uint32_t at : grains.place) renewMass(at);
    if (liquidDensity > 0)
        for (std::size_t k = 0; k < grains.bodies.size(); ++k) weighFilmsOf(k);
}

void ParticleHandler::weighFilmsOf(std::size_t body) {
    std::vector<double> masses;
    for (const BodyMember& member : grains.bodies.membersOf(body))
        masses.push_back(liquidDensity * liquidFilms.of(grains, grains.place[member.grain]));
    grains.bodies.weigh(grains, body, masses, gravity);
}

void ParticleHandler::setGravity(const Vector<double>& acceleration) {
    finishStep();  // with the gravity that it had
    const Vector<double> change = acceleration - std::exchange(gravity, acceleration);
    if (change == Vector<double>{0, 0, 0}) return;
    for (const std::uint32_t at : grains.place) {
        if (!grains.isFree(at)) continue;
        grains.acceleration[at] += change;
        if (!grains.earlier.empty()) grains.earlier[at].acceleration += change;
        followFreely(grains, at);
    }
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) grains.bodies[k].acceleration += change;
    for (EarlierBodyMotion& body : grains.bodies.earlier) body.acceleration += change;
}

void ParticleHandler::noteDensityOfJoined(std::uint32_t identity) {
    const std::uint16_t index = grains.species[grains.place[identity]];
    densitiesOfJoined.try_emplace(index, species->density(index));
}

void ParticleHandler::noteJoined(std::span<const std::uint32_t> identities) {
    changes.altered.insert(changes.altered.end(), identities.begin(), identities.end());
    for (const std::uint32_t identity : identities) noteDensityOfJoined(identity);
}

void ParticleHandler::visitState(StateArchive& archive) {
    finishStep();
    grains.visitState(archive);
    if (liquidFilms.areKept()) archive.group("films", [&] { liquidFilms.visitState(archive, grains); });
    for (const std::uint16_t index : grains.species)
        archive.require(index < species->speciesCount(), "species", "has one that the scene has not");
    if (!archive.isReading()) return;
    for (const std::uint32_t at : grains.place)
        archive.require(
            grains.translation[at].inverseMass == 0 || !heldByScene.without(grains.heldAt(at)).any(), "held",
            "lets grains go along axes along which this scene holds all (holdAll())");
    changes = {};
    for (const std::uint32_t identity : grains.identity)
        if (grains.bodies.contains(identity)) noteDensityOfJoined(identity);
}

}  // namespace pendular
