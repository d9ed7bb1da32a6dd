#include "Kernel/Features/PeriodicWalls/PeriodicWalls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "Kernel/Core/Motion/GrainSizes.h"
#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Features/Wear/WornWall.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {

namespace {

constexpr std::array<Vector<double>, 3> units{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array names{'x', 'y', 'z'};

/// How far outside a grain may be at most, as a share of the smallest radius. A list of contacts lasts about
/// as long as grains need for it, so that bringing them back makes at most about twice as many lists.
constexpr double widestBand = 0.2;
/// Steps in a surface that are smaller than this share of the smallest radius count as none. A file with
/// numbers of single precision is rounded to 6e-8 of its lengths.
constexpr double tolerance = 1e-4;

constexpr double rounded = 1 - 1e-6;  // what a sentence asks for is

/// Whether it is alike at both faces as far as grains meet it (m).
bool isAlike(const SurfaceAtFaces& seen, double met) { return seen.margin >= met * rounded; }

bool movesVertices(const Wall& wall) {
    if (wall.membrane()) return true;
    const auto* const worn = dynamic_cast<const WornWall*>(&wall);
    return worn && worn->keepsWear() && worn->movesVertices();
}

}  // namespace

double PeriodicWalls::neededOf(const Wall& wall, const ContactLaws& laws, const GrainSizes& sizes,
                               double bodyReach) {
    double farthest = 0;
    for (std::size_t s = 0; s < sizes.free.size(); ++s) {
        if (sizes.free[s].empty()) continue;
        const auto species = static_cast<int>(s);
        for (const double radius : {sizes.free[s].smallest, sizes.free[s].largest}) {
            const double range =
                laws.layout.interaction == 0
                    ? 0
                    : std::max(laws.range(species, wall.getSpeciesIndex(), {radius, infinity}),
                               laws.filmContactGap(species, wall.getSpeciesIndex()));
            farthest = std::max(farthest, std::max(radius, bodyReach) + range);
        }
    }
    return farthest;
}

PeriodicFaces PeriodicWalls::facesOf(std::size_t axis, double least) const {
    const double needed = least + widestBand * smallest;
    PeriodicFaces faces{.along = units[axis],
                        .lowest = periodic.lowest.*vectorAxes[axis],
                        .length = periodic.length.*vectorAxes[axis],
                        .width = std::min(2 * needed, 0.5 * periodic.length.*vectorAxes[axis]),
                        .tolerance = tolerance * smallest,
                        .others = {}};
    for (std::size_t k = 0; k < 3; ++k) {
        const double length = periodic.length.*vectorAxes[k], low = periodic.lowest.*vectorAxes[k];
        if (k == axis || length == 0) continue;
        faces.others.push_back({units[k], low + length + needed});
        faces.others.push_back({-units[k], needed - low});
    }
    return faces;
}

std::string PeriodicWalls::sentence(std::size_t wall, std::size_t axis, const SurfaceAtFaces& seen,
                                    double met) const {
    const double needed = 1.001 * met, low = periodic.lowest.*vectorAxes[axis],
                 high = low + periodic.length.*vectorAxes[axis];
    const std::string advice = fmt::format(
        "only meshes are repeated, and grains at a face meet them up to {:.4g} m beyond it: let it go "
        "on alike for {:.6g} m beyond both faces, or end {:.6g} m before them.",
        met, needed, needed);
    const auto ending = [&](std::string_view how, double end, double face) {
        const double beyond = how == "ends" ? end - face : face - end;
        return fmt::format("wall {} {} at {} = {:.6g} m, {:.4g} m {} the periodic face at {:.6g} m; {}", wall,
                           how, names[axis], end, std::abs(beyond), beyond < 0 ? "before" : "beyond", face,
                           advice);
    };
    if (std::abs(seen.highest - high) < needed) return ending("ends", seen.highest, high);
    if (std::abs(seen.lowest - low) < needed) return ending("begins", seen.lowest, low);
    const std::string where =
        seen.place ? fmt::format(
                         "what it has at ({:.6g}, {:.6g}, {:.6g}) m, {:.4g} m from a face, it has not "
                         "at the other one",
                         seen.place->x, seen.place->y, seen.place->z, seen.margin)
                   : "it goes through a face, and not alike through the other one";
    return fmt::format("wall {} is not the same after a period of {:.6g} m along {}: {}; {}", wall,
                       high - low, names[axis], where, advice);
}

void PeriodicWalls::requireShort(const RepeatedWall& wall, std::size_t number) const {
    const Vector<double> half = wall.surroundings().half;
    for (std::size_t k = 0; k < 3; ++k) {
        const double length = 2 * half.*vectorAxes[k], period = periodic.length.*vectorAxes[k];
        if (period > 0 && length > WallImages::mostPeriods * period)
            throw InputError(fmt::format(
                "wall {} is {:.6g} m long along {}, and it is not the same after a period of {:.6g} m: a "
                "mesh or a membrane that is to be repeated with the scene is not longer than {} periods; "
                "make it shorter.",
                number, length, names[k], period, WallImages::mostPeriods));
    }
}

void PeriodicWalls::repeat(RepeatedWall& wall, WallLooks& of) {
    requireShort(wall, of.number);
    if (wall.partCount() > WallImages::mostParts)
        throw InputError(fmt::format(
            "wall {} has {} parts, and it is not the same after a period: what is to be repeated with the "
            "scene has at most {}; take a coarser mesh.",
            of.number, wall.partCount(), WallImages::mostParts));
    wall.repeat(periodic.length);
    imagesAreNew = true;
    takeAsRepeated(of);
}

void PeriodicWalls::takeAsRepeated(WallLooks& of) {
    Look alike;
    alike.isEndless = false;
    alike.passes = true;
    alike.needed = of.needed;
    of.along.fill(alike);
}

bool PeriodicWalls::mustBeRepeated(const Wall& wall, const SurfaceAtFaces& seen, const PeriodicFaces& faces,
                                   double met) {
    const auto* const repeated = dynamic_cast<const RepeatedWall*>(&wall);
    if (!repeated || !repeated->canBeRepeated()) return false;
    // What does not go through a face and lies beyond it is a piece of its own.
    if (!seen.passes && (seen.highest > faces.highest() || seen.lowest < faces.lowest)) return true;
    // Vertices move on each side as grains wear or press them there, so that two ends would no longer fit.
    return !isAlike(seen, met) || (seen.passes && movesVertices(wall));
}

bool PeriodicWalls::areKnownFor(const WallHandler& walls, const ContactLaws& laws, const GrainSizes& sizes,
                                double widestBody) const {
    if (!std::ranges::equal(looks, walls.present(), {}, &WallLooks::number, &PresentWall::number))
        return false;
    for (const WallLooks& of : looks) {
        const auto* const wall = dynamic_cast<const RepeatedWall*>(&walls.getObject(of.number));
        if (!wall || !wall->canBeRepeated() || wall->isRepeated()) continue;
        const double needed = neededOf(*wall, laws, sizes, 0.5 * widestBody);
        for (const Look& known : of.along)
            if (!(needed + known.moved <= known.margin)) return false;
    }
    return true;
}

std::vector<RepeatedWall*> PeriodicWalls::wallsToRepeat(const WallHandler& walls, const PeriodicBox& box,
                                                        const ContactLaws& laws, const GrainSizes& sizes,
                                                        double widestBody, double smallestRadius) {
    PeriodicWalls own;
    std::vector<RepeatedWall*> found;
    if (!own.begin(box, widestBody, smallestRadius)) return found;
    for (const PresentWall& present : walls.present()) {
        auto* const wall = dynamic_cast<RepeatedWall*>(present.object.get());
        if (!wall || !wall->canBeRepeated() || wall->isRepeated()) continue;
        if (wall->partCount() > WallImages::mostParts) continue;  // it will be refused
        const double needed = neededOf(*wall, laws, sizes, own.bodyReach);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (box.length.*vectorAxes[axis] == 0) continue;
            const PeriodicFaces faces = own.facesOf(axis, needed);
            if (!mustBeRepeated(*wall, wall->atFaces(faces), faces, needed)) continue;
            found.push_back(wall);
            break;
        }
    }
    return found;
}

void PeriodicWalls::look(Wall& wall, WallLooks& of, std::size_t axis, double outside) {
    auto* const rigid = dynamic_cast<RigidWall*>(&wall);
    const double needed = of.needed;
    if (wall.isRepeated()) return takeAsRepeated(of);
    const PeriodicFaces faces = facesOf(axis, needed);
    const SurfaceAtFaces seen = wall.atFaces(faces);
    const double met = needed + outside;
    if (mustBeRepeated(wall, seen, faces, met)) return repeat(dynamic_cast<RepeatedWall&>(wall), of);
    if (!isAlike(seen, met)) throw InputError(sentence(of.number, axis, seen, met));
    of.along[axis] = {.isEndless = seen.isEndless,
                      .passes = seen.passes,
                      .needed = needed,
                      .margin = seen.passes ? std::min(seen.margin, faces.width) : seen.margin,
                      .pose = rigid ? rigid->getPose() : Pose(),
                      .moved = 0};
}

void PeriodicWalls::forgetChecks() {
    looks.clear();
    anyHasEnds = false;
}

void PeriodicWalls::takePresent(const WallHandler& walls) {
    std::vector<WallLooks> before = std::exchange(looks, {});
    for (const PresentWall& wall : walls.present()) {
        const auto known = std::ranges::lower_bound(before, wall.number, {}, &WallLooks::number);
        const bool isKnown = known != before.end() && known->number == wall.number;
        looks.push_back(isKnown ? *known : WallLooks{.number = wall.number, .along = {}});
    }
}

bool PeriodicWalls::begin(const PeriodicBox& box, double widestBody, double smallestRadius) {
    periodic = box;
    smallest = smallestRadius;
    bodyReach = 0.5 * widestBody;
    return box.any() && !box.imagesMove && smallest < infinity;
}

void PeriodicWalls::check(const WallHandler& walls, bool haveChanged, const PeriodicBox& box,
                          const ContactLaws& laws, const GrainSizes& sizes, double widestBody,
                          double smallestRadius) {
    const bool isOther = haveChanged || smallest != smallestRadius || looks.size() != walls.present().size();
    if (!(periodic.length == box.length))  // they were of another scene, or of an attempt that was refused
        for (const PresentWall& wall : walls.present())
            if (auto* const mesh = dynamic_cast<RepeatedWall*>(wall.object.get())) mesh->repeat({0, 0, 0});
    hasEnds.assign(walls.getSize(), false);
    if (!begin(box, widestBody, smallestRadius)) return forgetChecks();
    takePresent(walls);
    double spare = infinity;
    for (WallLooks& of : looks) {
        Wall& wall = walls.getObject(of.number);
        const double needed = of.needed = neededOf(wall, laws, sizes, bodyReach);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Look& known = of.along[axis];
            if (periodic.length.*vectorAxes[axis] == 0) continue;
            if (isOther || needed != known.needed || !isWhereItWas(wall, known)) look(wall, of, axis, 0);
        }
        for (const Look& known : of.along) spare = std::min(spare, known.margin - needed);
    }
    // The other half is left to walls that move.
    band = std::clamp(0.5 * spare, 0.0, widestBand * smallest);
    collectEnds();
}

void PeriodicWalls::visitState(StateArchive& archive, const WallHandler& walls) {
    // A wall that moves may have been alike at both faces when the run of the file began.
    std::vector<std::uint32_t> repeated;
    for (const auto& [number, wall] : walls.present())
        if (wall->isRepeated()) repeated.push_back(static_cast<std::uint32_t>(number));
    archive.column<std::uint32_t>("repeatedWalls", repeated);
    for (const std::uint32_t number : repeated) {
        auto* const wall =
            number < walls.getSize() ? dynamic_cast<RepeatedWall*>(&walls.getObject(number)) : nullptr;
        archive.require(wall && wall->canBeRepeated(), "repeatedWalls", "has a wall that cannot be repeated");
        const auto known = std::ranges::find(looks, number, &WallLooks::number);
        archive.require(known != looks.end(), "repeatedWalls", "has walls that this scene does not repeat");
        repeat(*wall, *known);
    }
    imagesAreNew = false;  // contacts are listed after this
    archive.finite("band", band);
    archive.require(band >= 0 && band <= widestBand * smallest, "band",
                    "is no distance to which grains may be outside");
}

void PeriodicWalls::collectEnds() {
    nearest = 0;
    anyHasEnds = false;
    for (const WallLooks& each : looks) {
        const bool ends = !std::ranges::all_of(each.along, &Look::isEndless);
        hasEnds[each.number] = ends;
        anyHasEnds = anyHasEnds || ends;
    }
}

bool PeriodicWalls::isWhereItWas(const Wall& wall, const Look& last) {
    const auto* const rigid = dynamic_cast<const RigidWall*>(&wall);
    return rigid && !movesVertices(wall) && rigid->getPose().shift == last.pose.shift &&
           std::ranges::equal(rigid->getPose().column, last.pose.column);
}

/// Turns about the axis and shifts carry what is alike at both faces along: then only the shift along the
/// axis brings an end nearer.
bool PeriodicWalls::mustBeLookedAt(const Wall& wall, std::size_t axis, WallLooks& of, double shift) const {
    const double length = periodic.length.*vectorAxes[axis];
    if (length == 0 || wall.isRepeated()) return false;
    Look& last = of.along[axis];
    const double spare = last.margin - (of.needed + band) * rounded;
    const auto* const rigid = dynamic_cast<const RigidWall*>(&wall);
    if (!rigid || movesVertices(wall)) {
        last.moved += shift;
        return !(last.moved <= spare);
    }
    const Pose since = rigid->getPose().after(last.pose.inverse());
    const double tilt = norm(since.turn(units[axis]) - units[axis]);
    if (last.isEndless) return tilt > 0;
    if (last.passes)
        return !(length * tilt <= 0.1 * tolerance * smallest &&
                 std::abs(since.shift.*vectorAxes[axis]) <= spare);
    if (!isWhereItWas(wall, last)) last.moved += shift;
    return !(last.moved <= spare);
}

bool PeriodicWalls::followOne(Wall& wall, WallLooks& of, double shift) {
    if (wall.isRepeated()) {
        requireShort(dynamic_cast<const RepeatedWall&>(wall), of.number);
        return false;
    }
    bool looked = false;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (mustBeLookedAt(wall, axis, of, shift)) look(wall, of, axis, band), looked = true;
    return looked;
}

void PeriodicWalls::follow(const WallHandler& walls, double shift, double time) {
    if (shift == 0 || looks.empty()) return;
    bool lookedAgain = false;
    for (WallLooks& of : looks) {
        try {
            lookedAgain |= followOne(walls.getObject(of.number), of, shift);
        } catch (const InputError& refusal) {
            throw RunError(fmt::format("At time {:.6g} s {}", time, refusal.what()));
        }
    }
    if (lookedAgain) collectEnds();
}

void PeriodicWalls::approach(const Vector<double>& centre) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double length = periodic.length.*vectorAxes[axis],
                     above = centre.*vectorAxes[axis] - periodic.lowest.*vectorAxes[axis];
        if (length > 0) nearest = std::min(nearest, band + std::min(above, length - above));
    }
}

bool PeriodicWalls::isBringingBackDue(const ParticleStore& grains, double shift, bool haveBodies,
                                      const AllRanks& ranks) {
    // The centre of a body may move farther than its grains.
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) approach(grains.bodies[k].position);
    nearest -= shift;
    if (haveBodies) nearest = ranks.smallest(nearest);
    if (nearest > 0) return false;
    nearest = infinity;
    for (std::size_t k = 0; k < grains.size(); ++k)
        if (!grains.isGap(k) && !grains.bodies.contains(grains.identity[k]))
            approach(grains.translation[k].position);
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) approach(grains.bodies[k].position);
    nearest = ranks.smallest(nearest);
    if (nearest < 0) return true;
    nearest *= 1 - 1e-9;  // sums of shifts are rounded
    return false;
}

std::vector<std::uint32_t> PeriodicWalls::outside(const ParticleStore& grains) const {
    std::vector<std::uint32_t> places;
    for (const std::uint32_t place : grains.place) {
        const std::uint32_t body = grains.bodies.bodyOf(grains.identity[place]);
        const Vector<double>& centre = body == RigidBodies::none
                                           ? grains.translation[place].position
                                           : grains.bodies[grains.bodies.find(body)].position;
        if (!(periodic.wrap(centre) == centre)) places.push_back(place);
    }
    return places;
}

}  // namespace pendular
