#include "Kernel/Species/AnySpecies.h"

#include <fmt/format.h>

#include "Kernel/Species/LawNames.h"

namespace pendular {

const NamedField* AnyLaws::findField(std::string_view field) {
    if (known.empty()) known = fields();
    const auto found = std::ranges::find(known, field, &NamedField::name);
    return found == known.end() ? nullptr : &*found;
}

bool AnyLaws::has(std::string_view field) { return findField(field) != nullptr; }

double AnyLaws::get(std::string_view field) {
    if (const NamedField* const found = findField(field)) return *found->value;
    std::vector<std::string_view> names;
    for (const NamedField& f : known) names.push_back(f.name);
    unknownName(fmt::format("field of {}", getName()), field, names);
}

void AnyLaws::set(std::string_view field, double value) {
    static_cast<void>(AnyLaws::get(field));  // throws if there is none
    const NamedField& found = *findField(field);
    checkValue(found.law, found.name, value, found.unit, found.range);
    *found.value = value;
}

void AnyLaws::visitState(StateArchive& archive) {
    archive.same("name", getName());
    for (const NamedField& field : fields())
        archive.group(field.law, [&] { archive.same(field.name, *field.value, field.unit); });
}

void AnySpecies::set(std::string_view field, double value) {
    if (field == "density") setDensity(value);
    else AnyLaws::set(field, value);
}

double AnySpecies::get(std::string_view field) {
    return field == "density" ? getDensity() : AnyLaws::get(field);
}

void AnySpecies::visitState(StateArchive& archive) {
    archive.same("density", getDensity(), "kg/m^3");
    AnyLaws::visitState(archive);
}

}  // namespace pendular
