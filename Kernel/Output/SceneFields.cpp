#include "Kernel/Output/SceneFields.h"

#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Files/FileName.h"
#include "Kernel/InputError.h"
#include "Kernel/Walls/WornWall.h"

namespace pendular {
namespace {

/// Of each polygon, where a wall keeps its wear; zeros of walls that do not.
void addWear(PolyData& data, const WallHandler& walls, const std::vector<WallSurface>& surfaces) {
    const std::vector<WornWall*> worn = wornWalls(walls);
    if (std::ranges::count(worn, nullptr) == std::ssize(worn)) return;
    const auto add = [&](std::string name, auto&& numberOf) {
        std::vector<double> numbers;
        for (std::size_t w = 0; w < worn.size(); ++w)
            for (std::size_t k = 0; k < surfaces[w].polygons.size(); ++k)
                numbers.push_back(worn[w] ? numberOf(worn[w]->wearOf(k)) : 0);
        data.cellFields.push_back({std::move(name), 1, std::move(numbers)});
    };
    add("sliding_work_J", [](const SurfaceWear& wear) { return wear.slidingWork; });
    add("impact_work_J", [](const SurfaceWear& wear) { return wear.impactWork; });
    add("impacts", [](const SurfaceWear& wear) { return wear.impacts; });
    add("worn_volume_m3", [](const SurfaceWear& wear) { return wear.volume; });
    add("wear_depth_m", [](const SurfaceWear& wear) { return wear.volume / wear.area; });
}

}  // namespace

void requireFieldName(const std::string& name) {
    if (name.empty() || !isWord(name))
        throw InputError(
            fmt::format("The name '{}' of a field must have letters, digits and _ only (as speed_m_per_s).",
                        printable(name)));
}

PolyData wallPolygons(const WallHandler& walls, const Vector<double>& lowest, const Vector<double>& highest) {
    PolyData data;
    data.kind = PolyData::Cells::Polygons;
    std::vector<std::int32_t> numbers, species;
    const std::vector<WallSurface> surfaces = surfacesOf(walls, lowest, highest);
    for (std::size_t w = 0; w < surfaces.size(); ++w)
        for (const Polygon& polygon : surfaces[w].polygons) {
            for (const Vector<double>& corner : polygon) {
                data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
                data.points.push_back(corner);
            }
            data.ends.push_back(static_cast<std::int32_t>(data.corners.size()));
            numbers.push_back(static_cast<std::int32_t>(w));
            species.push_back(walls.getObject(w).species);
        }
    data.cellFields = {{"wall", 1, std::move(numbers)}, {"species", 1, std::move(species)}};
    addWear(data, walls, surfaces);
    return data;
}

}  // namespace pendular
