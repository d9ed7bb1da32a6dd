#include <fmt/format.h>

#include <span>
#include <utility>

#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Analysis/Output/VtkDocument.h"
#include "Kernel/Analysis/Output/XmlText.h"

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

VtkDocument documentOf(const PolyData& data, int threads) {
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
    return document;
}

}  // namespace

void writePolyData(const std::filesystem::path& path, const PolyData& data, int threads) {
    documentOf(data, threads).write(path);
}

void writePolyData(WrittenBeside& file, const PolyData& data, int threads) {
    documentOf(data, threads).write(file);
}

void writePieces(const std::filesystem::path& path, const PolyData& like,
                 const std::vector<std::string>& pieces) {
    const auto describe = [](std::string_view section, const std::vector<PolyDataField>& fields) {
        std::string text = fmt::format("<{}>\n", section);
        for (const PolyDataField& field : fields)
            std::visit(
                [&]<class Number>(const std::vector<Number>&) {
                    text += fmt::format("<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n",
                                        VtkDocument::typeName<Number>(), field.name, field.components);
                },
                field.numbers);
        return text + fmt::format("</{}>\n", section);
    };
    WrittenBeside file(path);
    file.write(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"1.0\">\n"
        "<PPolyData GhostLevel=\"0\">\n");
    file.write(describe("PPointData", like.pointFields));
    file.write(describe("PCellData", like.cellFields));
    file.write(describe("PPoints", {{"Points", 3, std::vector<double>{}}}));
    for (const std::string& piece : pieces)
        file.write(fmt::format("<Piece Source=\"{}\"/>\n", escaped(piece)));
    file.write("</PPolyData>\n</VTKFile>\n");
    file.close();
}

}  // namespace pendular
