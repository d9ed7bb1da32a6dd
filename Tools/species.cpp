/// Lists the laws that species are composed of, and describes their parameters from the field tables.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Features/SpeciesByName/SeveralSpeciesHandler.h"
#include "Kernel/Laws/Concepts/Setter.h"
#include "Kernel/Laws/Species/LawNames.h"

using namespace pendular;

namespace {

std::string_view shown(std::string_view law) { return law.empty() ? std::string_view("none") : law; }

template <class Laws>
void listLaws(std::string_view kind) {
    fmt::print("{} laws\n", kind);
    Laws::forEach([]<class Law>() { fmt::print("  {:<30} {}\n", shown(Law::name), Law::summary); });
}

/// setDissipation of the field dissipation.
std::string setterOf(std::string_view field) {
    std::string name = "set" + std::string(field);
    name[3] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[3])));
    return name;
}

template <class Law>
void describe(const Setter<Law>& setter) {
    std::string values, ranges;
    for (const SetterValue& value : setter.values) {
        values += fmt::format("{}{}", values.empty() ? "" : ", ", value.name);
        ranges +=
            fmt::format("{}{} {}", ranges.empty() ? "" : ", ", value.name, value.range.text(value.unit));
    }
    fmt::print("Also `{}({})`, {}: sets {}.\n\n", setterOf(setter.name), values, ranges, setter.gives);
}

template <class Law>
void describeLaw() {
    fmt::print("## {}\n\n{}. Domain: {}.\n\n", shown(Law::name), Law::summary, Law::domain);
    if (Law::fields().empty()) return;
    fmt::print(
        "| field | setter | unit | range | default | mixing of a and b | meaning | source "
        "|\n|---|---|---|---|---|---|---|---|\n");
    const Law law;
    for (const auto& field : Law::fields()) {
        const double value = law.*field.member;
        const std::string standard = isSet(value)            ? fmt::format("{:.6g}", value)
                                     : field.ifUnset.empty() ? std::string("must be set")
                                                             : std::string(field.ifUnset);
        fmt::print("| {} | `{}` | {} | {} | {} | {} | {} | {} |\n", field.name, setterOf(field.name),
                   field.unit.empty() ? "-" : field.unit, field.range.text(field.unit), standard,
                   formula(field.mixing), field.meaning, field.source);
    }
    fmt::print("\n");
    for (const auto& setter : settersOf<Law>()) describe(setter);
}

struct LawEntry {
    std::string_view name;  // empty for a law that does nothing
    void (*describe)();
};

template <class Laws>
std::vector<LawEntry> entriesOf() {
    std::vector<LawEntry> entries;
    Laws::forEach([&]<class Law>() { entries.push_back({Law::name, describeLaw<Law>}); });
    return entries;
}

/// Calls function(name, normal, friction, adhesion) for every species.
template <class Function>
void forEachSpecies(Function&& function) {
    const auto frictions = entriesOf<FrictionLaws>(), adhesions = entriesOf<AdhesionLaws>();
    for (const LawEntry& normal : entriesOf<NormalLaws>())
        for (const LawEntry& friction : frictions)
            for (const LawEntry& adhesion : adhesions)
                function(fmt::format("{}{}{}Species", normal.name, friction.name, adhesion.name), normal,
                         friction, adhesion);
}

void list() {
    listLaws<NormalLaws>("Normal");
    listLaws<FrictionLaws>("Friction");
    listLaws<AdhesionLaws>("Adhesion");
    fmt::print(
        "Species: every normal law with every friction and every adhesion law; those with a * are "
        "instantiated, and can be chosen by name at run time\n");
    const std::vector<std::string_view> instantiated = instantiatedSpecies();
    forEachSpecies([&](const std::string& name, const LawEntry& normal, const LawEntry& friction,
                       const LawEntry& adhesion) {
        const bool isMarked = std::ranges::find(instantiated, name) != instantiated.end();
        fmt::print("{} {:<72} {} + {} + {}\n", isMarked ? '*' : ' ', name, normal.name, shown(friction.name),
                   shown(adhesion.name));
    });
}

/// Describes the law or the species of this name; all laws for "all".
void describe(std::string_view name) {
    bool found = false;
    std::vector<std::string> known;
    const std::string wanted = canonicalLawName(name);
    for (const auto& laws : {entriesOf<NormalLaws>(), entriesOf<FrictionLaws>(), entriesOf<AdhesionLaws>()})
        for (const LawEntry& law : laws) {
            if (law.name.empty()) continue;
            known.emplace_back(law.name);
            if (wanted != law.name && wanted != "all") continue;
            found = true;
            law.describe();
        }
    forEachSpecies([&](const std::string& species, const LawEntry& normal, const LawEntry& friction,
                       const LawEntry& adhesion) {
        known.push_back(species);
        if (wanted != species) return;
        found = true;
        fmt::print("# {}\n\nAlso: density, kg/m^3, greater than 0, `setDensity`; it must be set.\n\n",
                   species);
        for (const LawEntry* law : {&normal, &friction, &adhesion})
            if (!law->name.empty()) law->describe();
    });
    if (!found) unknownName("law or species", name, {known.begin(), known.end()});
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("The laws and species of Pendular and their parameters.");
    bool listed = false;
    std::string described;
    app.add_flag("--list", listed, "name all laws and species, a line each");
    app.add_option(
        "--describe", described,
        "table of the parameters of a law or a species, with their setters, units and allowed values "
        "(all: of every law)");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] {
        if (!described.empty()) describe(described);
        else if (listed) list();
        else fmt::print("{}", app.help());
        return 0;
    });
}
