#include "Kernel/Particles/NamedColumn.h"

#include <fmt/format.h>

#include <cmath>

#include "Kernel/InputError.h"

namespace pendular {

void requireNewColumn(const NamedColumn& added, std::string_view owners, bool isTaken) {
    const auto isOfNames = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (added.name.empty() || !std::ranges::all_of(added.name, isOfNames))
        throw InputError(fmt::format("The name '{}' of a column of {} must have letters, digits and _ only.",
                                     added.name, owners));
    if (isTaken)
        throw InputError(fmt::format("There is a column '{}' of the {} already.", added.name, owners));
    if (!std::isfinite(added.initial))
        throw InputError(fmt::format("The column '{}' of the {} starts at {}{}{}; it must be finite.",
                                     added.name, owners, added.initial, added.unit.empty() ? "" : " ",
                                     added.unit));
}

}  // namespace pendular
