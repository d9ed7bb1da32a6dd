#include "Kernel/Features/LiquidTransport/Droplets.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Core/Walls/WallHandler.h"

namespace pendular {

namespace {

/// The share of the way at which |start + share way| becomes `reach`; 0 where it is less from the start on, 2
/// where it never does.
double shareAtReach(const Vector<double>& start, const Vector<double>& way, double reach) {
    const double c = dot(start, start) - reach * reach, b = dot(start, way), a = dot(way, way);
    if (c <= 0) return 0;
    const double root = b * b - a * c;
    if (b >= 0 || root < 0) return 2;
    return c / (std::sqrt(root) - b);  // the smaller root of a x^2 + 2 b x + c, without cancellation
}

/// m/s, how much faster than each other images are that follow each other, at most.
double speedOfImages(const PeriodicBox& box) {
    if (!box.imagesMove) return 0;
    const Vector<double> apart{box.strainRate.x * box.length.x, box.strainRate.y * box.length.y,
                               box.strainRate.z * box.length.z};
    return norm(box.imageVelocity) + norm(apart);
}

}  // namespace

Approach approachTo(const TranslationRecord& grain, const Sweep& sweep, const PeriodicBox& box) {
    if (!box.imagesMove) {
        const Vector<double> before = grain.position - sweep.time * grain.velocity;
        return {box.nearest(sweep.from - before), (sweep.to - sweep.from) - sweep.time * grain.velocity};
    }
    // Where images are is known at the end of the step.
    const Vector<double> apart = sweep.to - grain.position, end = box.nearest(apart);
    const Vector<double> imageVelocity = box.velocityBetweenImages(apart, end);
    const Vector<double> way = (sweep.to - sweep.from) - sweep.time * (grain.velocity + imageVelocity);
    return {end - way, way, imageVelocity};
}

void SweptSearch::update(const ParticleStore& grains, const PeriodicBox& box, std::size_t lists, double shift,
                         double smallestRadius) {
    stepShift = shift;
    moved += shift;
    if (cells && !box.imagesMove && lists == listsThen && grains.nextIdentity() == nextThen &&
        moved < 0.5 * smallestRadius)
        return;
    cells.emplace(grains.translation, 0, box);
    moved = 0;
    listsThen = lists;
    nextThen = grains.nextIdentity();
}

SweepHit SweptSearch::firstHit(const Sweep& sweep, const ParticleStore& grains, const PeriodicBox& box,
                               const WallHandler& walls) const {
    SweepHit hit;
    meetGrains(sweep, grains, box, hit);
    for (const auto& [number, wall] : walls.present()) meetWall(sweep, *wall, static_cast<int>(number), hit);
    return hit;
}

void SweptSearch::meetGrains(const Sweep& sweep, const ParticleStore& grains, const PeriodicBox& box,
                             SweepHit& hit) const {
    const Vector<double> middle = 0.5 * (sweep.from + sweep.to);
    const double half = 0.5 * norm(sweep.to - sweep.from);
    const double farther = moved + stepShift + sweep.time * speedOfImages(box);
    const std::size_t ownPlaces = grains.ownSize();  // ghosts are told of by their ranks
    cells->forEachNear(middle, half + sweep.radius, farther, [&](std::uint32_t place) {
        if (place >= ownPlaces || grains.isGap(place)) return;
        const TranslationRecord& grain = grains.translation[place];
        const Approach approach = approachTo(grain, sweep, box);
        const double share = shareAtReach(approach.start, approach.way, grain.radius + sweep.radius);
        if (share > 1 || share > hit.share) return;
        const bool isFirst = share < hit.share || hit.grain == SweepHit::none ||
                             grains.identity[place] < grains.identity[hit.grain];
        if (isFirst) hit = {share, place, -1};
    });
}

void SweptSearch::meetWall(const Sweep& sweep, const Wall& wall, int number, SweepHit& hit) {
    const Vector<double> way = sweep.to - sweep.from;
    const double length = norm(way), reach = length + sweep.radius * (1 + 1e-4);
    std::vector<std::uint32_t> parts;
    wall.listParts(sweep.from, reach, parts);
    if (parts.empty()) return;
    std::vector<WallPoint> points(parts.size());
    double share = 0;
    for (int k = 0; k < 1000 && share < hit.share && share <= 1; ++k) {
        wall.findPoints(sweep.from + share * way, reach, parts, points);
        double free = infinity;
        for (const WallPoint& point : points) free = std::min(free, point.distance - sweep.radius);
        if (free <= 1e-4 * sweep.radius) {
            hit = {share, SweepHit::none, number};
            return;
        }
        if (!(length > 0)) return;
        share += free / length;
    }
}

}  // namespace pendular
