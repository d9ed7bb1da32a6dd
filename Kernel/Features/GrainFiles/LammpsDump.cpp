#include <algorithm>
#include <array>
#include <limits>

#include "Kernel/Features/GrainFiles/LammpsFiles.h"

namespace pendular {

namespace {

constexpr std::string_view beginsSnapshot = "ITEM: TIMESTEP\n";

struct Snapshot {
    std::int64_t timestep;
    std::size_t offset;  // of its first line
};

std::vector<Snapshot> snapshotsOf(const InputFile& file) {
    const std::string_view text = file.text;
    std::vector<Snapshot> found;
    for (std::size_t at = text.find(beginsSnapshot); at != text.npos;
         at = text.find(beginsSnapshot, at + 1)) {
        if (at > 0 && text[at - 1] != '\n') continue;
        WordLines lines(file, at);
        lines.next();
        if (!lines.next()) break;
        found.push_back({lines.whole(0), at});
    }
    return found;
}

Snapshot chosenSnapshot(const InputFile& file, std::optional<std::int64_t> timestep) {
    const std::vector<Snapshot> all = snapshotsOf(file);
    if (all.empty()) file.refuse("has no snapshot: no line 'ITEM: TIMESTEP'");
    if (!timestep) return all.back();
    const auto found =
        std::find_if(all.rbegin(), all.rend(), [&](const Snapshot& s) { return s.timestep == *timestep; });
    if (found == all.rend())
        file.refuse(fmt::format("has no snapshot of time step {}; it has {}, from {} to {}", *timestep,
                                all.size(), all.front().timestep, all.back().timestep));
    return *found;
}

/// The places of the columns in a row.
class DumpColumns {
public:
    DumpColumns(const WordLines& header, const InputFile& file)
        : names(header.words().begin() + 2, header.words().end()) {
        for (const char* kind : {"x", "xu", "xs", "xsu"})
            if (position = triple(kind, "x"); position) {
                isScaled = std::string_view(kind).starts_with("xs");
                break;
            }
        if (!position) file.refuse("has no columns x, y and z (or xu, xs, xsu and so on) in its dump");
        if (!find("radius") && !find("diameter"))
            file.refuse("has no column radius or diameter in its dump; write it with 'dump custom'");
        velocity = triple("vx", "x"), spin = triple("omegax", "x");
    }

    [[nodiscard]] std::size_t size() const { return names.size(); }
    [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) return {};
        return static_cast<std::size_t>(found - names.begin());
    }

    using Triple = std::array<std::size_t, 3>;
    std::optional<Triple> position, velocity, spin;
    bool isScaled = false;

private:
    /// The columns of a vector, by the name of its first one in which a letter stands for the axis.
    [[nodiscard]] std::optional<Triple> triple(std::string_view first, std::string_view letter) const {
        Triple columns;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::string name(first);
            name[name.find(letter)] = "xyz"[axis];
            const auto found = find(name);
            if (!found) return {};
            columns[axis] = *found;
        }
        return columns;
    }

    std::vector<std::string_view> names;
};

class DumpReader {
public:
    DumpReader(const InputFile& of, const Snapshot& from)
        : file(of), snapshot(from), lines(of, from.offset) {}

    std::vector<GrainRow> read() {
        lines.next();
        while (lines.next())
            if (lines.words().front() == "ITEM:") {
                const std::string_view item = lines.words().size() > 1 ? lines.words()[1] : "";
                if (item == "NUMBER") takeNumber();
                else if (item == "BOX") takeBox();
                else if (item == "ATOMS") return takeAtoms();
                else if (item == "TIMESTEP") break;
            }
        file.refuse(
            fmt::format("has no atoms ('ITEM: ATOMS') in its snapshot of time step {}", snapshot.timestep));
    }

private:
    void takeNumber() {
        if (!lines.next()) lines.refuse("the file ends where the number of atoms is expected");
        const std::int64_t count = lines.whole(0);
        if (count < 1) lines.refuse(fmt::format("there are {} atoms; there must be one at least", count));
        atoms = static_cast<std::uint64_t>(count);
    }
    void takeBox() {
        for (int axis = 0; axis < 3; ++axis) {
            if (!lines.next()) lines.refuse("the file ends within the bounds of the box");
            lowest[axis] = lines.length(0), side[axis] = lines.length(1) - lowest[axis];
            isTilted = isTilted || lines.words().size() > 2;
        }
        hasBox = true;
    }
    std::vector<GrainRow> takeAtoms() {
        const DumpColumns columns(lines, file);
        if (columns.isScaled && (!hasBox || isTilted))
            file.refuse("has scaled coordinates (xs) in a tilted box, or without one; write x, y and z");
        NumberedGrains grains;
        while (grains.size() < atoms) {
            if (!lines.next() || lines.words().front() == "ITEM:")
                file.refuse(
                    fmt::format("has {} of {} grains in its snapshot of time step {}; choose another time "
                                "step if there is one",
                                grains.size(), atoms, snapshot.timestep));
            if (lines.words().size() != columns.size())
                lines.refuse(
                    fmt::format("{} numbers; the dump has {} columns", lines.words().size(), columns.size()));
            const auto id = columns.find("id");
            grains.add(lines, id ? lines.whole(*id) : static_cast<std::int64_t>(grains.size()),
                       grainOf(columns));
        }
        if (atoms == 0) file.refuse("has no number of atoms before them");
        grains.sort(file);
        return grains.rows();
    }
    [[nodiscard]] GrainRow grainOf(const DumpColumns& columns) const {
        const auto radius = columns.find("radius");
        GrainRow grain{radius ? lines.length(*radius) : 0.5 * lines.length(*columns.find("diameter")),
                       Vec3D::Zero()};
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            const double x = lines.length((*columns.position)[k]);
            grain.position[axis] = columns.isScaled ? lowest[axis] + x * side[axis] : x;
            if (columns.velocity) grain.velocity[axis] = lines.finite((*columns.velocity)[k]);
            if (columns.spin) grain.angularVelocity[axis] = lines.finite((*columns.spin)[k]);
        }
        if (const auto type = columns.find("type")) {
            const std::int64_t number = lines.whole(*type);
            if (number < 1 || number > std::numeric_limits<int>::max())
                lines.refuse(fmt::format("the type {} must be a number from 1 on", number));
            grain.type = static_cast<int>(number);
        }
        if (const auto density = columns.find("density")) grain.density = lines.finite(*density);
        else if (const auto mass = columns.find("mass"))
            grain.density = lines.finite(*mass) / sphereMass(grain.radius, 1);
        return grain;
    }

    const InputFile& file;
    Snapshot snapshot;
    WordLines lines;
    std::uint64_t atoms = 0;
    Vec3D lowest = Vec3D::Zero(), side = Vec3D::Zero();  // m
    bool hasBox = false, isTilted = false;
};

}  // namespace

std::vector<GrainRow> readLammpsDump(const InputFile& file, std::optional<std::int64_t> timestep) {
    WordLines first(file);
    first.next();
    if (first.words().size() > 1 && first.words()[1] == "UNITS" && first.next())
        refuseOtherUnits(file, first.words().front());
    return DumpReader(file, chosenSnapshot(file, timestep)).read();
}

}  // namespace pendular
