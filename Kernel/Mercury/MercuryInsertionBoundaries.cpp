#include "Kernel/Mercury/MercuryInsertionBoundaries.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "Kernel/Base/InputError.h"
#include "Kernel/Sizes/SizeTable.h"

namespace pendular {

static SizeDistribution oneSize(double radius) {
    return singleSizes(std::array{2 * radius}, std::array{1.0}, SizeBasis::Number);
}

void InsertionBoundary::setGrains(const std::vector<const SphericalParticle*>& likes, unsigned maxFailed,
                                  const Vec3D& lowestVelocity, const Vec3D& highestVelocity) {
    requireChangeable("set()");
    if ((lowestVelocity.array() > highestVelocity.array()).any())
        throw InputError(
            fmt::format("{}: the lowest velocity = ({}, {}, {}) m/s is above the highest, ({}, {}, {}) m/s; "
                        "no part of it "
                        "may be.",
                        name, lowestVelocity.x(), lowestVelocity.y(), lowestVelocity.z(), highestVelocity.x(),
                        highestVelocity.y(), highestVelocity.z()));
    plan.maxFailed = maxFailed;
    plan.lowVelocity = lowestVelocity, plan.highVelocity = highestVelocity;
    if (!likes.empty()) grains.clear();
    for (const SphericalParticle* like : likes) grains.push_back(*like);
}

void InsertionBoundary::setBox(const Vec3D& lowest, const Vec3D& highest) {
    requireChangeable("set()");
    for (int axis = 0; axis < 3; ++axis)
        checkValue(name, "highest corner", highest[axis], "m", {lowest[axis], infinity, true, false});
    plan.lowest = lowest, plan.highest = highest;
    hasBox = true;
    handOverWhenSet();
}

void InsertionBoundary::setRadii(double smallest, double largest) {
    requireChangeable("set()");
    PSD radii;
    if (smallest != largest) radii.setDistributionUniform(smallest, largest);
    else radii = PSD(oneSize(smallest));
    setPSD(radii);
}

void InsertionBoundary::setPSD(const std::vector<PSD>& distributions, const std::vector<double>& numbers) {
    requireChangeable("setPSD()");
    if (distributions.size() != numbers.size())
        throw InputError(fmt::format("{}: there are {} distributions and {} shares; give one for each.", name,
                                     distributions.size(), numbers.size()));
    for (const double share : numbers) checkValue(name, "share", share, "", positive);
    for (const PSD& distribution : distributions) static_cast<void>(distribution.sizes());  // they are set
    sizes = distributions, shares = numbers;
}

void InsertionBoundary::addSort(const SphericalParticle& like, const PSD& radii, double share) {
    requireChangeable("addGenerandum()");
    checkValue(name, "share", share, "", positive);
    grains.push_back(like), sizes.push_back(radii), shares.push_back(share);
}

void InsertionBoundary::setInitialVolume(double volume) {
    requireChangeable("setInitialVolume()");
    checkValue(name, "initial volume", volume, "m^3", notNegative);
    plan.atOnce = volume;
    handOverWhenSet();
}

void InsertionBoundary::setVolumeFlowRate(double rate) {
    requireChangeable("setVolumeFlowRate()");
    checkValue(name, "volume flow rate", rate, "m^3/s", notNegative);
    plan.flow = rate;
    handOverWhenSet();
}

GrainSource InsertionBoundary::sourceFor(const Scene& of) const {
    if (grains.empty())
        throw InputError(fmt::format("{}: it has no grains; call its set() with a grain.", name));
    if (of.particleHandler.axesOfAllHeld().z && plan.lowest.z() != plan.highest.z())
        throw InputError(
            fmt::format("{}: in two dimensions (setSystemDimensions(2)) its grains would come at all heights "
                        "of the box, {} "
                        "to {} m; let both corners have one z.",
                        name, plan.lowest.z(), plan.highest.z()));
    if (!sizes.empty() && sizes.size() != grains.size())
        throw InputError(
            fmt::format("{}: there are {} distributions and {} sorts of grains; give one for each.", name,
                        sizes.size(), grains.size()));
    GrainSource made = plan;
    for (std::size_t k = 0; k < grains.size(); ++k) {
        if (grains[k].getSpeciesIndex() < 0)
            throw InputError(
                fmt::format("{}: the grain has no species; call its setSpecies() before set().", name));
        if (sizes.empty()) checkValue(name, "radius of the grain", grains[k].getRadius(), "m", radiusRange);
        made.sorts.push_back({grains[k], sizes.empty() ? oneSize(grains[k].getRadius()) : sizes[k].sizes(),
                              shares.empty() ? 1 : shares[k]});
    }
    return made;
}

void InsertionBoundary::handOver(Scene& of) {
    GrainSource made = sourceFor(of);
    const bool isFlat = (plan.lowest.array() == plan.highest.array()).any();
    if (plan.atOnce > 0 && isBox && !isFlat && made.sorts.size() == 1) {
        insertAtOnce(of, made.sorts[0]);
        made.atOnce = 0;
        if (plan.flow == 0) return;
    }
    source = insertions().add(std::move(made));
    if (source->atOnce > 0) source->letIn(of.particleHandler, of.wallHandler, of.getPeriodicBox(), 0);
}

void InsertionBoundary::insertAtOnce(Scene& of, const GrainSource::Sort& sort) {
    const double density = of.particleHandler.massOf(1, sort.like.getSpeciesIndex()) / sphereMass(1, 1);
    const std::uint32_t first = of.particleHandler.store().nextIdentity();
    SphericalParticle like = sort.like;
    like.setVelocity(plan.lowVelocity);
    const Inserted inserted = of.insert(sort.sizes, BoxRegion(plan.lowest, plan.highest),
                                        Amount::mass(plan.atOnce * density), like);
    numberAtOnce = inserted.number, massAtOnce = inserted.mass, volumeAtOnce = inserted.mass / density;
    if (plan.lowVelocity == plan.highVelocity) return;
    UniformRandom random(first);
    for (std::uint32_t identity = first; identity < of.particleHandler.store().nextIdentity(); ++identity) {
        Vec3D velocity;
        for (int axis = 0; axis < 3; ++axis)
            velocity[axis] = random.uniform(plan.lowVelocity[axis], plan.highVelocity[axis]);
        of.particleHandler.getObject(identity).setVelocity(velocity);
    }
}

void InsertionBoundary::checkBoundaryBeforeTimeStep(Scene* scene) {
    if (isAdded()) {
        settle();
        if (source)
            source->letIn(scene->particleHandler, scene->wallHandler, scene->getPeriodicBox(),
                          scene->getTime());
        return;
    }
    GrainSource now = sourceFor(*scene);
    now.letIn(scene->particleHandler, scene->wallHandler, scene->getPeriodicBox(), scene->getTime());
    numberAtOnce += now.number, massAtOnce += now.mass, volumeAtOnce += now.volume;
}

void InsertionBoundary::stop() {
    if (source) insertions().stop(source);
}

std::uint64_t InsertionBoundary::getNumberOfParticlesInserted() const {
    return numberAtOnce + (source ? source->number : 0);
}

double InsertionBoundary::getMassOfParticlesInserted() const {
    return massAtOnce + (source ? source->mass : 0);
}

double InsertionBoundary::getVolumeOfParticlesInserted() const {
    return volumeAtOnce + (source ? source->volume : 0);
}

void SphereInsertionBoundary::set(const SphericalParticle* like, unsigned maxFailed, const Vec3D& centre,
                                  double radius, const Vec3D& lowestVelocity, const Vec3D& highestVelocity) {
    checkValue(name, "radius", radius, "m", radiusRange);
    setGrains({like}, maxFailed, lowestVelocity, highestVelocity);
    isBox = false;
    plan.place = [centre, radius](UniformRandom& random, double ofGrain) -> std::optional<Vec3D> {
        const double room = radius - ofGrain;
        if (!(room >= 0)) return std::nullopt;
        Vec3D way;  // even in the ball: points of the cube around it until one is in it
        do
            for (int axis = 0; axis < 3; ++axis) way[axis] = random.uniform(-1, 1);
        while (way.squaredNorm() > 1);
        return centre + room * way;
    };
    setBox(centre - Vec3D::Constant(radius), centre + Vec3D::Constant(radius));
}

void PolydisperseInsertionBoundary::setGeometry(unsigned maxFailed, const Vec3D& lowest, const Vec3D& highest,
                                                const Vec3D& lowestVelocity, const Vec3D& highestVelocity) {
    setGrains({}, maxFailed, lowestVelocity, highestVelocity);
    setBox(lowest, highest);
}

void PolydisperseInsertionBoundary::addGenerandum(const SphericalParticle* like, double share,
                                                  double spread) {
    checkValue(name, "spread", spread, "", {0, 1, true, false});
    const double radius = like->getRadius();
    checkValue(name, "radius of the grain", radius, "m", radiusRange);
    PSD radii;
    if (spread > 0) radii.setDistributionUniform(radius * (1 - spread), radius * (1 + spread));
    else radii = PSD(oneSize(radius));
    addSort(*like, radii, share);
}

}  // namespace pendular
