#include "Kernel/Mercury/MercuryRestart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "Kernel/Files/TextFile.h"

namespace pendular {
namespace {

/// The lines of a file, one after the other, and their words.
class Lines {
public:
    explicit Lines(const InputFile& of) : file(of) {}

    /// The next line that is not empty; none at the end.
    bool next() {
        words.clear();
        while (words.empty() && at < file.text.size()) {
            const std::size_t end = std::min(file.text.find('\n', at), file.text.size());
            Words row(std::string_view(file.text).substr(at, end - at));
            for (std::string_view word = row.next(); !word.empty(); word = row.next()) words.push_back(word);
            at = end + 1;
            ++line;
        }
        return !words.empty();
    }
    void require() {
        if (!next()) refuse("the file ends here");
    }
    [[nodiscard]] const std::vector<std::string_view>& all() const { return words; }
    [[nodiscard]] double number(std::size_t word) const {
        double value = 0;
        if (word >= words.size()) refuse("a number is missing at its end");
        if (!parseNumber(words[word], value)) refuse(whyNoNumber(words[word]));
        return value;
    }
    [[nodiscard]] Vec3D vector(std::size_t word) const {
        return {number(word), number(word + 1), number(word + 2)};
    }
    /// The place behind a word of the line.
    [[nodiscard]] std::optional<std::size_t> behind(std::string_view word) const {
        for (std::size_t k = 0; k < words.size(); ++k)
            if (words[k] == word) return k + 1;
        return std::nullopt;
    }
    [[nodiscard]] std::size_t countBehind(std::string_view word) const {
        const double count = number(*behind(word));
        if (!(count >= 0 && count < 1e9)) refuse(fmt::format("{} is no number of things", count));
        return static_cast<std::size_t>(count);
    }
    [[noreturn]] void refuse(std::string_view reason) const { file.refuse("line", line, reason); }

private:
    const InputFile& file;
    std::vector<std::string_view> words;
    std::size_t at = 0, line = 0;
};

/// The kernel's name of a number of a species, in files of all versions.
std::string fieldOf(std::string_view word) {
    static const std::map<std::string_view, std::string_view> others{
        {"rho", "density"},
        {"k", "stiffness"},
        {"disp", "dissipation"},
        {"frictionCoefficient", "slidingFrictionCoefficient"},
        {"frictionCoefficientStatic", "slidingFrictionCoefficientStatic"}};
    const auto found = others.find(word);
    return std::string(found == others.end() ? word : found->second);
}

void readHead(const Lines& lines, MercuryRestart& state) {
    if (lines.behind("idMixed"))
        lines.refuse(
            "values of pairs of species are not taken over; set them by getMixedObject() in the driver");
    const auto take = [&](std::string_view word, double& to) {
        if (const auto at = lines.behind(word)) to = lines.number(*at);
    };
    constexpr std::array axes{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        take(fmt::format("{}Min", axes[axis]), state.lowest[axis]);
        take(fmt::format("{}Max", axes[axis]), state.highest[axis]);
    }
    take("timeStep", state.timeStep);
    take("timeMax", state.timeMax);
    if (const auto at = lines.behind("gravity")) state.gravity = lines.vector(*at);
    if (lines.behind("restart_version"))
        if (const auto at = lines.behind("name"); at && *at < lines.all().size())
            state.name = lines.all()[*at];
    if (lines.behind("dataFile"))
        if (const auto at = lines.behind("saveCount"))
            state.saveCount = static_cast<std::size_t>(lines.number(*at));
}

/// Rolling and torsion have one coefficient here: a static one must be the dynamic one, and is no field.
bool isDynamicAgain(const Lines& lines, std::size_t word) {
    const std::string_view name = lines.all()[word];
    for (const std::string_view dynamic : {"rollingFrictionCoefficient", "torsionFrictionCoefficient"}) {
        if (name != fmt::format("{}Static", dynamic)) continue;
        const auto value = lines.behind(dynamic);
        if (!value || lines.number(*value) != lines.number(word + 1))
            lines.refuse(fmt::format("{} is not {}, and rolling and torsion have one coefficient here", name,
                                     dynamic));
        return true;
    }
    return false;
}

MercuryRestart::Species speciesOf(const Lines& lines) {
    MercuryRestart::Species species{std::string(lines.all()[0]), {}};
    for (std::size_t k = 1; k + 1 < lines.all().size(); k += 2)
        if (lines.all()[k] != "id" && !isDynamicAgain(lines, k))
            species.fields.emplace_back(fieldOf(lines.all()[k]), lines.number(k + 1));
    return species;
}

MercuryRestart::Plane planeOf(const Lines& lines) {
    const auto species = lines.behind("indSpecies"), normal = lines.behind("normal"),
               position = lines.behind("position");
    if (lines.all()[0] != "InfiniteWall" || !species || !normal || !position)
        lines.refuse(fmt::format("'{}' is no plane (InfiniteWall); set other walls up in the driver",
                                 shown(lines.all()[0])));
    return {static_cast<std::size_t>(lines.number(*species)), lines.vector(*normal), lines.vector(*position)};
}

GrainRow grainOf(const Lines& lines) {
    const auto species = lines.behind("indSpecies"), position = lines.behind("position"),
               velocity = lines.behind("velocity"), spin = lines.behind("angularVelocity"),
               radius = lines.behind("radius");
    if (const auto at = lines.behind("invMass"); at && lines.number(*at) == 0)
        lines.refuse("a grain is held (invMass 0), which is not taken over; set it up in the driver");
    if (!species || !position || !velocity || !radius)
        lines.refuse("this is no grain with the words position, velocity, radius and indSpecies");
    return {.radius = lines.number(*radius),
            .position = lines.vector(*position),
            .velocity = lines.vector(*velocity),
            .angularVelocity = spin ? lines.vector(*spin) : Vec3D(0, 0, 0),
            .type = static_cast<int>(lines.number(*species)) + 1};
}

/// A contact that has begun and remembers nothing: all is zero that it remembers (springs of friction,
/// plastic overlaps, bonds), so that the first step makes it anew.
void passInteraction(const Lines& lines) {
    static const std::set<std::string_view> notRemembered{
        "particleIds", "particleWallIds", "id",      "timeStamp", "force", "torque",
        "position",    "contactPoint",    "overlap", "distance",  "normal"};
    std::string_view field;
    for (std::size_t k = 1; k < lines.all().size(); ++k) {
        double value = 0;
        if (!parseNumber(lines.all()[k], value)) field = lines.all()[k];
        else if (value != 0 && !notRemembered.contains(field))
            lines.refuse(
                fmt::format("a contact remembers '{}', which is not taken over; it must be 0", shown(field)));
    }
}

}  // namespace

bool isMercuryRestart(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string word;
    return file >> word && word == "restart_version";
}

MercuryRestart readMercuryRestart(const std::filesystem::path& path) {
    const InputFile file = loadTextFile("restart file", path);
    Lines lines(file);
    MercuryRestart state;
    const auto section = [&](std::string_view word, auto&& readOne) {
        for (std::size_t left = lines.countBehind(word); left > 0; --left) {
            lines.require();
            readOne();
        }
    };
    while (lines.next()) {
        const std::string_view first = lines.all()[0];
        if (first == "Species") section(first, [&] { state.species.push_back(speciesOf(lines)); });
        else if (first == "Walls") section(first, [&] { state.planes.push_back(planeOf(lines)); });
        else if (first == "Particles") section(first, [&] { state.grains.push_back(grainOf(lines)); });
        else if (first == "Interactions") section(first, [&] { passInteraction(lines); });
        else if (first == "Boundaries" && lines.countBehind(first) > 0)
            lines.refuse("boundaries are not taken over; set them up in the driver");
        else readHead(lines, state);
    }
    return state;
}

}  // namespace pendular
