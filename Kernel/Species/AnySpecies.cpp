#include "Kernel/Species/AnySpecies.h"

#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Species/LawNames.h"

namespace pendular {

bool AnyLaws::has(std::string_view field) {
    return std::ranges::count(fields(), field, &NamedField::name) > 0;
}

NamedField AnyLaws::fieldOf(std::string_view name) {
    std::vector<std::string_view> names;
    for (const NamedField& field : fields()) {
        if (field.name == name) return field;
        names.push_back(field.name);
    }
    unknownName(fmt::format("field of {}", getName()), name, names);
}

double AnyLaws::get(std::string_view field) { return *fieldOf(field).value; }

void AnyLaws::set(std::string_view field, double value) {
    const NamedField found = fieldOf(field);
    checkValue(found.law, found.name, value, found.unit, found.range);
    *found.value = value;
}

void AnyLaws::visitState(StateArchive& archive, bool changedInRun) {
    archive.same("name", getName());
    for (const NamedField& field : fields())
        archive.group(field.law, [&] {
            if (changedInRun) archive.value(field.name, *field.value);
            else archive.same(field.name, *field.value, field.unit);
        });
}

void AnySpecies::set(std::string_view field, double value) {
    if (field == "density") setDensity(value);
    else AnyLaws::set(field, value);
}

double AnySpecies::get(std::string_view field) {
    return field == "density" ? getDensity() : AnyLaws::get(field);
}

void AnySpecies::visitState(StateArchive& archive, bool changedInRun) {
    double density = getDensity();
    if (changedInRun) archive.value("density", density);
    else archive.same("density", density, "kg/m^3");
    if (archive.isReading() && changedInRun) setDensity(density);
    AnyLaws::visitState(archive, changedInRun);
}

}  // namespace pendular
