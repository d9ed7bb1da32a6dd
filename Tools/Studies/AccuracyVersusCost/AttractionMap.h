#pragma once

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/AccuracyVersusCost/DampedCollisions.h"

// A map of when the normal force of a damped contact pulls, how strongly, and what it means for the
// restitution.

namespace pendular {

/// A dashpot beside what a plastic contact loses, e = 0.5: that with which its spring of loading alone would
/// rebound with the restitution of the loss.
template <class Function>
void forEachContactWithDashpot(const Loss& loss, Function&& function) {
    forEachDampedCollision(loss, function);
    auto linear = collisions::linearPlasticWith({0.5});
    linear.species.setDissipation(collisions::dashpot(loss, collisions::springConstant,
                                                      collisions::reducedMass(linear.encounter.radius)));
    linear.contactTime *= 2;  // of the spring of loading
    function(linear);
    auto hertzian = collisions::hertzianPlasticWith({0.5});
    hertzian.species.setDissipation(std::sqrt(5.0) * collisions::dampingOverCritical(loss));
    hertzian.contactTime = collisions::hertzianTime(hertzian.encounter);
    function(hertzian);
}

/// The numbers of one collision in the map.
struct Attraction {
    SeenCollision seen;
    double begin = 0;           // s, when the force turns
    double speedAtBegin = 0;    // m/s, of parting
    double push = 0, pull = 0;  // N, the largest ones
    std::vector<CollisionMoment> moments;
};

template <class S>
Attraction findAttraction(const CollisionCase<S>& studied) {
    constexpr int steps = 1000;  // for the elastic contact time
    const double step = studied.contactTime / steps;
    Encounter encounter = studied.encounter;
    encounter.gap = 2.5 * step * encounter.speed;
    StudiedCollision<S> collision(studied.species, encounter, step, integrators::predictedVelocityVerlet);
    Attraction found;
    found.seen =
        watchCollision(collision, encounter, 5 * studied.contactTime, [&](const CollisionMoment& now) {
            if (now.force < 0 && found.begin == 0) {
                const CollisionMoment& last = found.moments.back();
                const double share = last.force / (last.force - now.force);
                found.begin = last.time + share * (now.time - last.time);
                found.speedAtBegin = last.parting + share * (now.parting - last.parting);
            }
            found.push = std::max(found.push, now.force);
            found.pull = std::max(found.pull, -now.force);
            found.moments.push_back(now);
        });
    return found;
}

/// Two tables: the force over time, and for each collision its pull.
inline void mapAttraction(const std::filesystem::path& forces, const std::filesystem::path& pulls) {
    CsvFile course(forces,
                   "law,dashpot_restitution,dashpot_over_critical,time_over_elastic_contact_time,"
                   "overlap_over_largest,force_over_largest");
    CsvFile summary(pulls,
                    "law,dashpot_restitution,dashpot_over_critical,pull_begins_over_elastic_contact_time,"
                    "contact_time_over_elastic,largest_pull_over_largest_push,restitution,"
                    "restitution_without_pull,parted");
    for (const Loss& loss : losses)
        forEachContactWithDashpot(loss, [&](const auto& studied) {
            const Attraction found = findAttraction(studied);
            const std::string damping =
                loss.restitution > 0 ? "" : fmt::format("{}", loss.dampingOverCritical);
            const std::string which = fmt::format("{},{},{}", studied.name, loss.restitution, damping);
            const double longest = 2.5 * studied.contactTime;
            for (std::size_t k = 19; k < found.moments.size() && found.moments[k].time < longest; k += 40) {
                const CollisionMoment& now = found.moments[k];
                course.line(fmt::format("{},{:.4g},{:.3g},{:.3g}", which, now.time / studied.contactTime,
                                        now.overlap / found.seen.largestOverlap, now.force / found.push));
            }
            const double without =
                found.begin > 0 ? found.speedAtBegin / studied.encounter.speed : found.seen.restitution;
            summary.line(fmt::format(
                "{},{},{},{:.4g},{:.6g},{:.6g},{}", which,
                found.begin > 0 ? fmt::format("{:.5g}", found.begin / studied.contactTime) : "",
                found.seen.parted ? fmt::format("{:.5g}", found.seen.contactTime / studied.contactTime) : "",
                found.pull / found.push, found.seen.restitution, without, found.seen.parted ? 1 : 0));
        });
    course.close();
    summary.close();
}

}  // namespace pendular
