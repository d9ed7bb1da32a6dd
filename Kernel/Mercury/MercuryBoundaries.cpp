#include "Kernel/Mercury/MercuryBoundaries.h"

#include <fmt/format.h>

#include <array>

#include "Kernel/Base/InputError.h"
#include "Kernel/Sizes/SizeTable.h"

namespace pendular {
namespace {

/// Throws InputError unless the boundary has been added to a scene.
template <class S>
S& added(S* scene, const char* boundary) {
    if (!scene)
        throw InputError(
            fmt::format("{}: this one was not added to the scene; take the pointer that "
                        "boundaryHandler.copyAndAddObject() returned.",
                        boundary));
    return *scene;
}

/// The point (m) of the plane position.dot(normal) = distance that is nearest to the origin.
Vec3D pointOfPlane(const char* boundary, const Vec3D& normal, double distance) {
    checkValue(boundary, "length of the normal", normal.norm(), "", positive);
    checkValue(boundary, "distance", distance, "m", anyFinite);
    return distance / normal.squaredNorm() * normal;
}

}  // namespace

void PeriodicBoundary::set(const Vec3D& normal, double lowest, double highest) {
    for (int k = 0; k < 3; ++k)
        if (normal == Vec3D::Unit(k)) {
            axis = k, low = lowest, high = highest;
            return;
        }
    throw InputError(
        fmt::format("PeriodicBoundary: normal = ({}, {}, {}); it must be (1, 0, 0), (0, 1, 0) or (0, 0, 1).",
                    normal.x(), normal.y(), normal.z()));
}

void DeletionBoundary::set(const Vec3D& normal, double distance) {
    outlet.setPlane(normal, pointOfPlane("DeletionBoundary", normal, distance));
}

void DeletionBoundary::addTo(Scene& of) {
    number = of.outletHandler.copyAndAddObject(outlet);
    scene = &of;
}

GrainTally::Entry DeletionBoundary::count() const {
    return added(scene, "DeletionBoundary").outletHandler.countOf(number).all();
}

void FluxBoundary::set(const Vec3D& normal, double distance) {
    plane = {normal, pointOfPlane("FluxBoundary", normal, distance)};
}

void FluxBoundary::addTo(Scene& of) {
    number = of.fluxPlaneHandler.copyAndAddObject(plane);
    scene = &of;
}

FluxCount FluxBoundary::count() const {
    return added(scene, "FluxBoundary").fluxPlaneHandler.countOf(number);
}

void CubeInsertionBoundary::set(const SphericalParticle& like, unsigned maxFailed, const Vec3D& lowest,
                                const Vec3D& highest, const Vec3D& lowestVelocity,
                                const Vec3D& highestVelocity) {
    if (lowestVelocity != highestVelocity)
        throw InputError(
            "CubeInsertionBoundary: the bounds of the velocity differ, and all grains come with one velocity "
            "here; give it twice, in m/s, or set velocities in a hook.");
    grain = like;
    grain.setVelocity(lowestVelocity);
    region.emplace(lowest, highest);
    tries = maxFailed + 1;
}

void CubeInsertionBoundary::set(const SphericalParticle& like, unsigned maxFailed, const Vec3D& lowest,
                                const Vec3D& highest, const Vec3D& lowestVelocity,
                                const Vec3D& highestVelocity, double smallest, double largest) {
    set(like, maxFailed, lowest, highest, lowestVelocity, highestVelocity);
    PSD even;
    if (smallest == largest) grain.setRadius(smallest);
    else even.setDistributionUniform(smallest, largest), setPSD(even);
}

void CubeInsertionBoundary::setInitialVolume(double volume) {
    checkValue("CubeInsertionBoundary", "initial volume", volume, "m^3", notNegative);
    initialVolume = volume;
}

void CubeInsertionBoundary::setVolumeFlowRate(double rate) {
    checkValue("CubeInsertionBoundary", "volume flow rate", rate, "m^3/s", notNegative);
    flow = rate;
}

SizeDistribution CubeInsertionBoundary::sizesOfGrains() const {
    if (sizes) return *sizes;
    checkValue("CubeInsertionBoundary", "radius of the grain", grain.getRadius(), "m", radiusRange);
    return singleSizes(std::array{2 * grain.getRadius()}, std::array{1.0}, SizeBasis::Number);
}

void CubeInsertionBoundary::addTo(Scene& of) {
    if (!region) throw InputError("CubeInsertionBoundary: it has no box; call set() before it is added.");
    if (initialVolume == 0 && flow == 0)
        throw InputError(
            "CubeInsertionBoundary: it has no amount; call setInitialVolume(), in m^3, or "
            "setVolumeFlowRate(), in "
            "m^3/s, before it is added, as a box is not filled again in each step here.");
    if (grain.getSpeciesIndex() < 0)
        throw InputError(
            "CubeInsertionBoundary: the grain has no species; call its setSpecies() before set().");
    const double density = of.particleHandler.massOf(1, grain.getSpeciesIndex()) / sphereMass(1, 1);
    if (initialVolume > 0)
        atOnce = of.insert(sizesOfGrains(), *region, Amount::mass(initialVolume * density), grain);
    if (flow > 0) {
        Inlet stream;
        stream.setRegion(*region);
        stream.setSizes(sizesOfGrains());
        stream.setGrain(grain);
        stream.setMassFlow(flow * density);
        stream.setTries(tries);
        inlet = of.inletHandler.copyAndAddObject(stream);
    }
    scene = &of;
}

std::uint64_t CubeInsertionBoundary::getNumberOfParticlesInserted() const {
    const Scene& in = added(scene, "CubeInsertionBoundary");
    return atOnce.number + (inlet ? in.inletHandler.countOf(*inlet).number : 0);
}

double CubeInsertionBoundary::getMassOfParticlesInserted() const {
    const Scene& in = added(scene, "CubeInsertionBoundary");
    return atOnce.mass + (inlet ? in.inletHandler.countOf(*inlet).mass : 0);
}

MercuryBoundary* MercuryBoundaryHandler::getObject(std::size_t number) const {
    if (number >= all.size())
        throw InputError(fmt::format("BoundaryHandler: there is no boundary {}; it has {}, counted from 0.",
                                     number, all.size()));
    return all[number].get();
}

}  // namespace pendular
