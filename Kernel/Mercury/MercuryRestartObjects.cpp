#include "Kernel/Mercury/MercuryRestartObjects.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>

#include "Kernel/Laws/Species/LawNames.h"

namespace pendular {
namespace {

using Lines = MercuryRestartLines;

/// The kernel's name of a field of a species, in files of version 1.0 on.
std::string fieldOf(std::string_view word, std::string_view type) {
    static const std::map<std::string_view, std::string_view> others{
        {"rho", "density"},
        {"k", "stiffness"},
        {"disp", "dissipation"},
        {"elasticModulus", "effectiveElasticModulus"},
        {"shearModulus", "effectiveShearModulus"},
        {"maxUnloadingStiffness", "unloadingStiffnessMax"},
        {"maxPenetration", "penetrationDepthMax"},
        {"frictionCoefficient", "slidingFrictionCoefficient"},
        {"frictionCoefficientStatic", "slidingFrictionCoefficientStatic"}};
    if (word == "liquidBridgeVolumeMax" && type.find("LiquidMigration") == type.npos)
        return "liquidBridgeVolume";
    const auto found = others.find(word);
    return std::string(found == others.end() ? word : found->second);
}

/// Parameters of laws of sintering that the kernel has not; with 0 they have no effect.
bool isOfOtherSintering(std::string_view word) {
    constexpr std::array<std::string_view, 5> words{"inverseSinterViscosity", "complianceZero", "surfTension",
                                                    "constantC1", "separationDis"};
    return std::ranges::count(words, word) > 0;
}

/// A static coefficient of friction that is the dynamic one, or a stiffness of sliding without a coefficient:
/// it has no effect, and laws that have no such field take it so. Throws InputError for a static coefficient
/// of rolling or torsion that is another one.
bool hasNoEffect(const Lines& lines, std::size_t word) {
    const std::string_view name = lines.all()[word];
    const double value = lines.parameterAt(word + 1);
    if (isOfOtherSintering(name)) return value == 0;
    const auto coefficient = [&](std::string_view of) -> std::optional<double> {
        if (of == "slidingFrictionCoefficient" && !lines.has(of)) of = "frictionCoefficient";
        const auto place = lines.behind(of);
        return place ? std::optional(lines.parameterAt(*place)) : std::nullopt;
    };
    if (name == "slidingStiffness") return value == 0 && coefficient("slidingFrictionCoefficient") == 0.0;
    constexpr std::string_view end = "Static";
    if (!name.ends_with(end)) return false;
    const std::string_view dynamic = name == "frictionCoefficientStatic"
                                         ? "slidingFrictionCoefficient"
                                         : name.substr(0, name.size() - end.size());
    if (coefficient(dynamic) == value) return true;
    if (!dynamic.starts_with("sliding"))
        lines.refuse(
            fmt::format("{} is not {}, and rolling and torsion have one coefficient here", name, dynamic));
    return false;
}

MercuryRestart::Species speciesOf(const Lines& lines) {
    std::string type(lines.first());
    if (const auto at = type.find("MixedSpecies"); at != type.npos) type.erase(at, 5);
    constexpr std::size_t mostWords = 1000;
    if (lines.all().size() > mostWords)
        lines.refuse(fmt::format("it has more than {} words, which no species has", mostWords));
    MercuryRestart::Species species{canonicalLawName(type), {}, lines.number()};
    for (std::size_t k = 1; k < lines.all().size();) {
        const std::string_view word = lines.all()[k];
        const std::size_t count = lines.countAt(k + 1);
        if (count == 0) lines.refuse(fmt::format("'{}' has no number behind it", shownName(word)));
        if (word != "id" && word != "idA" && word != "idB" && word != "idMixed" && !hasNoEffect(lines, k))
            species.fields.emplace_back(fieldOf(word, species.type), lines.parameterAt(k + 1));
        k += 1 + count;
    }
    return species;
}

/// The plane of an InfiniteWall of an older form: normal x y z position p, p along the normal.
SolidFace oldFaceAt(const Lines& lines, std::size_t normalAt, std::size_t positionAt) {
    const Vec3D normal = lines.vectorAt(normalAt);
    if (!(normal.norm() > 0)) lines.refuse("the normal of a wall is 0 0 0, which is no direction");
    if (lines.countAt(positionAt) >= 3) return {normal, lines.vectorAt(positionAt)};
    return {normal, lines.numberAt(positionAt) / normal.norm() * normal.normalized()};
}

SolidFace faceOfPlane(const Lines& lines) {
    const auto normal = lines.behind("normal"), position = lines.behindLast("position"),
               orientation = lines.behind("orientation");
    if (normal && position) {
        SolidFace face = oldFaceAt(lines, *normal, *position);
        // A form that has both: the place of the wall is that of the plane, or 0.
        if (lines.behind("position") != position)
            if (const Vec3D place = lines.vector("position"); place != Vec3D::Zero() && place != face.point)
                lines.refuse("the wall has two positions that differ");
        return face;
    }
    if (!orientation || !position)
        lines.refuse("the wall has neither orientation nor normal, or no position");
    return {lines.directionAt(*orientation), lines.vectorAt(*position)};
}

/// The planes of a wall of several, each with a position and an orientation (older: a normal).
std::vector<SolidFace> facesOf(const Lines& lines) {
    const std::string_view word =
        lines.has("numIntersectObjects") ? "numIntersectObjects" : "numIntersectionOfWalls";
    const std::uint64_t count = lines.count(word);
    std::size_t at = *lines.behind(word) + 1;
    std::vector<SolidFace> faces;
    for (std::uint64_t k = 0; k < count; ++k) {
        if (at >= lines.all().size()) lines.refuse(fmt::format("{} of its {} planes are there", k, count));
        if (lines.all()[at] == "normal") {
            faces.push_back(oldFaceAt(lines, at + 1, at + 5));
            at += 5 + lines.countAt(at + 5);
        } else {
            const Vec3D position = lines.vectorAt(at + 1);
            faces.push_back({lines.directionAt(at + 5), position});
            at += 9;
        }
    }
    return faces;
}

MercuryRestart::Wall::Shape shapeOf(const Lines& lines) {
    using Shape = MercuryRestart::Wall::Shape;
    if (lines.first() == "InfiniteWall") return Shape::Plane;
    if (lines.first() == "IntersectionOfWalls") return Shape::Solid;
    if (lines.first() == "AxisymmetricIntersectionOfWalls") return Shape::Axisymmetric;
    if (lines.first() == "numFiniteWalls" && lines.count("numFiniteWalls") == 0) return Shape::Plane;
    lines.refuse(fmt::format(
        "walls of the type '{}' are not taken over; set this one up in the driver, and delete it here",
        shownName(lines.first())));
}

/// The axis of a period. Throws InputError for one across another direction, or along its faces.
MercuryRestart::Period periodOf(const Lines& lines) {
    const auto sideOf = [&](std::initializer_list<std::string_view> names) {
        for (const std::string_view name : names)
            if (lines.has(name)) return lines.value(name);
        return lines.value(*names.begin());
    };
    const Vec3D normal = lines.vector("normal");
    MercuryRestart::Period period{-1, sideOf({"distanceLeft", "position_left", "pos_left"}),
                                  sideOf({"distanceRight", "position_right", "pos_right"})};
    for (int axis = 0; axis < 3; ++axis)
        if (normal == Vec3D::Unit(axis)) period.axis = axis;
    if (period.axis < 0)
        lines.refuse(
            fmt::format("a PeriodicBoundary has the normal ({}, {}, {}); taken over are those along an axis",
                        normal.x(), normal.y(), normal.z()));
    const double length = period.highest - period.lowest;
    const Vec3D along = length * normal, shift = lines.vector("shift", along);
    // The distances are written with so many digits, and their difference is not.
    const double largest = std::max(std::abs(period.lowest), std::abs(period.highest));
    if ((shift - along).norm() > 1e-6 * largest)
        lines.refuse(
            fmt::format("a PeriodicBoundary has the shift ({}, {}, {}) m, which must be its length, {} m, "
                        "along its normal",
                        shift.x(), shift.y(), shift.z(), length));
    return period;
}

constexpr std::size_t several = ~std::size_t{0};  // the place of an id that more than one has

void note(std::unordered_map<std::uint64_t, std::size_t>& places, std::uint64_t id, std::size_t place) {
    if (const auto [at, isNew] = places.try_emplace(id, place); !isNew) at->second = several;
}

/// A parameter of a deletion boundary that must be as it is here.
void requireActive(const Lines& lines) {
    if (lines.value("isActivated", 1) == 0)
        lines.refuse("a DeletionBoundary is not activated, which is not taken over");
}

}  // namespace

bool MercuryRestartObjects::isOfSpecies(const MercuryRestartLines& lines) const {
    if (isOld()) return lines.first() == "k" || lines.has("(mixed)");
    return lines.first().find("Species") != std::string_view::npos && lines.first() != "Species";
}

bool MercuryRestartObjects::addSpecies(const MercuryRestartLines& lines) {
    const bool isMarked = lines.first().find("Mixed") != std::string_view::npos || lines.has("idMixed") ||
                          lines.has("idA") || lines.has("(mixed)");
    if (isOld()) addOldSpecies(lines);
    else if (!isMarked && !allSpeciesAreThere) state->species.push_back(speciesOf(lines));
    else {
        MercuryRestart::Pair pair{0, 0, speciesOf(lines)};
        std::erase_if(pair.laws.fields, [](const auto& field) { return field.first == "density"; });
        if (const auto at = lines.behind("idMixed"))
            pair.a = lines.wholeAt(*at), pair.b = lines.wholeAt(*at + 1);
        else if (lines.has("idA")) pair.a = lines.count("idA"), pair.b = lines.count("idB");
        else if (state->species.size() == 2) pair.a = 1;  // an early form, without a name for it
        else lines.refuse("it is not said which two species this one is of");
        state->pairs.push_back(std::move(pair));
    }
    return !isMarked && !allSpeciesAreThere;
}

void MercuryRestartObjects::addWall(const MercuryRestartLines& lines) {
    MercuryRestart::Wall wall{.shape = shapeOf(lines),
                              .species = lines.count("indSpecies", 0),
                              .line = lines.number(),
                              .id = lines.count("id", state->walls.size()),
                              .faces = {}};
    using Shape = MercuryRestart::Wall::Shape;
    // Walls that only pictures have follow this word.
    if (!lines.has("renderedWalls"))
        lines.refuseOthers("the wall", {"id", "indSpecies", "position", "orientation", "velocity",
                                        "angularVelocity", "force", "torque", "normal", "factor",
                                        "vtkVisibility", "numIntersectionOfWalls", "numIntersectObjects"});
    else if (wall.shape != Shape::Plane)
        lines.refuse("the wall has 'renderedWalls', which are not taken over");
    wall.velocity = lines.vector("velocity", Vec3D::Zero());
    wall.spin = lines.spin("angularVelocity");
    if (wall.shape == Shape::Plane) {
        wall.faces = {faceOfPlane(lines)};
        wall.position = wall.faces[0].point;
    } else {
        wall.position = lines.vector("position");
        wall.faces = facesOf(lines);
        const std::size_t turn = lines.behind("orientation").value_or(lines.all().size());
        wall.axis = lines.directionAt(turn);
        if (wall.shape == Shape::Solid)
            for (SolidFace& face : wall.faces)
                face = {lines.turnedAt(turn, face.normal), lines.turnedAt(turn, face.point)};
    }
    note(placesOfWalls, wall.id, state->walls.size());
    state->walls.push_back(std::move(wall));
}

void MercuryRestartObjects::addBoundary(const MercuryRestartLines& lines) {
    const std::string_view type = lines.first();
    if (type == "PeriodicBoundary" || type == "normal") {
        lines.refuseOthers(type == "normal" ? "a period" : type,
                           {"id", "normal", "scaleFactor", "distanceLeft", "distanceRight", "shift",
                            "position_left", "position_right", "pos_left", "pos_right"});
        state->periods.push_back(periodOf(lines));
    } else if (type == "DeletionBoundary") {
        lines.refuseOthers(type, {"id", "normal", "scaleFactor", "distance", "isActivated",
                                  "numberOfParticlesDeleted", "massDeleted", "volumeDeleted"});
        requireActive(lines);
        state->deletions.push_back({lines.vector("normal"), lines.value("distance")});
    } else {
        lines.refuse(
            fmt::format("boundaries of the type '{}' are not taken over; set this one up in the driver, and "
                        "delete it here",
                        shownName(type)));
    }
}

void MercuryRestartObjects::addGrain(const MercuryRestartLines& lines) {
    if (isOld()) return addOldGrain(lines);
    const std::string_view type = lines.first();
    if (type != "BaseParticle" && type != "SphericalParticle" && type != "LiquidFilmParticle")
        lines.refuse(fmt::format("particles of the type '{}' are not taken over", shownName(type)));
    for (const std::string_view word : {"position", "velocity", "radius", "indSpecies"})
        if (!lines.has(word)) lines.refuse(fmt::format("the particle has no '{}'", word));
    lines.refuseOthers("the particle",
                       {"id", "indSpecies", "position", "orientation", "velocity", "angularVelocity", "force",
                        "torque", "radius", "invMass", "invInertia", "timeStamp", "liquidVolume"});
    constexpr double unsetMass = -1;
    if (lines.value("invMass", 0) < 0)
        lines.refuse(fmt::format("invMass is {}; it must be at least 0", lines.value("invMass")));
    note(placesOfGrains, lines.count("id", state->grains.size()), state->grains.size());
    state->grains.push_back({.row = {.radius = lines.value("radius"),
                                     .position = lines.vector("position"),
                                     .velocity = lines.vector("velocity"),
                                     .angularVelocity = lines.spin("angularVelocity"),
                                     .type = static_cast<int>(lines.count("indSpecies")) + 1},
                             .id = lines.count("id", state->grains.size()),
                             .inverseMass = lines.value("invMass", unsetMass),
                             .liquidVolume = lines.value("liquidVolume", 0),
                             .line = lines.number()});
}

void MercuryRestartObjects::addInteraction(const MercuryRestartLines& lines) {
    lines.refuseOthers(
        "a contact", {"particleIds", "particleWallIds", "timeStamp", "contactPoint", "force", "torque", "id",
                      "position", "overlap", "distance", "normal", "slidingSpring", "rollingSpring",
                      "torsionSpring", "maxOverlap", "plasticOverlap", "wasInContact", "bonded"});
    const bool isWithWall = lines.has("particleWallIds");
    const auto ids = lines.behind(isWithWall ? "particleWallIds" : "particleIds");
    if (!ids) lines.refuse("a contact has neither particleIds nor particleWallIds");
    const auto placeOf = [&](const Places& places, std::size_t at) {
        const double id = lines.numberAt(at);
        const auto found = id >= 0 && id < 1e18 ? places.find(static_cast<std::uint64_t>(id)) : places.end();
        const bool isOfWalls = &places == &placesOfWalls;
        const std::string_view kind = isOfWalls ? "wall" : "particle";
        // In files whose walls have no ids of their own (all have 0) contacts give the places of walls.
        if (isOfWalls && places.size() < state->walls.size() && id >= 0 &&
            id < static_cast<double>(state->walls.size()))
            return static_cast<std::size_t>(id);
        if (found == places.end()) lines.refuse(fmt::format("there is no {} with the id {}", kind, id));
        if (found->second == several)
            lines.refuse(fmt::format("there is more than one {} with the id {}", kind, id));
        return found->second;
    };
    const MercuryRestart::History contact{
        .first = placeOf(placesOfGrains, *ids),
        .second = placeOf(isWithWall ? placesOfWalls : placesOfGrains, *ids + 1),
        .isWithWall = isWithWall,
        .sliding = lines.vector("slidingSpring", Vec3D::Zero()),
        .rolling = lines.vector("rollingSpring", Vec3D::Zero()),
        .torsion = lines.vector("torsionSpring", Vec3D::Zero()),
        .flattening = lines.value("maxOverlap", lines.value("plasticOverlap", 0)),
        .isBonded = lines.value("bonded", 0) != 0,
        .isBridged = lines.value("wasInContact", 0) != 0,
        .line = lines.number()};
    state->histories.push_back(contact);
}

}  // namespace pendular
