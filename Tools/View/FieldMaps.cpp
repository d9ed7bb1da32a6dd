#include "Tools/View/FieldMaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "Kernel/Analysis/CoarseGraining/FieldImage.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Tools/View/Columns.h"
#include "Tools/View/FrameLists.h"

namespace pendular::view {

using Json = Columns::Json;

namespace {

constexpr std::size_t mostSeries = 20, mostCells = 4'000'000;

/// "run-coarse.h5", and not "run-coarse-000000100.h5", "run-fields.h5", "run-restart.h5".
bool isListOfFields(const std::string& file) {
    if (!file.ends_with(".h5") || file.ends_with(hdf5Frames) || file.ends_with("-restart.h5")) return false;
    const std::string stem = file.substr(0, file.size() - 3), step = stem.substr(stem.rfind('-') + 1);
    return step.size() < 9 || step.find_first_not_of("0123456789") != step.npos;
}

std::vector<FieldSeries::Entry> entriesOf(const RunFiles& run, const std::string& list) {
    std::vector<FieldSeries::Entry> entries;
    const auto add = [&](double time, const std::string& file) {
        if (run.folder->hasFile(file)) entries.push_back({time, run.folder, file});
    };
    if (list.ends_with(".h5")) {
        for (const Hdf5Entry& entry : framesIn(*run.folder, list)) add(entry.time, entry.file);
    } else if (isOfFields(*run.folder, list)) {
        for (const ParaViewEntry& entry : filesOf(*run.folder, list))
            if (entry.file.extension() == ".vti") add(entry.time, entry.file);
    }
    return entries;
}

/// Which number of a row a part is, "x" or "xz"; nothing where none is named.
std::optional<std::size_t> componentOf(const std::string& part, std::size_t components) {
    if (part.empty()) return {};
    std::size_t component = 0;
    for (const char letter : part) component = 3 * component + std::string_view("xyz").find(letter);
    const bool isPart = part.find_first_not_of("xyz") == part.npos &&
                        ((part.size() == 1 && components == 3) || (part.size() == 2 && components == 9));
    if (!isPart) throw InputError(fmt::format("view: the field has no part {}.", shown(part)));
    return component;
}

double valueAt(const FieldImage& image, const std::array<std::size_t, 3>& point,
               std::optional<std::size_t> component) {
    if (component || image.field.components == 1) return image.at(point, component.value_or(0));
    if (image.field.components == 9)
        return (image.at(point, 0) + image.at(point, 4) + image.at(point, 8)) / 3;
    double square = 0;
    for (std::size_t c = 0; c < image.field.components; ++c) square += std::pow(image.at(point, c), 2);
    return std::sqrt(square);
}

/// Looked along: what was wished, else an axis that is averaged over, y before the others.
std::size_t normalOf(const FieldImage& image, const MapWish& wish) {
    if (wish.normal) {
        if (*wish.normal > 2) throw InputError("view: 'normal' must be 0, 1 or 2.");
        return *wish.normal;
    }
    for (const std::size_t axis : {1, 0, 2})
        if (image.places[axis].size() == 1) return axis;
    return 1;
}

Json axisOf(const FieldImage& image, std::size_t axis) {
    Json places = Json::array();
    for (const double place : image.places[axis])
        places.push_back(std::isfinite(place) ? Json(place) : Json(nullptr));
    return {{"name", image.axes[axis]}, {"number", axis}, {"places", std::move(places)}};
}

}  // namespace

std::vector<FieldSeries> fieldSeriesOf(const RunFiles& run) {
    std::vector<FieldSeries> all;
    run.folder->forEach([&](const std::string& name, OpenFolder::Kind kind) {
        const bool isList = name.ends_with(".pvd") || isListOfFields(name);
        if (name[0] == '.' || kind != OpenFolder::Kind::File || !isList) return true;
        try {
            if (auto entries = entriesOf(run, name); !entries.empty())
                all.push_back({name, std::move(entries)});
        } catch (const InputError&) {
            return true;
        }
        return all.size() < mostSeries;
    });
    std::ranges::sort(all, {}, &FieldSeries::name);
    return all;
}

std::string packMap(const FieldSeries::Entry& entry, const MapWish& wish) {
    const std::size_t dot = std::min(wish.field.find('.'), wish.field.size());
    const FieldImage image = entry.folder->read(entry.file, [&](const std::filesystem::path& path) {
        return readFieldImage(path, wish.field.substr(0, dot), entry.file);
    });
    const auto component =
        componentOf(wish.field.substr(std::min(dot + 1, wish.field.size())), image.field.components);
    const std::size_t normal = normalOf(image, wish), count = image.places[normal].size();
    const std::size_t slice = wish.slice.value_or(count / 2), across = normal == 0 ? 1 : 0,
                      up = normal == 2 ? 1 : 2;
    if (slice >= count) throw InputError("view: the fields have no such slice.");
    const std::size_t wide = image.places[across].size(), high = image.places[up].size();
    if (wide * high > mostCells)
        throw InputError(
            fmt::format("view: the map has {} points; {} can be shown.", wide * high, mostCells));
    std::vector<float> values;
    values.reserve(wide * high);
    std::array<std::size_t, 3> point{};
    point[normal] = slice;
    for (point[up] = 0; point[up] < high; ++point[up])
        for (point[across] = 0; point[across] < wide; ++point[across])
            values.push_back(static_cast<float>(valueAt(image, point, component)));
    Json fields = Json::array();
    for (const FieldImage::Name& known : image.known) {
        fields.push_back(fieldName(known.name));
        fields.back()["components"] = known.components;
    }
    Columns columns;
    columns.add("value", values);
    return std::move(columns).behind({{"time", entry.time},
                                      {"fields", fields},
                                      {"field", wish.field.empty() ? image.field.name : wish.field},
                                      {"across", axisOf(image, across)},
                                      {"up", axisOf(image, up)},
                                      {"normal", axisOf(image, normal)},
                                      {"slice", slice}});
}

}  // namespace pendular::view
