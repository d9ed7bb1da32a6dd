#pragma once

#include <fmt/format.h>

#include <bit>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Analysis/Output/Compression.h"
#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Foundation/Files/WrittenBeside.h"

namespace pendular {

/// A file of VTK's XML format, version 1.0: the XML, and the data that it refers to by its offset, binary in
/// this machine's byte order behind the XML ("appended", "raw"), compressed by zlib. Source: the VTK file
/// formats, "XML file formats".
class VtkDocument {
public:
    /// @param type "PolyData"; @param time s; @param whole fields of the whole
    /// @param threadCount that compress; the file does not depend on it
    VtkDocument(std::string_view type, double time, std::string_view attributes, int threadCount,
                const std::vector<PolyDataField>& whole = {})
        : threads(threadCount), kind(type) {
        xml = fmt::format(
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"{1}\" header_type=\"UInt64\" "
            "compressor=\"vtkZLibDataCompressor\">\n"
            "<{0}{2}>\n"
            "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
            "format=\"ascii\">{3}</DataArray>\n",
            type, std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", attributes,
            time);
        for (const PolyDataField& field : whole) {
            xml += fmt::format(
                "<DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"{}\" NumberOfComponents=\"{}\" "
                "format=\"ascii\">",
                field.name, field.size() / field.components, field.components);
            for (std::size_t k = 0; k < field.size(); ++k)
                xml += fmt::format("{}{}", k ? " " : "", field.at(k));
            xml += "</DataArray>\n";
        }
        xml += "</FieldData>\n";
    }

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
                [&](const auto& numbers) {
                    addArray(field.name, field.components, std::span(std::as_const(numbers)));
                },
                field.numbers);
        xml += fmt::format("</{}>\n", section);
    }
    void write(const std::filesystem::path& path) const {
        WrittenBeside file(path);
        write(file);
        file.close();
    }
    void write(WrittenBeside& file) const {
        file.write(xml);
        file.write(fmt::format("</{}>\n", kind));
        file.write("<AppendedData encoding=\"raw\">\n_");
        for (const std::string& array : appended) file.write(array);
        file.write("\n</AppendedData>\n</VTKFile>\n");
    }

    template <class Number>
    static constexpr std::string_view typeName() {
        if constexpr (std::is_same_v<Number, float>) return "Float32";
        else if constexpr (std::is_same_v<Number, double>) return "Float64";
        else return "Int32";
    }

private:
    int threads;
    std::string kind, xml;
    std::vector<std::string> appended;
    std::size_t appendedSize = 0;  // bytes
};

}  // namespace pendular
