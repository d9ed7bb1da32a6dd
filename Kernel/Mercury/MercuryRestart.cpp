#include "Kernel/Mercury/MercuryRestart.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "Kernel/Mercury/MercuryRestartLines.h"
#include "Kernel/Mercury/MercuryRestartObjects.h"

namespace pendular {
namespace {

using Lines = MercuryRestartLines;

/// Steps between two outputs; there 2^32 - 1 steps are never.
std::size_t saveCountOf(const Lines& lines, std::string_view word, std::size_t standard) {
    if (!lines.has(word)) return standard;
    constexpr double never = 4294967295;
    return lines.value(word) >= never ? 0 : lines.count(word);
}

/// The box, the times and the settings of the head, in all versions.
void readHead(const Lines& lines, MercuryRestart& state) {
    const auto take = [&](std::initializer_list<std::string_view> names, double& to) {
        for (const std::string_view name : names)
            if (const auto at = lines.behind(name)) to = lines.numberAt(*at);
    };
    constexpr std::array axes{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        take({fmt::format("{}Min", axes[axis]), fmt::format("{}min", axes[axis])}, state.lowest[axis]);
        take({fmt::format("{}Max", axes[axis]), fmt::format("{}max", axes[axis])}, state.highest[axis]);
    }
    take({"timeStep", "dt"}, state.timeStep);
    take({"time", "t"}, state.time);
    take({"timeMax", "tmax"}, state.timeMax);
    state.gravity = lines.vector("gravity", state.gravity);
    const auto dimensions = [&](std::string_view name, int& to) {
        to = static_cast<int>(lines.count(name, static_cast<std::uint64_t>(to)));
    };
    dimensions("systemDimensions", state.systemDimensions);
    dimensions("dim", state.systemDimensions);
    dimensions("particleDimensions", state.particleDimensions);
    if (lines.has("dataFile")) state.saveCount = saveCountOf(lines, "saveCount", 0);
    for (const std::string_view word : {"save_count", "save_count_data"})
        state.saveCount = saveCountOf(lines, word, state.saveCount);
    if (const double drag = lines.value("backgroundDrag", 0); drag != 0)
        lines.refuse(fmt::format(
            "backgroundDrag is {}, which is not taken over; give it by computeExternalForces()", drag));
    if (lines.value("isRotating", 1) == 0 || lines.value("rotation", 1) == 0)
        lines.refuse("its particles do not rotate (isRotating 0), which is not taken over");
}

/// The first line: MercuryDPM VERSION name NAME ..., or restart_version N name NAME, the name also in the
/// next line. Returns whether it is one of the two: a name may be any word, also one of the head.
bool readTitle(const Lines& lines, MercuryRestart& state) {
    const bool hasVersion = lines.first() == "MercuryDPM" || lines.first() == "restart_version";
    if (hasVersion && lines.all().size() > 1) state.version = lines.all()[1];
    return hasVersion || lines.first() == "name";
}

/// Whether a line outside of the sections is one of the objects that they have.
bool isOfSection(const Lines& lines, const MercuryRestart& state) {
    const std::string_view word = lines.first();
    if (state.version == "2" || state.version == "3")
        return word == "TSP" || word == "BP" || word == "DMP" || word == "normal" ||
               word == "numFiniteWalls" || word.ends_with("Wall") || word.ends_with("Boundary") ||
               lines.countAt(0) > 0;
    const bool isPlaced = lines.has("radius") || lines.has("normal") || lines.has("orientation");
    return lines.has("particleIds") || lines.has("particleWallIds") || (lines.has("position") && isPlaced) ||
           word.ends_with("Boundary");
}

/// Counts a line that is passed over. Of a text that has nothing else only the first words are kept.
void passOver(const Lines& lines, MercuryRestart& state) {
    constexpr std::size_t most = 99;
    const std::string word = shownName(lines.first());
    if (state.passedOver.size() < most || state.passedOver.contains(word)) ++state.passedOver[word];
    else ++state.passedOver["others"];
}

/// Lines of the head that say nothing of the state: the files that were written.
bool isOfFiles(std::string_view word) {
    constexpr std::array<std::string_view, 8> files{"dataFile",      "fStatFile",   "eneFile",
                                                    "restartFile",   "statFile",    "interactionFile",
                                                    "options_fstat", "options_data"};
    return std::ranges::count(files, word) > 0;
}

class MercuryRestartReader {
public:
    explicit MercuryRestartReader(const std::filesystem::path& path)
        : file(loadTextFile("restart file", path)) {
        state.file = path;
    }

    MercuryRestart read() {
        while (lines.next()) readLine();
        for (const auto& [word, isThere] :
             {std::pair("Species", hasSpecies), std::pair("Particles", hasGrains)})
            if (!isThere) file.refuse(fmt::format("has no section {}: it is damaged, or not whole", word));
        objects.finish();
        return std::move(state);
    }

private:
    void readLine() {
        const std::string_view word = lines.first();
        if (word == "Species") return readSpecies();
        if (word == "Walls") return section([&] { objects.addWall(lines); });
        if (word == "Boundaries" || word == "WallsPeriodic")
            return section([&] { objects.addBoundary(lines); });
        if (word == "Particles") return hasGrains = true, section([&] { objects.addGrain(lines); });
        if (word == "FixedParticles" && lines.count(word) > 0)
            lines.refuse(
                "particles of the section FixedParticles are not in the file; add them in the driver");
        if (word == "Interactions") return section([&] { objects.addInteraction(lines); });
        if (!hasSpecies) {
            const bool isTitle = readTitle(lines, state);
            if (const auto at = lines.behind("name"); at && *at < lines.all().size() && !isOfFiles(word))
                state.name = lines.all()[*at];
            if (!isTitle) readHead(lines, state);
        } else if (isOfSection(lines, state)) {
            lines.refuse("this object is beyond the number that its section begins with");
        } else if (word != "FixedParticles") {
            passOver(lines, state);
        }
    }
    /// So many species, and the pairs of them wherever they stand between and behind them.
    void readSpecies() {
        hasSpecies = true;
        for (std::uint64_t left = lines.count("Species"); left > 0;) {
            lines.require();
            if (objects.addSpecies(lines)) --left;
        }
        // Behind the last one only pairs can follow.
        objects.onlyPairsFollow();
        while (lines.next()) {
            if (!objects.isOfSpecies(lines)) return readLine();
            objects.addSpecies(lines);
        }
    }
    template <class ReadOne>
    void section(ReadOne&& readOne) {
        for (std::uint64_t left = lines.count(lines.first()); left > 0; --left) {
            lines.require();
            readOne();
        }
    }

    InputFile file;
    Lines lines{file};
    MercuryRestart state;
    MercuryRestartObjects objects{state};
    bool hasSpecies = false, hasGrains = false;
};

}  // namespace

bool isMercuryRestart(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string word;
    file.width(64);  // of a file without blanks no more than this is read
    return file >> word && (word == "restart_version" || word == "MercuryDPM");
}

std::filesystem::path withRestartEnding(const std::filesystem::path& file) {
    std::error_code problem;
    std::filesystem::path longer = file;
    longer += ".restart";
    const bool isShort = !std::filesystem::exists(file, problem) && std::filesystem::exists(longer, problem);
    return isShort ? longer : file;
}

MercuryRestart readMercuryRestart(const std::filesystem::path& path) {
    return MercuryRestartReader(path).read();
}

void MercuryRestart::refuse(std::size_t line, std::string_view reason) const {
    throw InputError(fmt::format("The restart file {}, line {}: {}.", file.string(), line, reason));
}

std::string MercuryRestart::summary() const {
    const auto held = std::ranges::count(grains, 0.0, &Grain::inverseMass);
    const auto remembering = std::ranges::count_if(histories, &History::remembers);
    std::string text = fmt::format(
        "{}, of MercuryDPM (version {}) at {} s: {} species, {} walls, {} boundaries, {} particles ({} "
        "fixed), "
        "{} contacts with a history",
        file.string(), version, time, species.size(), walls.size(), periods.size() + deletions.size(),
        grains.size(), held, remembering);
    if (passedOver.empty()) return text + ".";
    std::vector<std::string> words;
    for (const auto& [word, count] : passedOver)
        words.push_back(count > 1 ? fmt::format("{} ({} times)", word, count) : word);
    return fmt::format("{}; passed over: {}.", text, fmt::join(words, ", "));
}

}  // namespace pendular
