#include "Kernel/Analysis/Output/Hdf5Frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <variant>

#include "Kernel/Analysis/Output/Hdf5Columns.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileName.h"

namespace pendular {

namespace {

/// The columns of one group of a frame.
class Group {
public:
    Group(const Hdf5File& from, std::string_view group)
        : file(from), name(group), columns(readColumns(from, name)) {}

    [[nodiscard]] bool isEmpty() const { return columns.empty(); }
    /// Takes a column out. Throws InputError unless it is there with so many numbers to a row.
    PolyDataField take(std::string_view wanted, std::size_t components) {
        const auto found = std::ranges::find(columns, wanted, &PolyDataField::name);
        if (found == columns.end() || found->components != components)
            refuse(
                fmt::format("no {} of {} number{} to a row", wanted, components, components > 1 ? "s" : ""));
        PolyDataField column = std::move(*found);
        columns.erase(found);
        return column;
    }
    std::vector<Vector<double>> takePoints(std::string_view wanted) {
        const PolyDataField column = take(wanted, 3);
        std::vector<Vector<double>> points;
        for (std::size_t k = 0; k < column.size(); k += 3)
            points.push_back({column.at(k), column.at(k + 1), column.at(k + 2)});
        return points;
    }
    /// What is left. Throws InputError unless each column has so many rows.
    std::vector<PolyDataField> rest(std::size_t rows) {
        for (const PolyDataField& column : columns)
            if (column.size() != rows * column.components)
                refuse(
                    fmt::format("a column {} that is longer or shorter than others", printable(column.name)));
        return std::move(columns);
    }
    [[noreturn]] void refuse(std::string_view what) const {
        throw InputError(
            fmt::format("The file {} is no frame of a run: {} has {}.", file.path().string(), name, what));
    }

private:
    const Hdf5File& file;
    std::string name;
    std::vector<PolyDataField> columns;
};

/// All points are one cell.
PolyData pointsOf(Group group) {
    PolyData data;
    data.points = group.takePoints("position_m");
    data.pointFields = group.rest(data.points.size());
    data.corners.resize(data.points.size());
    std::iota(data.corners.begin(), data.corners.end(), 0);
    if (!data.corners.empty()) data.ends = {static_cast<std::int32_t>(data.corners.size())};
    return data;
}

/// One whole number to a row; nothing where a field has others.
const std::vector<std::int32_t>* wholesOf(const PolyDataField* field) {
    return field && field->components == 1 ? std::get_if<std::vector<std::int32_t>>(&field->numbers)
                                           : nullptr;
}

PolyData linesOf(Group group, const PolyData& grains) {
    std::unordered_map<std::int32_t, std::size_t> rows;
    if (const auto* const identities = wholesOf(grains.pointField("identity")))
        for (std::size_t k = 0; k < identities->size(); ++k) rows[(*identities)[k]] = k;
    PolyData data;
    data.kind = PolyData::Cells::Lines;
    const std::vector<Vector<double>> branches = group.takePoints("branch_m");
    data.cellFields = group.rest(branches.size());
    const auto* const first = wholesOf(data.cellField("particle1"));
    if (!first) group.refuse("no particle1");
    for (std::size_t k = 0; k < branches.size(); ++k) {
        const auto row = rows.find((*first)[k]);
        if (row == rows.end())
            group.refuse(fmt::format("a contact of a grain {} that is not there", (*first)[k]));
        const Vector<double> begin = grains.points[row->second];
        for (const Vector<double>& point : {begin, begin + branches[k]}) {
            data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
            data.points.push_back(point);
        }
        data.ends.push_back(static_cast<std::int32_t>(data.corners.size()));
    }
    return data;
}

PolyData polygonsOf(Group group) {
    PolyData data;
    data.kind = PolyData::Cells::Polygons;
    data.points = group.takePoints("corner_m");
    const PolyDataField ends = group.take("end", 1);
    data.cellFields = group.rest(ends.size());
    std::int32_t last = 0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
        const double end = ends.at(k);
        if (!(end >= last) || end > static_cast<double>(data.points.size()) || end != std::floor(end))
            group.refuse("ends of polygons that are no corners in order");
        data.ends.push_back(last = static_cast<std::int32_t>(end));
    }
    data.corners.resize(static_cast<std::size_t>(last));
    std::iota(data.corners.begin(), data.corners.end(), 0);
    return data;
}

}  // namespace

SceneFrame readHdf5Frame(const std::filesystem::path& path) {
    const Hdf5File file(path, Hdf5File::Access::Read);
    SceneFrame frame;
    frame.grains = pointsOf(Group(file, "particles"));
    if (Group contacts(file, "contacts"); !contacts.isEmpty())
        frame.contacts = linesOf(std::move(contacts), frame.grains);
    if (Group walls(file, "walls"); !walls.isEmpty()) frame.walls = polygonsOf(std::move(walls));
    if (Group droplets(file, "droplets"); !droplets.isEmpty()) frame.droplets = pointsOf(std::move(droplets));
    return frame;
}

}  // namespace pendular
