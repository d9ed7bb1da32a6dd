#include "Kernel/Mercury/MercuryRestartScene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "Kernel/Foundation/Base/FullStop.h"
#include "Kernel/Foundation/Files/FileName.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Mercury/MercuryRestartLines.h"

namespace pendular {
namespace {

/// What the kernel refuses, with the line of the file.
template <class Action>
void atLine(const MercuryRestart& state, std::size_t line, Action&& action) {
    try {
        action();
    } catch (const InputError& refusal) {
        state.refuse(line, withoutFullStop(refusal.what()));
    }
}

void requireType(const MercuryRestart& state, const MercuryRestart::Species& species) {
    try {
        static_cast<void>(speciesTypeNamed(species.type));
    } catch (const InputError&) {
        state.refuse(species.line,
                     fmt::format("this program has no species type '{0}'; if the kernel has its laws, call "
                                 "registerSpecies<{0}>() (SpeciesRegistry.h) before",
                                 shownName(species.type)));
    }
}

void setFields(AnyLaws& laws, const MercuryRestart::Species& species) {
    for (const auto& [field, value] : species.fields) laws.set(field, value);
}

template <class Solid>
Solid solidOf(const MercuryRestart::Wall& wall, const AnySpecies* species) {
    Solid solid;
    for (const SolidFace& face : wall.faces) solid.addObject(face.normal, face.point);
    solid.setSpecies(species);
    solid.setPosition(wall.position);
    solid.setVelocity(wall.velocity);
    solid.setAngularVelocity(wall.spin);
    if constexpr (requires { solid.setAxis(wall.axis); }) solid.setAxis(wall.axis);
    return solid;
}

void addPlane(const MercuryRestart::Wall& wall, const AnySpecies* species, MercuryWallHandler& walls) {
    InfiniteWall plane(wall.faces[0].normal, wall.faces[0].point, species);
    if (wall.velocity != Vec3D::Zero()) plane.setVelocity(wall.velocity);
    if (wall.spin != Vec3D::Zero()) plane.setAngularVelocity(wall.spin, wall.position);
    walls.copyAndAddObject(plane);
}

/// kg, that of the species' density. Files that were written by hand have it to a few digits; one that
/// differs by more was set for the particle alone.
void requireMass(const MercuryRestart& state, const MercuryRestart::Grain& grain, double mass) {
    if (!(grain.inverseMass > 0) || std::abs(grain.inverseMass * mass - 1) < 1e-5) return;
    state.refuse(grain.line,
                 fmt::format("the particle {} has a mass of {:.9g} kg, and by the density of its species "
                             "{:.9g} kg; particles have the density of their species",
                             grain.id, 1 / grain.inverseMass, mass));
}

/// m, of the surfaces of the bodies of a contact, at the nearest image.
double gapOf(const MercuryRestart& state, const MercuryRestart::History& one) {
    const GrainRow& first = state.grains[one.first].row;
    if (one.isWithWall) {
        const MercuryRestart::Wall& wall = state.walls[one.second];
        const SolidFace& face = wall.faces[0];
        // Of a wall of several planes it is not known here.
        if (wall.shape != MercuryRestart::Wall::Shape::Plane) return 0;
        return (face.point - first.position).dot(face.normal.normalized()) - first.radius;
    }
    const GrainRow& second = state.grains[one.second].row;
    Vec3D shift = second.position - first.position;
    for (const MercuryRestart::Period& period : state.periods) {
        const double length = period.highest - period.lowest;
        shift[period.axis] -= length * std::round(shift[period.axis] / length);
    }
    return shift.norm() - first.radius - second.radius;
}

}  // namespace

void requireNoSpecies(const MercuryRestart& state, const SeveralSpeciesHandler& species) {
    if (species.isEmpty()) return;
    throw InputError(fmt::format(
        "The restart file {} has species of its own, and the scene has {} already; read it into a scene "
        "without species, and add what else the scene has after it.",
        state.file.string(), species.getSize()));
}

std::string nameInFolder(const MercuryRestart& state, const Logger& logger) {
    const std::filesystem::path name = state.name;
    const bool leadsOut = name.is_absolute() || std::any_of(name.begin(), name.end(),
                                                            [](const auto& part) { return part == ".."; });
    if (!leadsOut) return state.name;
    logger(
        LogLevel::Warn,
        "The name '{}' of the restart file leads out of this folder; the run is named '{}', or as setName() "
        "says.",
        printable(state.name), printable(name.filename().string()));
    return name.filename().string();
}

void addSpeciesOf(const MercuryRestart& state, SeveralSpeciesHandler& species) {
    for (const MercuryRestart::Species& one : state.species) requireType(state, one);
    for (const MercuryRestart::Pair& pair : state.pairs) requireType(state, pair.laws);
    for (const MercuryRestart::Species& one : state.species)
        atLine(state, one.line, [&] { setFields(*species.addByName(one.type), one); });
    for (const MercuryRestart::Pair& pair : state.pairs)
        atLine(state, pair.laws.line, [&] {
            setFields(*species.setPairTypeByName(static_cast<int>(pair.a), static_cast<int>(pair.b),
                                                 pair.laws.type),
                      pair.laws);
        });
}

std::vector<std::size_t> addWallsOf(const MercuryRestart& state, const SeveralSpeciesHandler& species,
                                    MercuryWallHandler& walls) {
    using Shape = MercuryRestart::Wall::Shape;
    const WallHandler& all = walls;
    std::vector<std::size_t> numbers;
    for (const MercuryRestart::Wall& wall : state.walls)
        atLine(state, wall.line, [&] {
            const AnySpecies* const of = species.getObject(wall.species);
            if (wall.shape == Shape::Plane) addPlane(wall, of, walls);
            else if (wall.shape == Shape::Solid)
                walls.copyAndAddObject(solidOf<IntersectionOfWalls>(wall, of));
            else walls.copyAndAddObject(solidOf<AxisymmetricIntersectionOfWalls>(wall, of));
            numbers.push_back(all.present().back().number);
        });
    return numbers;
}

void addBoundariesOf(const MercuryRestart& state, MercuryBoundaryHandler& boundaries) {
    for (const MercuryRestart::Period& period : state.periods) {
        PeriodicBoundary boundary;
        boundary.set(Vec3D::Unit(period.axis), period.lowest, period.highest);
        boundaries.copyAndAddObject(boundary);
    }
    for (const MercuryRestart::Deletion& deletion : state.deletions) {
        DeletionBoundary boundary;
        boundary.set(deletion.normal, deletion.distance);
        boundaries.copyAndAddObject(boundary);
    }
}

std::vector<std::uint32_t> addGrainsOf(const MercuryRestart& state, const SeveralSpeciesHandler& species,
                                       ParticleHandler& particles) {
    particles.reserve(particles.getSize() + state.grains.size());
    std::vector<std::uint32_t> identities;
    for (const MercuryRestart::Grain& grain : state.grains)
        atLine(state, grain.line, [&] {
            SphericalParticle one(species.getObject(static_cast<std::size_t>(grain.row.type - 1)));
            one.setRadius(grain.row.radius);
            one.setPosition(grain.row.position);
            one.setLiquidVolume(grain.liquidVolume);
            if (grain.inverseMass == 0) one.fixParticle();
            else one.setVelocity(grain.row.velocity), one.setAngularVelocity(grain.row.angularVelocity);
            GrainReference added = particles.copyAndAddObject(one);
            if (one.isFixed()) {  // it moves with the velocity that it has
                added.setVelocity(grain.row.velocity);
                added.setAngularVelocity(grain.row.angularVelocity);
            }
            requireMass(state, grain, particles.massOf(one.getRadius(), one.getSpeciesIndex()));
            identities.push_back(added.getId());
        });
    return identities;
}

void requireTouchingBridges(const MercuryRestart& state) {
    for (const MercuryRestart::History& one : state.histories)
        if (one.isBridged)
            if (const double gap = gapOf(state, one); gap > 0)
                state.refuse(
                    one.line,
                    fmt::format("a contact has 'wasInContact' = 1 at a gap of {:.6g} m, a bridge that "
                                "is stretched, which is not taken over",
                                gap));
}

MercuryHistories::OfContact historyOf(const MercuryRestart::History& one,
                                      const std::vector<std::uint32_t>& grains,
                                      const std::vector<std::size_t>& walls) {
    MercuryHistories::OfContact contact{.first = grains[one.first],
                                        .sliding = toVector(one.sliding),
                                        .rolling = toVector(one.rolling),
                                        .torsion = toVector(one.torsion),
                                        .flattening = one.flattening};
    if (one.isWithWall) contact.wall = static_cast<std::int32_t>(walls[one.second]);
    else contact.second = grains[one.second];
    return contact;
}

}  // namespace pendular
