// The species and particles of MercuryDPM's restart files of the versions 2 and 3, which give their numbers
// in a fixed order.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "Kernel/Mercury/MercuryRestartObjects.h"

namespace pendular {
namespace {

using Lines = MercuryRestartLines;

/// A name of these versions, and the kernel's; that of a plastic law where it is another one.
struct OldField {
    std::string_view old, now, ofPlastic = {};
};
constexpr std::array oldFields{OldField{"rho", "density"},
                               OldField{"k", "stiffness", "loadingStiffness"},
                               OldField{"k2max", "unloadingStiffnessMax"},
                               OldField{"kc", "cohesionStiffness"},
                               OldField{"depth", "penetrationDepthMax"},
                               OldField{"disp", "dissipation"},
                               OldField{"kt", "slidingStiffness"},
                               OldField{"dispt", "slidingDissipation"},
                               OldField{"mu", "slidingFrictionCoefficient"},
                               OldField{"mus", "slidingFrictionCoefficientStatic"},
                               OldField{"krolling", "rollingStiffness"},
                               OldField{"disprolling", "rollingDissipation"},
                               OldField{"murolling", "rollingFrictionCoefficient"},
                               OldField{"ktorsion", "torsionStiffness"},
                               OldField{"disptorsion", "torsionDissipation"},
                               OldField{"mutorsion", "torsionFrictionCoefficient"}};

bool isPositive(const Lines& lines, std::initializer_list<std::string_view> words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return lines.value(word, 0) > 0; });
}

/// The springs of a particle, or its flattened contacts: their count, and so many numbers each.
class OldContacts {
public:
    OldContacts(const Lines& of, std::size_t place) : lines(of), at(place) {}
    [[nodiscard]] std::size_t end() const { return at; }
    /// @param read called with the place of the numbers of each that has not ended by the time (s)
    template <class Read>
    void forEach(std::size_t numbers, double time, Read&& read) {
        const std::uint64_t count = lines.wholeAt(at++);
        for (std::uint64_t k = 0; k < count; ++k, at += numbers)
            if (lines.numberAt(at + numbers - 1) >= time) read(at, at + numbers - 3);
    }

private:
    const Lines& lines;
    std::size_t at;
};

}  // namespace

/// The law follows from the parameters that are not 0; friction against rolling and torsion has the lever 2
/// R*.
void MercuryRestartObjects::addOldSpecies(const MercuryRestartLines& lines) {
    const bool isPlastic = lines.has("k2max"), isPair = lines.has("(mixed)");
    std::string_view friction;
    if (isPositive(lines, {"murolling", "mutorsion"})) friction = "Friction";
    else if (isPositive(lines, {"mu"})) friction = "SlidingFriction";
    MercuryRestart::Species species{
        fmt::format("{}{}Species", isPlastic ? "LinearPlasticViscoelastic" : "LinearViscoelastic", friction),
        {},
        lines.number()};
    for (std::size_t k = 0; k + 1 < lines.all().size() && lines.all()[k] != "(mixed)"; k += 2) {
        const std::string_view word = lines.all()[k];
        const double value = lines.numberAt(k + 1);
        if (word == "dim_particle") {
            if (!isPair) state->particleDimensions = static_cast<int>(lines.wholeAt(k + 1));
            continue;
        }
        const auto field = std::ranges::find(oldFields, word, &OldField::old);
        if (field == oldFields.end())
            lines.refuse(
                fmt::format("the species has '{}' = {}, which is not taken over", shownName(word), value));
        const std::string_view now = isPlastic && !field->ofPlastic.empty() ? field->ofPlastic : field->now;
        const bool isRotation = now.starts_with("rolling") || now.starts_with("torsion");
        const bool isOfNone = (now.starts_with("sliding") && friction.empty()) ||
                              (isRotation && friction != "Friction") || (isPair && now == "density") ||
                              (word == "mus" && value == lines.value("mu", 0));
        if (!isOfNone) species.fields.emplace_back(now, value);
    }
    if (!isPair) return state->species.push_back(std::move(species));
    const std::size_t pairs = state->pairs.size();
    // By rows of the triangle of all pairs: 1 0, 2 0, 2 1, ...
    std::size_t a = 1;
    while (a * (a + 1) / 2 <= pairs) ++a;
    state->pairs.push_back({a, pairs - a * (a - 1) / 2, std::move(species)});
}

/// [DMP] [TSP] [BP] position velocity radius angles spin 1/mass 1/inertia [species] [springs] [flattenings]:
/// version 3 has the words and the species, version 2 has springs and no species.
void MercuryRestartObjects::addOldGrain(const MercuryRestartLines& lines) {
    std::size_t at = 0;
    bool hasSprings = state->version == "2", hasFlattening = false;
    for (; at < lines.all().size() && lines.countAt(at) == 0; ++at) {
        const std::string_view word = lines.all()[at];
        if (word == "TSP") hasSprings = true;
        else if (word == "DMP") hasFlattening = true;
        else if (word != "BP")
            lines.refuse(fmt::format("particles of the type '{}' are not taken over", shownName(word)));
    }
    const bool hasSpecies = state->version != "2";
    if (lines.numberAt(at + 13) < 0) lines.refuse("the inverse of its mass is less than 0");
    const std::size_t self = state->grains.size();
    state->grains.push_back({.row = {.radius = lines.numberAt(at + 6),
                                     .position = lines.vectorAt(at),
                                     .velocity = lines.vectorAt(at + 3),
                                     .angularVelocity = lines.vectorAt(at + 10),
                                     .type = hasSpecies ? static_cast<int>(lines.wholeAt(at + 15)) + 1 : 1},
                             .id = self,
                             .inverseMass = lines.numberAt(at + 13),
                             .line = lines.number()});
    // Each is of the particle that has it, against the particle or the wall with this number.
    const auto history = [&](std::size_t partner) {
        MercuryRestart::History one{.first = self, .line = lines.number()};
        one.isWithWall = lines.numberAt(partner) < 0;
        one.second = lines.wholeAt(one.isWithWall ? partner + 1 : partner);
        return one;
    };
    OldContacts contacts(lines, at + (hasSpecies ? 16 : 15));
    if (hasSprings)
        contacts.forEach(hasSpecies ? 12 : 6, state->time, [&](std::size_t from, std::size_t partner) {
            MercuryRestart::History one = history(partner);
            one.sliding = lines.vectorAt(from);
            if (hasSpecies) one.rolling = lines.vectorAt(from + 3), one.torsion = lines.vectorAt(from + 6);
            state->histories.push_back(one);
        });
    if (hasFlattening)
        contacts.forEach(4, state->time, [&](std::size_t from, std::size_t partner) {
            MercuryRestart::History one = history(partner);
            one.flattening = lines.numberAt(from);
            state->histories.push_back(one);
        });
    if (contacts.end() < lines.all().size())
        lines.refuse(fmt::format("the particle has {} numbers more than are known of it",
                                 lines.all().size() - contacts.end()));
}

void MercuryRestartObjects::finish() {
    for (const MercuryRestart::Pair& pair : state->pairs)
        if (std::max(pair.a, pair.b) >= state->species.size())
            state->refuse(pair.laws.line, fmt::format("it is of the species {} and {}, and the file has {}",
                                                      pair.a, pair.b, state->species.size()));
    const auto requireSpecies = [&](std::size_t species, std::size_t line) {
        if (species >= state->species.size())
            state->refuse(line, fmt::format("indSpecies is {}, and the file has {} species", species,
                                            state->species.size()));
    };
    for (const MercuryRestart::Wall& wall : state->walls) requireSpecies(wall.species, wall.line);
    for (const MercuryRestart::Grain& grain : state->grains)
        requireSpecies(static_cast<std::size_t>(std::max(0, grain.row.type - 1)), grain.line);
    for (const MercuryRestart::History& one : state->histories)
        if (one.second >= (one.isWithWall ? state->walls.size() : state->grains.size()))
            state->refuse(one.line, fmt::format("a contact is with {} {}, which is not there",
                                                one.isWithWall ? "wall" : "particle", one.second));
}

}  // namespace pendular
