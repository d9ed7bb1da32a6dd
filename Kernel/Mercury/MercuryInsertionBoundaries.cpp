#include "Kernel/Mercury/MercuryInsertionBoundaries.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "Kernel/Foundation/Base/InputError.h"

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

void RoundInsertionBoundary::setRegion(const Vec3D& lowest, const Vec3D& highest, BoxOf boxOf,
                                       Contains contains) {
    low = lowest, high = highest, isBoxOf = boxOf, isIn = std::move(contains);
    isBox = false;
    place();
}

void RoundInsertionBoundary::shiftBoundary(const Vec3D& shift) {
    requireChangeable("shiftBoundary()");
    origin += shift;
    if (isIn) place();
}

void RoundInsertionBoundary::turn(const Eigen::Matrix3d& by) {
    rotation = by * rotation;
    if (isIn) place();
}

void RoundInsertionBoundary::checkRange(const char* what, double lowest, double highest,
                                        const char* unit) const {
    checkValue(name, fmt::format("lowest of the {}", what), lowest, unit, anyFinite);
    checkValue(name, fmt::format("highest of the {}", what), highest, unit, {lowest, infinity, false, false});
}

/// Even in the region: points of the box around it until one is in it, or a thousand are not. In a box of
/// whole grains centres keep a radius from its faces.
void RoundInsertionBoundary::place() {
    constexpr int mostTries = 1000;
    const double share = isBoxOf == BoxOf::WholeGrains ? 1 : 0;
    plan.place = [=, contains = isIn, turn = rotation, from = origin, low = low, high = high](
                     UniformRandom& random, double radius) -> std::optional<Vec3D> {
        const Vec3D lowest = low + Vec3D::Constant(share * radius),
                    highest = high - Vec3D::Constant(share * radius);
        if (!(lowest.array() <= highest.array()).all()) return std::nullopt;
        for (int k = 0; k < mostTries; ++k) {
            Vec3D point;
            for (int axis = 0; axis < 3; ++axis) point[axis] = random.uniform(lowest[axis], highest[axis]);
            if (contains(point, radius)) return turn * point + from;
        }
        return std::nullopt;
    };
    const double reach = low.cwiseAbs().cwiseMax(high.cwiseAbs()).norm();
    setBox(origin - Vec3D::Constant(reach), origin + Vec3D::Constant(reach));
}

/// rad, around z from x on: from 0 to 2 pi.
static double thetaOf(const Vec3D& point) {
    const double angle = std::atan2(point.y(), point.x());
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

void SphereInsertionBoundary::set(const SphericalParticle* like, unsigned maxFailed, const Vec3D& centre,
                                  double radius, const Vec3D& lowestVelocity, const Vec3D& highestVelocity) {
    checkValue(name, "radius", radius, "m", radiusRange);
    setGrains({like}, maxFailed, lowestVelocity, highestVelocity);
    shiftBoundary(centre - getOrigin());
    setRegion(Vec3D::Constant(-radius), Vec3D::Constant(radius), BoxOf::WholeGrains,
              [radius](const Vec3D& point, double ofGrain) { return point.norm() <= radius - ofGrain; });
}

void SphereInsertionBoundary::set(const SphericalParticle* like, unsigned maxFailed, double lowestRadius,
                                  double highestRadius, double lowestTheta, double highestTheta,
                                  double lowestPhi, double highestPhi, const Vec3D& lowestVelocity,
                                  const Vec3D& highestVelocity) {
    checkRange("radii", lowestRadius, highestRadius, "m");
    checkRange("angles theta", lowestTheta, highestTheta, "rad");
    checkRange("angles phi", lowestPhi, highestPhi, "rad");
    setGrains({like}, maxFailed, lowestVelocity, highestVelocity);
    setRegion(Vec3D::Constant(-highestRadius), Vec3D::Constant(highestRadius), BoxOf::Centres,
              [=](const Vec3D& point, double) {
                  const double r = point.norm(), theta = thetaOf(point),
                               phi = std::atan2(std::hypot(point.x(), point.y()), point.z());
                  return r >= lowestRadius && r <= highestRadius && theta >= lowestTheta &&
                         theta <= highestTheta && phi >= lowestPhi && phi <= highestPhi;
              });
}

void CylinderInsertionBoundary::set(const SphericalParticle* like, unsigned maxFailed, double lowestRadius,
                                    double highestRadius, double lowestHeight, double highestHeight,
                                    const Vec3D& axis, double lowestTheta, double highestTheta,
                                    const Vec3D& lowestVelocity, const Vec3D& highestVelocity) {
    checkRange("radii", lowestRadius, highestRadius, "m");
    checkRange("heights", lowestHeight, highestHeight, "m");
    checkRange("angles theta", lowestTheta, highestTheta, "rad");
    const bool isAlongX = axis == Vec3D::UnitX(), isAlongY = axis == Vec3D::UnitY();
    if (!isAlongX && !isAlongY && axis != Vec3D::UnitZ())
        throw InputError(fmt::format(
            "{}: axis = ({}, {}, {}); it must be (1, 0, 0), (0, 1, 0) or (0, 0, 1); rotateBoundary() turns "
            "it further.",
            name, axis.x(), axis.y(), axis.z()));
    setGrains({like}, maxFailed, lowestVelocity, highestVelocity);
    const double quarter = 0.5 * std::numbers::pi;
    const Vec3D about = isAlongX ? Vec3D::UnitY() : Vec3D::UnitX();
    setRotation(Eigen::AngleAxisd(isAlongX || isAlongY ? quarter : 0, about).toRotationMatrix());
    setRegion({-highestRadius, -highestRadius, lowestHeight}, {highestRadius, highestRadius, highestHeight},
              BoxOf::Centres, [=](const Vec3D& point, double) {
                  const double r = std::hypot(point.x(), point.y()), theta = thetaOf(point);
                  return r >= lowestRadius && r <= highestRadius && theta >= lowestTheta &&
                         theta <= highestTheta;
              });
}

void CylinderInsertionBoundary::rotateBoundary(const Vec3D& angles) {
    requireChangeable("rotateBoundary()");
    for (int axis = 0; axis < 3; ++axis)
        turn(Eigen::AngleAxisd(angles[axis], Vec3D::Unit(axis)).toRotationMatrix());
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
