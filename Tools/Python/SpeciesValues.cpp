#include "Tools/Python/SpeciesValues.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/ElasticConstants.h"
#include "Kernel/Laws/Species/LawNames.h"

namespace pendular::python {

namespace {

constexpr std::string_view ending = "Species";

}  // namespace

std::string typeNamed(std::string name) {
    if (!name.ends_with(ending)) name += ending;
    return name;
}
std::string withoutEnding(std::string_view name) {
    return std::string(name.substr(0, name.size() - (name.ends_with(ending) ? ending.size() : 0)));
}

Values valuesOf(const py::kwargs& given) {
    Values values;
    for (const auto& [key, value] : given) {
        const std::string name = py::str(key);
        values[camelCase(name)] = valueOf<double>(value, name, "a number");
    }
    nameYoungModulus(values);
    return values;
}

void nameYoungModulus(Values& values) {
    if (values.contains("poissonRatio") && values.contains("elasticModulus") &&
        !values.contains("youngModulus"))
        values.insert({"youngModulus", values.extract("elasticModulus").mapped()});
}

std::string nameOfSetter(const NamedSetter& setter, const SetterValue& value) {
    if (setter.values.size() == 1) return snakeCase(setter.name);
    if (value.name == "elasticModulus") return "young_modulus";
    return value.name == "restitution" ? "restitution_coefficient" : snakeCase(value.name);
}

std::string togetherWith(AnyLaws& laws, const std::string& name) {
    std::string all;
    for (const NamedSetter& setter : laws.setters()) {
        std::vector<std::string> names;
        bool isIts = false;
        for (const SetterValue& value : setter.values) {
            names.push_back(nameOfSetter(setter, value));
            isIts = isIts || names.back() == name || snakeCase(value.name) == name;
        }
        if (names.size() == 1 || !isIts) continue;
        const std::string last = names.back();
        names.pop_back();
        all += fmt::format("{}{} and {}", all.empty() ? "" : ", or ",
                           listOfNames({names.begin(), names.end()}), last);
    }
    return all;
}

void refuseName(AnyLaws& laws, const std::string& name) {
    if (const std::string names = togetherWith(laws, snakeCase(name)); !names.empty())
        throw InputError(fmt::format("{}: {} are given together.", laws.getName(), names));
    std::set<std::string> known;
    for (const NamedSetter& setter : laws.setters())
        for (const SetterValue& value : setter.values) known.insert(nameOfSetter(setter, value));
    const std::vector<std::string_view> names(known.begin(), known.end());
    unknownName(fmt::format("field of {}", laws.getName()), snakeCase(name), names);
}

namespace {

/// Moduli come before what is computed from them.
bool isAfterFields(const NamedSetter& setter) {
    return setter.name.find("estitution") != std::string_view::npos;
}

/// The values of a setter, by their own names or, of a single one, by that of the setter; empty unless all
/// are given.
std::vector<double> takenBy(const NamedSetter& setter, const Values& values) {
    std::vector<double> taken;
    for (const SetterValue& value : setter.values) {
        auto found = values.find(std::string(setter.values.size() == 1 ? setter.name : value.name));
        if (found == values.end() && value.name == "restitution")
            found = values.find("restitutionCoefficient");
        if (found == values.end()) return {};
        taken.push_back(found->second);
    }
    return taken;
}

/// A setter that is to be called, whose values are all given.
struct PlannedCall {
    std::string given;                // names of its values
    std::vector<std::string> fields;  // which it gives values
    std::function<void()> call;
};

bool hasWord(std::string_view text, std::string_view word) {
    const auto isLetter = [&](std::size_t at) {
        return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at])) != 0;
    };
    for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1))
        if ((at == 0 || !isLetter(at - 1)) && !isLetter(at + word.size())) return true;
    return false;
}

/// The fields that a setter gives values; the kernel's tables name them.
std::vector<std::string> fieldsOf(const NamedSetter& setter, const std::vector<NamedSetter>& all) {
    if (setter.gives.empty()) return {std::string(setter.name)};
    std::vector<std::string> found;
    for (const NamedSetter& field : all)
        if (field.gives.empty() && hasWord(setter.gives, field.name)) found.emplace_back(field.name);
    return found;
}

/// Young's modulus and Poisson's ratio give E* and, with Mindlin, G* of two grains of the material.
void planElasticConstants(AnyLaws& laws, Values& values, std::vector<PlannedCall>& plan) {
    const auto young = values.find("youngModulus"), poisson = values.find("poissonRatio");
    if (young == values.end() && poisson == values.end()) return;
    if (young == values.end() || poisson == values.end())
        throw InputError("young_modulus and poisson_ratio are given together.");
    if (!laws.has("effectiveElasticModulus")) refuseName(laws, "youngModulus");
    std::vector<std::string> fields{"effectiveElasticModulus"};
    if (laws.has("effectiveShearModulus")) fields.emplace_back("effectiveShearModulus");
    plan.push_back({"young_modulus and poisson_ratio", fields,
                    [&laws, e = young->second, nu = poisson->second] { setElasticConstants(laws, e, nu); }});
    values.erase(young), values.erase(poisson);
}

/// The setters all of whose values are given, those of most values first.
std::vector<PlannedCall> planOf(AnyLaws& laws, Values values) {
    std::vector<PlannedCall> plan;
    planElasticConstants(laws, values, plan);
    std::vector<NamedSetter> setters = laws.setters();
    std::ranges::stable_sort(setters, [](const NamedSetter& a, const NamedSetter& b) {
        if (a.values.size() != b.values.size()) return a.values.size() > b.values.size();
        return isAfterFields(a) < isAfterFields(b);
    });
    for (const NamedSetter& setter : setters) {
        const std::vector<double> taken = takenBy(setter, values);
        if (taken.empty()) continue;
        std::vector<std::string> names;
        for (const SetterValue& value : setter.values) {
            names.push_back(snakeCase(setter.values.size() == 1 ? setter.name : value.name));
            values.erase(std::string(value.name));
        }
        values.erase(std::string(setter.name));
        if (setter.values.size() > 1) values.erase("restitutionCoefficient");
        plan.push_back({fmt::format("{}", fmt::join(names, ", ")), fieldsOf(setter, setters),
                        [set = setter.set, taken] { set(taken); }});
    }
    if (!values.empty()) refuseName(laws, values.begin()->first);
    return plan;
}

/// Of two values that give the same field, one would be lost.
void refuseContradictions(const AnyLaws& laws, const std::vector<PlannedCall>& plan) {
    std::map<std::string, std::string> givenBy;
    for (const PlannedCall& planned : plan)
        for (const std::string& field : planned.fields)
            if (const auto [other, isFirst] = givenBy.try_emplace(field, planned.given); !isFirst)
                throw InputError(fmt::format("{}: {} and {} both give its {}; leave one out.",
                                             withoutEnding(laws.getName()), other->second, planned.given,
                                             snakeCase(field)));
}

}  // namespace

void checkNames(AnyLaws& laws, const Values& values) { refuseContradictions(laws, planOf(laws, values)); }

void setValues(AnyLaws& laws, const Values& values) {
    const std::vector<PlannedCall> plan = planOf(laws, values);
    refuseContradictions(laws, plan);
    std::vector<std::pair<double*, double>> before;
    for (const NamedField& field : laws.fields()) before.emplace_back(field.value, *field.value);
    auto* const species = dynamic_cast<AnySpecies*>(&laws);
    const double density = species ? species->getDensity() : unset;
    try {
        for (const PlannedCall& planned : plan) planned.call();
    } catch (...) {
        for (const auto& [place, value] : before) *place = value;
        if (isSet(density) && species->getDensity() != density) species->setDensity(density);
        throw;
    }
}

}  // namespace pendular::python
