#include "Kernel/Features/Inlets/Inlet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/GrainSpecies.h"
#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Features/Insertion/SphereGrid.h"
#include "Kernel/Features/Insertion/WallGap.h"
#include "Kernel/Features/Superquadrics/ExtremeContact.h"
#include "Kernel/Features/Superquadrics/SuperquadricBody.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/ApartTexts.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

namespace {

constexpr std::string_view ownerOfInlet = "Inlet";
/// The purpose of the random numbers of places; three for each inlet.
constexpr std::uint32_t purposeOfInletPlaces = 0x1258000;

/// The purpose of the random numbers of turns; three for each inlet.
constexpr std::uint32_t purposeOfInletTurns = 0x1259000;

/// kg
double massOf(const ParticleHandler& particles, const BodyKind& kind, double radius) {
    if (kind.grain()) return particles.massOf(radius, kind.species());
    const double density = densityOf(particles, kind.species());
    if (kind.shaped()) return sphereMass(radius, density);
    return kind.clump()->getTemplate().massOf(density, kind.scale(radius)).mass;
}

/// m
double largestReach(const BodyMixture& bodies) {
    double reach = 0;
    for (const BodyKind& kind : bodies) reach = std::max(reach, kind.reach(0.5 * kind.sizes.largest()));
    return reach;
}

/// Adds the body that a clump of a template is.
void addClump(ParticleStore& one, const ClumpTemplate& shape, double density) {
    const BodyMass mass = shape.massOf(density, 1);
    const PrincipalAxes principal = principalAxes(mass.inertia);
    std::vector<BodyMember> members;
    double largest = 0;  // kg
    for (const Ball& ball : shape.getSpheres()) {
        const double own = sphereMass(ball.radius, density);
        largest = std::max(largest, own);
        const std::uint32_t identity =
            one.add({toVector(ball.centre), ball.radius, {0, 0, 0}, 1 / own}, {0, 0, 0}, 0);
        members.push_back({identity, toVector(principal.axes.conjugate() * ball.centre)});
    }
    one.bodies.add({.mass = mass.mass, .inertia = toVector(principal.moments), .largestFreeMass = largest},
                   members, shape.getVolume(), {principal.axes.w(), toVector(Vec3D(principal.axes.vec()))});
}

/// Numbers of the shape, whatever its density and size.
ContactsAround contactsOf(const BodyKind& kind) {
    constexpr double density = 1;
    ParticleStore one;
    if (kind.clump()) addClump(one, kind.clump()->getTemplate(), density);
    else {
        const Superquadric& shape = kind.shaped()->getShape();
        const RigidBody body = bodyOf(*kind.shaped(), density, extremeContact(shape).turning);
        const BodyMember member{
            one.add({{0, 0, 0}, shape.boundingRadius(), {0, 0, 0}, 1 / body.mass}, {0, 0, 0}, 0), {0, 0, 0}};
        one.bodies.add(body, {&member, 1}, shape.volume());
    }
    // Those of the bodies that come may differ by the last digit, and must not be beyond it.
    return one.bodies.contactsAt(one, 0).roundedUp(1 + 2.0 / 1024);
}

/// What the stability limit counts with for all clumps or superquadrics of a kind.
/// @param density kg/m^3
BodiesAlike alikeOf(const BodyKind& kind, double density, const ContactsAround& around) {
    BodiesAlike alike{.species = static_cast<std::size_t>(kind.species()), .around = around};
    const auto sizeOf = [&](double diameter) {
        const double radius = 0.5 * diameter;
        return BodiesAlike::Size{sphereMass(radius, density), kind.smallestSphere(radius),
                                 kind.largestSphere(radius)};
    };
    alike.add(sizeOf(kind.sizes.smallest()), sizeOf(kind.sizes.largest()));
    alike.count = 2;  // any number may come
    return alike;
}

}  // namespace

void Inlet::setMassFlow(double rate) {
    checkValue(ownerOfInlet, "mass flow", rate, "kg/s", positive);
    massFlow = rate;
    numberFlow = unset;
}
void Inlet::setNumberFlow(double rate) {
    checkValue(ownerOfInlet, "number flow", rate, "1/s", positive);
    numberFlow = rate;
    massFlow = unset;
}
void Inlet::setTimes(double begin, double end) {
    checkValue(ownerOfInlet, "first time", begin, "s", notNegative);
    checkValue(ownerOfInlet, "last time", end, "s", {begin, infinity, true, false});
    first = begin;
    last = end;
}
void Inlet::setTries(std::uint32_t number) {
    checkValue(ownerOfInlet, "number of tries", number, "", {1, 1e9});
    tries = number;
}

void Inlet::setFollowsWall(std::size_t number) { wall = number; }
void Inlet::setFollowsFill(const Vec3D& direction, double step, double most) {
    const Vector<double> unit =
        checkedDirection(ownerOfInlet, "length of the direction of the fill", direction);
    checkValue(ownerOfInlet, "step after the fill", step, "m", positive);
    // All steps may be tried in one time step.
    checkValue(ownerOfInlet, "way after the fill", most, "m", {step, 1e4 * step});
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
    if (inlet.mixture && inlet.sizes)
        throw InputError(fmt::format(
            "inlet {}: sizes are given twice; call setSizes(), or give them to the mixture of setBodies().",
            inlets.size()));
    BodyMixture bodies;
    if (inlet.mixture) {
        require(!inlet.mixture->empty(), "what it brings", "add() of the mixture");
        bodies = *inlet.mixture;
    } else {
        require(inlet.sizes.has_value(), "the sizes of its grains", "setSizes()");
        std::visit([&](const auto& like) { bodies.add(like, *inlet.sizes); }, inlet.like);
    }
    for (const BodyKind& kind : bodies)
        require(kind.species() >= 0, "the species of its grains",
                inlet.mixture ? "setSpecies() of all in the mixture" : "setGrain()");
    require(isSet(inlet.massFlow) || isSet(inlet.numberFlow), "its flow", "setMassFlow() or setNumberFlow()");
    std::vector<ContactsAround> around;
    for (const BodyKind& kind : bodies) around.push_back(kind.grain() ? ContactsAround{} : contactsOf(kind));
    inlets.push_back({.inlet = inlet,
                      .bodies = std::move(bodies),
                      .around = std::move(around),
                      .region = inlet.region,
                      .count = {}});
    return inlets.size() - 1;
}

const InletCount& InletHandler::countOf(std::size_t number) const {
    if (number >= inlets.size())
        throw InputError(
            fmt::format("There is no inlet {}; the scene has {} (counted from 0).", number, inlets.size()));
    return inlets[number].count;
}

std::vector<InletHandler::Sizes> InletHandler::sizes(const GrainSpecies& species) const {
    std::vector<Sizes> all;
    for (const Kept& kept : inlets)
        for (std::size_t k = 0; k < kept.bodies.size(); ++k) {
            const BodyKind& kind = kept.bodies[k];
            Sizes sizes{kind.smallestSphere(0.5 * kind.sizes.smallest()),
                        kind.largestSphere(0.5 * kind.sizes.largest()), kind.species(), std::nullopt};
            if (!kind.grain())
                sizes.bodies =
                    alikeOf(kind, species.density(static_cast<std::size_t>(kind.species())), kept.around[k]);
            all.push_back(sizes);
        }
    return all;
}

bool InletHandler::bringLiquid() const {
    return std::ranges::any_of(inlets, [](const Kept& kept) {
        for (const BodyKind& kind : kept.bodies)
            if (kind.film() > 0) return true;
        return false;
    });
}

bool InletHandler::bringBodies() const {
    return std::ranges::any_of(inlets, [](const Kept& kept) { return kept.bodies.hasBodies(); });
}

double InletHandler::widestBody() const {
    double widest = 0;
    for (const Kept& kept : inlets)
        for (const BodyKind& kind : kept.bodies)
            if (!kind.grain()) widest = std::max(widest, 2 * kind.reach(0.5 * kind.sizes.largest()));
    return widest;
}

void InletHandler::expectShapes(GrainShapes* shapes) const {
    for (std::size_t k = 0; k < inlets.size(); ++k)
        requireShapes(inlets[k].bodies, shapes, fmt::format("inlet {}", k));
}

void InletHandler::refuseTooWide(const PeriodicBox& periodic) const {
    const double shortest = periodic.shortestLength(), widest = widestBody();
    if (widest > 0.5 * shortest)
        throw InputError(fmt::format(
            "Inlet: the largest body to come is {:.6g} m wide when it turns; in a scene that repeats itself "
            "after {:.6g} m a body must not be wider than half of that.",
            widest, shortest));
}

double InletHandler::liquidBy(const ParticleHandler& particles, double time) const {
    double sum = 0;
    for (const Kept& kept : inlets) {
        const Inlet& inlet = kept.inlet;
        const double lasts = std::max(std::min(time, inlet.last) - inlet.first, 0.0);  // s
        const double rate =                                                            // grains/s
            isSet(inlet.massFlow) ? inlet.massFlow / kept.bodies.meanMass(particles) : inlet.numberFlow;
        double film = 0;  // m^3, of a mean grain
        for (std::size_t k = 0; k < kept.bodies.size(); ++k)
            film += kept.bodies.shareOf(k) * kept.bodies[k].film();
        sum += rate * lasts * film;
    }
    return sum;
}

/// m^3, of films that have come to the grains of other ranks.
static double absorbedByOthers(const GrainFilms& films, const AllRanks& ranks) {
    ExactSum all;
    all.add(films.absorbed());
    return ranks.sum(all) - films.absorbed();
}

void InletHandler::requireLiquid(const ParticleHandler& particles, const AllRanks& ranks, double time) const {
    const GrainFilms& films = particles.films();
    for (const Kept& kept : inlets) {
        double film = 0;  // m^3
        for (const BodyKind& kind : kept.bodies) film = std::max(film, kind.film());
        if (film == 0 || time <= kept.inlet.first || time > kept.inlet.last) continue;
        if (const auto objection = films.objectionToMore(film + absorbedByOthers(films, ranks)))
            throw InputError(*objection);
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
        for (const BodyKind& kind : inlets[number].bodies)
            refuseWithoutRoom(who, *inlets[number].region, scene.walls, scene.periodic,
                              kind.smallestSphere(0.5 * kind.sizes.smallest()),
                              kind.largestSphere(0.5 * kind.sizes.largest()), inlet.wholeGrains, way);
    };
    checkAt(fmt::format("inlet {}", number), {0, 0, 0});
    if (inlet.mostRises == 0) return;
    const Vector<double> way = static_cast<double>(inlet.mostRises) * inlet.rise;
    checkAt(fmt::format("inlet {}, at the end of its way of {:.6g} m after the fill", number, norm(way)),
            way);
}

void InletHandler::check(const InsertionScene& scene, std::size_t number) const {
    for (const BodyKind& kind : inlets[number].bodies)
        if (kind.film() > 0 && !scene.particles.films().areKept())
            throw InputError(fmt::format(
                "inlet {}: the liquid volume of its grains = {:.6g} m^3, but no species of this scene "
                "moves liquid; take an adhesion law whose name begins with LiquidMigration, or leave "
                "it out.",
                number, kind.film()));
    checkStream(scene, number);
}

/// Each kind takes its part of the stream's solid fraction, at its own velocity.
void InletHandler::checkStream(const InsertionScene& scene, std::size_t number) const {
    const Inlet& inlet = inlets[number].inlet;
    const BodyMixture& bodies = inlets[number].bodies;
    const double mean = bodies.meanMass(scene.particles),
                 flow = isSet(inlet.massFlow) ? inlet.massFlow : inlet.numberFlow * mean;
    double fraction = 0, slowest = infinity;  // m/s
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const BodyKind& kind = bodies[k];
        const double speed = norm(kind.velocity()),
                     volume = flow / mean * bodies.shareOf(k) * std::numbers::pi / 6 * kind.sizes.moment(3);
        slowest = std::min(slowest, speed);
        if (speed > 0)
            fraction += volume / (speed * inlets[number].region->areaAcross(1 / speed * kind.velocity()));
    }
    if (!(slowest > 0) || fraction <= Inlet::densestStream * (1 + roundOffOfLimits)) return;
    const auto [wanted, allowed] = apartTexts(flow, flow * Inlet::densestStream / fraction, 6);
    throw InputError(fmt::format(
        "inlet {}: a flow of {} kg/s is more than its region can let in at {:.6g} m/s; it must be at "
        "most {} kg/s, a solid fraction of {:g}.",
        number, wanted, slowest, allowed, Inlet::densestStream));
}

void InletHandler::letIn(const InsertionScene& scene, ContactSystem& contacts, double time,
                         const std::function<void(std::string)>& tell) {
    ParticleStore& grains = scene.particles.store();
    GrainFilms& films = scene.particles.films();
    const double absorbed = films.absorbed(),
                 elsewhere = bringLiquid() ? absorbedByOthers(films, contacts.ranks()) : 0;
    for (std::size_t k = 0; k < inlets.size(); ++k) letInOf(scene, contacts, k, time, elsewhere, tell);
    if (!contacts.isArriving()) return;
    contacts.finishArrival(grains);  // their films have come on all ranks
    if (!contacts.ranks().isFirst()) films.setAccounts(absorbed, films.removed());
}

void InletHandler::letInOf(const InsertionScene& scene, ContactSystem& contacts, std::size_t number,
                           double time, double filmsElsewhere, const std::function<void(std::string)>& tell) {
    Kept& kept = inlets[number];
    const Inlet& inlet = kept.inlet;
    InletCount& count = kept.count;
    const double lasted = std::min(time, inlet.last) - inlet.first;
    if (!(lasted > 0)) return;
    const bool byMass = isSet(inlet.massFlow);
    const double due = (byMass ? inlet.massFlow : inlet.numberFlow) * lasted;
    std::optional<SphereGrid> grid;
    for (;;) {
        if (!isSet(kept.nextRadius)) {
            const CountedRandom random(inlet.seed);
            kept.nextKind = kept.bodies.draw(random, count.number);
            kept.nextRadius = kept.bodies[kept.nextKind].sizes.drawRadius(random, count.number);
        }
        const BodyKind& kind = kept.bodies[kept.nextKind];
        const double radius = kept.nextRadius, mass = massOf(scene.particles, kind, radius);
        const double come = (byMass ? count.mass : static_cast<double>(count.number)) + count.lost;
        const double whole = come + (byMass ? mass : 1);
        if (whole > due) return;
        // The run ends with a sentence before its next step: requireLiquid().
        const double film = kind.film();
        if (film > 0 && scene.particles.films().objectionToMore(film + filmsElsewhere)) return;
        if (!grid) {
            kept.inFlow.requireRoom(fmt::format("At time {:.6g} s inlet {}", time, number), scene.periodic);
            const Vector<double> shift = shiftOf(scene, kept, number);
            const Box bounds = kept.region->bounds();
            grid.emplace(ParticleHandler::Inside::grainsInStep(scene.particles), scene.periodic,
                         Box{bounds.lowest + shift, bounds.highest + shift}, largestReach(kept.bodies));
        }
        const auto room = findRoom(scene, contacts.ranks(), kept, *grid, static_cast<std::uint32_t>(number));
        if (!room && kept.rises < inlet.mostRises) {
            count.risen = ++kept.rises * norm(inlet.rise);
            grid.reset();
            continue;
        }
        count.waits = !room;
        if (!room) {
            if (!std::exchange(kept.wasTold, true))
                tell(
                    fmt::format("inlet {}: at {:.6g} s there was no room for a {} of radius {:.3g} m; {} "
                                "grains, {:.6g} kg, "
                                "had come; the flow of such times is {}.",
                                number, time, kind.word(), radius, count.number, count.mass,
                                inlet.noRoom == NoRoom::Later ? "made up for later" : "lost"));
            if (inlet.noRoom == NoRoom::Lost) count.lost += due - whole;
            return;
        }
        const Vector<double> flow =
            scene.periodic.imagesMove ? scene.periodic.flowAt(room->place) : Vector<double>{0, 0, 0};
        if (contacts.ranks().areSeveral() && !contacts.isArriving()) {
            scene.particles.finishStep();
            contacts.beginArrival(scene.particles.store());
        }
        kind.addTo(scene, radius, room->place, room->turn, flow);
        for (const auto& [place, size] : kind.spheres(radius, room->place, room->turn))
            grid->add(toVector(place), size);
        ++count.number;
        count.mass += mass;
        kept.attempts = 0;
        kept.nextRadius = unset;
    }
}

/// Which of the rooms are there on all ranks.
template <class Rooms>
static std::vector<bool> areFree(const Rooms& rooms, const AllRanks& ranks) {
    std::vector<char> here;
    for (const auto& room : rooms) here.push_back(room ? 1 : 0);
    const std::vector<char> ofAll = ranks.gather(here);
    std::vector<bool> free(here.size(), true);
    for (std::size_t k = 0; k < ofAll.size(); ++k)
        if (ofAll[k] == 0) free[k % here.size()] = false;
    return free;
}

/// A grain is placed among the centres that keep it in the region, a clump tried with each of its spheres.
std::optional<InletHandler::Room> InletHandler::findRoom(const InsertionScene& scene, const AllRanks& ranks,
                                                         Kept& kept, const SphereGrid& grid,
                                                         std::uint32_t number) {
    const Inlet& inlet = kept.inlet;
    const BodyKind& kind = kept.bodies[kept.nextKind];
    const CountedRandom random(inlet.seed);
    const double margin = inlet.wholeGrains && kind.grain() ? kept.nextRadius : 0;
    const Vector<double> shift = shiftOf(scene, kept, number);
    const auto roomOf = [&](std::uint32_t attempt) -> std::optional<Room> {
        const Vector<double> place = candidateOf(*kept.region, random, kept.count.number,
                                                 purposeOfInletPlaces + 3 * number, attempt, margin);
        if (!kept.region->contains(place, margin)) return std::nullopt;
        const Vector<double> way = kept.inFlow.placeNow(place, scene.periodic) - place + shift;
        const auto even = [&](std::uint32_t which) {
            return random.uniform(kept.count.number, purposeOfInletTurns + 3 * number + which, attempt);
        };
        const Eigen::Quaterniond turn =
            !kind.grain() && inlet.randomTurns ? evenTurn(even(0), even(1), even(2)) : kind.orientation();
        const auto isFree = [&](const Ball& ball) {
            const Vector<double> inRegion = toVector(ball.centre), centre = inRegion + way;
            return (!inlet.wholeGrains || kept.region->contains(inRegion, ball.radius)) &&
                   !touchesWall(scene.walls, scene.periodic, centre, ball.radius) &&
                   grid.isFree(centre, ball.radius);
        };
        if (!std::ranges::all_of(kind.spheres(kept.nextRadius, place, turn), isFree)) return std::nullopt;
        return Room{scene.periodic.wrap(place + way), turn};
    };
    // Ranks ask each other for several tries at once.
    const std::uint32_t atOnce = ranks.areSeveral() ? 32 : 1;
    for (std::uint32_t done = 0; done < inlet.tries; done += atOnce) {
        const std::uint32_t count = std::min(atOnce, inlet.tries - done);
        std::vector<std::optional<Room>> rooms;
        for (std::uint32_t k = 0; k < count; ++k) rooms.push_back(roomOf(kept.attempts + k));
        const std::vector<bool> free = areFree(rooms, ranks);
        const auto first =
            static_cast<std::uint32_t>(std::find(free.begin(), free.end(), true) - free.begin());
        kept.attempts += std::min(first + 1, count);
        if (first < count) return rooms[first];
    }
    return std::nullopt;
}

void InletHandler::compareSetUp(StateArchive& archive) const {
    archive.same("count", inlets.size());
    for (std::size_t k = 0; k < inlets.size(); ++k)
        archive.group(std::to_string(k), [&] {
            const Inlet& inlet = inlets[k].inlet;
            archive.group("region", [&] { inlet.region->visitState(archive); });
            compareKinds(archive, inlets[k].bodies);
            archive.same("randomTurns", inlet.randomTurns);
            archive.same("massFlow", inlet.massFlow, "kg/s");
            archive.same("numberFlow", inlet.numberFlow, "1/s");
            archive.same("firstTime", inlet.first, "s");
            archive.same("lastTime", inlet.last, "s");
            archive.same("lost", inlet.noRoom == NoRoom::Lost);
            archive.same("tries", inlet.tries);
            archive.same("seed", inlet.seed);
            archive.same("wholeGrains", inlet.wholeGrains);
            archive.same("followsWall", inlet.wall ? static_cast<std::int32_t>(*inlet.wall) : -1);
            archive.sameRecord<double>("rise", inlet.rise, "m");
            archive.same("mostRises", inlet.mostRises);
        });
}

void InletHandler::compareKinds(StateArchive& archive, const BodyMixture& bodies) {
    archive.same("kinds", static_cast<std::int32_t>(bodies.size()));
    for (std::size_t k = 0; k < bodies.size(); ++k)
        archive.group(fmt::format("kind{}", k), [&] {
            archive.same("share", bodies.shareOf(k));
            bodies[k].compareSetUp(archive);
        });
}

void InletHandler::visitState(StateArchive& archive) {
    for (std::size_t k = 0; k < inlets.size(); ++k)
        archive.group(std::to_string(k), [&] {
            Kept& kept = inlets[k];
            const Inlet& inlet = kept.inlet;
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
