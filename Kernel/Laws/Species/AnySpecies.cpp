#include "Kernel/Laws/Species/AnySpecies.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Species/LawNames.h"

namespace pendular {

bool AnyLaws::has(std::string_view field) {
    return std::ranges::count(fields(), field, &NamedField::name) > 0;
}

std::vector<NamedSetter> AnyLaws::setters() {
    std::vector<NamedSetter> found;
    for (const NamedField& field : fields())
        found.push_back({field.law,
                         field.name,
                         {{field.name, field.unit, field.range}},
                         {},
                         [field](std::span<const double> values) {
                             checkValue(field.law, field.name, values[0], field.unit, field.range);
                             *field.value = values[0];
                         },
                         [field] { return *field.value; }});
    for (NamedSetter& setter : derivedSetters()) found.push_back(std::move(setter));
    return found;
}

NamedSetter AnyLaws::setterOf(std::string_view name) {
    std::vector<std::string_view> names;
    for (NamedSetter& setter : setters()) {
        if (setter.name == name) return std::move(setter);
        names.push_back(setter.name);
    }
    unknownName(fmt::format("field of {}", getName()), name, names);
}

double AnyLaws::get(std::string_view name) {
    const NamedSetter found = setterOf(name);
    if (!found.get)
        throw InputError(
            fmt::format("{}: {} can be set and not read; read {}.", found.law, name, found.gives));
    return found.get();
}

void AnyLaws::set(std::string_view name, std::span<const double> values) {
    const NamedSetter found = setterOf(name);
    if (values.size() != found.values.size()) {
        std::string taken;
        for (const SetterValue& value : found.values)
            taken +=
                fmt::format("{}{} {}", taken.empty() ? "" : ", ", value.name, value.range.text(value.unit));
        throw InputError(fmt::format("{}: {} takes {} value{} and was given {}: {}.", found.law, name,
                                     found.values.size(), found.values.size() == 1 ? "" : "s", values.size(),
                                     taken));
    }
    found.set(values);
}

void AnyLaws::visitState(StateArchive& archive, bool changedInRun) {
    archive.same("name", getName());
    for (const NamedField& field : fields())
        archive.group(field.law, [&] {
            if (changedInRun) archive.value(field.name, *field.value);
            else archive.same(field.name, *field.value, field.unit);
        });
}

std::vector<NamedSetter> AnySpecies::setters() {
    std::vector<NamedSetter> found = AnyLaws::setters();
    found.insert(found.begin(), {getName(),
                                 "density",
                                 {{"density", "kg/m^3", positive}},
                                 {},
                                 [this](std::span<const double> values) { setDensity(values[0]); },
                                 [this] { return getDensity(); }});
    return found;
}

void AnySpecies::visitState(StateArchive& archive, bool changedInRun) {
    double density = getDensity();
    if (changedInRun) archive.value("density", density);
    else archive.same("density", density, "kg/m^3");
    if (archive.isReading() && changedInRun) setDensity(density);
    AnyLaws::visitState(archive, changedInRun);
}

}  // namespace pendular
