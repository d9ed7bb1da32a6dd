#include "Kernel/Mercury/MercuryInsertion.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "Kernel/Features/Insertion/SphereGrid.h"
#include "Kernel/Features/Insertion/WallGap.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

bool hasRoomFor(const Scene& scene, const SphericalParticle& grain) {
    checkValue("SphericalParticle", "radius", grain.getRadius(), "m", radiusRange);
    const Vector<double> at = toVector(grain.getPosition());
    const SphereGrid grid(scene.particleHandler.store(), scene.getPeriodicBox(), Box{at, at},
                          grain.getRadius());
    return grid.isFree(at, grain.getRadius()) &&
           !touchesWall(scene.wallHandler, scene.getPeriodicBox(), at, grain.getRadius());
}

double GrainSource::largestRadius() const {
    double largest = 0;  // m
    for (const Sort& sort : sorts) largest = std::max(largest, 0.5 * sort.sizes.largest());
    return largest;
}

/// A whole grain is in the box, but along axes along which it has no room for one: there its centre is.
Vec3D GrainSource::placeInBox(double radius) {
    Vec3D at;
    for (int axis = 0; axis < 3; ++axis) {
        const double margin = highest[axis] - lowest[axis] >= 2 * radius ? radius : 0;
        at[axis] = random.uniform(lowest[axis] + margin, highest[axis] - margin);
    }
    return at;
}

void GrainSource::drawNext() {
    double all = 0, drawn = 0;
    for (const Sort& sort : sorts) all += sort.share;
    if (sorts.size() > 1) drawn = random.uniform(0, all);
    nextSort = 0;
    while (nextSort + 1 < sorts.size() && drawn >= sorts[nextSort].share) drawn -= sorts[nextSort++].share;
    nextRadius = 0.5 * sorts[nextSort].sizes.quantile(SizeBasis::Number, random.uniform(0, 1));
}

void GrainSource::add(ParticleHandler& particles, const Vec3D& at) {
    SphericalParticle grain = sorts[nextSort].like;
    grain.setRadius(nextRadius);
    grain.setPosition(at);
    Vec3D velocity;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = lowVelocity[axis], high = highVelocity[axis];
        velocity[axis] = low == high ? low : random.uniform(low, high);
    }
    grain.setVelocity(velocity);
    particles.copyAndAddObject(grain);
    ++number;
    volume += sphereMass(nextRadius, 1);
    mass += particles.massOf(nextRadius, grain.getSpeciesIndex());
    nextRadius = unset;
}

void GrainSource::letIn(ParticleHandler& particles, const WallHandler& walls, const PeriodicBox& box,
                        double time) {
    const bool isLimited = atOnce > 0 || flow > 0;
    const double due = atOnce + flow * time;  // m^3
    std::optional<SphereGrid> grid;
    for (unsigned failed = 0; failed <= maxFailed;) {
        if (!isSet(nextRadius)) drawNext();
        // Round-off of the sum must not keep the last one out.
        if (isLimited && volume + sphereMass(nextRadius, 1) > due * (1 + 1e-12)) return;
        if (!grid)
            grid.emplace(particles.store(), box, Box{toVector(lowest), toVector(highest)}, largestRadius());
        const std::optional<Vec3D> at = place ? place(random, nextRadius) : placeInBox(nextRadius);
        const bool isFree = at && grid->isFree(toVector(*at), nextRadius) &&
                            !touchesWall(walls, box, toVector(*at), nextRadius);
        if (!isFree) {
            ++failed;
            continue;
        }
        grid->add(toVector(*at), nextRadius);
        add(particles, *at);
    }
}

void GrainSource::visitState(StateArchive& archive) {
    random.visitState(archive);
    archive.value("number", number);
    archive.finite("mass", mass);
    archive.finite("volume", volume);
    archive.value("nextSort", nextSort);
    archive.value("nextRadius", nextRadius);
    archive.require(nextSort < std::max<std::size_t>(1, sorts.size()), "nextSort",
                    "is no sort of the source");
}

GrainSource* MercuryInsertions::add(GrainSource source) {
    if (hasBegun && sources.empty())
        throw InputError(
            "An insertion boundary is added in a run that began without any; add it at set-up, or add grains "
            "in a "
            "hook.");
    source.random = UniformRandom(1 + sources.size());
    return running.emplace_back(&sources.emplace_back(Kept{std::move(source)}).source);
}

void MercuryInsertions::stop(const GrainSource* source) {
    for (Kept& kept : sources)
        if (&kept.source == source) kept.isStopped = true;
    std::erase(running, source);
}

void MercuryInsertions::atEnd(StepContext& step) {
    for (GrainSource* const source : running)
        source->letIn(step.particles, step.walls, step.box, step.timeAfter);
}

void GrainSource::compareSetUp(StateArchive& archive) const {
    archive.same("sorts", static_cast<std::uint64_t>(sorts.size()));
    for (std::size_t k = 0; k < sorts.size(); ++k)
        archive.group(fmt::format("sort {}", k), [&, &sort = sorts[k]] {
            archive.same("share", sort.share);
            BodyKind{sort.like, sort.sizes, sort.share}.compareSetUp(archive);
        });
    archive.same("maxFailed", maxFailed);
    const auto compare = [&](std::string_view name, const Vec3D& v, std::string_view unit) {
        archive.sameRecord<double>(name, toVector(v), unit);
    };
    compare("lowest", lowest, "m"), compare("highest", highest, "m");
    compare("lowestVelocity", lowVelocity, "m/s"), compare("highestVelocity", highVelocity, "m/s");
    archive.same("volumeAtOnce", atOnce, "m^3");
    archive.same("volumeFlow", flow, "m^3/s");
    archive.same("hasOwnPlaces", static_cast<bool>(place));
}

void MercuryInsertions::compareSetUp(StateArchive& archive, StepContext& /*scene*/) {
    archive.same("count", static_cast<std::uint64_t>(sources.size()));
    std::size_t number = 0;
    for (const Kept& kept : sources)
        archive.group(fmt::format("source {}", number++), [&] { kept.source.compareSetUp(archive); });
}

void MercuryInsertions::visitState(StateArchive& archive, StepContext& /*scene*/) {
    std::size_t number = 0;
    for (Kept& kept : sources)
        archive.group(fmt::format("source {}", number++), [&] {
            kept.source.visitState(archive);
            archive.value("isStopped", kept.isStopped);
        });
    running.clear();
    for (Kept& kept : sources)
        if (!kept.isStopped) running.push_back(&kept.source);
}

}  // namespace pendular
