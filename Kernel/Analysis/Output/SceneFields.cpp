#include "Kernel/Analysis/Output/SceneFields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "Kernel/Analysis/Output/BoxFields.h"
#include "Kernel/Analysis/Output/SceneBox.h"
#include "Kernel/Analysis/Output/ShapeFields.h"
#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Core/Walls/WallSurface.h"
#include "Kernel/Features/Wear/WornWall.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileName.h"
#include "Kernel/Scene/ListedContacts.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

namespace {

/// Adds the wear of each polygon, where a wall keeps it; zeros for walls that do not.
void addWear(PolyData& data, const WallHandler& walls, const std::vector<WallSurface>& surfaces) {
    const std::vector<NumberedWornWall> worn = wornWalls(walls);
    if (worn.empty()) return;
    const auto add = [&](std::string name, auto&& numberOf) {
        std::vector<double> numbers;
        auto next = worn.begin();
        for (std::size_t w = 0; w < surfaces.size(); ++w) {
            const bool wears = next != worn.end() && next->number == walls.present()[w].number;
            for (std::size_t k = 0; k < surfaces[w].polygons.size(); ++k)
                numbers.push_back(wears ? numberOf(next->wall->wearOf(k)) : 0);
            if (wears) ++next;
        }
        data.cellFields.push_back({std::move(name), 1, std::move(numbers)});
    };
    add("sliding_work_J", [](const SurfaceWear& wear) { return wear.slidingWork; });
    add("impact_work_J", [](const SurfaceWear& wear) { return wear.impactWork; });
    add("impacts", [](const SurfaceWear& wear) { return wear.impacts; });
    add("worn_volume_m3", [](const SurfaceWear& wear) { return wear.volume; });
    add("wear_depth_m", [](const SurfaceWear& wear) { return wear.volume / wear.area; });
}

/// Throws InputError unless a field of an output can have this name.
void requireFieldName(const std::string& name) {
    if (name.empty() || !isWord(name))
        throw InputError(
            fmt::format("The name '{}' of a field must have letters, digits and _ only (as speed_m_per_s).",
                        printable(name)));
}

/// Throws InputError where two fields of a frame have one name: a file cannot hold them.
void requireDistinctNames(const std::vector<PolyDataField>& fields, std::string_view owners) {
    for (std::size_t k = 0; k < fields.size(); ++k)
        for (std::size_t other = 0; other < k; ++other)
            if (fields[k].name == fields[other].name)
                throw InputError(fmt::format(
                    "The outputs have two fields '{}' of the {}; give the column or the field another name.",
                    fields[k].name, owners));
}

template <class Real>
PolyDataField fieldOf(const std::string& name, const FrameContent::GrainValue& valueOf,
                      const ParticleStore& grains) {
    std::vector<Real> numbers;
    const auto add = [&](double number) { numbers.push_back(static_cast<Real>(number)); };
    for (const std::uint32_t place : grains.place) {
        const std::size_t identity = grains.identity[place];
        if (const auto* const number = std::get_if<0>(&valueOf)) {
            add((*number)(identity));
        } else {
            const Eigen::Vector3d vector = std::get<1>(valueOf)(identity);
            for (int axis = 0; axis < 3; ++axis) add(vector[axis]);
        }
    }
    return {name, valueOf.index() == 0 ? 1u : 3u, std::move(numbers)};
}

/// The droplets of sprays in flight, in the order in which they came out.
template <class Real>
PolyData dropletPoints(const SprayHandler& sprays) {
    PolyData data;
    std::vector<Real> radii, velocities, volumes;
    std::vector<std::int32_t> numbers;
    for (const Droplet& droplet : sprays.droplets()) {
        data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
        data.points.push_back(droplet.position);
        radii.push_back(static_cast<Real>(droplet.radius));
        volumes.push_back(static_cast<Real>(droplet.volume));
        numbers.push_back(static_cast<std::int32_t>(droplet.spray));
        for (const auto axis : vectorAxes) velocities.push_back(static_cast<Real>(droplet.velocity.*axis));
    }
    if (!data.corners.empty()) data.ends = {static_cast<std::int32_t>(data.corners.size())};
    data.pointFields = {{"radius_m", 1, std::move(radii)},
                        {"velocity_m_per_s", 3, std::move(velocities)},
                        {"volume_m3", 1, std::move(volumes)},
                        {"spray", 1, std::move(numbers)}};
    return data;
}

using AddedFields = std::vector<std::pair<std::string, FrameContent::GrainValue>>;

template <class Real>
SceneFrame frameOf(const FrameContent& content, const AddedFields& added, const Scene& scene, SceneBox& box) {
    const auto& store = scene.particleHandler.store();
    const bool withBodies = scene.contacts().ranks().any(!store.bodies.empty());
    SceneFrame frame{.step = scene.getNumberOfTimeSteps(),
                     .time = scene.getTime(),
                     .grains = grainPoints<Real>(store, scene.laws(), withBodies),
                     .contacts = {},
                     .walls = {},
                     .shapes = {},
                     .droplets = {}};
    for (const auto& [name, valueOf] : added)
        frame.grains.pointFields.push_back(fieldOf<Real>(name, valueOf, store));
    if (content.stress)
        frame.grains.pointFields.push_back(grainStresses<Real>(scene.contacts(), store, scene.laws()));
    if (content.contacts)
        frame.contacts =
            contactLines<Real>(scene.contacts(), store, scene.laws(),
                               content.contactPoints || scene.laws().shapes(), scene.getNumberOfThreads());
    if (const GrainShapes* const shapes = scene.laws().shapes()) {
        addShapeFields(store, *shapes, frame.grains);
        frame.shapes = shapeSurfaces(store, *shapes);
    }
    frame.grains.wholeFields = boxFields(boxOfContacts(scene));
    requireDistinctNames(frame.grains.pointFields, "grains");
    if (frame.contacts) requireDistinctNames(frame.contacts->cellFields, "contacts");
    if (scene.wallHandler.getSize() > 0) {  // also where all were removed: each frame has the same files
        box.take(scene);
        const Vector<double>& period = boxOfContacts(scene).length;
        frame.walls = wallPolygons(scene.wallHandler, box.box().lowest, box.box().highest,
                                   {period.x > 0, period.y > 0, period.z > 0});
    }
    if (!scene.sprayHandler.isEmpty()) frame.droplets = dropletPoints<Real>(scene.sprayHandler);
    return frame;
}

}  // namespace

PolyData wallPolygons(const WallHandler& walls, const Vector<double>& lowest, const Vector<double>& highest,
                      std::array<bool, 3> isPeriod) {
    PolyData data;
    data.kind = PolyData::Cells::Polygons;
    std::vector<std::int32_t> numbers, species;
    const std::vector<WallSurface> surfaces = surfacesOf(walls, lowest, highest, isPeriod);
    for (std::size_t w = 0; w < surfaces.size(); ++w)
        for (const Polygon& polygon : surfaces[w].polygons) {
            for (const Vector<double>& corner : polygon) {
                data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
                data.points.push_back(corner);
            }
            data.ends.push_back(static_cast<std::int32_t>(data.corners.size()));
            numbers.push_back(static_cast<std::int32_t>(walls.present()[w].number));
            species.push_back(walls.present()[w].object->getSpeciesIndex());
        }
    data.cellFields = {{"wall", 1, std::move(numbers)}, {"species", 1, std::move(species)}};
    addWear(data, walls, surfaces);
    return data;
}

void FrameContent::addField(std::string name, GrainValue valueOf) {
    requireFieldName(name);
    added.emplace_back(std::move(name), std::move(valueOf));
}

SceneFrame FrameContent::of(const Scene& scene, SceneBox& box) const {
    return doubles ? frameOf<double>(*this, added, scene, box) : frameOf<float>(*this, added, scene, box);
}

SceneFrame FrameContent::of(const Scene& scene) const {
    SceneBox box;
    return of(scene, box);
}

}  // namespace pendular
