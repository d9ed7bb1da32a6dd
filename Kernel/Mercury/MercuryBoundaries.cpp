#include "Kernel/Mercury/MercuryBoundaries.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {
namespace {

/// The point (m) of the plane position.dot(normal) = distance that is nearest to the origin.
Vec3D pointOfPlane(const char* boundary, const Vec3D& normal, double distance) {
    checkValue(boundary, "length of the normal", normal.norm(), "", positive);
    checkValue(boundary, "distance", distance, "m", anyFinite);
    return distance / normal.squaredNorm() * normal;
}

}  // namespace

void MercuryBoundary::addTo(Scene& of, const MercuryParts& with) {
    scene = &of;
    parts = with;
    isHandedOver = false;
    handOverWhenSet();
}

void MercuryBoundary::handOverWhenSet() {
    if (!scene || isHandedOver || !isSet()) return;
    handOver(*scene);
    isHandedOver = true;
}

void MercuryBoundary::settle() {
    if (!scene || isHandedOver || !isEnough()) return;
    handOver(*scene);
    isHandedOver = true;
}

void MercuryBoundary::requireChangeable(const char* call) const {
    if (isHandedOver)
        throw InputError(
            fmt::format("{}: {} comes too late, as the scene has the boundary already; call it "
                        "before the boundary is added.",
                        name, call));
}

void MercuryBoundary::stop() {
    if (isHandedOver)
        throw InputError(fmt::format(
            "{}: it cannot be removed, as the scene has it for good; only insertion boundaries can.", name));
}

void MercuryBoundary::requireSet() const {
    if (!isHandedOver)
        throw InputError(fmt::format("{}: it was added and not set; call its set() before the run.", name));
}

Scene& MercuryBoundary::sceneThatHasIt() const {
    if (!isHandedOver)
        throw InputError(
            fmt::format("{}: this one was not added to the scene, or not set; take the pointer that "
                        "boundaryHandler.copyAndAddObject() returned.",
                        name));
    return *scene;
}

void PeriodicBoundary::set(const Vec3D& normal, double lowest, double highest) {
    requireChangeable("set()");
    for (int k = 0; k < 3; ++k)
        if (normal == Vec3D::Unit(k)) {
            axis = k, low = lowest, high = highest;
            return handOverWhenSet();
        }
    throw InputError(
        fmt::format("PeriodicBoundary: normal = ({}, {}, {}); it must be (1, 0, 0), (0, 1, 0) or (0, 0, 1).",
                    normal.x(), normal.y(), normal.z()));
}

void LeesEdwardsBoundary::set(const std::function<double(double)>& shift,
                              const std::function<double(double)>& velocity, double left, double right,
                              double down, double up) {
    requireChangeable("set()");
    checkValue(name, "up", up, "m", {down, infinity, false, false});
    const double asked = velocity(0);
    for (const double time : {0.0, 1.0, 17.0})
        if (velocity(time) != asked || std::abs(shift(time) - asked * time) > 1e-12 * std::abs(asked * time))
            throw InputError(
                fmt::format("LeesEdwardsBoundary: at {} s the velocity is {} m/s and the shift {} m; the "
                            "velocity must be "
                            "steady, and the shift that velocity times the time.",
                            time, velocity(time), shift(time)));
    speed = asked;
    low = Vec3D(left, down, 0), high = Vec3D(right, up, 0);
    handOverWhenSet();
}

void LeesEdwardsBoundary::handOver(Scene& of) {
    for (int axis = 0; axis < 2; ++axis) of.setPeriodic(axis, (*low)[axis], (*high)[axis]);
    of.setLeesEdwards(0, 1, speed / (high->y() - low->y()));
}

void DeletionBoundary::setOutlet(const Outlet& where) {
    requireChangeable("set()");
    outlet = where;
    handOverWhenSet();
}

void DeletionBoundary::set(const Vec3D& normal, double distance) {
    Outlet beyond;
    beyond.setPlane(normal, pointOfPlane(name, normal, distance));
    setOutlet(beyond);
}

void CubeDeletionBoundary::set(const Vec3D& lowest, const Vec3D& highest) {
    Outlet within;
    within.setRegion(BoxRegion(lowest, highest));
    setOutlet(within);
}

GrainTally::Entry DeletionBoundary::count() const {
    return sceneThatHasIt().outletHandler.countOf(number).all();
}

double DeletionBoundary::getVolumeOfParticlesDeleted() const {
    const Scene& in = sceneThatHasIt();
    const GrainTally& tally = in.outletHandler.countOf(number);
    double volume = 0;
    for (std::size_t species = 0; species < tally.speciesCount(); ++species)
        for (std::size_t k = 0; k < tally.classCount(); ++k)
            if (const GrainTally::Entry some = tally.of(species, k); some.number > 0)
                volume += some.mass / in.laws().density(species);
    return volume;
}

double FluxBoundary::volumeOf(double mass) const {
    const ContactLaws& laws = sceneThatHasIt().laws();
    for (std::size_t k = 1; k < laws.speciesCount(); ++k)
        if (laws.density(k) != laws.density(0))
            throw InputError(
                "FluxBoundary: volumes follow from masses by the density, and the species of this scene "
                "differ in it; ask for the masses.");
    return mass / laws.density(0);
}

void FluxBoundary::set(const Vec3D& normal, double distance) {
    requireChangeable("set()");
    plane = FluxPlane{normal, pointOfPlane(name, normal, distance)};
    handOverWhenSet();
}

void FluxBoundary::handOver(Scene& of) { number = of.fluxPlaneHandler.copyAndAddObject(*plane); }

void FluxBoundary::setPrescribedDistance(std::function<double(double)> distance) {
    if (prescribed || !isAdded())
        throw InputError(
            "FluxBoundary: setPrescribedDistance() is called once, after the boundary was added.");
    prescribed = std::move(distance);
    actions().add(this);
}

void FluxBoundary::act(StepContext& step) {
    const Vec3D normal = plane->normal;
    const auto isBeyond = [&](const Vec3D& place, double time) {
        return normal.dot(place) > prescribed(time);
    };
    for (const GrainReference grain : step.particles) {
        const std::uint32_t identity = grain.getId();
        // Where a grain was before its first step, it says itself.
        const bool was = known.insert(identity).second
                             ? isBeyond(grain.getPosition() - step.length * grain.getVelocity(), step.time)
                             : beyond.contains(identity),
                   is = isBeyond(grain.getPosition(), step.timeAfter);
        if (is) beyond.insert(identity);
        else beyond.erase(identity);
        if (was == is) continue;
        const double mass = step.particles.massOf(grain.getRadius(), grain.getSpeciesIndex());
        if (is) ++own.forwards, own.massForwards += mass;
        else ++own.backwards, own.massBackwards += mass;
    }
}

void FluxBoundary::compareSetUp(StateArchive& archive, double now) const {
    archive.sameRecord<double>("normal", toVector(plane->normal));
    if (prescribed) archive.sameValues("prescribedDistance", {prescribed(0), prescribed(now)}, "m");
    else archive.sameRecord<double>("point", toVector(plane->point), "m");
}

void FluxBoundary::visitState(StateArchive& archive) {
    for (auto [name, set] : {std::pair("beyond", &beyond), std::pair("known", &known)}) {
        std::vector<std::uint32_t> identities(set->begin(), set->end());
        archive.column<std::uint32_t>(name, identities);
        *set = {identities.begin(), identities.end()};
    }
    archive.value("forwards", own.forwards);
    archive.value("backwards", own.backwards);
    archive.finite("massForwards", own.massForwards);
    archive.finite("massBackwards", own.massBackwards);
}

FluxCount FluxBoundary::count() const {
    return prescribed ? own : sceneThatHasIt().fluxPlaneHandler.countOf(number);
}

void MercuryBoundaryHandler::setWriteVTK(bool write) {
    if (write)
        scene->logger(LogLevel::Warn, "boundaryHandler.setWriteVTK(): boundaries have no pictures here.");
}

void MercuryBoundaryHandler::removeObject(std::size_t number) {
    getObject(number)->stop();
    removed.push_back(std::move(all[number]));
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(number));
}

MercuryBoundary* MercuryBoundaryHandler::getObject(std::size_t number) const {
    if (number >= all.size())
        throw InputError(fmt::format("BoundaryHandler: there is no boundary {}; it has {}, counted from 0.",
                                     number, all.size()));
    return all[number].get();
}

MercuryBoundary* MercuryBoundaryHandler::getLastObject() const {
    if (all.empty()) throw InputError("BoundaryHandler: there is no boundary.");
    return all.back().get();
}

}  // namespace pendular
