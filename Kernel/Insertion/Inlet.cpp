#include "Kernel/Insertion/Inlet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Base/InputError.h"
#include "Kernel/Insertion/SphereGrid.h"
#include "Kernel/Insertion/WallGap.h"
#include "Kernel/Math/ApartTexts.h"
#include "Kernel/Particles/ParticleHandlerInside.h"
#include "Kernel/State/StateArchive.h"
#include "Kernel/Walls/WallHandler.h"

namespace pendular {

namespace {

constexpr std::string_view owner = "Inlet";
/// The purpose of the random numbers of places; three for each inlet.
constexpr std::uint32_t purposeOfPlaces = 0x1258000;

/// kg/m^3
double densityOf(const ParticleHandler& particles, const SphericalParticle& grain) {
    return particles.massOf(1, grain.getSpeciesIndex()) / sphereMass(1, 1);
}
/// kg, of one grain
double meanMass(const SizeDistribution& sizes, double density) {
    return density * std::numbers::pi / 6 * sizes.moment(3);
}

}  // namespace

void Inlet::setMassFlow(double rate) {
    checkValue(owner, "mass flow", rate, "kg/s", positive);
    massFlow = rate;
    numberFlow = unset;
}
void Inlet::setNumberFlow(double rate) {
    checkValue(owner, "number flow", rate, "1/s", positive);
    numberFlow = rate;
    massFlow = unset;
}
void Inlet::setTimes(double begin, double end) {
    checkValue(owner, "first time", begin, "s", notNegative);
    checkValue(owner, "last time", end, "s", {begin, infinity, true, false});
    first = begin;
    last = end;
}
void Inlet::setTries(std::uint32_t number) {
    checkValue(owner, "number of tries", number, "", {1, 1e9});
    tries = number;
}

void Inlet::setFollowsWall(std::size_t number) { wall = number; }
void Inlet::setFollowsFill(const Vec3D& direction, double step, double most) {
    const Vector<double> unit = checkedDirection(owner, "length of the direction of the fill", direction);
    checkValue(owner, "step after the fill", step, "m", positive);
    // All steps may be tried in one time step.
    checkValue(owner, "way after the fill", most, "m", {step, 1e4 * step});
    rise = step * unit;
    mostRises = static_cast<std::uint32_t>(most / step * (1 + 1e-12));
}

std::size_t InletHandler::copyAndAddObject(const Inlet& inlet) {
    if (hasBegun) throw InputError("Simulation: inlets can only be added before the run begins.");
    const auto require = [&](bool isGiven, std::string_view what, std::string_view call) {
        if (!isGiven)
            throw InputError(fmt::format("inlet {}: {} is not set; call {} before it is added.",
                                         inlets.size(), what, call));
    };
    require(inlet.region != nullptr, "its region", "setRegion()");
    require(inlet.sizes.has_value(), "the sizes of its grains", "setSizes()");
    require(inlet.like.getSpeciesIndex() >= 0, "the species of its grains", "setGrain()");
    require(isSet(inlet.massFlow) || isSet(inlet.numberFlow), "its flow", "setMassFlow() or setNumberFlow()");
    inlets.push_back({.inlet = inlet, .region = inlet.region, .count = {}});
    return inlets.size() - 1;
}

const InletCount& InletHandler::countOf(std::size_t number) const {
    if (number >= inlets.size())
        throw InputError(
            fmt::format("There is no inlet {}; the scene has {} (counted from 0).", number, inlets.size()));
    return inlets[number].count;
}

std::vector<InletHandler::Sizes> InletHandler::sizes() const {
    std::vector<Sizes> all;
    for (const Kept& kept : inlets)
        all.push_back({0.5 * kept.inlet.sizes->smallest(), 0.5 * kept.inlet.sizes->largest(),
                       kept.inlet.like.getSpeciesIndex()});
    return all;
}

double InletHandler::liquidBy(const ParticleHandler& particles, double time) const {
    double sum = 0;
    for (const Kept& kept : inlets) {
        const Inlet& inlet = kept.inlet;
        const double lasts = std::max(std::min(time, inlet.last) - inlet.first, 0.0);  // s
        const double rate =                                                            // grains/s
            isSet(inlet.massFlow) ? inlet.massFlow / meanMass(*inlet.sizes, densityOf(particles, inlet.like))
                                  : inlet.numberFlow;
        sum += rate * lasts * inlet.like.getLiquidVolume();
    }
    return sum;
}

void InletHandler::requireLiquid(const ParticleHandler& particles, double time) const {
    for (const Kept& kept : inlets) {
        const double film = kept.inlet.like.getLiquidVolume();
        if (film == 0 || time <= kept.inlet.first || time > kept.inlet.last) continue;
        if (const auto objection = particles.films().objectionToMore(film)) throw InputError(*objection);
    }
}

namespace {

/// Throws InputError if there is no such wall, or one that has no motion of its own.
const RigidWall& wallOf(const WallHandler& walls, std::size_t inlet, std::size_t wall) {
    const auto* const body = wall < walls.getSize() && !walls.isRemoved(wall)
                                 ? dynamic_cast<const RigidWall*>(&walls.getObject(wall))
                                 : nullptr;
    if (!body)
        throw InputError(fmt::format(
            "inlet {}: the wall {} that it follows is no wall of this scene; it has {} (counted from 0).",
            inlet, wall, walls.getSize()));
    return *body;
}

}  // namespace

Vector<double> InletHandler::shiftOf(const InsertionScene& scene, const Kept& kept, std::size_t number) {
    Vector<double> shift = static_cast<double>(kept.rises) * kept.inlet.rise;
    if (const auto wall = kept.inlet.wall)
        shift +=
            wallOf(scene.walls, number, *wall).getPose().place(kept.onWall) - kept.region->bounds().middle();
    return shift;
}

void InletHandler::begin(const InsertionScene& scene, const PeriodicBox& atSetUp, bool isRestarted) {
    hasBegun = true;
    for (std::size_t k = 0; k < inlets.size(); ++k) {
        Kept& kept = inlets[k];
        kept.region = kept.inlet.region->in(atSetUp);
        kept.inFlow = RegionInFlow(kept.region, atSetUp);
        // On a restart walls and regions have moved, and the region's way is not known yet.
        if (!isRestarted) checkRoom(scene, k);
        check(scene, k);
        if (kept.inlet.wall)
            kept.onWall =
                wallOf(scene.walls, k, *kept.inlet.wall).getPose().placeBack(kept.region->bounds().middle());
    }
}

void InletHandler::checkRoom(const InsertionScene& scene, std::size_t number) const {
    const Inlet& inlet = inlets[number].inlet;
    const auto checkAt = [&](const std::string& who, const Vector<double>& way) {
        refuseWithoutRoom(who, *inlets[number].region, scene.walls, scene.periodic,
                          0.5 * inlet.sizes->smallest(), 0.5 * inlet.sizes->largest(), inlet.wholeGrains,
                          way);
    };
    checkAt(fmt::format("inlet {}", number), {0, 0, 0});
    if (inlet.mostRises == 0) return;
    const Vector<double> way = static_cast<double>(inlet.mostRises) * inlet.rise;
    checkAt(fmt::format("inlet {}, at the end of its way of {:.6g} m after the fill", number, norm(way)),
            way);
}

void InletHandler::check(const InsertionScene& scene, std::size_t number) const {
    const Inlet& inlet = inlets[number].inlet;
    const Region& region = *inlets[number].region;
    if (inlet.like.getLiquidVolume() > 0 && !scene.particles.films().areKept())
        throw InputError(fmt::format(
            "inlet {}: the liquid volume of its grains = {:.6g} m^3, but no species of this scene "
            "moves liquid; take an adhesion law whose name begins with LiquidMigration, or leave "
            "it out.",
            number, inlet.like.getLiquidVolume()));
    const Vector<double> velocity = toVector(inlet.like.getVelocity());
    const double speed = norm(velocity);
    if (speed == 0) return;
    const double density = densityOf(scene.particles, inlet.like);
    const double flow =
        isSet(inlet.massFlow) ? inlet.massFlow : inlet.numberFlow * meanMass(*inlet.sizes, density);
    const double most = Inlet::densestStream * density * speed * region.areaAcross((1 / speed) * velocity);
    if (flow > most * (1 + roundOffOfLimits)) {
        const auto [wanted, allowed] = apartTexts(flow, most, 6);
        throw InputError(fmt::format(
            "inlet {}: a flow of {} kg/s is more than its region can let in at {:.6g} m/s; it must be at "
            "most {} kg/s, a solid fraction of {:g}.",
            number, wanted, speed, allowed, Inlet::densestStream));
    }
}

void InletHandler::letIn(const InsertionScene& scene, double time,
                         const std::function<void(std::string)>& tell) {
    for (std::size_t k = 0; k < inlets.size(); ++k) letInOf(scene, k, time, tell);
}

void InletHandler::letInOf(const InsertionScene& scene, std::size_t number, double time,
                           const std::function<void(std::string)>& tell) {
    Kept& kept = inlets[number];
    const Inlet& inlet = kept.inlet;
    InletCount& count = kept.count;
    const double lasted = std::min(time, inlet.last) - inlet.first;
    if (!(lasted > 0)) return;
    const bool byMass = isSet(inlet.massFlow);
    const double due = (byMass ? inlet.massFlow : inlet.numberFlow) * lasted;
    std::optional<SphereGrid> grid;
    for (;;) {
        if (!isSet(kept.nextRadius))
            kept.nextRadius = inlet.sizes->drawRadius(CountedRandom(inlet.seed), count.number);
        const double radius = kept.nextRadius;
        const double mass = scene.particles.massOf(radius, inlet.like.getSpeciesIndex());
        const double come = (byMass ? count.mass : static_cast<double>(count.number)) + count.lost;
        const double whole = come + (byMass ? mass : 1);
        if (whole > due) return;
        // The run ends with a sentence before its next step: requireLiquid().
        const double film = inlet.like.getLiquidVolume();
        if (film > 0 && scene.particles.films().objectionToMore(film)) return;
        if (!grid) {
            kept.inFlow.requireRoom(fmt::format("At time {:.6g} s inlet {}", time, number), scene.periodic);
            const Vector<double> shift = shiftOf(scene, kept, number);
            const Box bounds = kept.region->bounds();
            grid.emplace(ParticleHandler::Inside::grainsInStep(scene.particles), scene.periodic,
                         Box{bounds.lowest + shift, bounds.highest + shift}, 0.5 * inlet.sizes->largest());
        }
        const auto centre = findRoom(scene, kept, *grid, radius, static_cast<std::uint32_t>(number));
        if (!centre && kept.rises < inlet.mostRises) {
            count.risen = ++kept.rises * norm(inlet.rise);
            grid.reset();
            continue;
        }
        count.waits = !centre;
        if (!centre) {
            if (!std::exchange(kept.wasTold, true))
                tell(
                    fmt::format("inlet {}: at {:.6g} s there was no room for a grain of radius {:.3g} m; {} "
                                "grains, {:.6g} kg, "
                                "had come; the flow of such times is {}.",
                                number, time, radius, count.number, count.mass,
                                inlet.noRoom == NoRoom::Later ? "made up for later" : "lost"));
            if (inlet.noRoom == NoRoom::Lost) count.lost += due - whole;
            return;
        }
        SphericalParticle grain = inlet.like;
        grain.setRadius(radius);
        grain.setPosition(toEigen(*centre));
        if (scene.periodic.imagesMove)
            grain.setVelocity(inlet.like.getVelocity() + toEigen(scene.periodic.flowAt(*centre)));
        scene.particles.copyAndAddObject(grain);
        grid->add(*centre, radius);
        ++count.number;
        count.mass += mass;
        kept.attempts = 0;
        kept.nextRadius = unset;
    }
}

std::optional<Vector<double>> InletHandler::findRoom(const InsertionScene& scene, Kept& kept,
                                                     const SphereGrid& grid, double radius,
                                                     std::uint32_t number) {
    const Inlet& inlet = kept.inlet;
    const CountedRandom random(inlet.seed);
    const double margin = inlet.wholeGrains ? radius : 0;
    const Vector<double> shift = shiftOf(scene, kept, number);
    for (std::uint32_t k = 0; k < inlet.tries; ++k) {
        const Vector<double> inRegion = candidateOf(*kept.region, random, kept.count.number,
                                                    purposeOfPlaces + 3 * number, kept.attempts++, margin);
        const Vector<double> centre = kept.inFlow.placeNow(inRegion, scene.periodic) + shift;
        if (kept.region->contains(inRegion, margin) &&
            !touchesWall(scene.walls, scene.periodic, centre, radius) && grid.isFree(centre, radius))
            return scene.periodic.wrap(centre);
    }
    return std::nullopt;
}

void InletHandler::visitState(StateArchive& archive) {
    archive.same("count", inlets.size());
    for (std::size_t k = 0; k < inlets.size(); ++k)
        archive.group(std::to_string(k), [&] {
            Kept& kept = inlets[k];
            const Inlet& inlet = kept.inlet;
            archive.group("region", [&] { inlet.region->visitState(archive); });
            archive.same("smallest", inlet.sizes->smallest(), "m");
            archive.same("largest", inlet.sizes->largest(), "m");
            archive.same("meanVolume", inlet.sizes->moment(3), "m^3");
            archive.same("species", inlet.like.getSpeciesIndex());
            archive.sameRecord<double>("velocity", toVector(inlet.like.getVelocity()));
            archive.same("massFlow", inlet.massFlow, "kg/s");
            archive.same("numberFlow", inlet.numberFlow, "1/s");
            archive.same("firstTime", inlet.first, "s");
            archive.same("lastTime", inlet.last, "s");
            archive.same("lost", inlet.noRoom == NoRoom::Lost);
            archive.same("tries", inlet.tries);
            archive.same("seed", inlet.seed);
            archive.same("wholeGrains", inlet.wholeGrains);
            archive.same("followsWall", inlet.wall ? static_cast<std::int32_t>(*inlet.wall) : -1);
            archive.sameRecord<double>("rise", inlet.rise);
            archive.same("mostRises", inlet.mostRises);
            archive.value("rises", kept.rises);
            archive.require(kept.rises <= inlet.mostRises, "rises", "is more than there can be");
            kept.count.risen = kept.rises * norm(inlet.rise);
            archive.finite("onWall", kept.onWall);
            archive.value("number", kept.count.number);
            archive.finite("mass", kept.count.mass);
            archive.finite("lostFlow", kept.count.lost);
            archive.value("waits", kept.count.waits);
            archive.value("attempts", kept.attempts);
            archive.value("wasTold", kept.wasTold);
            kept.nextRadius = unset;
            archive.require(kept.count.mass >= 0 && kept.count.lost >= 0, "mass", "is negative");
        });
}

}  // namespace pendular
