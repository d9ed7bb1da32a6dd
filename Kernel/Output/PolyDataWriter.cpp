#include <fmt/format.h>

#include <bit>
#include <span>

#include "Kernel/Files/WrittenBeside.h"
#include "Kernel/Output/Compression.h"
#include "Kernel/Output/PolyData.h"

namespace pendular {

namespace {

template <class Number>
constexpr std::string_view typeName() {
    if constexpr (std::is_same_v<Number, float>) return "Float32";
    else if constexpr (std::is_same_v<Number, double>) return "Float64";
    else return "Int32";
}

/// The XML, and the data that it refers to by its offset.
class Document {
public:
    explicit Document(int threadCount) : threads(threadCount) {}

    void add(std::string_view text) { xml += text; }

    template <class Number>
    void addArray(std::string_view name, std::size_t components, std::span<const Number> numbers) {
        xml += fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            typeName<Number>(), name, components, appendedSize);
        appended.push_back(compressInBlocks(std::as_bytes(numbers), threads));
        appendedSize += appended.back().size();
    }
    void addFields(std::string_view section, const std::vector<PolyDataField>& fields) {
        xml += fmt::format("<{}>\n", section);
        for (const PolyDataField& field : fields)
            std::visit(
                [&](const auto& numbers) { addArray(field.name, field.components, std::span(numbers)); },
                field.numbers);
        xml += fmt::format("</{}>\n", section);
    }
    void addCells(const PolyData& data) {
        constexpr std::string_view sections[] = {"Verts", "Lines", "Polys"};
        const std::string_view section = sections[static_cast<int>(data.kind)];
        xml += fmt::format("<{}>\n", section);
        addArray("connectivity", 1, std::span(data.corners));
        addArray("offsets", 1, std::span(data.ends));
        xml += fmt::format("</{}>\n", section);
    }

    void write(const std::filesystem::path& path) const {
        WrittenBeside file(path);
        file.write(xml);
        file.write("<AppendedData encoding=\"raw\">\n_");
        for (const std::string& array : appended) file.write(array);
        file.write("\n</AppendedData>\n</VTKFile>\n");
        file.close();
    }

private:
    template <class Number>
    void addArray(std::string_view name, std::size_t components, std::span<Number> numbers) {
        addArray(name, components, std::span<const Number>(numbers));
    }

    int threads;
    std::string xml;
    std::vector<std::string> appended;
    std::size_t appendedSize = 0;  // bytes
};

}  // namespace

void writePolyData(const std::filesystem::path& path, const PolyData& data, int threads) {
    static_assert(sizeof(Vector<double>) == 3 * sizeof(double));
    const auto countOf = [&](PolyData::Cells kind) { return data.kind == kind ? data.ends.size() : 0; };
    Document document(threads);
    document.add(fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\" "
        "compressor=\"vtkZLibDataCompressor\">\n"
        "<PolyData>\n"
        "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
        "format=\"ascii\">{}</DataArray>\n</FieldData>\n"
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"{}\">\n",
        std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", data.time,
        data.points.size(), countOf(PolyData::Cells::Vertices), countOf(PolyData::Cells::Lines),
        countOf(PolyData::Cells::Polygons)));
    document.addFields("PointData", data.pointFields);
    document.addFields("CellData", data.cellFields);
    document.add("<Points>\n");
    document.addArray("Points", 3,
                      std::span(reinterpret_cast<const double*>(data.points.data()), 3 * data.points.size()));
    document.add("</Points>\n");
    document.addCells(data);
    document.add("</Piece>\n</PolyData>\n");
    document.write(path);
}

}  // namespace pendular
