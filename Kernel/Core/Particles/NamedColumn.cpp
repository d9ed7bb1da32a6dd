#include "Kernel/Core/Particles/NamedColumn.h"

#include <fmt/format.h>

#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileName.h"

namespace pendular {

void requireNewColumn(const NamedColumn& added, std::string_view owners, bool isTaken) {
    if (added.name.empty() || !isWord(added.name))
        throw InputError(fmt::format("The name '{}' of a column of {} must have letters, digits and _ only.",
                                     printable(added.name), owners));
    if (!isWord(added.unit))
        throw InputError(fmt::format(
            "The unit '{}' of the column '{}' of the {} must have letters, digits and _ only (as m_per_s).",
            printable(added.unit), added.name, owners));
    // What files have of their own, wherever they have it.
    if (added.fieldName() == (owners == "grains" ? "position_m" : "contact_point_m"))
        throw InputError(
            fmt::format("The column '{}' of the {} would have the name {} in files, which is taken.",
                        added.name, owners, added.fieldName()));
    if (isTaken)
        throw InputError(fmt::format("There is a column '{}' of the {} already.", added.name, owners));
    if (!std::isfinite(added.initial))
        throw InputError(fmt::format("The column '{}' of the {} starts at {}{}{}; it must be finite.",
                                     added.name, owners, added.initial, added.unit.empty() ? "" : " ",
                                     added.unit));
}

}  // namespace pendular
