#include "Kernel/Features/Outlets/Outlet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

void Outlet::setPlane(const Vec3D& direction, const Vec3D& point) {
    normal = checkedDirection("Outlet", "length of the normal", direction);
    offset = dot(normal, checkedVector("Outlet", "point", point, "m"));
    region = nullptr;
    hasPlane = true;
}

void Outlet::setLeastAge(double age) {
    checkValue("Outlet", "least age", age, "s", notNegative);
    leastAge = age;
}

void Outlet::setCondition(std::function<bool(const GrainReference&)> function) {
    if (!function)
        throw InputError("Outlet: the condition is an empty function; give one that can be called.");
    condition = std::move(function);
}

std::size_t OutletHandler::copyAndAddObject(const Outlet& outlet) {
    if (hasBegun) throw InputError("Simulation: outlets can only be added before the run begins.");
    if (!outlet.region && !outlet.hasPlane)
        throw InputError(
            fmt::format("outlet {}: its place is not set; call setRegion() or setPlane() before it is added.",
                        outlets.size()));
    outlets.push_back(outlet);
    return outlets.size() - 1;
}

void OutletHandler::begin(const PeriodicBox& atSetUp, const ParticleStore& grains, double time) {
    hasBegun = true;
    for (const Outlet& outlet : outlets) longestAge = std::max(longestAge, outlet.leastAge);
    arrivals = {{time, grains.nextIdentity()}};
    last = time;
    const std::array<double, 3> periods{atSetUp.length.x, atSetUp.length.y, atSetUp.length.z};
    for (std::size_t o = 0; o < outlets.size(); ++o) {
        Outlet& outlet = outlets[o];
        if (outlet.region) {
            outlet.region = outlet.region->in(atSetUp);
            outlet.inFlow = RegionInFlow(outlet.region, atSetUp);
            outlet.fromRegion = outlet.inFlow.boxNow(atSetUp);
            continue;
        }
        const std::array<double, 3> normal{outlet.normal.x, outlet.normal.y, outlet.normal.z};
        for (std::size_t k = 0; k < 3; ++k)
            if (periods[k] > 0 && normal[k] != 0)
                throw InputError(fmt::format(
                    "outlet {}: the normal of its plane has the part {:.6g} along {}, along which "
                    "the scene repeats itself; it must be across it, or take a region.",
                    o, normal[k], "xyz"[k]));
    }
}

const GrainTally& OutletHandler::countOf(std::size_t number) const {
    if (number >= outlets.size())
        throw InputError(
            fmt::format("There is no outlet {}; the scene has {} (counted from 0).", number, outlets.size()));
    return outlets[number].tally;
}

std::uint64_t OutletHandler::removedNumber() const {
    std::uint64_t sum = 0;
    for (const Outlet& outlet : outlets) sum += outlet.tally.all().number;
    return sum;
}

double OutletHandler::removedMass() const {
    double sum = 0;
    for (const Outlet& outlet : outlets) sum += outlet.tally.all().mass;
    return sum;
}

/// Grains that are new have come at the end of the step before, or after it.
void OutletHandler::noteArrivals(std::uint32_t next, double time) {
    if (next > arrivals.back().next) arrivals.push_back({last, next});
    last = time;
    // All but the last of those that every outlet takes for old enough.
    const auto young = firstYoung(longestAge, time);
    if (young - arrivals.begin() > 1) arrivals.erase(arrivals.begin(), young - 1);
}

std::vector<OutletHandler::Arrival>::const_iterator OutletHandler::firstYoung(double age, double time) const {
    // Times rise. They are sums of steps, up to round-off.
    return std::ranges::partition_point(
        arrivals, [&](const Arrival& arrival) { return time - arrival.time >= age * (1 - 1e-12); });
}

std::uint32_t OutletHandler::firstTooYoung(const Outlet& outlet, double time) const {
    if (outlet.leastAge == 0) return ~std::uint32_t{0};
    const auto young = firstYoung(outlet.leastAge, time);
    return young == arrivals.begin() ? 0 : (young - 1)->next;
}

void OutletHandler::follow(const PeriodicBox& periodic, double time) {
    if (!periodic.imagesMove) return;
    for (std::size_t o = 0; o < outlets.size(); ++o) {
        Outlet& outlet = outlets[o];
        if (!outlet.region) continue;
        outlet.inFlow.requireRoom(fmt::format("At time {:.6g} s outlet {}", time, o), periodic);
        outlet.fromRegion = outlet.inFlow.boxNow(periodic);
    }
}

std::vector<double> OutletHandler::letOut(ParticleHandler& particles, BodyHandler& bodies,
                                          ContactSystem& contacts, const PeriodicBox& periodic, double time,
                                          int threads) {
    follow(periodic, time);
    const ParticleStore& grains = ParticleHandler::Inside::grainsInStep(particles);
    if (longestAge > 0) noteArrivals(grains.nextIdentity(), time);
    std::vector<std::uint32_t> tooYoung;
    for (const Outlet& outlet : outlets) tooYoung.push_back(firstTooYoung(outlet, time));
    leaving.clear();
    findGrains(grains, tooYoung, threads);
    findBodies(grains, tooYoung);
    std::ranges::sort(leaving);
    std::vector<double> stored;
    if (contacts.ranks().areSeveral()) {
        stored = letOutOfRanks(particles, bodies, contacts);
    } else {
        for (const Leaving& one : leaving)
            if (const auto gone = measure(one, particles, bodies)) remove(*gone, particles, bodies);
    }
    for (Outlet& outlet : outlets) outlet.tally.endStep();
    return stored;
}

std::vector<double> OutletHandler::letOutOfRanks(ParticleHandler& particles, BodyHandler& bodies,
                                                 ContactSystem& contacts) {
    std::vector<Gone> own;
    for (const Leaving& one : leaving) {
        if (!own.empty() && own.back().identity == one.identity) continue;  // it goes through an earlier one
        if (const auto gone = measure(one, particles, bodies)) own.push_back(*gone);
    }
    std::vector<Gone> all = contacts.ranks().gather(own);
    if (all.empty()) return {};
    std::ranges::sort(all, {}, &Gone::identity);
    particles.finishStep();
    std::uint32_t number = 0;
    for (const Gone& gone : all) {
        contacts.beginRemoval(number++);
        if (particles.contains(gone.identity)) {
            remove(gone, particles, bodies);
        } else {
            contacts.removeGhost(particles.store(), gone.identity, gone.body);
            count(gone);
        }
    }
    return contacts.finishRemovals(particles.store());
}

/// Whether eight grains, one behind the other, are all on the near side of a plane.
static bool areWithinOutletPlane(const Vector<double>& normal, double offset,
                                 const TranslationRecord* grains) {
    static constexpr std::array<std::uint32_t, Pack::lanes> each{0, 1, 2, 3, 4, 5, 6, 7};
    auto [x, y, z, radius] = loadRecords<4>(reinterpret_cast<const double*>(grains), 8, each.data());
    return none(dot(Vector<Pack>{Pack(normal.x), Pack(normal.y), Pack(normal.z)}, Vector<Pack>{x, y, z}) >
                Pack(offset));
}

void OutletHandler::findGrains(const ParticleStore& grains, std::span<const std::uint32_t> tooYoung,
                               int threads) {
    // Divided as at the end of a step: a thread then finds its own grains in the cache of its core.
    constexpr std::size_t worthAThread = 2048;
    found.resize(static_cast<std::size_t>(threads));
    for (auto& own : found) own.clear();
    inParts(
        grains.ownSize(), threads,
        [&](int part, std::size_t begin, std::size_t end) {
            const auto look = [&](std::size_t k) {
                for (std::uint32_t o = 0; o < outlets.size(); ++o) {
                    const TranslationRecord& grain = grains.translation[k];
                    // The place first: it lets nearly all stay, and what else is asked lies in other columns.
                    if (!outlets[o].takes(grain.position)) continue;
                    if (grain.radius == 0 || grain.inverseMass == 0 || grains.identity[k] >= tooYoung[o])
                        continue;
                    if (grains.bodies.contains(grains.identity[k])) break;
                    found[static_cast<std::size_t>(part)].push_back({grains.identity[k], o});
                    if (!outlets[o].condition) break;
                }
            };
            for (std::size_t k = begin; k < end; k += Pack::lanes) {
                const std::size_t last = std::min<std::size_t>(k + Pack::lanes, end);
                const auto takesNone = [&](const Outlet& outlet) {
                    return !outlet.region &&
                           areWithinOutletPlane(outlet.normal, outlet.offset, &grains.translation[k]);
                };
                if (last - k == Pack::lanes && std::ranges::all_of(outlets, takesNone)) continue;
                for (std::size_t at = k; at < last; ++at) look(at);
            }
        },
        worthAThread);
    for (const auto& own : found) leaving.insert(leaving.end(), own.begin(), own.end());
}

void OutletHandler::findBodies(const ParticleStore& grains, std::span<const std::uint32_t> tooYoung) {
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        if (grains.bodies.isHeld(k)) continue;
        const std::span<const BodyMember> members = grains.bodies.membersOf(k);
        const std::uint32_t youngest = std::ranges::max(members, {}, &BodyMember::grain).grain;
        for (std::uint32_t o = 0; o < outlets.size(); ++o) {
            if (youngest >= tooYoung[o] || !outlets[o].takes(grains.bodies[k].position)) continue;
            leaving.push_back({members.front().grain, o, grains.bodies.numberOf(k)});
            if (!outlets[o].condition) break;
        }
    }
}

std::optional<OutletHandler::Gone> OutletHandler::measure(const Leaving& one, ParticleHandler& particles,
                                                          BodyHandler& bodies) const {
    if (!particles.contains(one.identity)) return {};  // it has gone through an earlier one
    const Outlet& outlet = outlets[one.outlet];
    const GrainReference grain = particles.getObject(one.identity);
    if (outlet.condition && !outlet.condition(grain)) return {};
    Gone gone{one.identity, one.outlet, one.body, grain.getSpeciesIndex(), grain.getRadius(), 0};
    if (one.body == RigidBodies::none) {
        gone.mass = particles.massOf(gone.radius, gone.species);
    } else {
        gone.radius = std::cbrt(bodies.getObject(one.body).getVolume() / (4 * std::numbers::pi / 3));
        gone.mass = particles.store().bodies.dryMassOf(particles.store().bodies.find(one.body));
    }
    return gone;
}

void OutletHandler::remove(const Gone& one, ParticleHandler& particles, BodyHandler& bodies) {
    if (one.body == RigidBodies::none) particles.removeObject(one.identity);
    else bodies.removeObject(one.body);
    count(one);
}

void OutletHandler::count(const Gone& one) {
    outlets[one.outlet].tally.add(static_cast<std::size_t>(one.species), one.radius, one.mass);
}

void OutletHandler::visitArrivals(StateArchive& archive) {
    std::vector<double> times;
    std::vector<std::uint32_t> nexts;
    for (const Arrival& arrival : arrivals) times.push_back(arrival.time), nexts.push_back(arrival.next);
    archive.column<double>("times", times);
    archive.column<std::uint32_t>("nexts", nexts);
    archive.finite("last", last);
    archive.requireFinite("times", times);
    archive.require(times.size() == nexts.size() && !times.empty() && std::ranges::is_sorted(times) &&
                        std::ranges::is_sorted(nexts),
                    "times", "does not rise with the grains");
    arrivals.clear();
    for (std::size_t k = 0; k < times.size(); ++k) arrivals.push_back({times[k], nexts[k]});
}

void OutletHandler::compareSetUp(StateArchive& archive) const {
    archive.same("count", outlets.size());
    for (std::size_t k = 0; k < outlets.size(); ++k)
        archive.group(std::to_string(k), [&] {
            const Outlet& outlet = outlets[k];
            if (outlet.region) {
                archive.group("region", [&] { outlet.region->visitState(archive); });
            } else {
                archive.sameRecord<double>("normal", outlet.normal);
                archive.same("offset", outlet.offset, "m");
            }
            archive.same("leastAge", outlet.leastAge, "s");
            archive.same("hasCondition", static_cast<bool>(outlet.condition), {},
                         "a restart file cannot keep the function of setCondition(), so set it as it was");
            outlet.tally.compareSetUp(archive);
        });
}

void OutletHandler::visitState(StateArchive& archive) {
    for (std::size_t k = 0; k < outlets.size(); ++k)
        archive.group(std::to_string(k), [&] { outlets[k].tally.visitState(archive); });
    if (longestAge > 0) archive.group("arrivals", [&] { visitArrivals(archive); });
}

}  // namespace pendular
