#include "Kernel/Output/SceneFields.h"

#include "Kernel/Walls/WallHandler.h"

namespace pendular {

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
    return data;
}

}  // namespace pendular
