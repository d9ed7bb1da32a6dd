#include "Tools/View/FramePack.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "Kernel/Analysis/Output/FrameParts.h"
#include "Kernel/Analysis/Output/Hdf5Frame.h"
#include "Kernel/Analysis/Output/JoinPieces.h"
#include "Kernel/Analysis/Output/ShapeFields.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/Snapshot/Compose.h"
#include "Tools/View/Columns.h"
#include "Tools/View/FrameLists.h"

namespace pendular::view {

namespace {

using Json = nlohmann::ordered_json;

void put(std::vector<float>& column, const Vector<double>& p) {
    for (const double x : {p.x, p.y, p.z}) column.push_back(static_cast<float>(x));
}
bool isFinite(const Vector<double>& p) { return std::isfinite(p.x + p.y + p.z); }
Json list(const Vector<double>& p) { return {p.x, p.y, p.z}; }

/// The smallest box around points that are somewhere.
struct Limits {
    Vector<double> low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

    explicit Limits(const std::vector<Vector<double>>& points) {
        for (const Vector<double>& p : points) {
            if (!isFinite(p)) continue;
            for (const auto axis : {&Vector<double>::x, &Vector<double>::y, &Vector<double>::z}) {
                low.*axis = std::min(low.*axis, p.*axis);
                high.*axis = std::max(high.*axis, p.*axis);
            }
        }
        if (!(low.x <= high.x)) low = high = {0, 0, 0};
    }
};

/// The number of a field for each row: of a vector its length, or the part that is named behind a dot.
struct Part {
    const PolyDataField& field;
    std::size_t component = std::string::npos;  // npos: the length

    [[nodiscard]] double at(std::size_t row) const {
        const std::size_t n = field.components;
        if (n == 1 || component != std::string::npos) return field.at(n * row + (n == 1 ? 0 : component));
        double square = 0;
        for (std::size_t c = 0; c < n; ++c) square += field.at(n * row + c) * field.at(n * row + c);
        return std::sqrt(square);
    }
    [[nodiscard]] std::size_t rows() const { return field.size() / field.components; }
};

Part partOf(const PolyData& data, const std::string& wanted) {
    const std::size_t dot = wanted.rfind('.');
    const PolyDataField* const field = data.pointField(wanted.substr(0, dot));
    if (!field) throw InputError(fmt::format("view: the frame has no field {}.", shown(wanted)));
    if (dot == wanted.npos) return {*field};
    const std::size_t component = std::string_view("xyz").find(wanted.substr(dot + 1));
    if (wanted.size() != dot + 2 || component >= field->components)
        throw InputError(fmt::format("view: the field has no part {}.", shown(wanted)));
    return {*field, component};
}

Json describeFields(const std::vector<PolyDataField>& given) {
    Json fields = Json::array();
    for (const PolyDataField& field : given) {
        if (field.components == 9) continue;
        const Part part{field};
        double lowest = INFINITY, highest = -INFINITY;
        for (std::size_t k = 0; k < part.rows(); ++k) {
            const double value = part.at(k);
            lowest = std::min(lowest, value), highest = std::max(highest, value);
        }
        Json told = fieldName(field.name);
        told["components"] = field.components;
        told["lowest"] = lowest, told["highest"] = highest;
        told["whole"] = std::holds_alternative<std::vector<std::int32_t>>(field.numbers);
        fields.push_back(std::move(told));
    }
    return fields;
}

/// Row in the file of a grain's identity.
std::unordered_map<std::int64_t, std::size_t> rowsByIdentity(const PolyData& grains) {
    std::unordered_map<std::int64_t, std::size_t> rows;
    const PolyDataField* const identity = grains.pointField("identity");
    for (std::size_t k = 0; identity && k < identity->size(); ++k)
        rows[static_cast<std::int64_t>(identity->at(k))] = k;
    return rows;
}

/// Uses the corners of each polygon's triangles: a fan.
template <class Use>
void forEachTriangle(const PolyData& data, Use&& use) {
    std::size_t begin = 0;
    for (std::size_t polygon = 0; polygon < data.ends.size(); ++polygon) {
        const auto end = static_cast<std::size_t>(data.ends[polygon]);
        const auto corner = [&](std::size_t k) {
            return data.points[static_cast<std::size_t>(data.corners[k])];
        };
        for (std::size_t k = begin + 1; k + 1 < end; ++k)
            use(polygon, std::array{corner(begin), corner(k), corner(k + 1)});
        begin = end;
    }
}

std::vector<float> wallColumn(const PolyData& walls, const Vector<double>& origin) {
    std::vector<float> column;
    forEachTriangle(walls, [&](std::size_t, const auto& corners) {
        for (const Vector<double>& p : corners) put(column, p - origin);
    });
    return column;
}

/// Of each triangle; nothing where the walls have no such field.
std::vector<float> wallValueColumn(const PolyData& walls, const std::string& field) {
    std::vector<float> column;
    const PolyDataField* const values = walls.cellField(field);
    if (!values) return column;
    const Part part{*values};
    forEachTriangle(walls, [&](std::size_t polygon, const auto&) {
        column.push_back(static_cast<float>(part.at(polygon)));
    });
    return column;
}

/// Surfaces of grains that are no spheres; tells the rows of these grains.
std::vector<float> shapeColumn(const PolyData& shapes,
                               const std::unordered_map<std::int64_t, std::size_t>& rows,
                               const Vector<double>& origin, std::vector<bool>& isShape) {
    std::vector<float> column;
    const PolyDataField* const identity = shapes.cellField("identity");
    if (!identity) return column;
    forEachTriangle(shapes, [&](std::size_t polygon, const auto& corners) {
        const auto found = rows.find(static_cast<std::int64_t>(identity->at(polygon)));
        if (found == rows.end()) return;
        isShape[found->second] = true;
        for (const Vector<double>& p : corners) {
            put(column, p - origin);
            column.push_back(static_cast<float>(found->second));
        }
    });
    return column;
}

std::vector<float> bridgeColumn(const snapshot::Frame& frame,
                                const std::unordered_map<std::int64_t, std::size_t>& rows,
                                const Vector<double>& origin) {
    std::vector<float> column;
    const PolyData& lines = frame.contacts;
    const PolyDataField *bridged = lines.cellField("bridged"), *volume = lines.cellField("bridge_volume_m3"),
                        *overlap = lines.cellField("overlap_m"), *first = lines.cellField("particle1"),
                        *second = lines.cellField("particle2"), *radii = frame.grains.pointField("radius_m");
    if (!bridged || !volume || !overlap || !first || !second || !radii) return column;
    const auto inverseRadius = [&](double identity) {
        const auto found = rows.find(static_cast<std::int64_t>(identity));
        return identity < 0 || found == rows.end() ? 0 : 1 / radii->at(found->second);  // 0: a wall
    };
    for (std::size_t k = 0; k < lines.ends.size(); ++k) {
        const auto [begin, end] = snapshot::endsOf(lines, k);
        if (bridged->at(k) == 0 || !isFinite(begin) || !isFinite(end)) continue;
        const double effective = 1 / (inverseRadius(first->at(k)) + inverseRadius(second->at(k)));
        put(column, begin - origin);
        column.push_back(
            static_cast<float>(snapshot::bridgeRadius(volume->at(k), -overlap->at(k), effective)));
        put(column, end - origin);
        column.push_back(0);
    }
    return column;
}

std::vector<float> contactColumn(const PolyData& lines, const Vector<double>& origin) {
    std::vector<float> column;
    const PolyDataField* const force = lines.cellField("force_N");
    if (!force) return column;
    const Part size{*force};
    for (std::size_t k = 0; k < lines.ends.size(); ++k) {
        const auto [begin, end] = snapshot::endsOf(lines, k);
        put(column, begin - origin);
        column.push_back(static_cast<float>(size.at(k)));
        put(column, end - origin);
        column.push_back(0);
    }
    return column;
}

std::vector<float> grainColumn(const PolyData& grains, const Vector<double>& origin,
                               const std::vector<bool>& isShape) {
    std::vector<float> column;
    column.reserve(4 * grains.points.size());
    const PolyDataField* const radii = grains.pointField("radius_m");
    if (!radii) throw InputError("view: the frame has no field radius_m.");
    for (std::size_t k = 0; k < grains.points.size(); ++k) {
        const bool isThere = isFinite(grains.points[k]);
        put(column, isThere ? grains.points[k] - origin : Vector<double>{0, 0, 0});
        column.push_back(isThere ? static_cast<float>(isShape[k] ? -radii->at(k) : radii->at(k)) : 0);
    }
    return column;
}

/// The wished field, or, where the frame has none of the name and that is allowed, the radius.
std::string fieldOf(const FrameWish& wish, const PolyData& grains) {
    const bool isThere = grains.pointField(wish.field.substr(0, wish.field.rfind('.'))) != nullptr;
    return wish.field.empty() || (wish.orRadius && !isThere) ? "radius_m" : wish.field;
}

std::vector<float> valueColumn(const PolyData& grains, const std::string& wanted) {
    const Part part = partOf(grains, wanted);
    std::vector<float> column(part.rows());
    for (std::size_t k = 0; k < column.size(); ++k) column[k] = static_cast<float>(part.at(k));
    return column;
}

std::vector<float> dropletColumn(const PolyData& droplets, const Vector<double>& origin) {
    std::vector<float> column;
    const PolyDataField* const radii = droplets.pointField("radius_m");
    for (std::size_t k = 0; radii && k < droplets.points.size(); ++k) {
        if (!isFinite(droplets.points[k])) continue;
        put(column, droplets.points[k] - origin);
        column.push_back(static_cast<float>(radii->at(k)));
    }
    return column;
}

constexpr std::uintmax_t longestIndex = 1 << 20;  // bytes of a .pvtp file

PolyData readFile(const OpenFolder& folder, const std::string& name) {
    return folder.read(name, [](const std::filesystem::path& path) { return readPolyData(path); });
}

/// A file .vtp, or all that a file .pvtp names.
PolyData readParts(const OpenFolder& folder, const std::string& name) {
    const auto index = name.ends_with(".pvtp") ? folder.file(name) : std::nullopt;
    if (!index) return readFile(folder, name);
    std::vector<PolyData> pieces;
    try {
        for (const std::string& piece : pieceNames(index->bytes(0, longestIndex)))
            pieces.push_back(readFile(folder, piece));
        return joined(std::move(pieces));
    } catch (const InputError&) {
        throw;  // of a piece
    } catch (const std::runtime_error& problem) {
        folder.refuse(name, problem.what());
    }
}

/// The part of a frame that is in a file of its own, if there is one.
PolyData readBeside(const OpenFolder& folder, const std::string& particles, std::string_view kind) {
    std::string name = snapshot::nameBeside(particles, kind);
    if (name.ends_with(".pvtp") && !folder.hasFile(name)) name.replace(name.size() - 5, 5, ".vtp");
    return folder.hasFile(name) ? readParts(folder, name) : PolyData{};
}

/// All that is drawn of a frame.
struct Content : snapshot::Frame {
    PolyData shapes, droplets;
};

constexpr std::size_t mostShapes = 20'000;  // whose surfaces are made: 10 kB each

Content readHdf5(const FrameEntry& entry, const FrameWish& wish) {
    SceneFrame frame = entry.folder->read(entry.file, readHdf5Frame);
    if (wish.surfaces && frame.grains.points.size() <= mostShapes) frame.shapes = shapeSurfaces(frame.grains);
    const auto given = [](std::optional<PolyData>& part) { return std::move(part).value_or(PolyData{}); };
    return {{std::move(frame.grains), given(frame.contacts), given(frame.walls)},
            given(frame.shapes),
            given(frame.droplets)};
}

Content readParaView(const FrameEntry& entry, const FrameWish& wish) {
    const auto beside = [&](std::string_view kind) { return readBeside(*entry.folder, entry.file, kind); };
    Content content;
    content.grains = readParts(*entry.folder, entry.file);
    if (wish.surfaces) content.walls = beside("walls"), content.shapes = beside("shapes");
    if (wish.bridges || wish.contacts) content.contacts = beside("contacts");
    if (wish.droplets) content.droplets = beside("droplets");
    return content;
}

/// Throws InputError if it cannot be read, or if it is one that no run writes.
Content read(const FrameEntry& frame, const FrameWish& wish) {
    if (frame.kind == FrameEntry::Kind::Restart)
        return {frame.folder->read(frame.file, snapshot::readRestartState), {}, {}};
    Content content =
        frame.kind == FrameEntry::Kind::Hdf5 ? readHdf5(frame, wish) : readParaView(frame, wish);
    if (std::isfinite(frame.time)) content.grains.time = frame.time;
    snapshot::checkFrame(content, frame.file);
    return content;
}

}  // namespace

std::vector<FrameEntry> framesOf(const RunFiles& run) {
    const OpenFolder& folder = *run.folder;
    std::vector<FrameEntry> frames;
    const auto add = [&](double time, const std::string& file, FrameEntry::Kind kind) {
        if (folder.hasFile(file)) frames.push_back({time, run.folder, file, kind});
    };
    const std::string series = run.file(".pvd"), list = run.file(hdf5Frames);
    if (folder.hasFile(series)) {
        for (const ParaViewEntry& entry : filesOf(folder, series))
            if (entry.kind == "particles") add(entry.time, entry.file, FrameEntry::Kind::ParaView);
    } else if (folder.hasFile(list)) {
        for (const Hdf5Entry& entry : framesIn(folder, list))
            add(entry.time, entry.file, FrameEntry::Kind::Hdf5);
    } else {
        add(std::numeric_limits<double>::quiet_NaN(), run.file("-restart.h5"), FrameEntry::Kind::Restart);
    }
    return frames;
}

std::string packFrame(const FrameEntry& entry, const FrameWish& wish) {
    Content frame = read(entry, wish);
    const Limits limits(frame.grains.points);
    const Vector<double> origin = wish.origin.value_or(0.5 * (limits.low + limits.high));
    Json head{{"time", frame.grains.time},
              {"grains", frame.grains.points.size()},
              {"origin", list(origin)},
              {"low", list(limits.low - origin)},
              {"high", list(limits.high - origin)},
              {"fields", describeFields(frame.grains.pointFields)},
              {"wallFields", describeFields(frame.walls.cellFields)}};
    const std::string field = fieldOf(wish, frame.grains);
    head["field"] = field;
    const auto rows = rowsByIdentity(frame.grains);
    std::vector<bool> isShape(frame.grains.points.size());
    Columns columns;
    columns.add("shapes", shapeColumn(frame.shapes, rows, origin, isShape));
    columns.add("grains", grainColumn(frame.grains, origin, isShape));
    columns.add("value", valueColumn(frame.grains, field));
    columns.add("walls", wallColumn(frame.walls, origin));
    if (!wish.wallField.empty()) columns.add("wallValue", wallValueColumn(frame.walls, wish.wallField));
    if (wish.bridges) columns.add("bridges", bridgeColumn(frame, rows, origin));
    if (wish.contacts) columns.add("contacts", contactColumn(frame.contacts, origin));
    if (wish.droplets) columns.add("droplets", dropletColumn(frame.droplets, origin));
    frame = {};  // before the columns are copied
    return std::move(columns).behind(std::move(head));
}

std::string describeRow(const FrameEntry& frame, bool ofContacts, std::size_t row) {
    FrameWish wish;
    wish.contacts = wish.bridges = ofContacts, wish.droplets = wish.surfaces = false;
    const Content content = read(frame, wish);
    const PolyData& data = ofContacts ? content.contacts : content.grains;
    const std::vector<PolyDataField>& fields = ofContacts ? data.cellFields : data.pointFields;
    Json all = Json::array();
    const auto add = [&](const std::string& name, Json value) {
        all.push_back(fieldName(name));
        all.back()["value"] = std::move(value);
    };
    if (!ofContacts && row < data.points.size()) add("position_m", list(data.points[row]));
    for (const PolyDataField& field : fields) {
        if (row >= field.size() / field.components) throw InputError("view: the frame has no such row.");
        Json value = Json::array();
        for (std::size_t c = 0; c < field.components; ++c)
            value.push_back(field.at(row * field.components + c));
        add(field.name, std::move(value));
    }
    return Json{{"fields", all}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace pendular::view
