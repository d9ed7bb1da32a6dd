#include "Kernel/Features/LiquidTransport/SprayHandler.h"

#include <fmt/format.h>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Features/LiquidTransport/ContactLiquid.h"
#include "Kernel/Features/LiquidTransport/GrainFilms.h"
#include "Kernel/Features/LiquidTransport/LiquidLedger.h"
#include "Kernel/Features/RigidBodies/MovingBodies.h"
#include "Kernel/Features/ShearAndStrain/HomogeneousStrain.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

namespace {

constexpr double leastQuanta = 1024;  // of a droplet: its volume is then right to 0.05 %

/// m/s, that of the flow at a place a time (s) before the end of a step.
Vector<double> flowBefore(const PeriodicBox& end, const Vector<double>& place, double time) {
    PeriodicBox box = end;
    HomogeneousStrain::move(box, -time);
    const auto widen = [time](double& across, double rate) { across /= 1 - time * rate; };
    widen(box.across.x, end.strainRate.x);
    widen(box.across.y, end.strainRate.y);
    widen(box.across.z, end.strainRate.z);
    return box.flowAt(place);
}

InputError noSprayError(std::size_t number, std::size_t count) {
    return InputError(fmt::format("There is no spray {}; the scene has {} (counted from 0).", number, count));
}

}  // namespace

std::size_t SprayHandler::copyAndAddObject(const Spray& spray) {
    if (isClosed) throw InputError("Simulation: sprays can only be added before the run begins.");
    spray.check(sprays.size());
    sprays.push_back(spray);
    counts.push_back(0);
    return sprays.size() - 1;
}

const Spray& SprayHandler::getObject(std::size_t number) const {
    if (number >= sprays.size()) throw noSprayError(number, sprays.size());
    return sprays[number];
}

std::uint64_t SprayHandler::countOf(std::size_t number) const {
    if (number >= sprays.size()) throw noSprayError(number, sprays.size());
    return counts[number];
}

double SprayHandler::volumeBy(double time) const {
    double all = 0;
    for (const Spray& spray : sprays) all += spray.volumeBy(time);
    return all;
}

void SprayHandler::begin(double quantum) {
    unit = quantum;
    for (std::size_t k = 0; k < sprays.size(); ++k) {
        const double least = (2 - sprays[k].largestShare()) * sprays[k].dropletVolume();
        if (least < leastQuanta * quantum)
            throw InputError(fmt::format(
                "spray {}: its droplets, of {:.6g} m^3 and more, are less than 1024 quanta of {:.6g} m^3, in "
                "which all liquid of the run can be counted; take larger droplets, a smaller flow, or a "
                "shorter run (setTimes() of the spray, setTimeMax(), setLiquidToCome()).",
                k, least, quantum));
    }
}

double SprayHandler::wholeVolume(double radius) const {
    return std::nearbyint(sphereMass(radius, 1) / unit) * unit;
}

void SprayHandler::emit(GrainFilms& films, const PeriodicBox& periodic, double time) {
    newOnes = 0;
    for (std::size_t s = 0; s < sprays.size(); ++s) {
        const std::uint64_t count = std::max(sprays[s].countAt(time), counts[s]);
        if (count - counts[s] > mostDroplets - std::min(inFlight.size(), mostDroplets))
            throw InputError(fmt::format(
                "spray {}: {} droplets come out in a step and {} are in flight; there can be {}, so give it "
                "larger droplets, a smaller flow, or a shorter setLongestFlight().",
                s, count - counts[s], inFlight.size(), mostDroplets));
        for (; counts[s] < count; ++counts[s], ++newOnes) {
            const NewDroplet made = sprays[s].droplet(counts[s], s);
            const double volume = wholeVolume(made.radius);
            films.emit(volume);
            // Time before the step's end, which the flight is for.
            const Vector<double> velocity =
                periodic.imagesMove ? made.velocity + periodic.flowAt(made.position) : made.velocity;
            inFlight.push_back({made.position, velocity, made.radius, volume, sprays[s].timeOf(counts[s]),
                                static_cast<double>(s)});
        }
    }
}

void SprayHandler::advance(const SprayStep& step) {
    caughtInStep.clear();
    if (inFlight.empty()) return;
    fly(step);
    search.update(step.grains, step.periodic, step.contacts.rebuildCount(), step.grainShift,
                  step.smallestRadius);
    inParts(
        flights.size(), step.threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k)
                flights[k].hit = search.firstHit(flights[k].sweep, step.grains, step.periodic, step.walls);
        },
        64);
    joinHits(step);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < inFlight.size(); ++k)
        if (finish(step, inFlight[k], flights[k])) inFlight[kept++] = inFlight[k];
    inFlight.resize(kept);
}

void SprayHandler::joinHits(const SprayStep& step) {
    struct Met {
        std::uint32_t flight, particle;
        double share;  // of the way
    };
    std::vector<Met> own;
    for (std::uint32_t k = 0; k < flights.size(); ++k)
        if (const SweepHit& hit = flights[k].hit; hit.grain != SweepHit::none) {
            flights[k].particle = step.grains.identity[hit.grain];
            own.push_back({k, flights[k].particle, hit.share});
        }
    if (!step.contacts.ranks().areSeveral()) return;
    for (const Met& met : step.contacts.ranks().gather(own)) {
        Flight& flight = flights[met.flight];
        if (met.share > flight.hit.share) continue;
        // `none` is the largest number: a wall comes after grains
        if (met.share == flight.hit.share && met.particle >= flight.particle) continue;
        flight.hit = {met.share, SweepHit::none, -1};
        flight.particle = met.particle;
    }
}

/// x + v t + g t^2 / 2, exact for any step; a droplet that has just come out flies for a part of it.
void SprayHandler::fly(const SprayStep& step) {
    flights.clear();
    const std::size_t old = inFlight.size() - newOnes;
    for (std::size_t k = 0; k < inFlight.size(); ++k) {
        Droplet& droplet = inFlight[k];
        const double time =
            k < old ? step.length : std::clamp(step.time - std::exchange(droplet.flown, 0), 0.0, step.length);
        if (step.periodic.imagesMove) {
            const Vector<double> flow = k < old ? step.imagesNow.flowAt(droplet.position)
                                                : flowBefore(step.periodic, droplet.position, time);
            droplet.velocity += flow - step.imagesBefore.flowAt(droplet.position);
        }
        const Vector<double> from =
            step.periodic.imagesMove ? droplet.position : step.periodic.wrap(droplet.position);
        const Vector<double> way = time * droplet.velocity + (0.5 * time * time) * step.gravity;
        flights.push_back({{from, from + way, droplet.radius, time}, droplet.velocity, {}});
        droplet.position = from + way;
        droplet.velocity += time * step.gravity;
        droplet.flown += time;
        dry(step, droplet, time);
    }
    newOnes = 0;
}

void SprayHandler::dry(const SprayStep& step, Droplet& droplet, double time) {
    const Evaporation& law = step.contacts.movingLiquid().evaporation();
    if (!law.dropletsEvaporate() || step.time <= law.startTime()) return;
    droplet.radius = law.radiusLeftAfter(droplet.radius, time);
    const double left = std::min(wholeVolume(droplet.radius), droplet.volume);
    if (step.contacts.ranks().isFirst()) step.contacts.movingLiquid().addEvaporated(droplet.volume - left);
    droplet.volume = left;
}

bool SprayHandler::finish(const SprayStep& step, Droplet& droplet, const Flight& flight) {
    if (droplet.volume == 0) return false;  // it has dried
    const auto spray = static_cast<std::size_t>(droplet.spray);
    const SweepHit& hit = flight.hit;
    if (!hit.isHit() && droplet.flown < sprays[spray].longestFlight()) {
        if (step.periodic.imagesMove) {
            droplet.velocity += step.periodic.velocityOfWrap(droplet.position);
            droplet.position = step.periodic.wrap(droplet.position);
        }
        return true;
    }
    const Vector<double> way = flight.sweep.to - flight.sweep.from;
    CaughtDroplet end{spray, CaughtDroplet::none, hit.wall,
                      flight.sweep.from + std::min(hit.share, 1.0) * way, droplet.volume};
    if (flight.particle != CaughtDroplet::none) {
        end.particle = flight.particle;
        if (step.grains.place.contains(flight.particle)) hitGrain(step, droplet, flight);
    } else if (hit.wall < 0 || !step.contacts.movingLiquid().giveToWall(
                                   step.contacts.laws(), static_cast<std::size_t>(hit.wall),
                                   step.contacts.ranks().isFirst() ? droplet.volume : 0)) {
        lost += droplet.volume;
    }
    caughtInStep.push_back(end);
    return false;
}

void SprayHandler::hitGrain(const SprayStep& step, const Droplet& droplet, const Flight& flight) {
    const std::uint32_t place = step.grains.place[flight.particle];
    step.films.wet(step.grains, place, droplet.volume);
    const double density = sprays[static_cast<std::size_t>(droplet.spray)].liquidDensity();
    if (density == 0) return;
    const double share = flight.hit.share;
    Vector<double> at = flight.sweep.from + share * (flight.sweep.to - flight.sweep.from);
    Vector<double> velocity = flight.velocity + (share * flight.sweep.time) * step.gravity;
    if (step.periodic.imagesMove) {  // of its image that the grain meets
        const TranslationRecord& grain = step.grains.translation[place];
        const Approach approach = approachTo(grain, flight.sweep, step.periodic);
        at = grain.position + approach.start + share * approach.way;
        velocity -= approach.imageVelocity;
    }
    catchMomentum(step.grains, place, step.periodic, density * droplet.volume, at, velocity);
}

void SprayHandler::addTo(LiquidLedger& ledger) const {
    for (const Droplet& droplet : inFlight) ledger.airborne += droplet.volume;
    ledger.lost = lost;
}

void SprayHandler::compareSetUp(StateArchive& archive) const {
    archive.same("count", sprays.size());
    for (std::size_t k = 0; k < sprays.size(); ++k)
        archive.group(std::to_string(k), [&] { sprays[k].compareSetUp(archive); });
}

void SprayHandler::visitState(StateArchive& archive, const GrainFilms& films) {
    unit = films.quantum();
    std::size_t had = counts.size();
    archive.column<std::uint64_t>("emitted", counts);
    archive.require(counts.size() == had, "emitted", "has not one number for each spray");
    archive.finite("lost", lost);
    archive.column<double>("droplets", inFlight);
    archive.requireFinite("droplets", inFlight);
    archive.require(films.isWhole(lost), "lost", "is no multiple of the quantum");
    for (const Droplet& droplet : inFlight)
        archive.require(films.isWhole(droplet.volume) && droplet.radius > 0 && droplet.flown >= 0 &&
                            droplet.spray >= 0 && droplet.spray < static_cast<double>(sprays.size()) &&
                            droplet.spray == std::floor(droplet.spray),
                        "droplets", "has a droplet that cannot be");
}

}  // namespace pendular
