#pragma once

#include <array>
#include <map>
#include <set>
#include <sstream>

#include "Kernel/Analysis/Output/ParaViewSeries.h"
#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "Tools/Snapshot/Colours.h"

namespace pendular::snapshot {

/// The content of a picture, at one time.
struct Frame {
    PolyData grains, contacts, walls;
};

inline PolyData readIfThere(const std::filesystem::path& path) {
    return isThere(path) ? readPolyData(path) : PolyData{};
}

/// NAME-contacts-STEP.vtp beside NAME-particles-STEP.vtp; empty if the file has another name.
inline std::string nameBeside(std::string particles, std::string_view kind) {
    constexpr std::string_view own = "-particles-";
    const std::size_t at = particles.rfind(own);
    return at == particles.npos ? "" : particles.replace(at, own.size(), fmt::format("-{}-", kind));
}

/// The file of another kind that goes with one of particles; of a frame in parts (.pvtp) the one in parts, if
/// there is one. Empty if the file has another name.
inline std::filesystem::path fileBeside(const std::filesystem::path& particles, std::string_view kind) {
    const std::string name = nameBeside(particles.filename().string(), kind);
    if (name.empty()) return {};
    std::filesystem::path beside = particles.parent_path() / name;
    if (beside.extension() == ".pvtp" && !isThere(beside)) beside.replace_extension(".vtp");
    return beside;
}

/// Throws InputError unless each contact has two ends and each identity is one number, which all that draws
/// takes for granted.
/// @param file that the sentence names
inline void checkFrame(const Frame& frame, const std::filesystem::path& file) {
    const auto refuse = [&](std::string_view what) {
        throw InputError(fmt::format("The frame {} {}.", shown(file.filename().string()), what));
    };
    std::int32_t ends = 0;
    for (const std::int32_t end : frame.contacts.ends)
        if (end != (ends += 2)) refuse("has a contact that is no line between two points");
    const PolyDataField* const identity = frame.grains.pointField("identity");
    if (identity && identity->components != 1) refuse("has identities that are more than one number each");
}

/// The two ends of a contact (m), in a frame that has been checked.
inline std::array<Vector<double>, 2> endsOf(const PolyData& contacts, std::size_t k) {
    const auto end = [&](std::size_t which) {
        return contacts.points[static_cast<std::size_t>(contacts.corners[2 * k + which])];
    };
    return {end(0), end(1)};
}

/// NAME-particles-STEP.vtp, and the files of contacts and walls that go with it, if there are any.
inline Frame readFrame(const std::filesystem::path& particles) {
    Frame frame{readPolyData(particles), readIfThere(fileBeside(particles, "contacts")),
                readIfThere(fileBeside(particles, "walls"))};
    checkFrame(frame, particles);
    return frame;
}

/// A table with the columns radius_m, x_m, y_m and z_m, as a run that stops leaves it; its other columns are
/// fields.
inline Frame readTable(const std::filesystem::path& path) {
    const InputFile file = loadTextFile("table of grains", path);
    std::istringstream lines(file.text);
    std::vector<std::string> names;
    std::map<std::string, std::vector<double>> columns;
    std::size_t lineNumber = 0;
    for (std::string line; std::getline(lines, line);) {
        ++lineNumber;
        if (line.empty() || line[0] == '#') continue;
        std::istringstream cells(line);
        const bool isHeader = names.empty();
        std::size_t k = 0;
        for (std::string cell; std::getline(cells, cell, ','); ++k) {
            double value = 0;
            if (isHeader) names.push_back(cell);
            else if (k >= names.size() || !parseNumber(cell, value))
                file.refuse("line", lineNumber, fmt::format("'{}' is no number of a column", shown(cell)));
            else columns[names[k]].push_back(value);
        }
        if (k != names.size()) file.refuse("line", lineNumber, "a number is missing");
    }
    Frame frame;
    for (const char* needed : {"radius_m", "x_m", "y_m", "z_m"})
        if (columns[needed].empty()) file.refuse(fmt::format("has no column {} with numbers", needed));
    for (std::size_t k = 0; k < columns["x_m"].size(); ++k)
        frame.grains.points.push_back({columns["x_m"][k], columns["y_m"][k], columns["z_m"][k]});
    for (const std::string& name : names) frame.grains.pointFields.push_back({name, 1, columns[name]});
    return frame;
}

/// The grains of a restart file, in the order of their places; their walls and bridges are not drawn.
inline Frame readRestartState(const std::filesystem::path& path) {
    double timeStep = 0, timeBefore = 0;  // s; the step may have changed in the run
    std::uint64_t steps = 0, stepsBefore = 0;
    std::vector<TranslationRecord> grains;
    readRestartFile(path, [&](StateArchive& archive) {
        archive.value("timeStep", timeStep);
        archive.value("steps", steps);
        archive.value("stepsBefore", stepsBefore);
        archive.value("timeBefore", timeBefore);
        archive.group("particles", [&] { archive.column<double>("translation", grains); });
    });
    Frame frame;
    frame.grains.time = timeBefore + timeStep * static_cast<double>(steps - stepsBefore);
    std::vector<double> radii, velocities;
    for (const TranslationRecord& grain : grains) {
        const Vector<double>& v = grain.velocity;
        frame.grains.points.push_back(grain.position);
        radii.push_back(grain.radius);
        velocities.insert(velocities.end(), {v.x, v.y, v.z});
    }
    frame.grains.pointFields = {{"radius_m", 1, radii}, {"velocity_m_per_s", 3, velocities}};
    return frame;
}

/// The files of particles that are meant by a file: those of a series, in order, or the one.
inline std::vector<std::filesystem::path> framesOf(const std::filesystem::path& path) {
    if (path.extension() != ".pvd") return {path};
    std::vector<std::filesystem::path> found;
    for (const ParaViewEntry& entry : readParaViewSeries(path))
        if (entry.kind == "particles") found.push_back(entry.file);
    if (found.empty())
        throw InputError(fmt::format("The ParaView series {} has no particles.", path.string()));
    return found;
}

inline Frame readAny(const std::filesystem::path& path) {
    if (path.extension() == ".h5") return readRestartState(path);
    return path.extension() == ".csv" ? readTable(path) : readFrame(path);
}

/// A number of each point or cell: of a vector its length, or a part as in "velocity_m_per_s.z".
struct Scalar {
    std::string name;
    std::vector<double> values;
    bool areNames = false;  // few whole numbers, which tell kinds apart
};

/// Throws InputError if there is no field of this name.
inline Scalar scalarOf(const std::vector<PolyDataField>& fields, const std::string& wanted) {
    const std::size_t dot = wanted.rfind('.');
    const std::string name = wanted.substr(0, dot);
    const auto part =
        dot == wanted.npos ? std::string_view::npos : std::string_view("xyz").find(wanted.substr(dot + 1));
    std::string known;
    for (const PolyDataField& field : fields) {
        known += (known.empty() ? "" : ", ") + field.name;
        if (field.name != name || (dot != wanted.npos && part >= field.components)) continue;
        Scalar scalar{wanted, {}, false};
        for (std::size_t k = 0; k < field.size(); k += field.components) {
            double square = 0;
            for (std::size_t c = 0; c < field.components; ++c) square += field.at(k + c) * field.at(k + c);
            scalar.values.push_back(dot != wanted.npos      ? field.at(k + part)
                                    : field.components == 1 ? field.at(k)
                                                            : std::sqrt(square));
        }
        const std::set<double> different(scalar.values.begin(), scalar.values.end());
        scalar.areNames =
            different.size() <= namedColours.size() &&
            (field.name == "species" || std::holds_alternative<std::vector<std::int32_t>>(field.numbers));
        return scalar;
    }
    throw InputError(fmt::format("snapshot: there is no field '{}'; there are {}.", wanted, known));
}

}  // namespace pendular::snapshot
