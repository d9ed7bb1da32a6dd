#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

class WrittenBeside;

/// The numbers of the points or of the cells, under a name that ends with the unit: "radius_m".
struct PolyDataField {
    using Numbers = std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>>;

    std::string name;
    std::size_t components = 1;  // 3: vectors, 9: tensors, row by row
    Numbers numbers;

    [[nodiscard]] std::size_t size() const {
        return std::visit([](const auto& n) { return n.size(); }, numbers);
    }
    [[nodiscard]] double at(std::size_t k) const {
        return std::visit([k](const auto& n) { return static_cast<double>(n[k]); }, numbers);
    }
};

/// Points with numbers, and cells of one kind that join them: what a file of VTK's kind "PolyData" holds.
struct PolyData {
    enum class Cells { Vertices, Lines, Polygons };

    double time = 0;                     // s
    std::vector<Vector<double>> points;  // m
    Cells kind = Cells::Vertices;
    std::vector<std::int32_t> corners;  // of the cells one after another: places in `points`
    std::vector<std::int32_t> ends;     // of each cell in `corners`
    std::vector<PolyDataField> pointFields, cellFields;
    std::vector<PolyDataField> wholeFields;  // numbers of the whole, a few

    /// The field of this name, or nothing.
    [[nodiscard]] const PolyDataField* pointField(std::string_view name) const {
        return find(pointFields, name);
    }
    [[nodiscard]] const PolyDataField* cellField(std::string_view name) const {
        return find(cellFields, name);
    }
    [[nodiscard]] const PolyDataField* wholeField(std::string_view name) const {
        return find(wholeFields, name);
    }

private:
    static const PolyDataField* find(const std::vector<PolyDataField>& fields, std::string_view name) {
        for (const PolyDataField& field : fields)
            if (field.name == name) return &field;
        return nullptr;
    }
};

/// Writes a .vtp file: VTK XML, version 1.0, binary data of this machine's byte order behind the XML
/// ("appended", "raw"), compressed by zlib. Source: the VTK file formats, "XML file formats".
/// @param threads that compress; the file does not depend on it
/// Throws InputError if the file cannot be written.
void writePolyData(const std::filesystem::path& path, const PolyData& data, int threads = 1);

/// The same into a file that is completed later.
void writePolyData(WrittenBeside& file, const PolyData& data, int threads = 1);
/// Writes a .pvtp file: the names of files beside it that are one thing together.
/// @param like one of them, which all have the same fields
void writePieces(const std::filesystem::path& path, const PolyData& like,
                 const std::vector<std::string>& pieces);

/// Reads what writePolyData() writes, and no other form of VTK's files; of a .pvtp file all pieces, points in
/// the order of their identities and contacts in that of their particle1, as they are in one file. Throws
/// InputError with the file and the reason.
PolyData readPolyData(const std::filesystem::path& path);

}  // namespace pendular
