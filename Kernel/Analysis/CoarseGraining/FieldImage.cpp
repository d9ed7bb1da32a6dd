#include "Kernel/Analysis/CoarseGraining/FieldImage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "Kernel/Analysis/Output/Hdf5Columns.h"
#include "Kernel/Analysis/Output/VtkArrays.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileContent.h"
#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {

namespace {

constexpr std::size_t mostPoints = std::size_t{1} << 28;  // as FieldGrid has them
const std::array<std::string, 3> aroundAxis{"r", "theta", "z"};

void requireFew(std::size_t points) {
    if (points == 0 || points > mostPoints)
        throw std::runtime_error("has no points, or more than a grid has");
}

template <class Number>
std::vector<Number> wordsIn(const vtk::Tag& tag, std::string_view attribute, std::size_t count) {
    std::istringstream words{std::string(vtk::valueOf(tag, attribute))};
    std::vector<Number> numbers;
    for (Number number; words >> number;) numbers.push_back(number);
    if (numbers.size() != count)
        throw std::runtime_error(fmt::format("has not {} numbers in {}", count, attribute));
    return numbers;
}

/// A file of writeImage(): x is the fastest.
class ImageReader {
public:
    ImageReader(std::string_view text, const std::string& field) : arrays(text), wanted(field) {
        for (const vtk::Tag& tag : arrays.tags) take(tag);
        if (!hasGrid) throw std::runtime_error("is no image");
        if (!image.field.name.empty()) makePlaces();
    }

    FieldImage image;

private:
    void take(const vtk::Tag& tag) {
        if (tag.name == "VTKFile") vtk::Arrays::checkForm(tag, "ImageData");
        else if (tag.name == "ImageData") takeGrid(tag);
        else if (tag.name == "DataArray") takeArray(tag);
        else if (tag.name != "/DataArray") section = tag.name;
    }
    void takeGrid(const vtk::Tag& tag) {
        if (hasGrid) throw std::runtime_error("has two grids");
        const auto extent = wordsIn<long long>(tag, "WholeExtent", 6);
        const auto origin = wordsIn<double>(tag, "Origin", 3), spacing = wordsIn<double>(tag, "Spacing", 3);
        count = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const long long last = extent[2 * axis + 1];
            if (extent[2 * axis] != 0 || last < 0 || last >= static_cast<long long>(mostPoints) ||
                !std::isfinite(origin[axis]) || !(spacing[axis] > 0))
                throw std::runtime_error("has an extent, origin or spacing that no grid has");
            counts[axis] = static_cast<std::size_t>(last) + 1;
            count *= counts[axis];
            requireFew(count);
        }
        image.strides = {1, counts[0], counts[0] * counts[1]};
        lowest = {origin[0], origin[1], origin[2]}, distance = {spacing[0], spacing[1], spacing[2]};
        hasGrid = true;
    }
    /// Once the field has shown that there are as many points as the extent claims.
    void makePlaces() {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t k = 0; k < counts[axis]; ++k)
                image.places[axis].push_back(lowest[axis] + static_cast<double>(k) * distance[axis]);
    }
    void takeArray(const vtk::Tag& tag) {
        const std::string_view name = vtk::valueOf(tag, "Name");
        if (section == "FieldData" && name == "TimeValue") image.time = vtk::timeOf(tag);
        if (section == "FieldData" && name == "cylindrical") image.axes = aroundAxis;
        if (section != "PointData" || !hasGrid) return;
        const PolyDataField named = vtk::Arrays::nameOf(tag);
        const bool isWanted = wanted.empty() ? image.known.empty() : name == wanted;
        image.known.push_back({named.name, named.components});
        if (isWanted) image.field = arrays.field(tag, count);
    }

    vtk::Arrays arrays;
    std::string wanted;
    std::string_view section;
    std::size_t count = 0;
    std::array<std::size_t, 3> counts{};
    std::array<double, 3> lowest{}, distance{};  // m
    bool hasGrid = false;
};

FieldImage readVti(const std::filesystem::path& path, const std::string& field) {
    const InputFile file = loadInputFile("VTK file", path);
    if (recognise(file.text).content == FileContent::NoText) refuseOtherContent(file);
    return std::move(ImageReader(file.text, field).image);
}

/// A file of writeHdf5(): x is the slowest.
FieldImage readHdf5(const std::filesystem::path& path, const std::string& field) {
    const Hdf5File file(path, Hdf5File::Access::Read);
    FieldImage image;
    if (file.holds("points/r_m")) image.axes = aroundAxis;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string name = fmt::format("points/{}_m", image.axes[axis]);
        image.places[axis] = {std::numeric_limits<double>::quiet_NaN()};  // averaged over
        if (!file.holds(name)) continue;
        const PolyDataField column = readColumn(file, name);
        image.places[axis].clear();
        for (std::size_t k = 0; k < column.size(); ++k) image.places[axis].push_back(column.at(k));
    }
    std::size_t count = 1;
    for (const std::vector<double>& places : image.places) {
        requireFew(places.size());
        requireFew(count *= places.size());
    }
    image.strides = {image.places[1].size() * image.places[2].size(), image.places[2].size(), 1};
    for (const std::string& name : file.names()) {
        const auto shape = name.starts_with("fields/") ? file.shapeOf(name) : std::nullopt;
        if (shape) image.known.push_back({name.substr(std::string_view("fields/").size()), shape->columns});
    }
    if (image.known.empty()) throw std::runtime_error("has no fields");
    const std::string& wanted = field.empty() ? image.known.front().name : field;
    if (!file.holds("fields/" + wanted)) return image;
    image.field = readColumn(file, "fields/" + wanted);
    if (image.field.size() != count * image.field.components)
        throw std::runtime_error("has a field with fewer or more values than points");
    return image;
}

}  // namespace

FieldImage readFieldImage(const std::filesystem::path& path, const std::string& field,
                          const std::filesystem::path& named) {
    const std::filesystem::path& name = named.empty() ? path : named;
    FieldImage image;
    try {
        image = name.extension() == ".h5" ? readHdf5(path, field) : readVti(path, field);
    } catch (const InputError&) {
        throw;
    } catch (const std::runtime_error& problem) {
        throw InputError(fmt::format("The file {} {}.", path.string(), problem.what()));
    }
    if (image.field.name.empty())
        throw InputError(fmt::format("The file {} has no field '{}'.", path.string(), shown(field)));
    return image;
}

}  // namespace pendular
