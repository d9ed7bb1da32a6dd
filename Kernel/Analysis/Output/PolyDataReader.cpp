#include <algorithm>
#include <stdexcept>
#include <utility>

#include "Kernel/Analysis/Output/FrameParts.h"
#include "Kernel/Analysis/Output/JoinPieces.h"
#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Analysis/Output/VtkArrays.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileContent.h"
#include "Kernel/Foundation/Files/OwnFile.h"
#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {

namespace {

/// The arrays of a file, taken tag by tag.
class PolyDataParser {
public:
    explicit PolyDataParser(std::string_view text) : arrays(text) {
        for (const vtk::Tag& tag : arrays.tags) take(tag);
        requireWhole();
    }

    PolyData result;

private:
    void take(const vtk::Tag& tag) {
        if (tag.name == "VTKFile") vtk::Arrays::checkForm(tag, "PolyData");
        else if (tag.name == "Piece") takeCounts(tag);
        else if (tag.name == "DataArray") takeArray(tag);
        else if (tag.name != "/DataArray") section = tag.name;
    }
    /// Refuses a file that has not as many points, cells and values as it says, in whatever order it says it.
    void requireWhole() const {
        const auto fit = [](const std::vector<PolyDataField>& fields, std::size_t count) {
            return std::all_of(fields.begin(), fields.end(), [&](const PolyDataField& field) {
                return field.size() == count * field.components;
            });
        };
        const std::size_t there = result.points.size();
        if (there != points || result.ends.size() != cells || !fit(result.pointFields, there) ||
            !fit(result.cellFields, cells) ||
            std::any_of(result.corners.begin(), result.corners.end(),
                        [&](std::int32_t corner) { return static_cast<std::size_t>(corner) >= there; }))
            throw std::runtime_error("has arrays of the wrong size");
    }
    void takeCounts(const vtk::Tag& tag) {
        points = vtk::countIn(tag, "NumberOfPoints");
        constexpr const char* names[] = {"NumberOfVerts", "NumberOfLines", "NumberOfPolys"};
        for (int kind = 0; kind < 3; ++kind)
            if (const std::size_t count = vtk::countIn(tag, names[kind])) {
                cells = count;
                result.kind = static_cast<PolyData::Cells>(kind);
            }
    }
    void takeArray(const vtk::Tag& tag) {
        const std::string_view name = vtk::valueOf(tag, "Name");
        if (section == "FieldData") {
            if (name == "TimeValue") result.time = vtk::timeOf(tag);
            else result.wholeFields.push_back({std::string(name), 1, vtk::wordsOf(name, tag.behind)});
        } else if (section == "PointData") {
            result.pointFields.push_back(arrays.field(tag, points));
        } else if (section == "CellData") {
            result.cellFields.push_back(arrays.field(tag, cells));
        } else if (section == "Points") {
            const PolyDataField read = arrays.field(tag, points);
            if (read.components != 3) throw std::runtime_error("has points without three coordinates");
            for (std::size_t k = 0; k < points; ++k)
                result.points.push_back({read.at(3 * k), read.at(3 * k + 1), read.at(3 * k + 2)});
        } else if (section == "Verts" || section == "Lines" || section == "Polys") {
            if (cells > 0 && name == "connectivity") connectivity = tag;
            if (cells > 0 && name == "offsets") takeCells(tag);
        }
    }
    void takeCells(const vtk::Tag& offsets) {
        result.ends = arrays.numbers<std::int32_t>(offsets, cells);
        std::int32_t last = 0;
        for (const std::int32_t end : result.ends)
            if (end < std::exchange(last, end)) throw std::runtime_error("has cells with falling offsets");
        result.corners = arrays.numbers<std::int32_t>(connectivity, static_cast<std::size_t>(last));
        for (const std::int32_t corner : result.corners)
            if (corner < 0 || static_cast<std::size_t>(corner) >= points)
                throw std::runtime_error("has a cell with a corner that is no point");
    }

    vtk::Arrays arrays;
    std::string_view section;
    std::size_t points = 0, cells = 0;
    vtk::Tag connectivity;
};

}  // namespace

PolyData readPolyData(const std::filesystem::path& path) {
    const InputFile file = loadInputFile("VTK file", path);
    if (recognise(file.text).content == FileContent::NoText) refuseOtherContent(file);
    try {
        if (path.extension() != ".pvtp") return std::move(PolyDataParser(file.text).result);
        std::vector<PolyData> pieces;
        for (const std::string& name : pieceNames(file.text)) {
            requireOwnIfThere(path.parent_path() / name);
            pieces.push_back(readPolyData(path.parent_path() / name));
        }
        return joined(std::move(pieces));
    } catch (const InputError&) {
        throw;  // of a piece
    } catch (const std::runtime_error& problem) {
        file.refuse(problem.what());
    }
}

}  // namespace pendular
