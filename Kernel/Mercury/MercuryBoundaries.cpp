#include "Kernel/Mercury/MercuryBoundaries.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "Kernel/Base/InputError.h"
#include "Kernel/Mercury/InletVelocities.h"
#include "Kernel/Sizes/SizeTable.h"
#include "Kernel/State/Random.h"

namespace pendular {
namespace {

/// The point (m) of the plane position.dot(normal) = distance that is nearest to the origin.
Vec3D pointOfPlane(const char* boundary, const Vec3D& normal, double distance) {
    checkValue(boundary, "length of the normal", normal.norm(), "", positive);
    checkValue(boundary, "distance", distance, "m", anyFinite);
    return distance / normal.squaredNorm() * normal;
}

}  // namespace

void MercuryBoundary::addTo(Scene& of) {
    scene = &of;
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

FluxCount FluxBoundary::count() const { return sceneThatHasIt().fluxPlaneHandler.countOf(number); }

void CubeInsertionBoundary::set(const SphericalParticle& like, unsigned maxFailed, const Vec3D& lowest,
                                const Vec3D& highest, const Vec3D& lowestVelocity,
                                const Vec3D& highestVelocity) {
    requireChangeable("set()");
    if ((lowestVelocity.array() > highestVelocity.array()).any())
        throw InputError(
            fmt::format("CubeInsertionBoundary: the lowest velocity = ({}, {}, {}) m/s is above the highest, "
                        "({}, {}, {}) "
                        "m/s; no part of it may be.",
                        lowestVelocity.x(), lowestVelocity.y(), lowestVelocity.z(), highestVelocity.x(),
                        highestVelocity.y(), highestVelocity.z()));
    lowVelocity = lowestVelocity, highVelocity = highestVelocity;
    grain = like;
    grain.setVelocity(lowestVelocity);
    region.emplace(lowest, highest);
    tries = maxFailed + 1;
    handOverWhenSet();
}

void CubeInsertionBoundary::set(const SphericalParticle& like, unsigned maxFailed, const Vec3D& lowest,
                                const Vec3D& highest, const Vec3D& lowestVelocity,
                                const Vec3D& highestVelocity, double smallest, double largest) {
    requireChangeable("set()");
    SphericalParticle one = like;
    one.setRadius(smallest);
    if (smallest != largest) {
        PSD even;
        even.setDistributionUniform(smallest, largest);
        setPSD(even);
    }
    set(one, maxFailed, lowest, highest, lowestVelocity, highestVelocity);
}

void CubeInsertionBoundary::setPSD(const PSD& distribution) {
    requireChangeable("setPSD()");
    sizes = distribution.sizes();
}

void CubeInsertionBoundary::setInitialVolume(double volume) {
    requireChangeable("setInitialVolume()");
    checkValue(name, "initial volume", volume, "m^3", notNegative);
    initialVolume = volume;
    handOverWhenSet();
}

void CubeInsertionBoundary::setVolumeFlowRate(double rate) {
    requireChangeable("setVolumeFlowRate()");
    checkValue(name, "volume flow rate", rate, "m^3/s", notNegative);
    flow = rate;
    handOverWhenSet();
}

SizeDistribution CubeInsertionBoundary::sizesOfGrains() const {
    if (sizes) return *sizes;
    checkValue("CubeInsertionBoundary", "radius of the grain", grain.getRadius(), "m", radiusRange);
    return singleSizes(std::array{2 * grain.getRadius()}, std::array{1.0}, SizeBasis::Number);
}

void CubeInsertionBoundary::handOver(Scene& of) {
    if (grain.getSpeciesIndex() < 0)
        throw InputError(
            "CubeInsertionBoundary: the grain has no species; call its setSpecies() before set().");
    if (of.particleHandler.axesOfAllHeld().z)
        throw InputError(
            "CubeInsertionBoundary: in two dimensions (setSystemDimensions(2)) its grains would come at all "
            "heights of the box; add grains at one z in setupInitialConditions() or a hook.");
    const double density = of.particleHandler.massOf(1, grain.getSpeciesIndex()) / sphereMass(1, 1);
    if (initialVolume > 0) insertAtOnce(of, density);
    if (flow > 0 || !(initialVolume > 0)) addInlet(of, density);
}

void CubeInsertionBoundary::insertAtOnce(Scene& of, double density) {
    const std::uint32_t first = of.particleHandler.store().nextIdentity();
    atOnce = of.insert(sizesOfGrains(), *region, Amount::mass(initialVolume * density), grain);
    if (lowVelocity == highVelocity) return;
    UniformRandom random(first);
    for (std::uint32_t identity = first; identity < of.particleHandler.store().nextIdentity(); ++identity) {
        Vec3D velocity;
        for (int axis = 0; axis < 3; ++axis)
            velocity[axis] = random.uniform(lowVelocity[axis], highVelocity[axis]);
        of.particleHandler.getObject(identity).setVelocity(velocity);
    }
}

void CubeInsertionBoundary::addInlet(Scene& of, double density) {
    Inlet stream;
    stream.setRegion(*region);
    stream.setSizes(sizesOfGrains());
    stream.setGrain(grain);
    stream.setTries(tries);
    if (flow > 0) stream.setMassFlow(flow * density);
    else {
        // More than any box has room for in any step: what has none is lost.
        stream.setNumberFlow(1e18);
        stream.setNoRoom(NoRoom::Lost);
    }
    inlet = of.inletHandler.copyAndAddObject(stream);
    if (lowVelocity != highVelocity)
        of.addPart<InletVelocities>(of.inletHandler, *inlet, lowVelocity, highVelocity);
}

std::uint64_t CubeInsertionBoundary::getNumberOfParticlesInserted() const {
    const Scene& in = sceneThatHasIt();
    return atOnce.number + (inlet ? in.inletHandler.countOf(*inlet).number : 0);
}

double CubeInsertionBoundary::getMassOfParticlesInserted() const {
    const Scene& in = sceneThatHasIt();
    return atOnce.mass + (inlet ? in.inletHandler.countOf(*inlet).mass : 0);
}

double CubeInsertionBoundary::getVolumeOfParticlesInserted() const {
    const auto species = static_cast<std::size_t>(grain.getSpeciesIndex());
    return getMassOfParticlesInserted() / sceneThatHasIt().laws().density(species);
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
