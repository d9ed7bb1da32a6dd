#include <fmt/format.h>

#include <span>
#include <utility>

#include "Kernel/Output/PolyData.h"
#include "Kernel/Output/VtkDocument.h"

namespace pendular {

namespace {

void addCells(VtkDocument& document, const PolyData& data) {
    constexpr std::string_view sections[] = {"Verts", "Lines", "Polys"};
    const std::string_view section = sections[static_cast<int>(data.kind)];
    document.add(fmt::format("<{}>\n", section));
    document.addArray("connectivity", 1, std::span(data.corners));
    document.addArray("offsets", 1, std::span(data.ends));
    document.add(fmt::format("</{}>\n", section));
}

}  // namespace

void writePolyData(const std::filesystem::path& path, const PolyData& data, int threads) {
    static_assert(sizeof(Vector<double>) == 3 * sizeof(double));
    const auto countOf = [&](PolyData::Cells kind) { return data.kind == kind ? data.ends.size() : 0; };
    VtkDocument document("PolyData", data.time, "", threads, data.wholeFields);
    document.add(fmt::format(
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"{}\">\n",
        data.points.size(), countOf(PolyData::Cells::Vertices), countOf(PolyData::Cells::Lines),
        countOf(PolyData::Cells::Polygons)));
    document.addFields("PointData", data.pointFields);
    document.addFields("CellData", data.cellFields);
    document.add("<Points>\n");
    document.addArray("Points", 3,
                      std::span(reinterpret_cast<const double*>(data.points.data()), 3 * data.points.size()));
    document.add("</Points>\n");
    addCells(document, data);
    document.add("</Piece>\n");
    document.write(path);
}

}  // namespace pendular
